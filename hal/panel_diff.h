/*
 * panel_diff: sends only what changed. In place of the driver's own three (panel.h):
 *
 *   panel_diff_begin(diff, d)                 for panel_frame_begin
 *   panel_diff_rows(diff, d, pixels, lines)   for panel_rows
 *   panel_diff_end(diff, d)                   for panel_frame_end
 *
 * A copy of the picture on the glass is kept; lines are compared with it as they come. Where something changed,
 * windows are chosen so that commands and pixels together are few bytes: lines are cut into slabs and slabs into
 * windows by dynamic programming over the lines, each window is cut again as long as that saves bytes. It is not
 * always the fewest: tests/hal/test_panel_diff.c compares with an exhaustive search. Where the backend's writes cost
 * time besides their bits (hal.h, write_ns), each counts as the bytes that the bus could send in that time: windows are
 * fewer then, and larger.
 *
 * The picture is exact always, in every format. What is sent depends on how many lines come at a time (each call
 * decides for its own lines, for at least 32), what is seen does not.
 *
 * Time: for each line at most 64 times the changed runs of the lines above it; no heap, no recursion.
 */
#ifndef PANEL_DIFF_H
#define PANEL_DIFF_H

#include "panel_sender.h"

/* State. Read-only for the caller: windows, bytes. */
struct panel_diff {
    uint32_t refresh_frames; /* every so many frames all of the picture is sent; 0: only when it must be */
    uint32_t windows, bytes; /* of the last frame; bytes as the choice predicts them, commands included */

    uint16_t width, height;   /* of the picture */
    uint32_t units_x;         /* of a line: pixels, or pairs that share a byte */
    uint8_t pair_x, pair_y;   /* 1: two pixels beside, above each other share a byte */
    uint8_t lead;             /* the first pair has but its second pixel in the picture */
    uint16_t *shown;          /* the picture on the glass, or on its way there */
    uint32_t *bits[2];        /* what changed from line `first` on, a bit for each unit: by lines, by columns */
    uint32_t words[2];        /* of a line, of a column of them */
    uint32_t *cost[2];        /* by line, by column: of all from it to the end */
    uint16_t *next[2];        /* where the slab that starts there ends */
    uint32_t *merged[2];      /* union of a slab's lines, columns */
    uint16_t last[4];         /* x0, x1, y0, y1 of the window before, pixels */
    uint16_t first, row;      /* lines not yet decided, next line */
    uint32_t frames;          /* since the last whole picture */
    bool whole;               /* this frame is sent whole */
    bool unknown;             /* the glass may show something else: the next frame is sent whole */
    uint32_t unit_cost;       /* of a unit's pixels, in half bytes */
    uint32_t open_cost;       /* of a window, in half bytes, its writes' time included */
    uint32_t beside_cost;     /* of one in the same lines as the last */
    uint32_t step;            /* lines between which slabs may be cut */
    struct panel_driver *out; /* during a call */
    int status;               /* of the frame: the first error */
};

/* Memory for a picture of this size, any format. */
size_t panel_diff_bytes(uint16_t width, uint16_t height);

/*
 * For an open driver; the backend's write_ns is asked now. memory: panel_diff_bytes() or more, 8-byte aligned, the
 * diff's as long as it is used. The first frame is sent whole. HAL_EINVAL: too little memory.
 */
int panel_diff_init(struct panel_diff *diff, const struct panel_driver *d, uint32_t refresh_frames, void *memory,
                    size_t bytes);

/* 0, or errors as of the driver's functions. After an error the next frame is sent whole. */
int panel_diff_begin(struct panel_diff *diff, struct panel_driver *d);

/* The pixels are the caller's again when it returns. */
int panel_diff_rows(struct panel_diff *diff, struct panel_driver *d, const uint16_t *pixels, uint32_t lines);

int panel_diff_end(struct panel_diff *diff, struct panel_driver *d);

/* These three as a panel_sender. */
struct panel_sender panel_diff_sender(struct panel_diff *diff);

#endif
