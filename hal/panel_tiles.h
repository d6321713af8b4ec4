/*
 * panel_tiles: sends only what changed, for chips that have no room for a second picture. In place of the driver's own
 * three (panel.h):
 *
 *   panel_tiles_begin(t, d)                 for panel_frame_begin
 *   panel_tiles_rows(t, d, pixels, lines)   for panel_rows, one band at a time
 *   panel_tiles_end(t, d)                   for panel_frame_end
 *
 * Of each tile, PANEL_TILE_PX columns of a band, 32 bits are kept: a signature of the pixels that the panel shows.
 * Tiles with another signature than before are sent, neighbours together as one window; bands that are sent in the same
 * columns go on in the same window.
 *
 * What changed but has the same signature stays on the glass as it was. A change of one word (two pixels beside each
 * other) never has; others have with a probability of 2^-32 a tile. On 320x240 pixels, all of which change 50 times a
 * second, that is once in 80 hours. It heals: each frame also sends the next tile in turn, whatever its signature, so
 * that after panel_tiles_refresh_frames() frames every tile was sent, as it is where the panel was disturbed.
 *
 * A band of which nearly all changed twice is sent whole for 16 frames, and its signatures are worked out in but one.
 *
 * A frame's windows depend on its pixels and on the frames before, and on nothing else. RGB565.
 */
#ifndef PANEL_TILES_H
#define PANEL_TILES_H

#include "panel_sender.h"

#define PANEL_TILE_PX 16

/* State. Read-only for the caller. */
struct panel_tiles {
    uint32_t *signs;           /* by band, then by column of tiles */
    uint8_t *rest;             /* of each band: frames in which it is still sent whole */
    uint16_t width, height;    /* of the picture */
    uint16_t lines;            /* of a band */
    uint16_t columns, bands;   /* of tiles */
    uint16_t row;              /* next line */
    uint16_t open_x, open_end; /* columns of the window that goes on below, px; the same: there is none */
    uint32_t factor;           /* of signatures; were it in the code, a compiler might multiply by dozens of shifts */
    uint32_t turn;             /* the tile whose turn it is, by band, then by column */
    bool whole;                /* this frame is sent whole */
    bool unknown;              /* the panel may show anything: the next frame is sent whole */
    int status;                /* of the frame: the first error */
};

/* Memory for a picture of this size in bands of so many lines. Up to 1024 pixels wide. */
size_t panel_tiles_bytes(uint16_t width, uint16_t height, uint16_t lines);

/* memory: panel_tiles_bytes() or more, 4-byte aligned, the tiles' as long as they are used. HAL_EINVAL: too little, no
 * bands, or another format than RGB565. The first frame is sent whole. */
int panel_tiles_init(struct panel_tiles *t, const struct panel_driver *d, uint16_t lines, void *memory, size_t bytes);

/* A tile that the panel has lost, or that wrongly seemed the same, is sent within so many frames. */
uint32_t panel_tiles_refresh_frames(const struct panel_tiles *t);

/* The next frame is sent whole: another scene begins, or the panel may show anything. */
void panel_tiles_forget(struct panel_tiles *t);

/* 0, or errors as of the driver's functions. After an error the next frame is sent whole. */
int panel_tiles_begin(struct panel_tiles *t, struct panel_driver *d);

/*
 * The next band: t->lines lines, or what is left of the picture. pixels is 4-byte aligned; what of it is sent, if
 * anything, stays the driver's as with panel_rows.
 */
int panel_tiles_rows(struct panel_tiles *t, struct panel_driver *d, const uint16_t *pixels, uint32_t lines);

int panel_tiles_end(struct panel_tiles *t, struct panel_driver *d);

/* These three as a panel_sender. */
struct panel_sender panel_tiles_sender(struct panel_tiles *t);

#endif
