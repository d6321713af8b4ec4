/* texels_plain: a row of texels in plain C. */
#ifndef PH_TEXELS_PLAIN_H
#define PH_TEXELS_PLAIN_H

#include "span.h"
#include "texture_tile.h"

/* u or v along a row: at its first pixel, its step there, and that step's own, which it takes behind every second
 * pixel, counted from the last one. The step of a parabola over two pixels grows by 8 bend from pair to pair, so the
 * step of each pixel grows by 4. */
struct ph_texel_walk {
    uint32_t at, step, bend;
};

/* From column `from` on, along n pixels of the row at + i step + i^2 bend. */
static inline struct ph_texel_walk ph_texel_walk_from(uint32_t at, uint32_t step, uint32_t bend, uint32_t from,
                                                      uint32_t n)
{
    const uint32_t pair = 2 * (from + 1 - (n & 1)); /* that of the pair which the first pixel begins or ends */
    return (struct ph_texel_walk){at + from * (step + from * bend), step + pair * bend, 4 * bend};
}

static inline void ph_texel_walk_on(struct ph_texel_walk *w, uint32_t left)
{
    w->at += w->step;
    if ((left & 1) != 0) {
        w->step += w->bend;
    }
}

/* Where a row is drawn, and the texture. */
struct ph_texel_target {
    uint16_t *depth, *pixels; /* of its first pixel */
    uint32_t d, gd;           /* depth there, a 16.16 code, and per pixel */
    uint32_t u_mask, v_mask;
    const uint16_t *texels;
};

static inline void ph_draw_texels(struct ph_texel_target to, struct ph_texel_walk u, struct ph_texel_walk v, uint32_t n)
{
    for (; n > 0; n--, to.depth++, to.pixels++) {
        if (ph_nearer16(to.depth, to.d)) {
            PH_KEEP_BRANCH();
            *to.pixels = to.texels[(v.at >> 16 & to.v_mask) + (u.at >> 22 & to.u_mask)];
        }
        to.d += to.gd;
        ph_texel_walk_on(&u, n);
        ph_texel_walk_on(&v, n);
    }
}

#endif
