/* See gpio_lines.h. Built without libgpiod: every chip is refused with ENOSYS. */
#include "linux/gpio_lines.h"

#include <errno.h>
#include <stdio.h>

const char *linux_gpio_version(void)
{
    return NULL;
}

bool linux_gpio_debounces(void)
{
    return false;
}

void *linux_gpio_chip_open(const char *path)
{
    (void)path;
    errno = ENOSYS;
    return NULL;
}

void linux_gpio_chip_close(void *chip)
{
    (void)chip;
}

int linux_gpio_chip_label(void *chip, char *label, size_t size)
{
    (void)chip;
    snprintf(label, size, "%s", "");
    return -ENOSYS;
}

int linux_gpio_chip_lines(void *chip)
{
    (void)chip;
    return -ENOSYS;
}

int linux_gpio_chip_find(void *chip, const char *name)
{
    (void)chip;
    (void)name;
    return -ENOSYS;
}

int linux_gpio_chip_look(void *chip, unsigned offset, struct linux_line_look *look)
{
    (void)chip;
    (void)offset;
    (void)look;
    return -ENOSYS;
}

int linux_gpio_request(struct linux_line *line, void *chip, unsigned offset, const struct linux_gpio_want *want)
{
    (void)line;
    (void)chip;
    (void)offset;
    (void)want;
    return -ENOSYS;
}

void linux_gpio_release(struct linux_line *line)
{
    (void)line;
}

int linux_gpio_set(struct linux_line *line, bool level)
{
    (void)line;
    (void)level;
    return -ENOSYS;
}

int linux_gpio_get(struct linux_line *line)
{
    (void)line;
    return -ENOSYS;
}

int linux_gpio_descriptor(struct linux_line *line)
{
    (void)line;
    return -ENOSYS;
}

int linux_gpio_edge(struct linux_line *line, uint64_t *time_ns)
{
    (void)line;
    *time_ns = 0;
    return -ENOSYS;
}
