/*
 * texture_tile: the kernel that draws rows of a textured triangle within a tile of at most PH_TILE columns (see
 * texture.c). See kernels.h.
 *
 * Along a row u and v follow a parabola: at + i step + i^2 bend at column i. From row to row its coefficients change by
 * second differences. All of it is modulo 2^32.
 *
 * Two pixels share a step, the mean of the parabola's steps over both: so the step changes half as often, and every
 * second pixel lies on the parabola. Pairs are counted from the row's last pixel, because unrolled loops are entered in
 * the middle and end there. In a row of odd length the first pixel is the second of a pair, and those behind it are off
 * by one bend.
 */
#ifndef PH_TEXTURE_TILE_H
#define PH_TEXTURE_TILE_H

#include "texel_row.h"

#include <stdbool.h>
#include <stdint.h>

#define PH_TILE 64

struct ph_texel_way {
    uint32_t at, step, bend;          /* of the row */
    uint32_t at_dy, step_dy, bend_dy; /* how much they grow to the row below */
    uint32_t at_ddy, step_ddy;        /* how much that grows */
};

struct ph_tile_rows {
    struct ph_texel_rows row;      /* column 0 is that of the tile */
    uint32_t columns;              /* of the tile that are in the picture: 1 .. PH_TILE; one more of a small triangle */
    uint32_t count;                /* pixels drawn */
    uint32_t outside;              /* u_outside | v_outside */
    uint32_t u_outside, v_outside; /* the bits that u and v have outside a texture that is clamped that way, or 0 */
    struct ph_texel_way u,
        v; /* u: texel columns in 2^-22; v: texel rows times the texture's width in 2^-16, or in
              2^-12      if the texture has over 65,536 texels, which v_mask tells: see ph_texel_v_down */
};

/* Draws rows, at least one. It stops before a row that begins or ends outside a clamped texture. Afterwards everything
 * stands at the next row, `rows` is the number of rows left, and `count` has grown by the pixels. */
void ph_texture_tile(struct ph_tile_rows *r);

/* Steps the coefficients of u or v to the next row. */
static inline void ph_texel_way_down(struct ph_texel_way *w)
{
    w->at += w->at_dy;
    w->step += w->step_dy;
    w->bend += w->bend_dy;
    w->at_dy += w->at_ddy;
    w->step_dy += w->step_ddy;
}

/* The n columns from `from` on of a tile's row between two edges; false if there are none. */
static inline bool ph_tile_columns(uint32_t left_edge, uint32_t right_edge, uint32_t columns, uint32_t *from,
                                   uint32_t *n)
{
    const int32_t left = (int32_t)left_edge >> 16, right = (int32_t)right_edge >> 16;
    const int32_t first = left > 0 ? left : 0, end = right < (int32_t)columns ? right : (int32_t)columns;
    *from = (uint32_t)first;
    *n = (uint32_t)(end - first);
    return first < end;
}

static inline uint32_t ph_texel_at(const struct ph_texel_way *w, uint32_t i)
{
    return w->at + i * (w->step + i * w->bend);
}

#endif
