/*
 * texels2_row: a row of texels as a chain of 32 pixels, which is entered at its length. Private to the kernels of this
 * folder.
 */
#ifndef PH_TEXELS2_ROW_H
#define PH_TEXELS2_ROW_H

#include "texels2.h"

/* What all rows of a triangle or a tile have in common. */
struct texels2_common {
    uint64_t mask, u_to_v, bend; /* u_to_v: a product with it adds the column of u to the row of v; bend: of two pixels
                                  */
    uint64_t pair_bend[2];       /* what the first step of a row of even, of odd length has more */
    const uint16_t *texels;
    ptrdiff_t to_pixels; /* from a depth to its pixel, in bytes */
    __m128i gd;          /* in word 0 */
};

/* Fills in struct texels2_common; bend: those of u and v in one word. The compiler must not know u_to_v: it would take
 * several instructions in place of the product. */
static inline struct texels2_common texels2_common_of(const uint16_t *texels, uint32_t u_mask, uint32_t v_mask,
                                                      const uint16_t *depth, const uint16_t *pixels, uint32_t gd,
                                                      uint64_t bend, unsigned v_down)
{
    struct texels2_common t = {(uint64_t)v_mask << v_down | u_mask << 22,
                               (uint64_t)1 << (v_down - 22) | 1,
                               4 * bend,
                               {2 * bend, 0},
                               texels,
                               (const uint8_t *)pixels - (const uint8_t *)depth,
                               _mm_cvtsi32_si128((int)gd)};
    __asm__("" : "+r"(t.u_to_v));
    return t;
}

/* u and v of a pixel, and in word 0 the depth of the one before it. */
struct texels2_walk {
    uint64_t at, step;
    __m128i before;
};

static inline __attribute__((always_inline)) void texels2_draw(const struct texels2_common *t, struct texels2_walk *w,
                                                               uint16_t *depth, unsigned v_down)
{
    w->before = _mm_add_epi32(w->before, t->gd);
    const uint16_t code = (uint16_t)_mm_extract_epi16(w->before, 1);
    if (*depth < code) {
        *depth = code;
        *(uint16_t *)(void *)((uint8_t *)depth + t->to_pixels) = t->texels[(w->at & t->mask) * t->u_to_v >> v_down];
    }
    w->at += w->step;
}

#define TEXELS2_FIRST(k)                                                                                               \
    case k:                                                                                                            \
        texels2_draw(t, w, end - (k), v_down);                                                                         \
        w->step += (k) % 2 != 0 ? t->bend : 0;
#define TEXELS2_NEXT(k)                                                                                                \
    __attribute__((fallthrough));                                                                                      \
    TEXELS2_FIRST(k)
#define TEXELS2_FOUR(k) TEXELS2_NEXT(k) TEXELS2_NEXT((k)-1) TEXELS2_NEXT((k)-2) TEXELS2_NEXT((k)-3)

/* Draws the n = 1 .. 32 pixels before `end`. The step grows behind every second pixel, counted from the last one.
 * v_down: a constant, as in texels2_down. */
/* NOLINTNEXTLINE(readability-function-size): 32 times the same */
static inline __attribute__((always_inline)) void texels2_row(const struct texels2_common *t, uint16_t *end, uint64_t n,
                                                              struct texels2_walk *w, unsigned v_down)
{
    switch (n) {
        TEXELS2_FIRST(32)
        TEXELS2_NEXT(31)
        TEXELS2_NEXT(30)
        TEXELS2_NEXT(29)
        TEXELS2_FOUR(28)
        TEXELS2_FOUR(24)
        TEXELS2_FOUR(20)
        TEXELS2_FOUR(16)
        TEXELS2_FOUR(12)
        TEXELS2_FOUR(8)
        TEXELS2_FOUR(4)
        break;
    default:
        __builtin_unreachable();
    }
}

#endif
