/* small_texels: rows of small textured triangles. Private to firmware/core; u and v are set in texels.c. */
#ifndef PH_SMALL_TEXELS_H
#define PH_SMALL_TEXELS_H

#include "band.h"
#include "texel_rows.h"
#include "texture_knee.h"

/* The rows of a small textured triangle. */
struct ph_small_texels {
    struct ph_texel_run run;
    bool fast;                /* ph_texture_small can draw them, from run; else rows and kind are taken */
    struct ph_tile_rows rows; /* u, v stand at the next row, as in run */
    struct ph_tile_kind kind;
};

/* Begins at row y of a small textured triangle. */
void ph_small_texels_begin(struct ph_small_texels *s, const struct ph_triangle *t, int32_t y, uint32_t stride_bytes);

/* Draws the rows of `small`, whose depth is in codes; depth, pixels: of column 0 of the first. Returns their pixels. */
uint32_t ph_small_texels_draw(struct ph_small_texels *s, const struct ph_small_triangle *small, uint16_t *depth,
                              uint16_t *pixels);

/* Draws the rows of a small textured triangle that lie in the band, if it lies in one octave. */
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
