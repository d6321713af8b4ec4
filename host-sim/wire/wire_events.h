/*
 * wire_events: what happened on a display kit's wires, as text, so that virtual boards and emulators can tell and
 * pinhole-wire can show it.
 *
 * One event a line, words separated by one space, times in ns from any start, never falling but in names and notes:
 *
 *   TIME name BIT TEXT      line BIT (0 .. 63) is called TEXT: "dc", "reset", "backlight", "select", or as the board
 *                           names its pin ("GPIO25", "AC0"). A line without a name is its number: BOARD_PIN(17) is 17
 *   TIME level LEVELS       all lines from now on: hexadecimal, line n is bit n
 *   TIME spi SELECT ASKED GOT MODE BITS LEVELS LEVELS_AT_END END_TIME BYTES
 *                           a transfer. SELECT: number of the chip select that the controller drives, or "-": none (the
 *                           line "select" decides if it has a name, else the panel is always selected). ASKED, GOT: the
 *                           clock in Hz that was asked for and that the wire has. MODE: hexadecimal, bits as Linux'
 *                           SPI_*: 1 CPHA, 2 CPOL, 4 CS high, 8 lowest bit first, 40 no chip select. BITS a word.
 *                           LEVELS: all lines at the first and at the last bit. BYTES: hexadecimal, two digits each
 *   TIME read SELECT ASKED GOT MODE BITS LEVELS LEVELS_AT_END END_TIME BYTES
 *                           a transfer in which the panel sends: BYTES are its answer (or as many zeros)
 *   TIME i2c ADDRESS HZ END_TIME BYTES
 *                           a message on the I2C bus, from start to stop. ADDRESS: of 7 bits, hexadecimal. BYTES: what
 *                           follows it, the control byte first
 *   TIME lost COUNT         events that were not recorded: the stream is worth nothing
 *   TIME note TEXT          anything else, for people; `frame` where a frame's last bit was out, see struct wire_config
 *
 * Empty lines and those that begin with '#' are skipped. A transfer may be split anywhere into several. TIME and
 * END_TIME may be the same (a kit whose wire takes no time): the wire's time then is counted at GOT.
 */
#ifndef WIRE_EVENTS_H
#define WIRE_EVENTS_H

#include "wire_replay.h"

/* Reads one line; it changes the line, and the event points into it. Returns 1 for an event, 0 for none, or HAL_EINVAL
 * with the reason in *error. */
int wire_parse(char *line, struct wire_event *event, const char **error);

#endif
