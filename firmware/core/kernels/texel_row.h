/*
 * texel_row: the kernels that draw a row of texels with light or a filter. See kernels.h.
 *
 * The last four pixels of a row have one light, so do the four before them, and so on: the light at their middle. Light
 * is a number of 32nds, 0 .. 32.
 *
 * A bilinear texel is the sum of four, in 32nds: with fu and fv, 0 .. 31, the parts of u and v, the farthest has
 * fu fv / 32, rounded down. Each channel of the sum is rounded to nearest; then light scales it, rounded down.
 */
#ifndef PH_TEXEL_ROW_H
#define PH_TEXEL_ROW_H

#include <stdint.h>

/* Rows of texels between two edges, from one on: those of a tile, or of a small triangle. */
struct ph_texel_rows {
    uint32_t left, right, d; /* edges as in ph_edge, and depth (a 16.16 code) at column 0 */
    uint32_t left_dx, right_dx, d_dy;
    uint16_t *depth, *pixels; /* of column 0 */
    uint32_t stride_bytes;    /* from row to row, of both */
    uint32_t gd;              /* depth per column */
    uint32_t u_mask, v_mask;  /* of the column's and the row's bits in the index of a texel */
    const uint16_t *texels;
    uint32_t rows;
    uint32_t light, light_dy, glight; /* 32nds in 2^-24 at column 0, per row and per column; not of unlit kernels */
};

/* How far v of a nearest texel is shifted down, to be masked and become the part of an index. */
static inline uint32_t ph_texel_v_down(uint32_t v_mask)
{
    return v_mask >> 16 != 0 ? 12 : 16;
}

/* u or v along a row: at its first pixel, its step there, and that step's own, which it takes behind every second
 * pixel, counted from the last one. Units are those of struct ph_tile_rows. */
struct ph_texel_walk {
    uint32_t at, step, bend;
};

struct ph_texel_row {
    uint16_t *depth, *pixels; /* of the first pixel */
    uint32_t n;               /* pixels: 1 .. PH_TILE */
    uint32_t d, gd;           /* depth at the first pixel, a 16.16 code, and per pixel */
    struct ph_texel_walk u, v;
    uint32_t u_mask, v_mask; /* as in struct ph_texel_rows */
    const uint16_t *texels;
    uint32_t level;             /* light of the first 1 .. 4 pixels */
    uint32_t light, light_step; /* of the next four, in 2^-24, and from four to four */
};

typedef void ph_texel_row_kernel(const struct ph_texel_row *r);

/* Draw a row of nearest texels: as they are, or (lit) times light. */
ph_texel_row_kernel ph_texel_row_nearest, ph_texel_row_lit;

/* Draw a row of bilinear texels: as they are, or (lit) times light. u and v are those of a texel's first corner, and
 * both are in 2^-22 of a texel. */
ph_texel_row_kernel ph_texel_row_smooth, ph_texel_row_smooth_lit;

#endif
