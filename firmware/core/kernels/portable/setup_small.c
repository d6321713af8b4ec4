/* ph_setup_small and ph_setup_fast of kernels.h, in C for any CPU. */
#include "float_depths.h"
#include "kernels.h"
#include "list.h"
#include "slopes.h"

enum {
    STEEP_DEPTH = 17, /* bits that a gradient per 1/256 px may have: at 2^25 per pixel it is right to a code or two */
    FINE_DEPTH = 16,  /* with so many bits dropped of a gradient, no corner is off by more: */
    RIGHT_DEPTH = 9 << 12, /* 9/16 of a 16.16 code; why: host-sim/depth/depth_separation.c */
    STEEP_LIGHT = 28,      /* the head room of light allows that at 2^-9 px beside the triangle */
};

/* Whether a plane of depth through the first corner is right at the others, and so everywhere between them. */
static inline bool is_right(const struct ph_subpixel_gradient *g, const struct ph_sides *s, uint32_t d1, uint32_t d2)
{
    const uint32_t x = (uint32_t)g->x, y = (uint32_t)g->y;
    const uint32_t off1 = x * (uint32_t)s->dx1 + y * (uint32_t)s->dy1 - d1;
    const uint32_t off2 = x * (uint32_t)s->dx2 + y * (uint32_t)s->dy2 - d2;
    return off1 + RIGHT_DEPTH < 2 * RIGHT_DEPTH && off2 + RIGHT_DEPTH < 2 * RIGHT_DEPTH;
}

static inline bool set_depth_gradient(struct ph_subpixel_gradient *g, const struct ph_slopes *slopes,
                                      const struct ph_sides *sides, const uint32_t d[3])
{
    const int32_t d1 = (int32_t)(d[1] - d[0]), d2 = (int32_t)(d[2] - d[0]);
    const int excess = 32 - PH_SLOPE_BITS - fx_clz32(ph_without_sign(d1) | ph_without_sign(d2)),
              drop = excess > 0 ? excess : 0, down = slopes->shift - drop;
    return down >= 0 && ph_set_gradient(g, slopes, d1 >> drop, d2 >> drop, drop, STEEP_DEPTH) &&
           (down >= FINE_DEPTH || is_right(g, sides, (uint32_t)d1, (uint32_t)d2));
}

static inline void set_light(struct ph_triangle *t, const struct ph_slopes *slopes, const struct ph_vertex *const v[3],
                             uint32_t x, uint32_t y)
{
    struct ph_subpixel_gradient light;
    /* The plane of light is in 2^-16. Of 16 bits of a difference PH_SLOPE_BITS are kept: 17 bits of the plane are
     * dropped.
     */
    ph_set_gradient(&light, slopes, (v[1]->light - v[0]->light) >> 1, (v[2]->light - v[0]->light) >> 1, 17,
                    STEEP_LIGHT);
    t->as.small.rows.glight = (uint32_t)light.x * 256;
    t->as.small.rows.light_dy = (uint32_t)light.y * 256;
    t->as.small.rows.light = ((uint32_t)v[0]->light << 16) + (uint32_t)light.x * x + (uint32_t)light.y * y;
}

/* Sets the planes of depth and light. False if depth is too steep, or the triangle so thin that depth would be off by
 * more than RIGHT_DEPTH: then it is not set. */
static inline bool set_planes(struct ph_triangle *t, const struct ph_vertex *const v[3], const struct ph_sides *sides,
                              const uint32_t d[3])
{
    const struct ph_slopes slopes = ph_slopes_of(sides);
    const uint32_t x = (uint32_t)(128 - v[0]->x), y = (uint32_t)(t->y_top * 256 + 128 - v[0]->y);
    struct ph_subpixel_gradient depth;
    if (t->as.small.rows.ramp == NULL) {
        t->as.small.of.slopes = slopes;
    } else {
        set_light(t, &slopes, v, x, y);
    }
    if (!set_depth_gradient(&depth, &slopes, sides, d)) {
        return false;
    }
    t->as.small.rows.gd = (uint32_t)depth.x * 256;
    t->as.small.rows.d_dy = (uint32_t)depth.y * 256;
    t->as.small.rows.d = d[0] + (uint32_t)depth.x * x + (uint32_t)depth.y * y;
    return true;
}

