/*
 * kit: one demo on one open kit, in memory that the caller gives in one piece. The simulator, pinhole-panel and the
 * firmware images all run this: demo -> bands -> panel driver -> HAL backend.
 *
 *   kit_open(kit, &hal, &config)   wakes the panel, builds the scene
 *   kit_frame(kit, n)              buttons, draws and sends frame n; while one band is sent the next is drawn
 *   kit_close(kit)                 display and backlight off; the HAL stays open
 *
 * Budgets are counted in the sizes of a 32-bit target on every machine, so that a board's simulator leaves out what the
 * board itself would have to leave out, and the pictures are the same bytes.
 */
#ifndef KIT_H
#define KIT_H

#include "board.h"
#include "demo.h"
#include "panel.h"

struct kit_config {
    const struct board *board;
    uint8_t rotation;        /* enum panel_rotation */
    uint8_t depth_format;    /* enum ph_depth_format */
    uint16_t band_height;    /* lines; more than the picture has: the whole picture */
    uint32_t clock_hz;       /* bus clock asked for; 0: the board's */
    uint32_t budget_bytes;   /* of a 32-bit target, for everything; what does not fit is left out of the lists */
    const struct demo *demo; /* first; the select button takes the next on demo_list */
    void *state;             /* what that demo finds in context->state, or NULL */
    const char *view;        /* one of its views, or NULL: the first */
    struct demo_camera camera;
    bool overlay;        /* frame time of the bus and triangles over the picture */
    void *memory;        /* 8-byte aligned; the kit's until kit_close */
    size_t memory_bytes; /* kit_bytes() or more */
};

/* Read-only for the caller: demo, renderer.stats, driver. Holds no pointer into itself. */
struct kit {
    struct kit_config config;
    const struct demo *demo;
    struct demo_context context;
    struct ph_renderer renderer;
    struct panel_driver driver;
    struct hal hal;
    uint16_t *bands[2];
    uint16_t *depth;
    uint32_t *bins;
    uint8_t *wire;  /* scratch of the panel driver */
    uint8_t *scene; /* what is left of memory: lists, arena, scratch of the demo */
    size_t scene_bytes;
    uint32_t buttons; /* held during the last frame */
};

/* Memory that this machine needs for config (its memory fields are not read). */
size_t kit_bytes(const struct kit_config *config);

/* 0; PH_ERR_NOMEM: memory_bytes or budget_bytes is too small even for the bands; or an error of the panel (HAL_E..). */
int kit_open(struct kit *kit, const struct hal *hal, const struct kit_config *config);

/* 0, or an error of the renderer (PH_ERR_..) or the panel (HAL_E..). */
int kit_frame(struct kit *kit, uint32_t frame);

int kit_close(struct kit *kit);

#endif
