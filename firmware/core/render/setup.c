/*
 * Triangle set-up: edges, which way a triangle takes, the list. See setup.h.
 *
 * Most triangles of a mesh are small Gouraud ones: ph_setup_small of kernels.h does these. All others take setup_any.
 */
#include "setup.h"

#include "edge.h"
#include "exact.h"
#include "kernels.h"
#include "planes.h"
#include "texels.h"

#define NOINLINE __attribute__((noinline)) /* keeps rare work out of the registers of what is usual */

/* The edge from a down to b at row y0, in 64 bits. */
static NOINLINE void wide_edge(const struct ph_vertex *a, const struct ph_vertex *b, int32_t y0, struct ph_edge *edge)
{
    const int32_t dx = b->x - a->x, row = ph_first_row(a->y), down = row * 256 + 128 - a->y;
    int shift;
    const int32_t reciprocal = ph_wide_reciprocal((uint32_t)(b->y - a->y), &shift);
    const int32_t offset = (int32_t)(fx_mul_wide(dx * down, reciprocal) >> (53 - shift));
    const int32_t slope = (int32_t)(uint32_t)(fx_mul_wide(dx, reciprocal) >> (45 - shift));
    *edge = ph_edge_at_row(a->x * 256 + offset, slope, row, y0);
}

/* The edge from a down to b at row y0. */
static FX_APART void setup_edge(const struct ph_vertex *a, const struct ph_vertex *b, int32_t y0, struct ph_edge *edge)
{
    const int32_t dx = b->x - a->x, dy = b->y - a->y;
    if ((((uint32_t)dx + PH_SIDE_SHORT) | ((uint32_t)dy << 1)) < 2 * PH_SIDE_SHORT) {
        *edge = ph_short_edge(a, dx, dy, ph_first_row(a->y), y0);
    } else {
        wide_edge(a, b, y0, edge);
    }
}

/* No column of pixel centres lies within the triangle, or none of these lies in the picture. */
static inline bool misses_columns(int32_t width, const struct ph_vertex *const v[3])
{
    const int32_t a = v[0]->x, b = v[1]->x, c = v[2]->x;
    const int32_t from = ph_first_row(ph_min(ph_min(a, b), c)), to = ph_first_row(ph_max(ph_max(a, b), c));
    return from >= to || to <= 0 || from >= width;
}

int32_t ph_wide_area_sign(int32_t dx1, int32_t dy1, int32_t dx2, int32_t dy2)
{
    const int64_t area = fx_mul_wide(dx2, dy1) - fx_mul_wide(dx1, dy2);
    return (int32_t)(area >> 32) | (area > 0);
}

/* Rows and edges; false if no row of the picture is covered. */
static FX_APART bool setup_outline(int32_t height, const struct ph_vertex *const v[3], struct ph_triangle *t)
{
    const struct ph_outline o = ph_outline(v);
    const int32_t y_top = ph_max(o.row_top, 0), y_bottom = ph_min(o.row_low, height);
    const int32_t y_mid = ph_max(ph_min(o.row_mid, height), 0);
    t->long_left = o.long_left;
    if (y_top >= y_bottom) {
        return false;
    }
    t->y_top = (int16_t)y_top;
    t->y_mid = (int16_t)y_mid;
    t->y_bottom = (int16_t)y_bottom;
    setup_edge(o.top, o.low, y_top, &t->long_edge);
    if (y_mid > y_top) {
        setup_edge(o.top, o.mid, y_top, &t->upper);
    }
    if (y_bottom > y_mid) {
        setup_edge(o.mid, o.low, y_mid, &t->lower);
    }
    return true;
}

/* Edges and planes of any triangle; *fits: 32 bits do for its depth. */
static NOINLINE bool setup_any(struct ph_renderer *r, const struct ph_material *material,
                               const struct ph_vertex *const v[3], const fx_t *const uv[3],
                               const struct ph_sides *sides, struct ph_triangle *t, bool *fits)
{
    if (misses_columns(r->config.width, v) || !setup_outline(r->config.height, v, t)) {
        return false;
    }
    t->material = material;
    *fits = ph_set_planes(t, r, v, uv, sides);
    return true;
}

/* Whether all three coordinates keep a pixel away from the borders. */
static bool is_between(int32_t a, int32_t b, int32_t c, int32_t size)
{
    return ph_min(ph_min(a, b), c) >= 256 && ph_max(ph_max(a, b), c) <= (size - 1) * 256;
}

