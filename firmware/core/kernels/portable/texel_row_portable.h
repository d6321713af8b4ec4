/* texel_row_portable: rows of texels in portable C; see texel_row.h. */
#ifndef PH_TEXEL_ROW_PORTABLE_H
#define PH_TEXEL_ROW_PORTABLE_H

#include "span.h"
#include "texel_mix.h"

/* v_down: see ph_texel_v_down; rows with a filter take none. */
static inline __attribute__((always_inline)) void ph_texel_row_any(const struct ph_texel_row *r, bool smooth, bool lit,
                                                                   uint32_t v_down)
{
    uint16_t *depth = r->depth, *pixel = r->pixels;
    struct ph_texel_walk u = r->u, v = r->v;
    uint32_t d = r->d, level = r->level, light = r->light;
    for (uint32_t n = r->n; n > 0; n--, depth++, pixel++, d += r->gd) {
        if (ph_nearer16(depth, d)) {
            PH_KEEP_BRANCH();
            if (smooth || lit) {
                const uint32_t c =
                    smooth ? ph_mix_at(r, u.at, v.at) : ph_mix_spread(ph_texel_nearest(r, u.at, v.at, v_down));
                *pixel = ph_mix_folded(lit ? ph_mix_lit(c, level) : c);
            } else {
                *pixel = ph_texel_nearest(r, u.at, v.at, v_down);
            }
        }
        u.at += u.step;
        v.at += v.step;
        if ((n & 1) != 0) {
            PH_KEEP_BRANCH();
            u.step += u.bend;
            v.step += v.bend;
        }
        if (lit) {
            ph_texel_light_on(&level, &light, r->light_step, n);
        }
    }
}

/* Draws a row of nearest texels, in a loop of its own for either size of texture. */
static inline __attribute__((always_inline)) void ph_texel_row_unfiltered(const struct ph_texel_row *r, bool lit)
{
    if (ph_texel_v_down(r->v_mask) == 16) {
        ph_texel_row_any(r, false, lit, 16);
    } else {
        ph_texel_row_any(r, false, lit, 12);
    }
}

#endif
