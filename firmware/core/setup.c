/*
 * Triangle set-up: edges and attribute planes, once per triangle.
 *
 * Watertight: an edge is always walked from its upper to its lower vertex, and all its arithmetic depends on these two
 * alone, so the triangles on both sides get the same column in every row.
 */
#include "pipeline.h"

#define SHORT ((uint32_t)1 << 14) /* 64 px: below it products of sides, and of 16-bit factors, fit 32 bits */

/* First row whose centre is at or below y (1/256 px). */
static int32_t first_row(int32_t y)
{
    return (y + 127) >> 8;
}

/* x and slope of an edge of any size; down: from its upper vertex to the first row's centre. */
static struct ph_edge wide_edge(int32_t x, int32_t dx, int32_t dy, int32_t down)
{
    int shift;
    const int32_t reciprocal = (int32_t)(fx_rcp_norm((uint32_t)dy, &shift) >> 1); /* 2^(61 - shift) / dy */
    const int32_t offset = (int32_t)(fx_mul_wide(dx * down, reciprocal) >> (53 - shift));
    return (struct ph_edge){x * 256 + offset, (int32_t)(uint32_t)(fx_mul_wide(dx, reciprocal) >> (45 - shift))};
}

/* The same below 64 px each way, in 32 bits, to 2^-9 px at its far end. */
static struct ph_edge short_edge(int32_t x, int32_t dx, int32_t dy, int32_t down)
{
    const int shift = fx_clz32((uint32_t)dy);
    /* 2^(47 - shift) dx / dy, never above it: a centre that lies on the edge is on its right, as by the top-left rule
     */
    const int32_t scaled = dx * ((int32_t)fx_rcp16((uint32_t)dy << (shift - 16)) + (dx < 0));
    return (struct ph_edge){x * 256 + ((scaled >> 8) * down >> (31 - shift)), scaled >> (31 - shift)};
}

/* The edge from (xa, ya) down to (xb, yb), at row y0 >= first_row(ya); not called for an edge without a row. */
static struct ph_edge setup_edge(int32_t xa, int32_t ya, int32_t xb, int32_t yb, int32_t y0)
{
    const int32_t dx = xb - xa, dy = yb - ya, row = first_row(ya);
    const int32_t down = row * 256 + 128 - ya; /* 0 .. 255 */
    const bool is_short = (((uint32_t)dx + SHORT) | (uint32_t)dy) < 2 * SHORT && dy < (int32_t)SHORT;
    struct ph_edge edge = is_short ? short_edge(xa, dx, dy, down) : wide_edge(xa, dx, dy, down);
    const uint32_t skipped = (uint32_t)(y0 - row);
    edge.x = (int32_t)((uint32_t)edge.x + skipped * (uint32_t)edge.dx + 32767u);
    return edge;
}

/* Where the planes of a triangle hang: sides from its first corner, and the reciprocal of its area. */
struct plane_base {
    int32_t dx1, dy1, dx2, dy2;
    int32_t x, y;       /* from the first corner to the centre of pixel (0, 0), 1/256 px */
    int32_t reciprocal; /* 2^(61 - shift) / area */
    int shift;
    bool small; /* all sides below 64 px */
};

static int bits_of(int64_t v)
{
    const uint64_t m = v < 0 ? 0u - (uint64_t)v : (uint64_t)v;
    const uint32_t high = (uint32_t)(m >> 32);
    return high != 0 ? 64 - fx_clz32(high) : 32 - fx_clz32((uint32_t)m);
}

static int max_int(int a, int b)
{
    return a > b ? a : b;
}

static struct plane_base plane_base(const struct ph_corner *a, const struct ph_corner *b, const struct ph_corner *c,
                                    int64_t area)
{
    struct plane_base s = {b->x - a->x, b->y - a->y, c->x - a->x, c->y - a->y, 128 - a->x, 128 - a->y, 0, 0, false};
    s.small = (((uint32_t)s.dx1 + SHORT) | ((uint32_t)s.dy1 + SHORT) | ((uint32_t)s.dx2 + SHORT) |
               ((uint32_t)s.dy2 + SHORT)) < 2 * SHORT;
    const int excess = s.small ? 0 : max_int(bits_of(area) - 32, 0);
    s.reciprocal = (int32_t)(fx_rcp_norm((uint32_t)(area >> excess), &s.shift) >> 1);
    s.shift -= excess;
    return s;
}

