/*
 * kit: one demo on one open kit, in memory that the caller gives in one piece. The simulator, pinhole-panel and the
 * firmware images all run this: demo -> bands -> panel driver -> HAL backend.
 *
 *   runner_open(kit, &hal, &config)   wakes the panel, builds the scene
 *   runner_frame(kit, n)              buttons, draws and sends frame n; while one band is sent the next is drawn
 *   runner_finish(kit)                waits until that frame is on the glass
 *   runner_close(kit)                 display and backlight off; the HAL stays open
 *
 * runner_frame returns while the last bands are still on the wire, so that the next frame's scene is made meanwhile. It
 * is runner_buttons, runner_scene and runner_send, for whoever wants to know which of them failed.
 *
 * Budgets are counted in the sizes of a 32-bit target on every machine, so that a board's simulator leaves out what the
 * board itself would have to leave out, and the pictures are the same bytes. A scene for which there is no room is
 * taken at the coarsest of its levels (demo.h); then its list of triangles is cut, which the renderer's statistics
 * count. Memory for blur is given only where all else fits.
 *
 * Where the backend keeps a queue (bus_queue) a demo has as many band buffers as fit beside it, and the next scene is
 * made while they are sent; one that hardly fits has two.
 */
#ifndef RUNNER_H
#define RUNNER_H

#include "board.h"
#include "demo.h"
#include "panel_diff.h"
#include "panel_tiles.h"

/* What an image needs beside the kit's memory: stack and variables. A board's budget for the kit is without it. */
#define RUNNER_OTHER_BYTES 8192

#define RUNNER_BANDS_MAX 16 /* band buffers */

struct runner_config {
    const struct board *board;
    uint8_t rotation;        /* enum panel_rotation */
    uint8_t depth_format;    /* enum ph_depth_format */
    uint16_t band_height;    /* lines; more than the picture has: the whole picture */
    uint32_t clock_hz;       /* bus clock asked for; 0: the board's */
    uint32_t budget_bytes;   /* of a 32-bit target, for all that lies in memory, in bands of the board's height (what
                                higher ones take is not counted: the picture is the same); see runner_budget() */
    const struct demo *demo; /* first; the select button takes the next on demo_list that fits */
    void *state;             /* what that demo finds in context->state, or NULL */
    const char *view;        /* one of its views, or NULL: the first */
    struct demo_camera camera;
    bool (*other_core)(void (*run)(void *argument), void *argument); /* see struct ph_config; may be NULL */
    void (*other_core_join)(void);
    bool overlay;              /* frame time of the bus and triangles over the picture */
    struct panel_diff *diff;   /* sends only what changed: panel_diff_init() after runner_open(); NULL: all is sent */
    struct panel_tiles *tiles; /* the same by tiles, where the backend keeps a queue: panel_tiles_init() after
                                  runner_open(); NULL: all is sent */
    void *memory;              /* 8-byte aligned; the kit's until runner_close */
    size_t memory_bytes;       /* runner_bytes() or more */
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
    uint32_t
        written[RUNNER_BANDS_MAX]; /* how far the bus must have come before one is the kit's again, see bus_until */
    void *depth;
    uint32_t *bins;
    uint8_t *scene; /* what is left of memory: lists, arena, scratch of the demo */
    uint32_t band_count, band_next;
    uint32_t buttons;      /* held during the last frame */
    uint32_t edges_missed; /* frames that waited in vain for the tearing-effect line, and were drawn without */
    bool sending;          /* a frame's last bands may still be on the wire */
};

/* What a board gives to its kit: ram_bytes without RUNNER_OTHER_BYTES. */
uint32_t runner_budget(const struct board *board);

/*
 * Memory that this machine needs for config (its memory fields are not read), whichever demo is selected: on a 32-bit
 * machine at most budget_bytes.
 */
size_t runner_bytes(const struct runner_config *config);

/* Memory that a 32-bit target needs to draw config->demo whole; with a budget_bytes below it parts are left out. */
uint64_t runner_whole_bytes(const struct runner_config *config);

/* 0; PH_ERR_NOMEM: memory_bytes or budget_bytes is too small for the bands and the scene's meshes; PH_ERR_INVAL: no
 * such picture; or an error of the panel (HAL_E..). */
int runner_open(struct runner *runner, const struct hal *hal, const struct runner_config *config);

/* 0, or an error of the renderer (PH_ERR_..) or the panel (HAL_E..). */
int runner_frame(struct runner *runner, uint32_t frame);

/* The steps of runner_frame. runner_buttons: `more` are held besides the kit's own, up and down together are select,
 * which some kits do not have; 0, or PH_ERR_NOMEM as runner_open. runner_scene: PH_ERR_... runner_send: HAL_E... */
int runner_buttons(struct runner *runner, uint32_t more);
int runner_scene(struct runner *runner, uint32_t frame);
int runner_send(struct runner *runner);

/* Waits for the last bit; after the first frame display and backlight go on. 0 (also when nothing is sent) or HAL_E...
 */
int runner_finish(struct runner *runner);

int runner_close(struct runner *runner);

#endif
