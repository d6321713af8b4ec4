/*
 * texture_tile_plain: ph_texture_tile of texture_tile.h in plain C, for a CPU without a form of its own, and for the
 * tiles that such a form cannot take.
 */
#ifndef PH_TEXTURE_TILE_PLAIN_H
#define PH_TEXTURE_TILE_PLAIN_H

#include "span.h"
#include "texture_tile.h"

/* The columns of a row, and a factor that u and v share. */
struct ph_row_run {
    uint32_t first, n;
    uint32_t pair; /* the first step is step + pair bend: that of the pair which the first pixel begins or ends */
};

/* False if the row has no pixel. */
static inline bool ph_next_row(const struct ph_texel_rows *r, struct ph_row_run *row)
{
    const bool any = ph_tile_columns(r->left, r->right, r->columns, &row->first, &row->n);
    row->pair = 2 * (row->first + 1 - (row->n & 1));
    return any;
}

static inline void ph_row_down(struct ph_texel_rows *r)
{
    r->left += r->left_dx;
    r->right += r->right_dx;
    r->d += r->d_dy;
    r->depth += r->stride_bytes / 2;
    r->pixels += r->stride_bytes / 2;
    r->rows--;
}

/* Whether the first or the last pixel of a row lies outside a clamped texture. */
static inline bool ph_is_outside(const struct ph_texel_rows *r, uint32_t first, uint32_t last)
{
    return (((ph_texel_at(&r->u, first) | ph_texel_at(&r->u, last)) & r->u_outside) |
            ((ph_texel_at(&r->v, first) | ph_texel_at(&r->v, last)) & r->v_outside)) != 0;
}

/* Draws a row. Steps change behind every second pixel, counted from the last one: see texture_tile.h. The step of a
 * parabola over two pixels grows by 8 bend from pair to pair, so the step of each pixel grows by 4. */
static inline void ph_draw_texel_row(const struct ph_texel_rows *r, const struct ph_row_run *row)
{
    uint32_t u = ph_texel_at(&r->u, row->first), du = r->u.step + row->pair * r->u.bend;
    uint32_t v = ph_texel_at(&r->v, row->first), dv = r->v.step + row->pair * r->v.bend;
    uint32_t d = r->d + row->first * r->gd;
    uint16_t *depth = r->depth + row->first, *pixel = r->pixels + row->first;
    for (uint32_t left = row->n; left > 0; left--, depth++, pixel++) {
        const uint32_t code = d >> 16;
        if (code > *depth) {
            PH_KEEP_BRANCH();
            *depth = (uint16_t)code;
            *pixel = r->texels[(v >> 16 & r->v_mask) + (u >> 22 & r->u_mask)];
        }
        d += r->gd;
        u += du;
        v += dv;
        if ((left & 1) != 0) {
            du += 4 * r->u.bend;
            dv += 4 * r->v.bend;
        }
    }
}

static inline void ph_texture_tile_plain(struct ph_texel_rows *r)
{
    while (r->rows > 0) {
        struct ph_row_run row;
        if (ph_next_row(r, &row)) {
            if (ph_is_outside(r, row.first, row.first + row.n - 1)) {
                return;
            }
            ph_draw_texel_row(r, &row);
            r->count += row.n;
        }
        ph_row_down(r);
        ph_texel_way_down(&r->u);
        ph_texel_way_down(&r->v);
    }
}

#endif
