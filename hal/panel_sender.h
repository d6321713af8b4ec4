/*
 * panel_sender: how frames are sent, chosen once when a panel is opened: whole (panel_sender_whole), as differences
 * from a copy of the last picture (panel_diff_sender), or as tiles that changed (panel_tiles_sender).
 */
#ifndef PANEL_SENDER_H
#define PANEL_SENDER_H

#include "panel.h"

/* Status: 0, or an error as of the driver's functions. The next frame may begin after an error. */
struct panel_sender_ops {
    bool copies; /* the pixels are the caller's again when rows returns; else as with panel_rows */
    bool skips;  /* rows may send nothing: only a backend's queue (hal.h) then says when a buffer is free */

    /* These replace panel_frame_begin, panel_rows and panel_frame_end. */
    int (*begin)(void *context, struct panel_driver *d);
    int (*rows)(void *context, struct panel_driver *d, const uint16_t *pixels, uint32_t lines);
    int (*end)(void *context, struct panel_driver *d);

    /* Another scene begins: the next frame is better sent whole. NULL: that makes no difference. */
    void (*forget)(void *context);
};

struct panel_sender {
    const struct panel_sender_ops *ops;
    void *context;
};

extern const struct panel_sender panel_sender_whole;

#endif
