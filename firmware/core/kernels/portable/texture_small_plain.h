/* texture_small_plain: ph_texture_small of texture_small.h in plain C, for a CPU without a form of its own, and for the
 * triangles that such a form cannot take. */
#ifndef PH_TEXTURE_SMALL_PLAIN_H
#define PH_TEXTURE_SMALL_PLAIN_H

#include "texel_row_plain.h"
#include "texture_small.h"

static inline void ph_draw_texel_line(const struct ph_texel_run *r, uint32_t from, uint32_t n)
{
    const struct ph_texel_row pixels = {
        .depth = r->depth + (int32_t)from,
        .pixels = r->pixels + (int32_t)from,
        .n = n,
        .d = r->d + from * r->gd,
        .gd = r->gd,
        .u = ph_texel_walk_from(r->u.at, r->u.step, r->u.bend, from, n),
        .v = ph_texel_walk_from(r->v.at, r->v.step, r->v.bend, from, n),
        .u_mask = r->u_mask,
        .v_mask = r->v_mask,
        .texels = r->texels,
    };
    ph_texel_row_any(&pixels, false, false);
}

static inline uint32_t ph_texture_small_plain(struct ph_texel_run *r)
{
    uint32_t count = 0;
    do {
        for (; r->rows > 0; r->rows--) {
            const int32_t from = (int32_t)r->left >> 16, n = ((int32_t)r->right >> 16) - from;
            if (n > 0) {
                ph_draw_texel_line(r, (uint32_t)from, (uint32_t)n);
                count += (uint32_t)n;
            }
            r->left += r->left_dx;
            r->right += r->right_dx;
            r->d += r->d_dy;
            r->depth = ph_row_below(r->depth, r->stride_bytes);
            r->pixels = ph_row_below(r->pixels, r->stride_bytes);
            ph_texel_line_down(&r->u);
            ph_texel_line_down(&r->v);
        }
    } while (ph_texel_run_lower(r));
    return count;
}

#endif
