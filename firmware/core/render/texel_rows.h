/* texel_rows: rows of texels within a tile or a small triangle. Private to firmware/core. */
#ifndef PH_TEXEL_ROWS_H
#define PH_TEXEL_ROWS_H

#include "texture_tile.h"
#include "triangle.h"

/* How the pixels of a tile or of a small triangle are drawn. */
struct ph_tile_kind {
    const struct ph_triangle *triangle;
    const uint16_t *texels;
    uint32_t u_mask, v_mask, log2_width;
    int u_down, v_down; /* from u, v to whole texels */
    uint32_t light;     /* 0 .. 32 */
    bool clamp;
    bool depth24;      /* as in struct ph_band */
    bool plain;        /* ph_texture_tile can draw them */
    int32_t from, end; /* columns of the picture, as the tile's columns count */
};

/* Draws rows whose depth is in codes, of a texture of up to 65,536 texels. */
void ph_draw_plain_rows(const struct ph_tile_kind *k, struct ph_texel_rows *r);

/* Draws rows whose depth may have several pieces each. r->d and r->gd are in units of the triangle's plane. Pieces
 * begin with the triangle's row, as in all other shadings, not with the tile. */
void ph_draw_rows_in_pieces(const struct ph_tile_kind *k, struct ph_texel_rows *r);

#endif