/* Whether a small triangle keeps a pixel off the borders. Mostly its first corner tells: see inner() in frame.c. */
static inline bool is_inside(const struct ph_renderer *r, const struct ph_vertex *const v[3])
{
    const uint32_t margin = PH_SIDE_SMALL + 256;
    return ((uint32_t)v[0]->x - margin < r->inner_x && (uint32_t)v[0]->y - margin < r->inner_y) ||
           (is_between(v[0]->x, v[1]->x, v[2]->x, r->config.width) &&
            is_between(v[0]->y, v[1]->y, v[2]->y, r->config.height));
}

/* Whether all three sides are below PH_SIDE_SMALL. */
static inline bool is_small(const struct ph_sides *s)
{
    const uint32_t dx1 = (uint32_t)s->dx1, dx2 = (uint32_t)s->dx2, dy1 = (uint32_t)s->dy1, dy2 = (uint32_t)s->dy2;
    return ((dx1 + PH_SIDE_SMALL) | (dy1 + PH_SIDE_SMALL) | (dx2 + PH_SIDE_SMALL) | (dy2 + PH_SIDE_SMALL) |
            (dx2 - dx1 + PH_SIDE_SMALL)) < 2 * PH_SIDE_SMALL;
}

/* Whether a triangle that is not small can be drawn as one, because it is textured, as narrow, and has short sides. */
static NOINLINE bool is_narrow(const struct ph_renderer *r, const struct ph_sides *s,
                               const struct ph_vertex *const v[3])
{
    const uint32_t dx1 = (uint32_t)s->dx1, dx2 = (uint32_t)s->dx2, dy = (uint32_t)(s->dy2 - s->dy1);
    return r->small.shading == PH_SHADE_TEXTURE && s->is_short && dy + PH_SIDE_SHORT < 2 * PH_SIDE_SHORT &&
           ((dx1 + PH_SIDE_SMALL) | (dx2 + PH_SIDE_SMALL) | (dx2 - dx1 + PH_SIDE_SMALL)) < 2 * PH_SIDE_SMALL &&
           is_between(v[0]->x, v[1]->x, v[2]->x, r->config.width) &&
           is_between(v[0]->y, v[1]->y, v[2]->y, r->config.height);
}

/* A triangle that is less than 2 px wide may miss the centres of all columns. */
static inline bool is_thin(const struct ph_sides *s)
{
    return (((uint32_t)s->dx1 + 256) | ((uint32_t)s->dx2 + 256)) < 512;
}

/* Depth of the corners in the format of small triangles, and the block exponent. False if two are 2^31 apart. */
static inline bool small_depths(const struct ph_renderer *r, const struct ph_material *material,
                                const struct ph_vertex *const v[3], uint32_t d[3], uint8_t *block)
{
    *block = PH_BLOCK_NONE;
    if (r->small.floats) {
        if (!ph_float_depths(&r->lens, v, r->small.bias, d)) {
            *block = ph_block_depths(r, v, ph_depth_bias(material), d);
        }
        return true;
    }
    for (int i = 0; i < 3; i++) {
        d[i] = ph_depth_before(ph_depth_of(v[i]), r->small.far, 0) + r->small.bias;
    }
    return ((d[0] ^ d[1]) | (d[0] ^ d[2])) >> 31 == 0;
}

/* An edge so many rows further down. */
static struct ph_edge edge_below(struct ph_edge edge, int32_t rows)
{
    return (struct ph_edge){(int32_t)((uint32_t)edge.x + (uint32_t)rows * (uint32_t)edge.dx), edge.dx};
}

/* Whether rows between two edges, which are given at the first of them, lie between all pixel centres. */
static bool rows_are_empty(struct ph_edge left, struct ph_edge right, int32_t rows)
{
    for (; rows > 0; rows--) {
        if (left.x >> 16 < right.x >> 16) {
            return false;
        }
        left = edge_below(left, 1);
        right = edge_below(right, 1);
    }
    return true;
}

/* Whether a triangle lies between all pixel centres, as thin ones often do. */
static bool is_empty(const struct ph_triangle *t)
{
    const int32_t upper = t->y_mid - t->y_top, lower = t->y_bottom - t->y_mid;
    const struct ph_edge below = edge_below(t->long_edge, upper);
    return t->long_left ? rows_are_empty(t->long_edge, t->upper, upper) && rows_are_empty(below, t->lower, lower)
                        : rows_are_empty(t->upper, t->long_edge, upper) && rows_are_empty(t->lower, below, lower);
}

static bool small_is_empty(const struct ph_small_triangle *s)
{
    const struct ph_edge left = {(int32_t)s->left, (int32_t)s->left_dx};
    const struct ph_edge right = {(int32_t)s->right, (int32_t)s->right_dx};
    return rows_are_empty(left, right, s->upper_rows) &&
           (s->lower_is_right ? rows_are_empty(edge_below(left, s->upper_rows), s->lower, s->lower_rows)
                              : rows_are_empty(s->lower, edge_below(right, s->upper_rows), s->lower_rows));
}

