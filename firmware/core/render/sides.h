/* sides: two sides and the area of a projected triangle. Private to firmware/core. */
#ifndef PH_SIDES_H
#define PH_SIDES_H

#include "vertex.h"

/* A triangle a, b, c in 1/256 px. */
struct ph_sides {
    int32_t dx1, dy1, dx2, dy2; /* from a to b, from a to c */
    int32_t area;               /* twice the area, positive if a, b, c run counter-clockwise; if is_short in
                                   1/65536 px^2, below 2^29; else only its sign */
    bool is_short;              /* all four differences are below PH_SIDE_SHORT: products of two fit 30 bits */
};

#define PH_SIDE_SHORT ((uint32_t)1 << 14) /* 64 px */
#define PH_SIDE_SMALL                                                                                                  \
    ((uint32_t)1 << 13) /* 32 px: a small triangle has no longer side, so PH_SMALL_COLUMNS columns                     \
                         */

static inline int64_t ph_wide_area(const struct ph_sides *s)
{
    return fx_mul_wide(s->dx2, s->dy1) - fx_mul_wide(s->dx1, s->dy2);
}

/* Whether -PH_SIDE_SHORT <= d < PH_SIDE_SHORT for all four d. The shifts need no constants, which would take
 * registers. */
static inline bool ph_sides_are_short(int32_t dx1, int32_t dy1, int32_t dx2, int32_t dy2)
{
    return ((uint32_t)((dx1 >> 14) + 1) | (uint32_t)((dy1 >> 14) + 1) | (uint32_t)((dx2 >> 14) + 1) |
            (uint32_t)((dy2 >> 14) + 1)) <= 1;
}

/* Whether the sides from the first corner, and the third one across, are below `side`, a power of two. */
static inline bool ph_sides_are_below(const struct ph_sides *s, uint32_t side)
{
    const uint32_t dx1 = (uint32_t)s->dx1, dx2 = (uint32_t)s->dx2, dy1 = (uint32_t)s->dy1, dy2 = (uint32_t)s->dy2;
    return ((dx1 + side) | (dy1 + side) | (dx2 + side) | (dy2 + side) | (dx2 - dx1 + side)) < 2 * side;
}

static inline bool ph_sides_are_small(const struct ph_sides *s)
{
    return ph_sides_are_below(s, PH_SIDE_SMALL);
}

/* A number with the sign of ph_wide_area. */
static inline int32_t ph_wide_area_sign(int32_t dx1, int32_t dy1, int32_t dx2, int32_t dy2)
{
    const int64_t area = fx_mul_wide(dx2, dy1) - fx_mul_wide(dx1, dy2);
    return (int32_t)(area >> 32) | (area > 0);
}

/* The sides and the area of a triangle whose corners are projected. */
struct ph_sides ph_sides(const struct ph_vertex *a, const struct ph_vertex *b, const struct ph_vertex *c);

#endif
