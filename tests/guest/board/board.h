/* SPDX-License-Identifier: Dual MIT/GPL */
/*
 * virtual_board: a Raspberry Pi's header as the kernel sees it, without the hardware. One GPIO chip, one SPI controller
 * with two chip selects (a spidev each), one I2C controller (bus 1), and /dev/virtual-board, from which the events of
 * host-sim/wire/wire_events.h are read and into which faults are written.
 *
 * Parameters: label (of the GPIO chip), names=pi|old|none (of its lines), core_hz (what the SPI clock is divided from),
 * log_kb (memory for events), persist=0 (lines that are released become inputs).
 *
 * /dev/virtual-board, read: the events so far; at their end a read returns nothing, or waits after "follow".
 * /dev/virtual-board, written, a command a line:
 *   follow | end                 readers wait at the end of the events | they no longer do
 *   mark TEXT                    a note among the events
 *   set LINE 0|1                 drives a line from outside (a button, TE)
 *   te LINE HZ                   pulses of 100 us on a line; 0: none
 *   busy LINE | free LINE        somebody else ("somebody") holds the line | lets it go
 *   dir-error LINE ERRNO         making the line an output fails; 0: no longer
 *   spi-error N ERRNO [COUNT]    the N-th transfer from now (1: the next) fails, and those after it, COUNT in all
 *   spi-setup-error N ERRNO      the N-th change from now of mode, bits a word or speed is refused
 *   spi-stall N MS | spi-go      the N-th transfer from now ("note spi stall") takes MS longer | no more
 *   wire-time 0|1                transfers take the time of their bits
 *   reply HEX...                 what the panel sends when it is read, from the next read on
 *   spi-unplug N                 unplug during the N-th transfer from now
 *   unplug                       GPIO chip and SPI devices vanish, open or not (start another guest afterwards)
 */
#ifndef VIRTUAL_BOARD_H
#define VIRTUAL_BOARD_H

#include <linux/types.h>

#define BOARD_LINES 54

/* ---- board_log.c: events ---- */
int board_log_init(size_t bytes);
void board_log_exit(void);
u64 board_now(void); /* ns since the module was loaded */
void board_log(const char *format, ...) __printf(1, 2);
/* Logs an event with bytes (at most 4000) in hexadecimal behind it. */
void board_log_bytes(const u8 *bytes, size_t n, const char *format, ...) __printf(3, 4);
/* Waits until there is room for n bytes and their line; may sleep. */
void board_log_room(size_t n);
void board_log_follow(bool on);
extern const struct file_operations board_log_fops;

/* A line written to /dev/virtual-board (board_main.c). 0 or a negative errno. */
int board_command(char *line);
void board_unplug_soon(void); /* from any context */

/* ---- board_gpio.c ---- */
struct device;
int board_gpio_init(struct device *parent);
void board_gpio_exit(void);
u64 board_gpio_levels(void);
/* Keeps level events back from now on; returns the levels now. */
u64 board_gpio_hold(void);
/* What they are, with every line that has moved in between shown as moved; the level events go on. */
u64 board_gpio_release(u64 levels);
int board_gpio_command(const char *verb, char *rest);

/* ---- board_spi.c ---- */
int board_spi_init(struct device *parent);
void board_spi_exit(void);

/* ---- board_i2c.c ---- */
int board_i2c_init(struct device *parent);
void board_i2c_exit(void);
int board_spi_command(const char *verb, char *rest);

#endif
