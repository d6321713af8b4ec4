/*
 * panel_tiles: sends only what changed, for chips that have no room for a second picture. Three functions replace
 * those of the driver (panel.h):
 *
 *   panel_tiles_begin(t, d)                 replaces panel_frame_begin
 *   panel_tiles_rows(t, d, pixels, lines)   replaces panel_rows, one band at a time
 *   panel_tiles_end(t, d)                   replaces panel_frame_end
 *
 * A tile is PANEL_TILE_PX columns of a band. For each tile 32 bits are kept: a signature of the pixels that the panel
 * shows. A tile is sent if its signature changed. Neighbours are sent as one window, and bands that are sent in the
 * same columns continue in the same window.
 *
 * A tile that changed but has the same signature stays on the glass as it was. This cannot happen if one word (two
 * neighbouring pixels) changed; otherwise its probability is 2^-32 a tile. On 320x240 pixels, all of which change 50
 * times a second, that is once in 80 hours. It does not last: each frame also sends the next tile in turn, whatever its
 * signature, so that every tile is sent within panel_tiles_refresh_frames() frames. That mends a disturbed panel, too.
 *
 * If nearly all tiles of a band changed twice, it is sent whole for 16 frames; only one of them makes signatures. If
 * two frames took longer than a whole one takes on the bus, all bands are, for 100 frames: there the cores are slower
 * than the bus, and signatures would make them slower still. The format is RGB565.
 */
#ifndef PANEL_TILES_H
#define PANEL_TILES_H

#include "panel.h"

#define PANEL_TILE_PX 16 /* columns of a tile */

/* State. Read-only for the caller. */
struct panel_tiles {
    uint32_t *signs;           /* by band, then by column of tiles */
    uint8_t *rest;             /* of each band: its state, see panel_tiles.c */
    uint16_t width, height;    /* of the picture */
    uint16_t lines;            /* of a band */
    uint16_t columns, bands;   /* of tiles */
    uint16_t row;              /* next line */
    uint16_t open_x, open_end; /* columns of the window that bands below can continue in, px; equal: there is none */
    uint32_t factor; /* of signatures; a variable, because compilers may turn a constant factor into dozens of shifts */
    uint32_t turn;   /* the tile that is sent in this frame in any case, by band, then by column */
    uint32_t begun_us;   /* when this frame began */
    uint32_t watched_us; /* what the last frame before a rest of all bands took */
    uint8_t slow;        /* frames in a row that took longer than a whole one on the bus */
    uint8_t resting;     /* frames until times count again */
    bool whole;          /* this frame is sent whole */
    bool unknown;        /* the panel may show anything, so the next frame is sent whole */
    int status;          /* of the frame: the first error */
};

/* Memory for a picture of this size in bands of so many lines. Pictures are at most 1024 pixels wide. */
size_t panel_tiles_bytes(uint16_t width, uint16_t height, uint16_t lines);

/* Prepares tiles for an open driver. memory: panel_tiles_bytes() or more, 4-byte aligned; it belongs to the tiles as
 * long as they are used. HAL_EINVAL: too little memory, no bands, or another format than RGB565. The first frame is
 * sent whole. */
int panel_tiles_init(struct panel_tiles *t, const struct panel_driver *d, uint16_t lines, void *memory, size_t bytes);

/* A tile that the panel has lost, or whose change was missed, is sent again within so many frames. */
uint32_t panel_tiles_refresh_frames(const struct panel_tiles *t);

/* Forgets what the panel shows, when another scene begins or the panel may show anything: the next frame is sent
 * whole. */
void panel_tiles_forget(struct panel_tiles *t);

/* Begins a frame. 0, or an error as of the driver's functions. After an error the next frame is sent whole. */
int panel_tiles_begin(struct panel_tiles *t, struct panel_driver *d);

/*
 * Sends the next band: t->lines lines, or fewer at the end of the picture. pixels is 4-byte aligned. The part that is
 * sent belongs to the driver as with panel_rows.
 */
int panel_tiles_rows(struct panel_tiles *t, struct panel_driver *d, const uint16_t *pixels, uint32_t lines);

/* Ends a frame, as panel_frame_end() does. */
int panel_tiles_end(struct panel_tiles *t, struct panel_driver *d);

/* A panel_sender that sends by panel_tiles_begin, panel_tiles_rows and panel_tiles_end. */
struct panel_sender panel_tiles_sender(struct panel_tiles *t);

#endif
