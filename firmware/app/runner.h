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
 * With a second core and memory for it, runner_frame has the other core make the next scene before it draws. The frames
 * are the same: a scene whose buttons turn out to be others is made again.
 *
 * runner_config.h has the configuration; memory_plan.h says how the memory is shared out, and how much a board needs.
 */
#ifndef RUNNER_H
#define RUNNER_H

#include "memory_plan.h"
#include "panel_diff.h"
#include "panel_tiles.h"

/* The scene that the other core makes, at the start of the configuration's memory for it. Its list follows. */
struct runner_ahead {
    struct ph_renderer renderer;
    struct demo_context context;
    const struct demo *demo;
    uint32_t frame, buttons;
    int status;
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
    uint16_t *samples; /* or NULL */
    uint8_t *scene;    /* the rest of memory: lists, arena, scratch of the demo */
    uint16_t band_count, band_next;
    uint32_t buttons;        /* held during the last frame */
    uint32_t edges_missed;   /* frames that waited in vain for the tearing-effect edge, and were sent without it */
    struct demo_clock clock; /* of the next frame, since its scene began */
    uint16_t step;           /* from the frame before to the next, in 64 us; 65,535: so long or longer */
    bool ahead;              /* the other core makes a scene, or has made it */
    bool sending;            /* a frame's last bands may still be on the wire */
};

/* Opens a runner on a kit. 0; PH_ERR_NOMEM: memory_bytes or budget_bytes is too small for the bands and the scene's
 * meshes; PH_ERR_INVAL: no such picture; or an error of the panel (HAL_E..). */
int runner_open(struct runner *runner, const struct hal *hal, const struct runner_config *config);

/* Draws a frame and sends it. 0, or an error of the renderer (PH_ERR_..) or the panel (HAL_E..). */
int runner_frame(struct runner *runner, uint32_t frame);

/* Lets time pass for clips that run by the clock: since the frame before, in microseconds. A scene that the other core
 * makes ahead is that of a time as much later. */
void runner_pass(struct runner *runner, uint32_t us);

/* The steps of runner_frame. runner_buttons adds `more` to the kit's own buttons; up and down together mean select,
 * which some kits lack. Errors: it PH_ERR_NOMEM as runner_open, runner_scene PH_ERR_.., runner_send HAL_E... */
int runner_buttons(struct runner *runner, uint32_t more);
int runner_scene(struct runner *runner, uint32_t frame);
void runner_ahead(struct runner *runner, uint32_t frame); /* this scene on the other core, if it can be */
int runner_send(struct runner *runner);

/* Takes another demo, as the select button does; the frame before is finished. PH_ERR_NOMEM: there is no room for it,
 * and another demo must be taken. */
int runner_take(struct runner *runner, const struct demo *demo);

/* Draws the bands of runner_scene() in place of runner_send(), and sends nothing. Returns the CRC-32 of the picture as
 * RGB888 rows. Call it only after runner_finish() or runner_take(). */
uint32_t runner_crc(struct runner *runner);

/* Ends the last frame: waits for its last bit. After the first frame display and backlight go on. 0 (also if nothing is
 * sent), or HAL_E.. */
int runner_finish(struct runner *runner);

/* Switches display and backlight off. 0, or HAL_E... */
int runner_close(struct runner *runner);

#endif
