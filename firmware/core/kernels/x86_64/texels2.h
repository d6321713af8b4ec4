/* texels2: u and v in one word, and a row of texels, for x86-64. Private to the kernels of this folder. */
#ifndef PH_TEXELS2_H
#define PH_TEXELS2_H

#include "texture_small.h"

#define TEXELS2_SIGN                                                                                                   \
    ((uint64_t)1 << 31) /* added to u, so that it is not negative; a multiple of the texture's width                   \
                         */
#define TEXELS2_U_TO_V                                                                                                 \
    ((uint64_t)1 << 26 | 1) /* a product with this adds the texel column of u to the texel row of v */

/* Whether |v| is below 2^log2. */
static inline bool texels2_below(uint32_t v, int log2)
{
    return v + ((uint32_t)1 << log2) < (uint32_t)2 << log2;
}

static inline uint64_t texels2(uint32_t u, uint32_t v)
{
    return ((uint64_t)v << 32) + (uint64_t)(int64_t)(int32_t)u;
}

static inline void texels2_part(uint64_t both, uint32_t *u, uint32_t *v)
{
    *u = (uint32_t)both;
    *v = (uint32_t)((both - (uint64_t)(int64_t)(int32_t)*u) >> 32);
}

/* Whether u of a run, over 32 columns and 32 rows to all sides, stays below 2^31 and never wraps. */
static inline bool texels2_fit(const struct ph_texel_run *r)
{
    const struct ph_texel_line *const u = &r->u;
    return r->rows + r->lower_rows <= 32 && r->u_mask < 512 && texels2_below(u->at, 29) && texels2_below(u->step, 24) &&
           texels2_below(u->bend, 17) && texels2_below(u->at_dy, 24) && texels2_below(u->step_dy, 17) &&
           texels2_below(u->at_ddy, 18);
}

/* All coefficients of a run as 2^32 v + u, so that one operation serves both. */
struct texels2_line {
    uint64_t at, step, at_dy, step_dy, at_ddy, bend;
};

static inline struct texels2_line texels2_line(const struct ph_texel_run *r)
{
    return (struct texels2_line){texels2(r->u.at, r->v.at) + TEXELS2_SIGN, texels2(r->u.step, r->v.step),
                                 texels2(r->u.at_dy, r->v.at_dy),          texels2(r->u.step_dy, r->v.step_dy),
                                 texels2(r->u.at_ddy, r->v.at_ddy),        texels2(r->u.bend, r->v.bend)};
}

static inline void texels2_line_down(struct texels2_line *b)
{
    b->at += b->at_dy;
    b->step += b->step_dy;
    b->at_dy += b->at_ddy;
}

/* Gives u and v back to the run. */
static inline void texels2_line_part(const struct texels2_line *b, struct ph_texel_run *r)
{
    texels2_part(b->at - TEXELS2_SIGN, &r->u.at, &r->v.at);
    texels2_part(b->step, &r->u.step, &r->v.step);
    texels2_part(b->at_dy, &r->u.at_dy, &r->v.at_dy);
}

/* The state along a row. */
struct texels2_walk {
    uint64_t at, step;
    uint32_t d, gd;
};

static inline __attribute__((always_inline)) void texels2_draw(struct texels2_walk *w, uint16_t *depth, uint16_t *pixel,
                                                               const uint16_t *texels, uint64_t mask, uint64_t u_to_v)
{
    const uint16_t code = (uint16_t)(w->d >> 16);
    if (*depth < code) {
        *depth = code;
        *pixel = texels[(w->at & mask) * u_to_v >> 48];
    }
    w->d += w->gd;
    w->at += w->step;
}

/* u and v along n pixels from column `from` on. */
static inline struct texels2_walk texels2_walk(const struct texels2_line *b, int32_t from, uint32_t n)
{
    const uint64_t first = (uint64_t)(int64_t)from, pair = 2 * (first + 1 - (n & 1));
    return (struct texels2_walk){.at = b->at + first * (b->step + first * b->bend), .step = b->step + pair * b->bend};
}

/* Draws the n pixels before depth and pixels. The step grows by `bend` behind every second pixel, counted from the last
 * one. */
static inline void texels2_row(uint16_t *depth, uint16_t *pixels, uint32_t n, struct texels2_walk w, uint64_t bend,
                               uint64_t mask, const uint16_t *texels)
{
    uint64_t u_to_v = TEXELS2_U_TO_V;
    __asm__("" : "+r"(u_to_v)); /* else the compiler takes several instructions in place of the product */
    intptr_t i = -(intptr_t)n;
    if ((n & 1) != 0) {
        texels2_draw(&w, &depth[i], &pixels[i], texels, mask, u_to_v);
        w.step += bend;
        i++;
    }
    for (; i != 0; i += 2) {
        texels2_draw(&w, &depth[i], &pixels[i], texels, mask, u_to_v);
        texels2_draw(&w, &depth[i + 1], &pixels[i + 1], texels, mask, u_to_v);
        w.step += bend;
    }
}

#endif