/* Sets the depth that ph_setup_small left out, or that crosses octaves. False if 32 bits do not do. */
static NOINLINE bool finish_depth(struct ph_triangle *t, const struct ph_renderer *r,
                                  const struct ph_vertex *const v[3], const struct ph_sides *sides, const uint32_t d[3],
                                  enum ph_small_setup done)
{
    struct ph_small_triangle *const small = &t->small;
    struct ph_triangle any;
    if (t->block != PH_BLOCK_NONE && done == PH_SMALL_SET && ph_octaves_between(d, t->block) <= 1) {
        small->d = ph_block_rounded(small->d, t->block); /* rounded: see planes.c; the gradients are multiples of 256 */
        return true;
    }
    any.block = PH_BLOCK_NONE;
    any.material = t->material;
    if (t->block != PH_BLOCK_NONE ? !ph_set_depth(&any, r, v, sides) : !ph_depth_plane(&any.depth, v[0], sides, d)) {
        return false;
    }
    t->block = any.block;
    small->gd = any.depth.gx;
    small->d_dy = any.depth.gy;
    small->d = any.depth.base + (uint32_t)t->y_top * any.depth.gy;
    return true;
}

/* Depth is the same in all shadings: that of a textured triangle is what a small one of another shading has.
 * False if 32 bits do not do. */
static NOINLINE bool take_small_depth(struct ph_triangle *t, const struct ph_renderer *r,
                                      const struct ph_vertex *const v[3], const struct ph_sides *sides, bool fits)
{
    struct ph_triangle other;
    uint32_t d[3];
    other.material = t->material;
    if (!small_depths(r, t->material, v, d, &other.block)) {
        return fits;
    }
    const enum ph_small_setup done = ph_setup_small(&other, v, sides, d);
    if (done == PH_SMALL_NO_ROW) {
        return true;
    }
    if ((done == PH_SMALL_STEEP || other.block != PH_BLOCK_NONE) && !finish_depth(&other, r, v, sides, d, done)) {
        return false;
    }
    const struct ph_small_triangle *const small = &other.small;
    t->block = other.block;
    t->depth = (struct ph_plane){small->d - (uint32_t)other.y_top * small->d_dy, small->gd, small->d_dy};
    return true;
}

/* Sets up and lists any triangle that ph_setup_small cannot take. */
static NOINLINE bool setup_listed(struct ph_renderer *r, const struct ph_material *material,
                                  const struct ph_vertex *const v[3], const fx_t *const uv[3],
                                  const struct ph_sides *sides, bool small)
{
    const uint32_t n = r->triangle_count;
    struct ph_triangle no_room, *const t = n < r->exact_first || ph_free_exact(r) ? &ph_triangles(r)[n] : &no_room;
    bool fits;
    if (!setup_any(r, material, v, uv, sides, t, &fits)) {
        return false;
    }
    if (t == &no_room) {
        r->stats.triangles_dropped++;
        return true;
    }
    if (material->depth_bias_slope != 0) {
        fits = false;
    } else if (small && t->kind == PH_KIND_TEXTURE && r->stats.depth_format <= PH_DEPTH_FLOAT16) {
        fits = take_small_depth(t, r, v, sides, fits);
    }
    if (!fits) {
        if (is_empty(t)) {
            return false;
        }
        ph_set_exact(r, n, v, sides);
    }
    r->triangle_count = n + 1;
    r->stats.triangles_drawn++;
    return true;
}

void ph_setup_part(struct ph_renderer *r, const struct ph_material *material)
{
    const unsigned format = r->stats.depth_format, shading = material->shading;
    const bool textured = (shading == PH_SHADE_TEXTURE || shading == PH_SHADE_TEXTURE_LIT) && material->texture != NULL;
    const bool lit = (shading == PH_SHADE_GOURAUD || shading == PH_SHADE_FLAT) && material->ramp != NULL;
    r->small.material =
        format <= PH_DEPTH_FLOAT16 && material->depth_bias_slope == 0 && (!textured || ph_texels_fit(material->texture))
            ? material
            : NULL;
    r->small.ramp = lit ? material->ramp : &material->colour;
    r->small.shading = lit ? material->shading : textured ? PH_SHADE_TEXTURE : PH_SHADE_UNLIT;
    r->small.floats = format == PH_DEPTH_FLOAT16;
    r->small.far = ph_depth_far(&r->lens, 0);
    r->small.bias = r->small.floats ? PH_DEPTH_BIAS_FLOAT16 + (ph_depth_bias(material) << 13)
                                    : PH_DEPTH_BIAS_FIXED16 + (ph_depth_bias(material) << 16);
}

