/* ph_setup_small of kernels.h. */
#include "kernels.h"

#include "edge.h"

enum {
    FRACTION = 15,    /* bits that are kept of a difference and of a side */
    STEEP_DEPTH = 17, /* bits that a gradient per 1/256 px may have: at 2^25 per pixel it is right to a code or two */
    ROUGH_DEPTH = 11, /* bits dropped of a gradient; with fewer, FRACTION is codes off on thin triangles */
    STEEP_LIGHT = 28, /* the head room of light allows that at 2^-9 px beside the triangle */
};

/*
 * The sides over their area (twice the triangle's), times 2^shift: dy1, dy2, dx1, dx2, in this order. Let d1 and d2 be
 * the differences between the value at the second or third corner and that at the first. Then the gradient of the value
 * is x = (d2 dy1 - d1 dy2) / area = d2 a - d1 b and y = (d1 dx2 - d2 dx1) / area = d1 d - d2 c.
 */
struct slopes {
    int32_t a, b, c, d;
    int shift;
};

static struct slopes slopes_of(const struct ph_sides *s)
{
    const int zeros = fx_clz32((uint32_t)s->area);
    /* NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): area > 0 */
    const int32_t reciprocal = (int32_t)fx_rcp16((uint32_t)s->area << zeros >> 16); /* 2^(47 - zeros) / area */
    const int bits = 32 - fx_clz32(ph_without_sign(s->dx1) | ph_without_sign(s->dy1) | ph_without_sign(s->dx2) |
                                   ph_without_sign(s->dy2) | 31);
    const int down = bits + 16 - FRACTION;
    return (struct slopes){s->dy1 * reciprocal >> down, s->dy2 * reciprocal >> down, s->dx1 * reciprocal >> down,
                           s->dx2 * reciprocal >> down, 47 - zeros - down};
}

struct subpixel_gradient {
    int32_t x, y; /* per 1/256 px */
};

/* Halves a gradient until it fits. False if it had to. */
static __attribute__((noinline)) bool flatten(struct subpixel_gradient *g, int down, int limit)
{
    const int least = 32 - fx_clz32(ph_without_sign(g->x) | ph_without_sign(g->y)) - limit;
    const int by = down > least ? down : least;
    *g = by < 0 ? (struct subpixel_gradient){g->x * (1 << -by), g->y * (1 << -by)}
                : (struct subpixel_gradient){g->x >> by, g->y >> by};
    return least <= down;
}

/* The gradient from the differences over 2^drop, which have FRACTION bits. False if it was flattened. */
static bool set_gradient(struct subpixel_gradient *g, const struct slopes *s, int32_t d1, int32_t d2, int drop,
                         int limit)
{
    const int down = s->shift - drop;
    *g = (struct subpixel_gradient){d2 * s->a - d1 * s->b, d1 * s->d - d2 * s->c};
    if (down < 31 - limit) {
        return flatten(g, down, limit);
    }
    g->x >>= down;
    g->y >>= down;
    return true;
}

static bool set_depth_gradient(struct subpixel_gradient *g, const struct slopes *s, const uint32_t d[3])
{
    const int32_t d1 = (int32_t)(d[1] - d[0]), d2 = (int32_t)(d[2] - d[0]);
    const int excess = 32 - FRACTION - fx_clz32(ph_without_sign(d1) | ph_without_sign(d2)),
              drop = excess > 0 ? excess : 0;
    return s->shift - drop >= ROUGH_DEPTH && set_gradient(g, s, d1 >> drop, d2 >> drop, drop, STEEP_DEPTH);
}

/* False if depth is too steep or the triangle too thin: then it is not set. */
static bool set_planes(struct ph_triangle *t, const struct ph_vertex *const v[3], const struct ph_sides *sides,
                       const uint32_t d[3])
{
    const struct slopes slopes = slopes_of(sides);
    const uint32_t x = (uint32_t)(128 - v[0]->x), y = (uint32_t)(t->y_top * 256 + 128 - v[0]->y);
    struct subpixel_gradient depth, light;
    /* The plane of light is in 2^-16. Of 16 bits of a difference FRACTION are kept: 17 bits of the plane are dropped.
     */
    set_gradient(&light, &slopes, (v[1]->light - v[0]->light) >> 1, (v[2]->light - v[0]->light) >> 1, 17, STEEP_LIGHT);
    t->small.glight = (uint32_t)light.x * 256;
    t->small.light_dy = (uint32_t)light.y * 256;
    t->small.light = ((uint32_t)v[0]->light << 16) + (uint32_t)light.x * x + (uint32_t)light.y * y;
    if (!set_depth_gradient(&depth, &slopes, d)) {
        return false;
    }
    t->small.gd = (uint32_t)depth.x * 256;
    t->small.d_dy = (uint32_t)depth.y * 256;
    t->small.d = d[0] + (uint32_t)depth.x * x + (uint32_t)depth.y * y;
    return true;
}

/* The edge from a down to b at `row`, the first row of a. */
static void set_edge(const struct ph_vertex *a, const struct ph_vertex *b, int32_t row, struct ph_edge *edge)
{
    *edge = ph_short_edge(a, b->x - a->x, b->y - a->y, row, row);
}

enum ph_small_setup ph_setup_small(struct ph_triangle *t, const struct ph_vertex *const v[3],
                                   const struct ph_sides *sides, const uint32_t d[3])
{
    const struct ph_outline o = ph_outline(v);
    if (o.row_top >= o.row_low) {
        return PH_SMALL_NO_ROW;
    }
    struct ph_small_triangle *const small = &t->small;
    const bool flat_top = o.row_mid == o.row_top;
    struct ph_edge long_edge, first;
    set_edge(o.top, o.low, o.row_top, &long_edge);
    set_edge(flat_top ? o.mid : o.top, flat_top ? o.low : o.mid, o.row_top, &first);
    small->left = (uint32_t)(o.long_left ? long_edge.x : first.x);
    small->left_dx = (uint32_t)(o.long_left ? long_edge.dx : first.dx);
    small->right = (uint32_t)(o.long_left ? first.x : long_edge.x);
    small->right_dx = (uint32_t)(o.long_left ? first.dx : long_edge.dx);
    small->lower_is_right = o.long_left;
    small->upper_rows = (uint16_t)(flat_top ? o.row_low - o.row_top : o.row_mid - o.row_top);
    small->lower_rows = (uint16_t)(flat_top ? 0 : o.row_low - o.row_mid);
    if (small->lower_rows > 0) {
        set_edge(o.mid, o.low, o.row_mid, &small->lower);
    }
    t->y_top = (int16_t)o.row_top;
    t->y_bottom = (int16_t)o.row_low;
    return set_planes(t, v, sides, d) ? PH_SMALL_SET : PH_SMALL_STEEP;
}
