/*
 * panel_show: a scene on one or several open-able displays until it is over or stopped. Displays go in step: each frame
 * is sent to the first, then the next. Whatever happens, a display that was opened is dark again and its kit released
 * when panel_show_run returns.
 */
#ifndef PANEL_SHOW_H
#define PANEL_SHOW_H

#include "runner.h"

#include <signal.h>

#define PANEL_SHOW_OVER 1

/* One display; the caller's, must not move. */
struct panel_display {
    const struct board *board;
    struct hal hal;                          /* not open */
    const char *(*why)(const void *context); /* what the backend says about its last error; NULL: nothing */
    const void *why_context;

    /* Private from here on. */
    struct runner runner;
    struct panel_diff diff;
    void *memory, *diff_memory;
    bool hal_open, runner_open, drops_told, edge_told;
    uint64_t bytes; /* on the wire since the last report */
};

struct panel_scene {
    const struct demo *demo;
    void *state; /* what it finds in context->state, or NULL */
    const char *view;
    uint32_t start, frames; /* frames 0: until stopped */
    uint32_t fps;           /* 0: as fast as it goes */
    uint16_t band;          /* 0: the board's */
    uint8_t depth;          /* enum ph_depth_format */
    bool diff, overlay, stats;
    uint32_t refresh;
    const volatile sig_atomic_t *stop; /* not 0: stop after this frame */

    /* Called before each frame if not NULL: 0; PANEL_SHOW_OVER: the run is over; else it fails with that status. */
    int (*before)(void *context, struct panel_display *display, uint32_t frame);
    void *before_context;
};

/* 0, or COMPLAINED when one line has said why. */
int panel_show_run(struct panel_display *displays, int count, const struct panel_scene *scene);

/* What a status of the backend, the panel or the renderer means, with the backend's own words if it has some. */
const char *panel_show_text(const struct panel_display *display, int status);

/* Monotonic time, ns. */
uint64_t panel_show_now_ns(void);

#endif
