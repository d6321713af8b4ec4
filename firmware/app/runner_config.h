/* runner_config: what a caller gives to the runner (runner.h), and what its memory is planned from (memory_plan.h). */
#ifndef RUNNER_CONFIG_H
#define RUNNER_CONFIG_H

#include "board.h"
#include "demo.h"
#include "panel.h"

/* What runner_open() is told. */
struct runner_config {
    const struct board *board;
    uint8_t rotation;                           /* enum panel_rotation */
    const struct ph_depth_format *depth_format; /* PH_DEPTH_... */
    uint16_t band_height;                       /* lines; more than the picture has: the whole picture */
    uint16_t clip_fps;       /* see struct demo_context; DEMO_CLIPS_BY_CLOCK: call runner_pass() before each frame */
    uint32_t clock_hz;       /* bus clock asked for; 0: the board's */
    uint32_t budget_bytes;   /* for all memory on a 32-bit target, in bands of the board's own height (the picture does
                                not depend on band_height); a board's is its scene_bytes */
    const struct demo *demo; /* the first; the select button takes the next on demo_list that fits */
    void *state;             /* that demo finds it in context->state; or NULL */
    const char *view;        /* one of its views, or NULL: the first */
    struct demo_camera camera;
    bool (*other_core)(void (*run)(void *argument), void *argument); /* see struct ph_config; may be NULL */
    void (*other_core_join)(void);
    const struct ph_cores *cores;
    void *ahead;            /* memory for the scene of the next frame, which the other core then makes while this one
                               draws; 8-byte aligned, the runner's until runner_close. NULL: none. other_core must
                               take a new run when the one before has returned, joined or not */
    size_t ahead_bytes;     /* with too few for a demo's list it is made without */
    bool overlay;           /* frame time of the bus and triangles over the picture */
    uint8_t depth_exponent; /* see struct ph_config */
    struct panel_sender sender; /* zero: every frame whole. For panel_diff_sender() or panel_tiles_sender() call
                                   panel_diff_init() or panel_tiles_init() after runner_open(), before the first frame.
                                   Without a queue in the backend tiles are not used: every frame is sent whole */
    void *memory;               /* 8-byte aligned; the runner's until runner_close */
    size_t memory_bytes;        /* runner_bytes() or more */
    const struct ph_antialiasing *antialiasing; /* PH_ANTIALIAS_2X2: 2 x 2 samples a pixel, in bands of a quarter of
                                                   band_height: about the same memory. Or NULL */
    struct ph_dither *dither;                   /* dithered light (ph_dither), or NULL; it keeps its own memory */
    int (*set_dither)(struct ph_renderer *r, struct ph_dither *dither); /* ph_dither, if dither is not NULL */
};

#endif
