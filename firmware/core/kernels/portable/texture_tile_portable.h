/*
 * texture_tile_portable: ph_texture_tile of texture_tile.h in portable C, for a CPU without a form of its own, and for
 * the tiles that such a form cannot take.
 */
#ifndef PH_TEXTURE_TILE_PORTABLE_H
#define PH_TEXTURE_TILE_PORTABLE_H

#include "texel_row_portable.h"
#include "texture_tile.h"

/* The columns of a row, and a factor that u and v share. */
struct ph_row_run {
    uint32_t first, n;
    uint32_t pair; /* the first step is step + pair bend: that of the pair which the first pixel begins or ends */
};

/* Finds the columns of the next row. False if it has no pixel. */
static inline bool ph_next_row(const struct ph_tile_rows *r, struct ph_row_run *row)
{
    const bool any = ph_tile_columns(r->row.left, r->row.right, r->columns, &row->first, &row->n);
    row->pair = 2 * (row->first + 1 - (row->n & 1));
    return any;
}

static inline void ph_row_down(struct ph_tile_rows *r)
{
    r->row.left += r->row.left_dx;
    r->row.right += r->row.right_dx;
    r->row.d += r->row.d_dy;
    r->row.depth += r->row.stride_bytes / 2;
    r->row.pixels += r->row.stride_bytes / 2;
    r->row.rows--;
}

/* The bits of u or v at the first and at the last pixel of a row. In a row of even length the last is one bend off its
 * parabola. */
static inline uint32_t ph_bits_at_ends(const struct ph_texel_way *w, const struct ph_row_run *row)
{
    const uint32_t last = ph_texel_at(w, row->first + row->n - 1);
    return ph_texel_at(w, row->first) | ((row->n & 1) != 0 ? last : last + w->bend);
}

/* Whether the first or the last pixel of a row lies outside a clamped texture. */
static inline bool ph_is_outside(const struct ph_tile_rows *r, const struct ph_row_run *row)
{
    return r->outside != 0 &&
           ((ph_bits_at_ends(&r->u, row) & r->u_outside) | (ph_bits_at_ends(&r->v, row) & r->v_outside)) != 0;
}

static inline void ph_draw_tile_row(const struct ph_tile_rows *r, const struct ph_row_run *row)
{
    const uint32_t first = row->first, n = row->n;
    const struct ph_texel_row pixels = {
        .depth = r->row.depth + first,
        .pixels = r->row.pixels + first,
        .n = n,
        .d = r->row.d + first * r->row.gd,
        .gd = r->row.gd,
        .u = ph_texel_walk_from(r->u.at, r->u.step, r->u.bend, first, n),
        .v = ph_texel_walk_from(r->v.at, r->v.step, r->v.bend, first, n),
        .u_mask = r->row.u_mask,
        .v_mask = r->row.v_mask,
        .texels = r->row.texels,
    };
    ph_texel_row_any(&pixels, false, false, ph_texel_v_down(pixels.v_mask));
}

static inline void ph_texture_tile_portable(struct ph_tile_rows *r)
{
    while (r->row.rows > 0) {
        struct ph_row_run row;
        if (ph_next_row(r, &row)) {
            if (ph_is_outside(r, &row)) {
                return;
            }
            ph_draw_tile_row(r, &row);
            r->count += row.n;
        }
        ph_row_down(r);
        ph_texel_way_down(&r->u);
        ph_texel_way_down(&r->v);
    }
}

#endif
