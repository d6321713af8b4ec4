/* See gpio_lines.h. libgpiod 1 (1.5 or later, for bias): Debian 11 and 12. */
#include "linux/gpio_lines.h"

#include <errno.h>
#include <gpiod.h>
#include <stdio.h>

const char *linux_gpio_version(void)
{
    return gpiod_version_string();
}

bool linux_gpio_debounces(void)
{
    return false;
}

void *linux_gpio_chip_open(const char *path)
{
    return gpiod_chip_open(path);
}

void linux_gpio_chip_close(void *chip)
{
    gpiod_chip_close(chip);
}

int linux_gpio_chip_label(void *chip, char *label, size_t size)
{
    snprintf(label, size, "%s", gpiod_chip_label(chip));
    return 0;
}

int linux_gpio_chip_lines(void *chip)
{
    return (int)gpiod_chip_num_lines(chip);
}

int linux_gpio_chip_find(void *chip, const char *name)
{
    struct gpiod_line *line = gpiod_chip_find_line(chip, name);
    return line == NULL ? -ENOENT : (int)gpiod_line_offset(line);
}

int linux_gpio_chip_look(void *chip, unsigned offset, struct linux_line_look *look)
{
    struct gpiod_line *line = gpiod_chip_get_line(chip, offset);
    if (line == NULL) {
        return -errno;
    }
    const char *name = gpiod_line_name(line);
    const char *holder = gpiod_line_consumer(line);
    look->taken = gpiod_line_is_used(line);
    snprintf(look->name, sizeof look->name, "%s", name == NULL ? "" : name);
    snprintf(look->holder, sizeof look->holder, "%s", holder == NULL ? "" : holder);
    return 0;
}

static int bias_flags(const struct linux_gpio_want *want)
{
    if (want->pull_up) {
        return GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
    }
    return want->pull_down ? GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN : 0;
}

static int take(struct gpiod_line *line, const struct linux_gpio_want *want)
{
    switch (want->use) {
    case GPIO_OUT:
        return gpiod_line_request_output(line, GPIO_CONSUMER, want->level);
    case GPIO_IN_RISING:
        return gpiod_line_request_rising_edge_events_flags(line, GPIO_CONSUMER, bias_flags(want));
    case GPIO_IN_BOTH:
        return gpiod_line_request_both_edges_events_flags(line, GPIO_CONSUMER, bias_flags(want));
    }
    errno = EINVAL;
    return -1;
}

int linux_gpio_request(struct linux_line *line, void *chip, unsigned offset, const struct linux_gpio_want *want)
{
    struct gpiod_line *taken = gpiod_chip_get_line(chip, offset);
    if (taken == NULL || take(taken, want) != 0) {
        return -errno;
    }
    line->chip = chip;
    line->request = taken;
    return 0;
}

void linux_gpio_release(struct linux_line *line)
{
    if (line->request != NULL) {
        gpiod_line_release(line->request);
        gpiod_chip_close(line->chip);
        *line = (struct linux_line){0};
    }
}

int linux_gpio_set(struct linux_line *line, bool level)
{
    return gpiod_line_set_value(line->request, level) == 0 ? 0 : -errno;
}

int linux_gpio_get(struct linux_line *line)
{
    const int level = gpiod_line_get_value(line->request);
    return level < 0 ? -errno : level;
}

int linux_gpio_descriptor(struct linux_line *line)
{
    return gpiod_line_event_get_fd(line->request);
}

int linux_gpio_edge(struct linux_line *line, uint64_t *time_ns)
{
    struct gpiod_line_event event;
    if (gpiod_line_event_read(line->request, &event) != 0) {
        return -errno;
    }
    *time_ns = (uint64_t)event.ts.tv_sec * 1000000000U + (uint64_t)event.ts.tv_nsec;
    return event.event_type == GPIOD_LINE_EVENT_RISING_EDGE;
}
