/* texture_small_plain: ph_texture_small of texture_small.h in plain C, for a CPU without a form of its own, and for the
 * triangles that such a form cannot take. */
#ifndef PH_TEXTURE_SMALL_PLAIN_H
#define PH_TEXTURE_SMALL_PLAIN_H

#include "texels_plain.h"
#include "texture_small.h"

static inline void ph_draw_texel_line(const struct ph_texel_run *r, uint32_t from, uint32_t n)
{
    const struct ph_texel_target to = {r->depth + (int32_t)from,
                                       r->pixels + (int32_t)from,
                                       r->d + from * r->gd,
                                       r->gd,
                                       r->u_mask,
                                       r->v_mask,
                                       r->texels};
    ph_draw_texels(to, ph_texel_walk_from(r->u.at, r->u.step, r->u.bend, from, n),
                   ph_texel_walk_from(r->v.at, r->v.step, r->v.bend, from, n), n);
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
