/* slopes: gradients over a small triangle, in 32 bits. Private to firmware/core. */
#ifndef PH_SLOPES_H
#define PH_SLOPES_H

#include "edge.h"

#define PH_SLOPE_BITS 15 /* so many bits are kept of a difference and of a side */

static inline struct ph_slopes ph_slopes_of(const struct ph_sides *s)
{
    const int zeros = fx_clz32((uint32_t)s->area);
    /* NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): area > 0 */
    const int32_t reciprocal = (int32_t)fx_rcp16((uint32_t)s->area << zeros >> 16); /* 2^(47 - zeros) / area */
    const int bits = 32 - fx_clz32(ph_without_sign(s->dx1) | ph_without_sign(s->dy1) | ph_without_sign(s->dx2) |
                                   ph_without_sign(s->dy2) | 31);
    const int down = bits + 16 - PH_SLOPE_BITS;
    return (struct ph_slopes){s->dy1 * reciprocal >> down, s->dy2 * reciprocal >> down, s->dx2 * reciprocal >> down,
                              s->dx1 * reciprocal >> down, 47 - zeros - down};
}

struct ph_subpixel_gradient {
    int32_t x, y; /* per 1/256 px */
};

/* Halves a gradient until it fits. False if it had to. */
static inline bool ph_flatten(struct ph_subpixel_gradient *g, int down, int limit)
{
    const int least = 32 - fx_clz32(ph_without_sign(g->x) | ph_without_sign(g->y)) - limit;
    const int by = down > least ? down : least;
    *g = by < 0 ? (struct ph_subpixel_gradient){g->x * (1 << -by), g->y * (1 << -by)}
                : (struct ph_subpixel_gradient){g->x >> by, g->y >> by};
    return least <= down;
}

/* The gradient from the differences over 2^drop, which have PH_SLOPE_BITS bits. False if it was flattened. */
static inline bool ph_set_gradient(struct ph_subpixel_gradient *g, const struct ph_slopes *s, int32_t d1, int32_t d2,
                                   int drop, int limit)
{
    const int down = s->shift - drop;
    *g = (struct ph_subpixel_gradient){d2 * s->a - d1 * s->b, d1 * s->d - d2 * s->c};
    if (down < 31 - limit) {
        return ph_flatten(g, down, limit);
    }
    g->x >>= down;
    g->y >>= down;
    return true;
}

#endif
