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
 *   TIME lost COUNT         events that were not recorded: the stream is worth nothing
 *   TIME note TEXT          anything else, for people; `frame` where a frame's last bit was out, see struct wire_config
 *
 * Empty lines and those that begin with '#' are skipped. A transfer may be split anywhere into several. TIME and
 * END_TIME may be the same (a kit whose wire takes no time): the wire's time then is counted at GOT.
 */
#ifndef WIRE_EVENTS_H
#define WIRE_EVENTS_H

#include "board.h"

#include <stdio.h>

enum wire_kind { WIRE_NAME, WIRE_LEVEL, WIRE_SPI, WIRE_READ, WIRE_LOST, WIRE_NOTE };

enum wire_mode { WIRE_CPHA = 1, WIRE_CPOL = 2, WIRE_CS_HIGH = 4, WIRE_LSB_FIRST = 8, WIRE_NO_CS = 0x40 };

#define WIRE_NO_SELECT UINT32_MAX

/* An event; what its kind has not is 0. */
struct wire_event {
    enum wire_kind kind;
    uint64_t time_ns, end_ns;
    uint32_t number; /* bit of a name, count of lost ones */
    uint64_t levels, levels_at_end;
    uint32_t select; /* or WIRE_NO_SELECT */
    uint32_t asked_hz, got_hz;
    uint32_t mode; /* enum wire_mode */
    uint32_t word_bits;
    char *text;           /* name or note */
    const uint8_t *bytes; /* count of them */
    size_t count;
};

/*
 * Reads one line (it is changed; the event points into it). 1: an event, 0: nothing in it, HAL_EINVAL: *error says what
 * is wrong with it.
 */
int wire_parse(char *line, struct wire_event *event, const char **error);

/* ---- replay into the model of a controller ------------------------------------------------------ */

struct wire_config {
    const struct board *board;
    uint32_t select;   /* chip select of this panel */
    unsigned rotation; /* enum panel_rotation */
    uint64_t idle_ns;  /* 0: a frame ends when every pixel was written; else when the bus rests so long */
    bool notes;        /* a frame ends at each note `frame`, whatever was written */
    bool order;        /* tell the steps of power-on and power-off */
    bool last;         /* tell only the last picture seen */
    void *context;     /* of the following */
    int (*frame)(void *context, uint32_t frame, const uint8_t *rgb); /* 0, or what wire_event and wire_end return */
    void (*step)(void *context, uint64_t time_ns, const char *what);
    void (*resent)(void *context, const char *complaint);
};

struct wire;

/* NULL: no memory, or no model of the board's controller. */
struct wire *wire_open(const struct wire_config *config);

/* Takes one event in its turn. 0, or what config->frame returned. */
int wire_event(struct wire *w, const struct wire_event *event);

/* The stream is over. 0, or what config->frame returned. */
int wire_end(struct wire *w);

/* How many complaints there were (resent was called for the first of them only). */
uint32_t wire_complaints(const struct wire *w);

/* Frames that were told. */
uint32_t wire_frames(const struct wire *w);

void wire_close(struct wire *w);

#endif