bool ph_setup_front(struct ph_renderer *r, const struct ph_material *material, const struct ph_vertex *const v[3],
                    const fx_t *const uv[3], const struct ph_sides *sides)
{
    const uint32_t n = r->triangle_count;
    const bool small = is_small(sides) && is_inside(r, v);
    if ((!small && !is_narrow(r, sides, v)) || material != r->small.material ||
        (n >= r->exact_first && !ph_free_exact(r))) {
        return setup_listed(r, material, v, uv, sides, small);
    }
    struct ph_triangle *const t = &ph_triangles(r)[n];
    uint32_t d[3];
    t->kind = PH_KIND_SMALL;
    t->material = material;
    t->small.ramp = r->small.ramp;
    if (!small_depths(r, material, v, d, &t->block)) {
        return setup_listed(r, material, v, uv, sides, false);
    }
    if (is_thin(sides) && misses_columns(r->config.width, v)) {
        return false;
    }
    const enum ph_small_setup done = ph_setup_small(t, v, sides, d);
    if (done == PH_SMALL_NO_ROW || (done == PH_SMALL_STEEP && small_is_empty(&t->small))) {
        return false;
    }
    if ((done == PH_SMALL_STEEP || t->block != PH_BLOCK_NONE || !small) && /* narrow: depth as in other shadings */
        !finish_depth(t, r, v, sides, d, small ? done : PH_SMALL_STEEP)) {
        return setup_listed(r, material, v, uv, sides, false);
    }
    if (r->small.shading == PH_SHADE_TEXTURE) {
        if (!ph_setup_texels(t, r, v, uv, sides)) {
            return setup_listed(r, material, v, uv, sides, small);
        }
    } else if (r->small.shading != PH_SHADE_GOURAUD) {
        t->small.light = r->small.shading == PH_SHADE_FLAT ? (uint32_t)v[0]->light << 16 : 0;
        t->small.glight = t->small.light_dy = 0;
    }
    r->triangle_count = n + 1;
    r->stats.triangles_drawn++;
    return true;
}

bool ph_setup_triangle(struct ph_renderer *r, const struct ph_material *material, const struct ph_vertex *const v[3],
                       const fx_t *const uv[3])
{
    struct ph_sides sides = ph_sides(v[0], v[1], v[2]);
    if (sides.area > 0) {
        return ph_setup_front(r, material, v, uv, &sides);
    }
    if (sides.area == 0 || material->two_sided == 0) {
        return false;
    }
    const struct ph_vertex *const turned[3] = {v[0], v[2], v[1]};
    sides = ph_sides(v[0], v[2], v[1]);
    if (uv == NULL) {
        return ph_setup_front(r, material, turned, NULL, &sides);
    }
    const fx_t *const uv_turned[3] = {uv[0], uv[2], uv[1]};
    return ph_setup_front(r, material, turned, uv_turned, &sides);
}

bool ph_setup_corners(struct ph_renderer *r, const struct ph_material *material, const struct ph_corner *a,
                      const struct ph_corner *b, const struct ph_corner *c)
{
    const struct ph_vertex *const v[3] = {&a->at, &b->at, &c->at};
    const fx_t *const uv[3] = {a->uv, b->uv, c->uv};
    return ph_setup_triangle(r, material, v, uv);
}

/* A line is a parallelogram that is one pixel wide across its longer axis: it covers one pixel in each column (if x is
 * the longer axis) or row, and needs no raster code of its own. */
void ph_setup_line(struct ph_renderer *r, const struct ph_material *material, const struct ph_corner *a,
                   const struct ph_corner *b)
{
    const bool x_major = fx_abs_sat(b->at.x - a->at.x) >= fx_abs_sat(b->at.y - a->at.y);
    const int32_t side_x = x_major ? 0 : 128, side_y = 128 - side_x;
    const bool turned = x_major ? b->at.x > a->at.x : b->at.y < a->at.y; /* so that it faces the viewer */
    const struct ph_corner *const from = turned ? b : a, *const to = turned ? a : b;
    struct ph_corner quad[4] = {*from, *to, *to, *from};
    for (int i = 0; i < 4; i++) {
        const int32_t sign = i < 2 ? -1 : 1;
        quad[i].at.x += sign * side_x;
        quad[i].at.y += sign * side_y;
    }
    ph_setup_corners(r, material, &quad[0], &quad[1], &quad[2]);
    ph_setup_corners(r, material, &quad[0], &quad[2], &quad[3]);
}