/* The plane with gradients gx, gy through `value` at the first corner; the last 8 bits of the fractions do not matter.
 */
static struct ph_plane hang_plane(const struct plane_base *s, uint32_t value, int32_t gx, int32_t gy)
{
    const uint32_t whole = (uint32_t)(s->x >> 8) * (uint32_t)gx + (uint32_t)(s->y >> 8) * (uint32_t)gy;
    const uint32_t part = (uint32_t)(gx >> 8) * (uint32_t)(s->x & 255) + (uint32_t)(gy >> 8) * (uint32_t)(s->y & 255);
    return (struct ph_plane){value + whole + part, (uint32_t)gx, (uint32_t)gy};
}

struct gradient {
    int32_t x, y;
};

/*
 * Gradient from the differences d1, d2 (below 2^32) of the second and third corner to the first. Beyond 2^limit per
 * pixel it is halved until it fits: slivers, and faces seen edge-on, are flattened rather than wrapped.
 */
static struct gradient wide_gradient(const struct plane_base *s, int64_t d1, int64_t d2, int limit)
{
    const int64_t nx = d2 * s->dy1 - d1 * s->dy2, ny = d1 * s->dx2 - d2 * s->dx1;
    const int excess = max_int(max_int(bits_of(nx), bits_of(ny)) - 31, 0);
    const int64_t px = fx_mul_wide((int32_t)(nx >> excess), s->reciprocal);
    const int64_t py = fx_mul_wide((int32_t)(ny >> excess), s->reciprocal);
    const int down = max_int(max_int(53 - s->shift - excess, max_int(bits_of(px), bits_of(py)) - limit), 1);
    const int64_t half = (int64_t)1 << (down - 1); /* down is not below 1: 22 without excess, else 29 */
    return (struct gradient){(int32_t)((px + half) >> down), (int32_t)((py + half) >> down)};
}

/* Plane through the value at the first corner. */
static struct ph_plane wide_plane(const struct plane_base *s, uint32_t value, int64_t d1, int64_t d2, int limit)
{
    const struct gradient g = wide_gradient(s, d1, d2, limit);
    return hang_plane(s, value, g.x, g.y);
}

static uint32_t size_of(int32_t v)
{
    return v < 0 ? ~(uint32_t)v : (uint32_t)v;
}

/* The same for a small triangle and |d1|, |d2| < 2^30, in 32 bits: the differences are taken to 16 of their bits. */
static struct ph_plane small_plane(const struct plane_base *s, uint32_t value, int32_t d1, int32_t d2, int limit)
{
    const int spare = fx_clz32(size_of(d1) | size_of(d2));
    const int drop = spare < 17 ? 17 - spare : 0;
    d1 = (d1 + (1 << drop >> 1)) >> drop;
    d2 = (d2 + (1 << drop >> 1)) >> drop;
    const int32_t nx = d2 * s->dy1 - d1 * s->dy2, ny = d1 * s->dx2 - d2 * s->dx1;
    const int up = fx_clz32(size_of(nx) | size_of(ny)) - 1; /* both to 31 bits and a sign */
    const int32_t px = (int32_t)(fx_mul_wide((int32_t)((uint32_t)nx << up), s->reciprocal) >> 32);
    const int32_t py = (int32_t)(fx_mul_wide((int32_t)((uint32_t)ny << up), s->reciprocal) >> 32);
    const int exact = 21 - s->shift - drop + up; /* px 2^-exact is the gradient; |px| < 2^29 */
    const int down = exact >= 29 - limit ? exact : max_int(exact, 32 - fx_clz32(size_of(px) | size_of(py)) - limit);
    if (down > 31) {
        return hang_plane(s, value, 0, 0);
    }
    return down >= 0 ? hang_plane(s, value, px >> down, py >> down)
                     : hang_plane(s, value, px * (1 << -down), py * (1 << -down));
}

