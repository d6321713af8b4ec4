/* See tile_surface.h. */
/* Kits on armv6m: -O2. */
#include "tile_surface.h"

#include "tier.h"

PH_TIER(scenery) static int32_t mulhi(int32_t a, int32_t b)
{
    return (int32_t)(fx_mul_wide(a, b) >> 32);
}

/* 1/w at a point: 2^(61 - shift) / reciprocal. */
struct over_w {
    int32_t reciprocal;
    int shift;
};

/* Divides exactly u/w and v/w (see setup_texture): u and v below 8 of their range. */
PH_TIER(scenery)
static FX_APART struct over_w divide(uint32_t over_w, uint32_t u_over_w, uint32_t v_over_w, int32_t *u, int32_t *v)
{
    const uint32_t w = over_w - 4 < ((uint32_t)1 << 30) - 4 ? over_w : 4; /* 2^29 with head room */
    struct over_w at;
    at.reciprocal = (int32_t)(fx_rcp_norm(w, &at.shift) >> 1);
    *u = mulhi((int32_t)(u_over_w << (at.shift - 2)), at.reciprocal);
    *v = mulhi((int32_t)(v_over_w << (at.shift - 2)), at.reciprocal);
    return at;
}

/* The part of a side that ends here: q (1 + q / 2). q is the change over 1/w, 1/4 at most. See struct ph_surface. */
static inline int32_t part_of(const struct over_w *end, uint32_t change)
{
    const int32_t q = ((int32_t)(change << end->shift) >> 16) * (end->reciprocal >> 15) >> 14;
    return q + (int32_t)((uint32_t)q * (uint32_t)q >> 17);
}

/* Divides at the right side of a tile, which ends at column x; ends: 1/w at its upper and its lower corner. */
PH_TIER(scenery)
static void divide_side(const struct ph_triangle *t, const struct ph_tile *tile, uint32_t x, struct ph_surface *s,
                        struct over_w ends[2])
{
    const struct ph_plane *const over_w = ph_over_w(t), *const u_w = &t->as.large.of.map.u,
                                 *const v_w = &t->as.large.of.map.v;
    uint32_t w = ph_plane_at(over_w, x, tile->y);
    uint32_t u = ph_plane_at(u_w, x, tile->y), v = ph_plane_at(v_w, x, tile->y);
    const uint32_t change = over_w->gy << tile->height_log2;
    ends[0] = divide(w, u, v, &s->u.right[0], &s->v.right[0]);
    w += change;
    u += u_w->gy << tile->height_log2;
    v += v_w->gy << tile->height_log2;
    ends[1] = divide(w, u, v, &s->u.right[1], &s->v.right[1]);
    s->right = part_of(&ends[1], change);
}

PH_TIER(scenery) void ph_surface_begin(const struct ph_triangle *t, const struct ph_tile *tile, struct ph_surface *s)
{
    struct over_w ends[2];
    divide_side(t, tile, tile->x, s, ends);
}

PH_TIER(scenery) void ph_surface_next(const struct ph_triangle *t, const struct ph_tile *tile, struct ph_surface *s)
{
    const uint32_t width = 1u << tile->width_log2, change = ph_over_w(t)->gx * width;
    struct over_w ends[2];
    for (int i = 0; i < 2; i++) {
        s->u.left[i] = s->u.right[i];
        s->v.left[i] = s->v.right[i];
    }
    s->left = s->right;
    divide_side(t, tile, tile->x + width, s, ends);
    s->top = part_of(&ends[0], change);
    s->bottom = part_of(&ends[1], change);
}

/* A change along a side: linear s + square s^2, s = 0 .. 1. Its middle is -square / 4 beside the straight line. */
struct curve {
    uint32_t linear, square;
};

static inline struct curve curve_of(int32_t from, int32_t to, int32_t part)
{
    const uint32_t change = (uint32_t)to - (uint32_t)from;
    const uint32_t square = (uint32_t)((int32_t)(0u - (uint32_t)((int32_t)change >> 10) * (uint32_t)part) >> 6);
    return (struct curve){change - square, square};
}

/* v 2^by. */
static inline uint32_t scaled(uint32_t v, int by)
{
    return by >= 0 ? v << by : (uint32_t)((int32_t)v >> -by);
}

/*
 * The coefficients of a row are polynomials of the row's
 * number, stepped by forward differences: the first is linear + square, and it grows by 2 square from row to row. `at`
 * comes from the left side, step and bend from the top and the bottom. The right side bends more than the left by
 * twist; since `at` follows the left side alone, step takes it up.
 */
PH_TIER(scenery)
void ph_surface_way(struct ph_texel_way *way, const struct ph_corners *c, const struct ph_surface *s,
                    const struct ph_tile *tile, int up)
{
    const int x = up - tile->width_log2, xx = x - tile->width_log2, y = tile->height_log2;
    const struct curve top = curve_of(c->left[0], c->right[0], s->top);
    const struct curve bottom = curve_of(c->left[1], c->right[1], s->bottom);
    const struct curve left = curve_of(c->left[0], c->left[1], s->left);
    const struct curve right = curve_of(c->right[0], c->right[1], s->right);
    const uint32_t twist = right.square - left.square;
    way->at = scaled((uint32_t)c->left[0], up);
    way->at_dy = scaled(left.linear, up - y) + scaled(left.square, up - 2 * y);
    way->at_ddy = scaled(left.square, up - 2 * y + 1);
    way->step = scaled(top.linear, x);
    way->step_dy = scaled(bottom.linear - top.linear - twist, x - y) + scaled(twist, x - 2 * y);
    way->step_ddy = scaled(twist, x - 2 * y + 1);
    way->bend = scaled(top.square, xx);
    way->bend_dy = scaled(bottom.square - top.square, xx - y);
}
