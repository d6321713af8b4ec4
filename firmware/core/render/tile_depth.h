/* tile_depth: depth of a tile that crosses the octaves of a float. Private to firmware/core. */
#ifndef PH_TILE_DEPTH_H
#define PH_TILE_DEPTH_H

#include "span.h"
#include "texel_rows.h"
#include "tile_surface.h"

/* Codes and border are stepped from the tile's first row, whatever the band. */
struct ph_tile_depth {
    uint32_t d, d_dy;            /* of its first row, in units of the triangle's plane */
    struct ph_octave octaves[2]; /* the far and the near one, or twice the only one */
};

/* The octaves of a tile; false if there are more than two. */
bool ph_tile_octaves(const struct ph_triangle *t, const struct ph_tile *tile, struct ph_tile_depth *depth);

/* Draws rows, from row `row` of the tile on. */
void ph_draw_rows_in_octaves(const struct ph_tile_kind *k, struct ph_tile_rows *r, const struct ph_tile_depth *depth,
                             uint32_t row);

#endif