/* The edge from a down to b at `row`, the first row of a. */
static inline void set_edge(const struct ph_vertex *a, const struct ph_vertex *b, int32_t row, struct ph_edge *edge)
{
    *edge = ph_short_edge(a, b->x - a->x, b->y - a->y, row, row);
}

/* Inlined into both callers, so that values they have computed stay in registers. */
static inline __attribute__((always_inline)) enum ph_small_setup setup_small(struct ph_triangle *t,
                                                                             const struct ph_vertex *const v[3],
                                                                             const struct ph_sides *sides,
                                                                             const uint32_t d[3])
{
    const struct ph_outline o = ph_outline(v);
    if (o.row_top >= o.row_low) {
        return PH_SMALL_NO_ROW;
    }
    struct ph_small_triangle *const small = &t->as.small.rows;
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

enum ph_small_setup ph_setup_small(struct ph_triangle *t, const struct ph_vertex *const v[3],
                                   const struct ph_sides *sides, const uint32_t d[3])
{
    return setup_small(t, v, sides, d);
}

/* Finds the codes of fixed16 of the corners. False if two are 2^31 apart. */
static inline bool fixed_depths(uint32_t bias, const struct ph_vertex *const v[3], uint32_t d[3])
{
    for (int i = 0; i < 3; i++) {
        d[i] = ph_depth_before((struct ph_quotient){v[i]->q, v[i]->s}, 0, 0) + bias;
    }
    return ((d[0] ^ d[1]) | (d[0] ^ d[2])) >> 31 == 0;
}

/* Finds the depth of the corners, without a call for most triangles. */
static inline bool fast_depths(const struct ph_fast *fast, const struct ph_vertex *const v[3], uint32_t d[3])
{
    if (fast->lens == NULL) {
        return fixed_depths(fast->bias, v, d);
    }
    return v[0]->s == v[1]->s && v[0]->s == v[2]->s ? ph_float_depths_alike(fast->lens, v, fast->bias, d)
                                                    : fast->set_codes(fast->lens, v, fast->bias, d);
}

/* Whether a corner keeps a pixel away from the borders. */
static inline bool is_off_borders(const struct ph_fast *fast, const struct ph_vertex *v)
{
    return (uint32_t)v->x - 256 <= fast->inner_x + 2 * fast->side &&
           (uint32_t)v->y - 256 <= fast->inner_y + 2 * fast->side;
}

/* Whether all corners keep a pixel away from the borders, if the sides are below fast->side. Mostly the first corner
 * tells: see inner() in frame.c. */
static inline bool is_inside(const struct ph_fast *fast, const struct ph_vertex *const v[3])
{
    const uint32_t margin = fast->margin;
    return ((uint32_t)v[0]->x - margin < fast->inner_x && (uint32_t)v[0]->y - margin < fast->inner_y) ||
           (is_off_borders(fast, v[0]) && is_off_borders(fast, v[1]) && is_off_borders(fast, v[2]));
}

enum ph_small_setup ph_setup_fast(const struct ph_fast *fast, const struct ph_ref *ref, struct ph_triangle *t)
{
    const struct ph_vertex *const base = fast->base;
    const struct ph_vertex *const v[3] = {&base[ref->corner[0]], &base[ref->corner[1]], &base[ref->corner[2]]};
    if (!is_inside(fast, v)) {
        return PH_SMALL_NO_ROW;
    }
    const int32_t dx1 = v[1]->x - v[0]->x, dx2 = v[2]->x - v[0]->x;
    const int32_t dy1 = v[1]->y - v[0]->y, dy2 = v[2]->y - v[0]->y;
    const uint32_t area = (uint32_t)dx2 * (uint32_t)dy1 - (uint32_t)dx1 * (uint32_t)dy2; /* wraps where not small */
    const struct ph_sides sides = {dx1, dy1, dx2, dy2, (int32_t)area, true};
    uint32_t d[3];
    if (!ph_sides_are_below(&sides, fast->side) || !fast_depths(fast, v, d)) {
        return PH_SMALL_NO_ROW;
    }
    t->kind = PH_KIND_SMALL;
    t->block = PH_BLOCK_NONE;
    t->material = fast->material;
    t->as.small.rows.ramp = fast->ramp;
    return setup_small(t, v, &sides, d);
}
