/*
 * sim_player: one demo on one simulated kit. The picture has one way out, the one that it has on a real kit:
 * demo -> bands -> panel driver -> HAL backend -> model of the controller -> what is seen on the glass.
 * The kit has the board's memory, not this machine's: what the board would have to leave out is left out here.
 */
#ifndef SIM_PLAYER_H
#define SIM_PLAYER_H

#include "ppm.h"
#include "runner.h"
#include "sim.h"

struct sim_player_setup {
    const struct board *board;
    unsigned rotation;    /* enum panel_rotation */
    uint16_t band_height; /* lines; more than the picture has: the whole picture */
    uint8_t depth_format; /* enum ph_depth_format */
    const struct demo *demo;
    void *state;      /* what the demo finds in context->state, or NULL */
    const char *view; /* one of the demo's views, or NULL: the first */
    struct demo_camera camera;
    bool overlay; /* frame time (of the bus) and triangles over the picture */
};

/* Owns all its memory. */
struct sim_player {
    struct sim_player_setup setup;
    struct runner runner;
    struct hal hal;
    struct sim *sim;
    void *memory;                 /* the kit's */
    struct ppm picture;           /* the last frame as it is seen */
    struct sim_counters counters; /* before the last frame */
    bool drops_told;
};

/* Powers the kit on and builds the scene. 0, or COMPLAINED when one line has said why. Close it in any case. */
int sim_player_open(struct sim_player *p, const struct sim_player_setup *setup);

/* Gives the demo the buttons that the kit says are held, draws and sends frame number `frame`; p->picture is what is
 * seen then. 0, or COMPLAINED as above. */
int sim_player_frame(struct sim_player *p, uint32_t frame);

/* The camera with which frame number `frame` is drawn; the last one where the demo uses several.
 * 0, or COMPLAINED as above. */
int sim_player_camera(struct sim_player *p, uint32_t frame, struct ph_xform *view, struct ph_projection *projection);

/* Time that the last frame took on the bus. */
uint64_t sim_player_bus_ns(const struct sim_player *p);

/* Prints what the last frame took, one line on stderr. */
void sim_player_print_stats(const struct sim_player *p, uint32_t frame);

/* Turns the display off, prints the controller's complaints on stderr (one line each) and gives the memory back.
 * 0, or COMPLAINED if there were any. */
int sim_player_close(struct sim_player *p);

#endif