static struct ph_plane setup_plane(const struct plane_base *s, uint32_t value, int64_t d1, int64_t d2, int limit)
{
    const int64_t limit_small = (int64_t)1 << 30;
    if (s->small && d1 < limit_small && d1 > -limit_small && d2 < limit_small && d2 > -limit_small) {
        return small_plane(s, value, (int32_t)d1, (int32_t)d2, limit);
    }
    return wide_plane(s, value, d1, d2, limit);
}

/* The plane through three unsigned values. */
static struct ph_plane plane_of(const struct plane_base *s, const uint32_t v[3], int limit)
{
    const uint32_t quarter = (uint32_t)1 << 29; /* halves that differ by less than this: differences below 2^30 */
    if (s->small && (v[1] >> 1) - (v[0] >> 1) + quarter < 2 * quarter &&
        (v[2] >> 1) - (v[0] >> 1) + quarter < 2 * quarter) {
        return small_plane(s, v[0], (int32_t)(v[1] - v[0]), (int32_t)(v[2] - v[0]), limit);
    }
    return wide_plane(s, v[0], (int64_t)v[1] - v[0], (int64_t)v[2] - v[0], limit);
}

/* The plane through three unsigned values to its last bit, for formats that keep 24 bits of them. */
static struct ph_plane exact_plane(const struct plane_base *s, const uint32_t v[3], int limit)
{
    const struct gradient g = wide_gradient(s, (int64_t)v[1] - v[0], (int64_t)v[2] - v[0], limit);
    const uint32_t right = (uint32_t)(fx_mul_wide(g.x, s->x) >> 8), down = (uint32_t)(fx_mul_wide(g.y, s->y) >> 8);
    return (struct ph_plane){v[0] + right + down, (uint32_t)g.x, (uint32_t)g.y};
}

static struct ph_plane depth_plane(const struct ph_renderer *r, const struct plane_base *s, const uint32_t v[3],
                                   int limit)
{
    return r->stats.depth_format >= PH_DEPTH_FIXED24 ? exact_plane(s, v, limit) : plane_of(s, v, limit);
}

static int least_exponent(const struct ph_corner *const v[3])
{
    const int a = v[0]->depth.s < v[1]->depth.s ? v[0]->depth.s : v[1]->depth.s;
    return v[2]->depth.s < a ? v[2]->depth.s : a;
}

/* N/w to the exponent `least` of the nearest corner, in units of 2^-(28 + least): below 2^29. */
static uint32_t corner_over_w(const struct ph_corner *v, int least)
{
    const int down = v->depth.s - least + 2;
    return down < 32 ? v->depth.q >> down : 0;
}

static void setup_fixed(const struct ph_renderer *r, const struct plane_base *s, const struct ph_corner *const v[3],
                        uint32_t bias, struct ph_triangle *t)
{
    const uint32_t far = ph_depth_far(&r->lens, 0), offset = PH_DEPTH_BIAS_FIXED16 + (bias << 16);
    uint32_t d[3];
    for (int i = 0; i < 3; i++) {
        d[i] = ph_depth_before(v[i]->depth, far, 0) + offset;
    }
    t->depth = depth_plane(r, s, d, 28);
}

static void setup_float(const struct ph_renderer *r, const struct plane_base *s, const struct ph_corner *const v[3],
                        uint32_t bias, struct ph_triangle *t)
{
    const int block = max_int(least_exponent(v) - 2, 0);
    const uint32_t far = ph_depth_far(&r->lens, block);
    uint32_t d[3];
    for (int i = 0; i < 3; i++) {
        d[i] = ph_depth_before(v[i]->depth, far, block);
    }
    const int octave = ph_depth_octave(d[0], block);
    if (!ph_depth_in_octave(d[1], octave, block) || !ph_depth_in_octave(d[2], octave, block)) {
        t->block = (uint8_t)block;
        t->depth = depth_plane(r, s, d, 27);
        return;
    }
    const uint32_t offset = ph_depth_float16_offset(octave, block) + (bias << 13);
    for (int i = 0; i < 3; i++) { /* all in one octave: no different from the fixed formats */
        d[i] = ph_depth_float16_value(d[i], octave) + offset;
    }
    t->depth = depth_plane(r, s, d, 27);
}

