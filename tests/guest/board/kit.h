/* SPDX-License-Identifier: Dual MIT/GPL */
/*
 * pinhole_kit: a Raspberry Pi's header as the kernel sees it, without the hardware. One GPIO chip, one SPI controller
 * with two chip selects (a spidev each), and /dev/pinhole-kit, from which the events of host-sim/wire/wire_events.h are
 * read and into which faults are written.
 *
 * Parameters: label (of the GPIO chip), names=pi|old|none (of its lines), core_hz (what the SPI clock is divided from),
 * log_kb (memory for events), persist=0 (lines that are released become inputs).
 *
 * /dev/pinhole-kit, read: the events so far; at their end a read returns nothing, or waits after "follow".
 * /dev/pinhole-kit, written, a command a line:
 *   follow | end                 readers wait at the end of the events | they no longer do
 *   mark TEXT                    a note among the events
 *   set LINE 0|1                 drives a line from outside (a button, TE)
 *   te LINE HZ                   pulses of 100 us on a line; 0: none
 *   busy LINE | free LINE        somebody else ("kit") holds the line | lets it go
 *   dir-error LINE ERRNO         making the line an output fails; 0: no longer
 *   spi-error N ERRNO [COUNT]    the N-th transfer from now (1: the next) fails, and those after it, COUNT in all
 *   spi-setup-error N ERRNO      the N-th change from now of mode, bits a word or speed is refused
 *   spi-stall N MS | spi-go      the N-th transfer from now ("note spi stall") takes MS longer | no more
 *   wire-time 0|1                transfers take the time of their bits
 *   reply HEX...                 what the panel sends when it is read, from the next read on
 *   spi-unplug N                 unplug during the N-th transfer from now
 *   unplug                       GPIO chip and SPI devices vanish, open or not (start another guest afterwards)
 */
#ifndef PINHOLE_KIT_H
#define PINHOLE_KIT_H

#include <linux/types.h>

#define KIT_LINES 54

/* ---- kit_log.c: events ---- */
int kit_log_init(size_t bytes);
void kit_log_exit(void);
u64 kit_now(void); /* ns since the module was loaded */
void kit_log(const char *format, ...) __printf(1, 2);
/* ... with bytes (at most 4000) in hexadecimal behind it. */
void kit_log_bytes(const u8 *bytes, size_t n, const char *format, ...) __printf(3, 4);
/* Waits until there is room for n bytes and their line; may sleep. */
void kit_log_room(size_t n);
void kit_log_follow(bool on);
extern const struct file_operations kit_log_fops;

/* A line written to /dev/pinhole-kit (kit_main.c). 0 or a negative errno. */
int kit_command(char *line);
void kit_unplug_soon(void); /* from any context */

/* ---- kit_gpio.c ---- */
struct device;
int kit_gpio_init(struct device *parent);
void kit_gpio_exit(void);
u64 kit_gpio_levels(void);
/* From now on level events are kept back; the levels now. */
u64 kit_gpio_hold(void);
/* What they are, with every line that has moved in between shown as moved; the level events go on. */
u64 kit_gpio_release(u64 levels);
int kit_gpio_command(const char *verb, char *rest);

/* ---- kit_spi.c ---- */
int kit_spi_init(struct device *parent);
void kit_spi_exit(void);
int kit_spi_command(const char *verb, char *rest);

#endif
