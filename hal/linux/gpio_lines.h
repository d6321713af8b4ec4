/*
 * gpio_lines: the part of libgpiod that Pinhole needs. gpiod1/ and gpiod2/ give it with version 1 and 2 of libgpiod,
 * nogpiod/ refuses. Private to hal/linux. Results: 0 (or a value), or -errno, which lines.c turns into a hal_status.
 */
#ifndef HAL_LINUX_GPIO_LINES_H
#define HAL_LINUX_GPIO_LINES_H

#include "linux_types.h"

#define GPIO_CONSUMER "pinhole"

enum linux_gpio_use { GPIO_OUT, GPIO_IN_RISING, GPIO_IN_BOTH };

struct linux_gpio_want {
    enum linux_gpio_use use;
    bool level; /* GPIO_OUT: the first level on the wire */
    bool pull_up, pull_down;
    uint32_t debounce_us; /* used where linux_gpio_debounces() */
};

const char *linux_gpio_version(void);

/* Whether edges arrive debounced. */
bool linux_gpio_debounces(void);

/* Opens a chip by its path, "/dev/gpiochip0". NULL: errno says why. */
void *linux_gpio_chip_open(const char *path);
void linux_gpio_chip_close(void *chip);
int linux_gpio_chip_label(void *chip, char *label, size_t size);
int linux_gpio_chip_lines(void *chip); /* how many it has */

/* Offset of the line of this name, or -ENOENT. */
int linux_gpio_chip_find(void *chip, const char *name);

/* Fills name, taken and holder. */
int linux_gpio_chip_look(void *chip, unsigned offset, struct linux_line_look *look);

/* Takes a line. On success the chip belongs to the line, and linux_gpio_release closes it. */
int linux_gpio_request(struct linux_line *line, void *chip, unsigned offset, const struct linux_gpio_want *want);
void linux_gpio_release(struct linux_line *line);

/* Sets or reads a line. Levels are those on the wire. */
int linux_gpio_set(struct linux_line *line, bool level);
int linux_gpio_get(struct linux_line *line);

/* A descriptor that is readable while an edge waits. */
int linux_gpio_descriptor(struct linux_line *line);

/* Takes the edge that waits, or blocks until one comes: 1 rising, 0 falling. Its time is that of CLOCK_MONOTONIC. */
int linux_gpio_edge(struct linux_line *line, uint64_t *time_ns);

#endif