static void setup_linear(const struct ph_renderer *r, const struct plane_base *s, const struct ph_corner *const v[3],
                         uint32_t bias, struct ph_triangle *t)
{
    const int least = least_exponent(v);
    const uint32_t w[3] = {corner_over_w(v[0], least), corner_over_w(v[1], least), corner_over_w(v[2], least)};
    t->block = PH_BLOCK_LINEAR;
    t->depth = exact_plane(s, w, 29);
    t->linear = r->lens.linear;
    t->linear.bias = (uint8_t)(t->linear.bias + bias);
    t->linear.down = (int8_t)(t->linear.down - least);
}

static void setup_depth(const struct ph_renderer *r, const struct plane_base *s, const struct ph_corner *const v[3],
                        struct ph_triangle *t)
{
    const uint32_t bias = t->material->depth_bias < 56 ? t->material->depth_bias : 56;
    const unsigned format = r->stats.depth_format;
    t->block = PH_BLOCK_NONE;
    if (format == PH_DEPTH_FLOAT16 || format == PH_DEPTH_FLOAT24) {
        setup_float(r, s, v, bias, t);
    } else if (format == PH_DEPTH_LINEAR_W && r->lens.kind != PH_ORTHOGRAPHIC) {
        setup_linear(r, s, v, bias, t);
    } else {
        setup_fixed(r, s, v, bias, t);
    }
}

/* u or v of the corners, in Q16.16 from a whole number of repeats; returns the log2 of their range. */
static int texture_range(const struct ph_texture *texture, const struct ph_corner *const v[3], int axis, int64_t out[3])
{
    int64_t least = v[0]->uv[axis], most = 0;
    for (int i = 0; i < 3; i++) {
        out[i] = v[i]->uv[axis];
        least = out[i] < least ? out[i] : least;
    }
    for (int i = 0; i < 3; i++) {
        if (texture->wrap == PH_WRAP_REPEAT) {
            out[i] -= least & ~(int64_t)0xffff;
        }
        const int64_t size = out[i] < 0 ? -out[i] : out[i];
        most = size > most ? size : most;
    }
    return max_int(bits_of(most - 1) - 16, 0);
}

static void setup_texture(const struct ph_renderer *r, const struct plane_base *s, const struct ph_corner *const v[3],
                          struct ph_triangle *t)
{
    int64_t uv[2][3];
    const int range_u = texture_range(t->material->texture, v, 0, uv[0]);
    const int range = max_int(range_u, texture_range(t->material->texture, v, 1, uv[1]));
    const bool perspective = r->lens.kind != PH_ORTHOGRAPHIC;
    const int least = least_exponent(v);
    uint32_t w[3]; /* 1/w to a common exponent, up to 2^29 */
    for (int i = 0; i < 3; i++) {
        w[i] = perspective ? corner_over_w(v[i], least) : (uint32_t)1 << 28;
    }
    for (int axis = 0; axis < 2; axis++) {
        int64_t over_w[3]; /* (u / 2^range) / w */
        for (int i = 0; i < 3; i++) {
            over_w[i] = (uv[axis][i] * w[i]) >> (16 + range);
        }
        t->attribute[axis] = setup_plane(s, (uint32_t)over_w[0], over_w[1] - over_w[0], over_w[2] - over_w[0], 31);
    }
    if (t->block != PH_BLOCK_LINEAR) { /* it is there already */
        t->attribute[2] = plane_of(s, w, 31);
    }
    t->range_log2 = (uint8_t)range;
}

/* Entry of the ramp for a light. */
static uint16_t ramp_colour(const struct ph_material *material, uint16_t light)
{
    return material->ramp != NULL ? material->ramp[light >> 9] : material->colour;
}

static void setup_shading(const struct ph_renderer *r, const struct plane_base *s, const struct ph_corner *const v[3],
                          struct ph_triangle *t)
{
    const struct ph_material *material = t->material;
    t->kind = PH_KIND_FLAT;
    switch (material->shading) {
    case PH_SHADE_FLAT:
        t->colour = ramp_colour(material, v[0]->light);
        return;
    case PH_SHADE_GOURAUD:
        if (material->ramp != NULL) {
            const uint32_t light[3] = {(uint32_t)v[0]->light << 16, (uint32_t)v[1]->light << 16,
                                       (uint32_t)v[2]->light << 16};
            t->kind = PH_KIND_GOURAUD;
            t->attribute[0] = plane_of(s, light, 31);
            return;
        }
        break;
    case PH_SHADE_TEXTURE:
    case PH_SHADE_TEXTURE_LIT:
        if (material->texture != NULL) {
            t->kind = PH_KIND_TEXTURE;
            t->colour = material->shading == PH_SHADE_TEXTURE_LIT
                            ? (uint16_t)(((uint32_t)(v[0]->light - PH_LIGHT_ZERO) * 33) / (PH_LIGHT_SPAN + 1))
                            : 32;
            setup_texture(r, s, v, t);
            return;
        }
        break;
    default:
        break;
    }
    t->colour = material->colour;
}

