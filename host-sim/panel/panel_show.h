/*
 * panel_show: shows a scene on one or several displays until it is over or stopped. Each frame goes to the first
 * display, then to the next. When panel_show_run returns, every display is dark and its kit released.
 */
#ifndef PANEL_SHOW_H
#define PANEL_SHOW_H

#include "option_text.h"
#include "runner.h"
#include "self_test.h"

#include <signal.h>

#define PANEL_SHOW_OVER 1

/* One display. It belongs to the caller and must not move. */
struct panel_display {
    const struct board *board;
    struct hal hal;                          /* not open */
    struct panel_sender sender;              /* zeros: through the panel driver, whole or as differences */
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
    uint32_t start, frames; /* frames 0: until stopped, and clips run by the clock */
    uint32_t fps;           /* 0: as fast as it goes */
    uint16_t band;          /* 0: the board's */
    struct option_depth depth;
    bool diff, overlay, stats;
    uint32_t refresh;
    const volatile sig_atomic_t *stop; /* not 0: stop after this frame */

    /* NULL, or called before each frame: 0 goes on, PANEL_SHOW_OVER ends the run, a negative status fails. */
    int (*before)(void *context, struct panel_display *display, uint32_t frame);
    void *before_context;
};

/* Shows the scene until it ends. 0 or COMPLAINED. */
int panel_show_run(struct panel_display *displays, int count, const struct panel_scene *scene);

/*
 * Opens the display, writes its report (self_test.h) by `put` and calls `look`, while the test card is shown; then it
 * is dark again. Returns 0, or COMPLAINED: a CRC was not the known one, or something failed.
 */
int panel_show_report(struct panel_display *display, const struct panel_scene *scene,
                      const struct self_test_machine *machine, self_test_put *put,
                      void (*look)(struct panel_driver *driver));

/* Says what a status means, in the words of the backend if it has some. */
const char *panel_show_text(const struct panel_display *display, int status);

/* Monotonic time, ns. */
uint64_t panel_show_now_ns(void);

#endif
