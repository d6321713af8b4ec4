/*
 * panel_diff: sends only what changed. These three replace the driver's own (panel.h):
 *
 *   panel_diff_begin(diff, d)                 replaces panel_frame_begin
 *   panel_diff_rows(diff, d, pixels, lines)   replaces panel_rows
 *   panel_diff_end(diff, d)                   replaces panel_frame_end
 *
 * It keeps a copy of the picture on the glass and compares lines with it as they come. For what changed it chooses
 * windows whose commands and pixels together are few bytes. Dynamic programming over the lines cuts them into slabs and
 * the slabs into windows; each window is cut once more in the other direction if that saves bytes. The result is not
 * always the minimum: tests/hal/test_panel_diff.c compares with an exhaustive search.
 *
 * Where writes take time besides their bits (write_ns in hal.h) that time, asked for before each frame, counts as
 * bytes, too; then windows are fewer and larger. There frames are also timed. While frames of windows take longer than
 * whole ones (medians of three), frames are sent whole. The slower way is tried again after 16 to 1024 frames: the more
 * it loses, the later. Whole frames are not tried while windows take less time than a whole frame's bits alone.
 *
 * The picture is always exact, in every format. The windows depend on how many lines come at a time, because each call
 * decides for its own lines (at least 32); the picture does not.
 *
 * Time for each line: at most 64 times the changed runs of the lines above it. No heap, no recursion.
 */
#ifndef PANEL_DIFF_H
#define PANEL_DIFF_H

#include "panel.h"

/* State. Read-only for the caller: windows, bytes. */
struct panel_diff {
    uint32_t refresh_frames; /* after so many frames the whole picture is sent again; 0: only when it must be */
    uint32_t windows, bytes; /* of the last frame; bytes as predicted when the windows were chosen, commands included */

    uint16_t width, height;   /* of the picture */
    uint32_t units_x;         /* units in a line: pixels, or those that share a byte */
    uint8_t share_x, share_y; /* log2 of the pixels that share a byte: side by side; one above the other */
    uint8_t lead;             /* only the second pixel of the first pair is in the picture */
    bool pages;               /* windows lie within a page, see panel.h */
    uint16_t *shown;          /* the picture on the glass, or on its way there */
    uint32_t *bits[2];        /* units that changed from line `first` on, a bit each: by lines; by columns */
    uint32_t words[2];        /* in a line; in a column */
    uint32_t *cost[2];        /* by line; by column: the cost of all from there to the end */
    uint16_t *next[2];        /* the end of the slab that starts there */
    uint32_t *merged[2];      /* union of a slab's lines; of its columns */
    uint16_t last[4];         /* x0, x1, y0, y1 of the last window, pixels */
    uint16_t first, row;      /* first line that is not yet decided; next line */
    uint32_t frames;          /* since the last whole picture */
    bool whole;               /* this frame is sent whole */
    bool unknown;             /* the glass may show something else, so the next frame is sent whole */
    uint32_t taken_us[2][3];  /* by the last frames of windows; by the last whole ones; a frame with its drawing */
    uint8_t taken[2];         /* not 0: there was one */
    uint8_t oldest[2];        /* the place of the next one */
    uint32_t begun_us;        /* when the last frame began */
    uint32_t bits_us;         /* of a whole frame */
    uint32_t tries;           /* frames until the other way is tried again */
    bool timed;               /* the last frame began at begun_us, and had nothing that others do not have */
    uint32_t unit_cost;       /* of the pixels of a unit, in half bytes */
    uint32_t open_cost;       /* of a window, in half bytes, with the time of its writes */
    uint32_t beside_cost;     /* of a window in the same lines as the last */
    uint32_t step;            /* slabs may be cut at multiples of so many lines */
    uint32_t slab;            /* most lines of a slab */
    struct panel_driver *out; /* during a call */
    int status;               /* of the frame: the first error */
};

/* Memory for a picture of this size in any format. */
size_t panel_diff_bytes(uint16_t width, uint16_t height);

/*
 * Prepares a diff for an open driver. memory: panel_diff_bytes() or more, 8-byte aligned; it belongs to the diff as
 * long as that is used. The first frame is sent whole. HAL_EINVAL: too little memory.
 */
int panel_diff_init(struct panel_diff *diff, const struct panel_driver *d, uint32_t refresh_frames, void *memory,
                    size_t bytes);

/* Begins a frame. 0, or an error as of the driver's functions. After an error the next frame is sent whole. */
int panel_diff_begin(struct panel_diff *diff, struct panel_driver *d);

/* Sends what changed in a band. The pixels are the caller's again when it returns. */
int panel_diff_rows(struct panel_diff *diff, struct panel_driver *d, const uint16_t *pixels, uint32_t lines);

/* Ends a frame, as panel_frame_end() does. */
int panel_diff_end(struct panel_diff *diff, struct panel_driver *d);

/* A panel_sender that sends by panel_diff_begin, panel_diff_rows and panel_diff_end. */
struct panel_sender panel_diff_sender(struct panel_diff *diff);

#endif
