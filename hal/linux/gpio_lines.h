/*
 * gpio_lines: the few things that Pinhole wants of libgpiod. gpiod1/ and gpiod2/ do them with version 1 and 2 of it,
 * nogpiod/ refuses. Private to hal/linux. Results: 0 (or a value), or -errno.
 */
#ifndef HAL_LINUX_GPIO_LINES_H
#define HAL_LINUX_GPIO_LINES_H

#include "linux.h"

#define GPIO_CONSUMER "pinhole"

enum gpio_use { GPIO_OUT, GPIO_IN_RISING, GPIO_IN_BOTH };

struct gpio_want {
    enum gpio_use use;
    bool level; /* GPIO_OUT: at first, on the wire */
    bool pull_up, pull_down;
    uint32_t debounce_us; /* where the version can: gpio_debounces() */
};

const char *gpio_version(void);

/* Whether edges arrive debounced. */
bool gpio_debounces(void);

/* NULL and errno. path: "/dev/gpiochip0". */
void *gpio_chip_open(const char *path);
void gpio_chip_close(void *chip);
int gpio_chip_label(void *chip, char *label, size_t size);
int gpio_chip_lines(void *chip); /* how many it has */

/* Offset of the line of this name, or -ENOENT. */
int gpio_chip_find(void *chip, const char *name);

/* Fills name, taken and holder. */
int gpio_chip_look(void *chip, unsigned offset, struct linux_line_look *look);

/* Takes a line. The chip becomes the line's if this succeeds; gpio_release closes it. */
int gpio_request(struct linux_line *line, void *chip, unsigned offset, const struct gpio_want *want);
void gpio_release(struct linux_line *line);

/* Levels are those on the wire. */
int gpio_set(struct linux_line *line, bool level);
int gpio_get(struct linux_line *line);

/* Readable while an edge waits. */
int gpio_descriptor(struct linux_line *line);

/* Takes the edge that waits (blocks if none does): 1 rising, 0 falling; its time by CLOCK_MONOTONIC. */
int gpio_edge(struct linux_line *line, uint64_t *time_ns);

#endif
