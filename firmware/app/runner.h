/*
 * runner: runs demos on one open display kit, in memory that the caller gives in one piece. The simulator,
 * pinhole-panel and the firmware images all use it: demo -> bands -> panel driver -> HAL backend.
 *
 *   runner_open(runner, &hal, &config)   wakes the panel, builds the scene
 *   runner_frame(runner, n)              reads buttons, draws and sends frame n; draws a band while one is sent
 *   runner_finish(runner)                waits until that frame is on the glass
 *   runner_close(runner)                 display and backlight off; the HAL stays open
 *
 * runner_frame returns while the last bands are still on the wire, so that the next scene is made meanwhile. It calls
 * runner_buttons, runner_scene and runner_send; a caller who wants to know which of them failed calls them itself.
 *
 * memory_plan.h says how the memory is shared out, and how much a board needs.
 */
#ifndef RUNNER_H
#define RUNNER_H

#include "memory_plan.h"
#include "panel_diff.h"
#include "panel_tiles.h"

struct runner_config {
    const struct board *board;
    uint8_t rotation;        /* enum panel_rotation */
    uint8_t depth_format;    /* enum ph_depth_format */
    uint16_t band_height;    /* lines; more than the picture has: the whole picture */
    uint32_t clock_hz;       /* bus clock asked for; 0: the board's */
    uint32_t budget_bytes;   /* for all memory on a 32-bit target, in bands of the board's own height (the picture does
                                not depend on band_height); see runner_budget() */
    const struct demo *demo; /* the first; the select button takes the next on demo_list that fits */
    void *state;             /* that demo finds it in context->state; or NULL */
    const char *view;        /* one of its views, or NULL: the first */
    struct demo_camera camera;
    bool (*other_core)(void (*run)(void *argument), void *argument); /* see struct ph_config; may be NULL */
    void (*other_core_join)(void);
    bool overlay;               /* frame time of the bus and triangles over the picture */
    struct panel_sender sender; /* zero: every frame whole. For panel_diff_sender() or panel_tiles_sender() call
                                   panel_diff_init() or panel_tiles_init() after runner_open(), before the first frame.
                                   Without a queue in the backend tiles are not used: every frame is sent whole */
    void *memory;               /* 8-byte aligned; the runner's until runner_close */
    size_t memory_bytes;        /* runner_bytes() or more */
};

/* Read-only for the caller: demo, context, renderer.stats, driver. Holds no pointer into itself. */
struct runner {
    struct runner_config config;
    const struct demo *demo;
    struct demo_context context;
    struct ph_renderer renderer;
    struct panel_driver driver;
    struct hal hal;
    uint16_t *bands[RUNNER_BANDS_MAX];
    uint32_t written[RUNNER_BANDS_MAX]; /* a band is free when the bus has come so far, see bus_until */
    void *depth;
    uint32_t *bins;
    uint8_t *scene; /* the rest of memory: lists, arena, scratch of the demo */
    uint32_t band_count, band_next;
    uint32_t buttons;      /* held during the last frame */
    uint32_t edges_missed; /* frames that waited in vain for the tearing-effect edge, and were sent without it */
    bool sending;          /* a frame's last bands may still be on the wire */
};

/* 0; PH_ERR_NOMEM: memory_bytes or budget_bytes is too small for the bands and the scene's meshes; PH_ERR_INVAL: no
 * such picture; or an error of the panel (HAL_E..). */
int runner_open(struct runner *runner, const struct hal *hal, const struct runner_config *config);

/* 0, or an error of the renderer (PH_ERR_..) or the panel (HAL_E..). */
int runner_frame(struct runner *runner, uint32_t frame);

/* The steps of runner_frame. runner_buttons adds `more` to the kit's own buttons; up and down together mean select,
 * which some kits lack. Errors: it PH_ERR_NOMEM as runner_open, runner_scene PH_ERR_.., runner_send HAL_E... */
int runner_buttons(struct runner *runner, uint32_t more);
int runner_scene(struct runner *runner, uint32_t frame);
int runner_send(struct runner *runner);

/* Waits for the last bit. After the first frame display and backlight go on. 0 (also if nothing is sent), or HAL_E.. */
int runner_finish(struct runner *runner);

int runner_close(struct runner *runner);

#endif
