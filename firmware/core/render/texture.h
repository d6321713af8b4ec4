/* texture: textured triangles. Private to firmware/core; the method is in texture.c. */
#ifndef PH_TEXTURE_H
#define PH_TEXTURE_H

#include "band.h"
#include "texture_small.h"
#include "texture_tile.h"

/* Draws the rows of a textured triangle that lie in the band. Returns the number of its pixels. */
uint32_t ph_draw_textured(const struct ph_triangle *t, const struct ph_band *band);

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

/* The rows of a small textured triangle. */
struct ph_small_texels {
    bool usual; /* ph_texture_small can draw them, from run; else rows and kind are taken */
    struct ph_texel_run run;
    struct ph_texel_rows rows; /* u, v stand at the next row, as in run */
    struct ph_tile_kind kind;
};

/* Whether ph_texture_small can draw a small triangle. */
static inline bool ph_texels_are_usual(const struct ph_triangle *t)
{
    return t->colour >= 32 && t->material->texture->wrap == PH_WRAP_REPEAT;
}

/* Begins at row y of a small textured triangle. */
void ph_small_texels_begin(struct ph_small_texels *s, const struct ph_triangle *t, int32_t y, uint32_t stride_bytes);

/* Draws the rows of r, whose depth is in codes; depth, pixels: of column 0 of the first. Returns their pixels. */
uint32_t ph_small_texels_draw(struct ph_small_texels *s, const struct ph_small_triangle *r, uint16_t *depth,
                              uint16_t *pixels);

/* Draws the rows of a small textured triangle that lie in the band, if it is usual and lies in one octave. */
uint32_t ph_draw_small_texels(const struct ph_triangle *t, const struct ph_band *band);

/* n pixels of a row from column x on; d: of the first, a 16.16 code. */
struct ph_row_piece {
    uint32_t x, n, d, gd;
    bool last; /* of the row */
};

/* Draws a piece of a row; behind the last one it stands at the next row. depth, pixels: of column 0. */
void ph_small_texels_piece(struct ph_small_texels *s, const struct ph_row_piece *piece, uint16_t *depth,
                           uint16_t *pixels);

#endif
