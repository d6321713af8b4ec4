/*
 * wire_replay: feeds the events on the wires of a display kit into the model of its controller (sim.h). It tells the
 * pictures that were seen, the order of power-on, and what a real panel would not accept.
 */
#ifndef WIRE_REPLAY_H
#define WIRE_REPLAY_H

#include "board.h"

enum wire_kind { WIRE_NAME, WIRE_LEVEL, WIRE_SPI, WIRE_READ, WIRE_I2C, WIRE_LOST, WIRE_NOTE };

enum wire_mode { WIRE_CPHA = 1, WIRE_CPOL = 2, WIRE_CS_HIGH = 4, WIRE_LSB_FIRST = 8, WIRE_NO_CS = 0x40 };

#define WIRE_NO_SELECT UINT32_MAX

/* An event. Fields that its kind does not have are 0. */
struct wire_event {
    enum wire_kind kind;
    uint64_t time_ns, end_ns;
    uint32_t number; /* bit of a name, count of lost ones, address on an I2C bus */
    uint64_t levels, levels_at_end;
    uint32_t select; /* or WIRE_NO_SELECT */
    uint32_t asked_hz, got_hz;
    uint32_t mode; /* enum wire_mode */
    uint32_t word_bits;
    char *text;           /* name or note */
    const uint8_t *bytes; /* count of them */
    size_t count;
};

struct wire_config {
    const struct board *board;
    uint32_t select;   /* chip select of this panel */
    unsigned rotation; /* enum panel_rotation */
    uint64_t idle_ns;  /* 0: a frame ends when every pixel was written; else when the bus rests that long */
    bool notes;        /* a frame ends at each note `frame` */
    bool order;        /* tell the steps of power-on and power-off */
    bool last;         /* tell only the last picture seen */
    void *context;     /* of the following */
    int (*frame)(void *context, uint32_t frame,
                 const uint8_t *rgb); /* 0, or what wire_replay_event and wire_replay_end return */
    void (*step)(void *context, uint64_t time_ns, const char *what);
    void (*reject)(void *context, const char *complaint);
};

struct wire;

/* Begins a replay. NULL: no memory, or no model of the board's controller. */
struct wire *wire_replay_open(const struct wire_config *config);

/* Takes one event in its turn. 0, or what config->frame returned. */
int wire_replay_event(struct wire *w, const struct wire_event *event);

/* The stream is over. 0, or what config->frame returned. */
int wire_replay_end(struct wire *w);

/* Returns how many complaints there were (config.reject was called for the first of them only). */
uint32_t wire_replay_complaints(const struct wire *w);

/* How many frames were reported. */
uint32_t wire_replay_frames(const struct wire *w);

void wire_replay_close(struct wire *w);

#endif
