/*
 * linux: display kits on single-board computers: pixels through spidev, all other lines through libgpiod.
 *
 *   static struct linux_hal context;                  all zeros; .spi_path may be set
 *   struct hal hal = {&linux_ops, &context};
 *   if (hal.ops->open(&context, board) < 0) { puts(linux_hal_error(&context)); }
 *
 * The board is one of boards/, or one that the caller makes at run time; it must stay while the kit is open. The
 * kernel's SPI driver moves clock, data and select. D/C, reset, backlight, TE and buttons are lines with names such as
 *
 *   "GPIO25"            a line that the kernel calls so, on any chip
 *   "gpiochip0:25"      line 25 of /dev/gpiochip0 (or "/dev/gpiochip0:25")
 *   "pinctrl-rp1:25"    line 25 of the chip with this label
 *
 * Where the kernel gives lines no names, "GPIOn" is line n of the first chip with a label in board->gpio_labels.
 * A pin without a name (BOARD_PIN) is refused: chips are numbered differently from one kernel to the next.
 *
 * bus_write copies. A thread of the kit sends the copies and moves D/C, while the caller goes on; it joins and divides
 * what has the same D/C, so that transfers are as long as spidev takes (bufsiz). The next bus_write or bus_wait returns
 * the error of a write, once. One thread at a time may call the functions of a kit. Kits do not know of each other.
 *
 * Without libgpiod (its folder is chosen when Pinhole is built) a board with lines cannot be opened, and says so.
 * linux_look.h looks at SPI and lines without taking them.
 */
#ifndef HAL_LINUX_H
#define HAL_LINUX_H

#include "linux_look.h"
#include "linux_types.h"

/* bus_read and te_wait return HAL_ENOSYS where data_in or tearing is not wired. */
extern const struct hal_ops linux_ops;

/* One line on the last error: what happened, where, what to do. "" if there was none. */
const char *linux_hal_error(const struct linux_hal *h);

/*
 * The bits per second of the fastest large write since bus_clock, with the kernel's time for it. The clock on the wire,
 * which spidev does not tell, is at least this, and at most what was asked for. 0: none was sent, or no clock is set.
 * Call it while the bus is idle (after bus_wait).
 */
uint32_t linux_hal_bits_per_second(const struct linux_hal *h);

#endif
