/* lines: finds a board's lines and takes them. Private to hal/linux. Results as in spi.h. */
#ifndef HAL_LINUX_LINES_H
#define HAL_LINUX_LINES_H

#include "gpio_lines.h"

/* Splits "chip:offset"; false if text is not of that form, so that it is a name. */
bool linux_line_place(const char *text, char chip[LINUX_PATH_SIZE], unsigned *offset);

/* n of "GPIOn"; -1 for other names. */
int linux_line_gpio_number(const char *name);

/* Takes the line of a pin. A pin that is not wired is no error; its line stays as it is. */
int linux_line_open(struct linux_line *line, const struct board *board, const struct board_pin *pin,
                    const struct linux_gpio_want *want, char error[LINUX_ERROR_SIZE]);

#endif