/* Rows and edges; false where no row of the picture is covered. Corners in the order a, b, c run counter-clockwise. */
static bool setup_edges(const struct ph_renderer *r, const struct ph_corner *const v[3], struct ph_triangle *t)
{
    const int top = v[0]->y <= v[1]->y ? (v[0]->y <= v[2]->y ? 0 : 2) : (v[1]->y <= v[2]->y ? 1 : 2);
    const struct ph_corner *a = v[top], *left = v[top == 2 ? 0 : top + 1], *right = v[top == 0 ? 2 : top - 1];
    const bool long_left = left->y > right->y;
    const struct ph_corner *mid = long_left ? right : left, *low = long_left ? left : right;
    const int32_t height = r->config.height;
    const int32_t row_top = first_row(a->y), row_mid = first_row(mid->y), row_low = first_row(low->y);
    const int32_t y_top = max_int(row_top, 0), y_bottom = row_low < height ? row_low : height;
    if (y_top >= y_bottom) {
        return false;
    }
    const int32_t y_mid = max_int(row_mid < height ? row_mid : height, 0);
    t->y_top = (int16_t)y_top;
    t->y_mid = (int16_t)y_mid;
    t->y_bottom = (int16_t)y_bottom;
    t->long_left = long_left;
    t->long_edge = setup_edge(a->x, a->y, low->x, low->y, y_top);
    if (y_mid > y_top) {
        t->upper = setup_edge(a->x, a->y, mid->x, mid->y, y_top);
    }
    if (y_bottom > y_mid) {
        t->lower = setup_edge(mid->x, mid->y, low->x, low->y, y_mid);
    }
    return true;
}

/*
 * No pixel centre between the outermost columns, or none of them in the picture. *narrow: at most PH_NARROW columns,
 * a pixel and more from the borders, so that no rounding of an edge makes them more or takes them out.
 */
static bool misses_columns(const struct ph_renderer *r, const struct ph_corner *const v[3], bool *narrow)
{
    int32_t least = v[0]->x, most = v[0]->x;
    for (int i = 1; i < 3; i++) {
        least = v[i]->x < least ? v[i]->x : least;
        most = v[i]->x > most ? v[i]->x : most;
    }
    const int32_t from = first_row(least), to = first_row(most), width = r->config.width;
    *narrow = from > 1 && to < width - 1 && to - from < PH_NARROW;
    return from >= to || to <= 0 || from >= width;
}

bool ph_setup_triangle(struct ph_renderer *r, const struct ph_material *material, const struct ph_corner *a,
                       const struct ph_corner *b, const struct ph_corner *c)
{
    int64_t area = ph_area(a->x, a->y, b->x, b->y, c->x, c->y);
    const bool turned = area < 0 && material->two_sided != 0;
    const struct ph_corner *const v[3] = {a, turned ? c : b, turned ? b : c};
    area = turned ? -area : area;
    bool narrow;
    if (area <= 0 || misses_columns(r, v, &narrow)) {
        return false;
    }
    struct ph_triangle no_room;
    const bool full = r->triangle_count >= r->config.triangle_max;
    struct ph_triangle *t = full ? &no_room : &ph_triangles(r)[r->triangle_count];
    t->material = material;
    t->narrow = narrow;
    if (!setup_edges(r, v, t)) {
        return false;
    }
    if (full) {
        r->stats.triangles_dropped++;
        return true;
    }
    const struct plane_base base = plane_base(v[0], v[1], v[2], area);
    setup_depth(r, &base, v, t);
    setup_shading(r, &base, v, t);
    r->triangle_count++;
    r->stats.triangles_drawn++;
    return true;
}
