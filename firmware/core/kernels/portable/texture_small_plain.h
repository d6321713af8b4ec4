/* texture_small_plain: ph_texture_small of texture_small.h in plain C, for a CPU without a form of its own, and for the
 * triangles that such a form cannot take. */
#ifndef PH_TEXTURE_SMALL_PLAIN_H
#define PH_TEXTURE_SMALL_PLAIN_H

#include "span.h"
#include "texture_small.h"

/* The first pixel of a row in column `from`. */
static inline uint32_t ph_line_at(const struct ph_texel_line *l, uint32_t from)
{
    return l->at + from * (l->step + from * l->bend);
}

static inline void ph_draw_texel_line(const struct ph_texel_run *r, uint32_t from, uint32_t n)
{
    const uint32_t pair = 2 * (from + 1 - (n & 1));
    uint32_t u = ph_line_at(&r->u, from), du = r->u.step + pair * r->u.bend;
    uint32_t v = ph_line_at(&r->v, from), dv = r->v.step + pair * r->v.bend;
    uint32_t d = r->d + from * r->gd;
    uint16_t *depth = r->depth + (int32_t)from, *pixel = r->pixels + (int32_t)from;
    for (uint32_t left = n; left > 0; left--, depth++, pixel++) {
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
