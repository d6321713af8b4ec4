/*
 * sim_player: one demo on one simulated kit. The picture takes the same way as on a real kit: demo -> bands -> panel
 * driver -> HAL backend -> model of the controller -> glass. The kit has the memory of the board: a triangle that the
 * board has no room for is left out here as well.
 */
#ifndef SIM_PLAYER_H
#define SIM_PLAYER_H

#include "option_text.h"
#include "ppm.h"
#include "runner.h"
#include "sim.h"

struct sim_player_setup {
    const struct board *board;
    unsigned rotation;    /* enum panel_rotation */
    uint16_t band_height; /* lines; at most the whole picture is taken */
    struct option_depth depth;
    const struct demo *demo;
    void *state;      /* what the demo finds in context->state, or NULL */
    const char *file; /* of the model, for messages; NULL: a demo */
    const char *cure; /* what to do where the board has not the memory, or NULL */
    const char *view; /* one of the demo's views, or NULL: the first */
    struct demo_camera camera;
    uint16_t clip_fps; /* see struct demo_context */
    bool antialias, dither;
    bool overlay; /* frame time (of the bus) and triangles over the picture */
};

#define SIM_DITHERED_RAMPS 32 /* more than a demo has */

struct sim_player {
    struct sim_player_setup setup;
    struct runner runner;
    struct hal hal;
    struct sim *sim;
    void *memory; /* the kit's */
    struct ph_dither dither;
    struct ph_dithered_ramp dithered_ramps[SIM_DITHERED_RAMPS];
    struct ppm picture;           /* the last frame as it is seen */
    struct sim_counters counters; /* before the last frame */
    bool drops_told;
};

/* Powers the kit on and builds the scene. 0 or COMPLAINED. Close it in any case. */
int sim_player_open(struct sim_player *p, const struct sim_player_setup *setup);

/* Turns the camera around the scene, counter-clockwise from above, and moves it away by a share of its distance, as the
 * kit's buttons do (demo_input); and moves it up over the scene by up32, a turn32. */
void sim_player_move(struct sim_player *p, uint32_t turn32, int32_t up32, fx_t away);

/* Moves the camera as a pointer does that drags the scene: by right and down pixels of the picture, of which 256 are a
 * turn. Each notch of the wheel away from the user brings it nearer by 1/16 of its distance. */
void sim_player_drag(struct sim_player *p, int32_t right, int32_t down, int32_t notches);

/* Gives the demo the kit's buttons, draws frame number `frame` and sends it to the panel; then p->picture is what the
 * glass shows. 0 or COMPLAINED. */
int sim_player_frame(struct sim_player *p, uint32_t frame);

/* Makes the scene of frame number `frame`, as sim_player_frame does before it draws. 0 or COMPLAINED. */
int sim_player_scene(struct sim_player *p, uint32_t frame);

/* Returns how long the last frame took on the bus. */
uint64_t sim_player_bus_ns(const struct sim_player *p);

/* Prints the cost of the last frame in one line on stderr. */
void sim_player_print_stats(const struct sim_player *p, uint32_t frame);

/* Prints the cost of the last frame as an object of JSON on a line of its own; host-sim/README.md has its keys, which
 * stay. */
void sim_player_print_json(const struct sim_player *p, uint32_t frame);

/* Turns the display off, prints each of the controller's complaints on stderr and frees the memory. 0, or COMPLAINED if
 * there were any. */
int sim_player_close(struct sim_player *p);

#endif
