/* Triangle set-up: edges and attribute planes, once per triangle. Those of most are in setup_small.c. */
#include "edge.h"
#include "kernels.h"

#define NOINLINE __attribute__((noinline)) /* keeps the registers of a long function for what is usual */

static NOINLINE void wide_edge(const struct ph_vertex *a, const struct ph_vertex *b, int32_t y0, struct ph_edge *edge)
{
    const int32_t dx = b->x - a->x, row = ph_first_row(a->y), down = row * 256 + 128 - a->y;
    int shift;
    const int32_t reciprocal = (int32_t)(fx_rcp_norm((uint32_t)(b->y - a->y), &shift) >> 1); /* 2^(61 - shift) / dy */
    const int32_t offset = (int32_t)(fx_mul_wide(dx * down, reciprocal) >> (53 - shift));
    const int32_t slope = (int32_t)(uint32_t)(fx_mul_wide(dx, reciprocal) >> (45 - shift));
    *edge = ph_edge_at_row(a->x * 256 + offset, slope, row, y0);
}

static FX_APART void setup_edge(const struct ph_vertex *a, const struct ph_vertex *b, int32_t y0, struct ph_edge *edge)
{
    const int32_t dx = b->x - a->x, dy = b->y - a->y;
    if ((((uint32_t)dx + PH_SIDE_SHORT) | ((uint32_t)dy << 1)) < 2 * PH_SIDE_SHORT) {
        *edge = ph_short_edge(a, dx, dy, ph_first_row(a->y), y0);
    } else {
        wide_edge(a, b, y0, edge);
    }
}

/* Where the planes of a triangle hang, and the reciprocal of its area. */
struct plane_base {
    const struct ph_sides *sides;
    int32_t x, y;           /* from the first corner to the centre of pixel (0, 0), px */
    int32_t part_x, part_y; /* and 1/256 px */
    int32_t reciprocal;     /* small: 2^(47 - shift) / area; else 2^(61 - shift) / area */
    int shift;
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

/* For products of 64 bits. */
static void wide_base(struct plane_base *s)
{
    const int64_t area = ph_wide_area(s->sides);
    const int excess = max_int(bits_of(area) - 32, 0);
    s->reciprocal = (int32_t)(fx_rcp_norm((uint32_t)(area >> excess), &s->shift) >> 1);
    s->shift -= excess;
}

static inline void plane_base(const struct ph_vertex *first, const struct ph_sides *sides, struct plane_base *s)
{
    const int32_t x = 128 - first->x, y = 128 - first->y;
    s->sides = sides;
    s->x = x >> 8;
    s->y = y >> 8;
    s->part_x = x & 255;
    s->part_y = y & 255;
    if (sides->is_short) {
        const uint32_t area = (uint32_t)sides->area;
        s->shift = fx_clz32(area);
        /* NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): area > 0 */
        s->reciprocal = (int32_t)fx_rcp16((area << s->shift) >> 16);
    } else {
        wide_base(s);
    }
}

/* The plane with gradients gx, gy through `value` at the first corner; the last 8 bits of the fractions do not matter.
 */
static struct ph_plane hang_plane(const struct plane_base *s, uint32_t value, int32_t gx, int32_t gy)
{
    const uint32_t whole = (uint32_t)s->x * (uint32_t)gx + (uint32_t)s->y * (uint32_t)gy;
    const uint32_t part = (uint32_t)(gx >> 8) * (uint32_t)s->part_x + (uint32_t)(gy >> 8) * (uint32_t)s->part_y;
    return (struct ph_plane){value + whole + part, (uint32_t)gx, (uint32_t)gy};
}

struct gradient {
    int32_t x, y;
};

/*
 * Gradient from the differences d1, d2 (below 2^32) of the second and third corner to the first. Beyond 2^limit per
 * pixel it is halved until it fits: slivers, and faces seen edge-on, are flattened rather than wrapped.
 */
static struct gradient wide_gradient(const struct plane_base *any, int64_t d1, int64_t d2, int limit)
{
    struct plane_base base = *any, *const s = &base;
    if (any->sides->is_short) {
        wide_base(&base);
    }
    const struct ph_sides *t = s->sides;
    const int64_t nx = d2 * t->dy1 - d1 * t->dy2, ny = d1 * t->dx2 - d2 * t->dx1;
    const int excess = max_int(max_int(bits_of(nx), bits_of(ny)) - 31, 0);
    const int64_t px = fx_mul_wide((int32_t)(nx >> excess), s->reciprocal);
    const int64_t py = fx_mul_wide((int32_t)(ny >> excess), s->reciprocal);
    const int down = max_int(max_int(53 - s->shift - excess, max_int(bits_of(px), bits_of(py)) - limit), 1);
    const int64_t half = (int64_t)1 << (down - 1); /* down is not below 1: 22 without excess, else 29 */
    return (struct gradient){(int32_t)((px + half) >> down), (int32_t)((py + half) >> down)};
}

/* Plane through the value at the first corner. */
static NOINLINE struct ph_plane wide_plane(const struct plane_base *s, uint32_t value, int64_t d1, int64_t d2,
                                           int limit)
{
    const struct gradient g = wide_gradient(s, d1, d2, limit);
    return hang_plane(s, value, g.x, g.y);
}

static uint32_t size_of(int32_t v)
{
    return v < 0 ? ~(uint32_t)v : (uint32_t)v;
}

/* n (below 2^30) times r / 2^16; r of 16 bits. */
static inline int32_t times_q16(int32_t n, int32_t r)
{
    return (n >> 16) * r + (int32_t)(((uint32_t)n & 0xffff) * (uint32_t)r >> 16);
}

/*
 * The same for a small triangle in 32 bits; d1, d2 below 2^15 are the differences over 2^drop. out->base is the value
 * at the first corner on entry.
 */
static FX_APART void small_plane(struct ph_plane *out, const struct plane_base *s, int32_t d1, int32_t d2, int drop,
                                 int limit)
{
    const struct ph_sides *const t = s->sides;
    int32_t gx = times_q16(d2 * t->dy1 - d1 * t->dy2, s->reciprocal);
    int32_t gy = times_q16(d1 * t->dx2 - d2 * t->dx1, s->reciprocal);
    int down = 23 - s->shift - drop; /* g 2^-down is the gradient; |g| < 2^30 */
    const int room = down + limit;   /* bits that g may have */
    if (room < 30 && ((uint32_t)((gx >> room) + 1) | (uint32_t)((gy >> room) + 1)) > 1) {
        down = max_int(down, 32 - fx_clz32(size_of(gx) | size_of(gy)) - limit);
    }
    gx = down >= 0 ? gx >> down : gx * (1 << -down);
    gy = down >= 0 ? gy >> down : gy * (1 << -down);
    *out = hang_plane(s, out->base, gx, gy);
}

/* For differences below 2^30, of which 16 bits are taken. */
static inline void scaled_plane(struct ph_plane *out, const struct plane_base *s, uint32_t value, int32_t d1,
                                int32_t d2, int limit)
{
    const int spare = fx_clz32(size_of(d1) | size_of(d2));
    const int drop = spare < 17 ? 17 - spare : 0;
    const int32_t half = (1 << drop) >> 1;
    out->base = value;
    small_plane(out, s, (d1 + half) >> drop, (d2 + half) >> drop, drop, limit);
}

/* The plane through three unsigned values. */
static void plane_of(struct ph_plane *out, const struct plane_base *s, const uint32_t v[3], int limit)
{
    /* Halves that differ by less than 2^29: differences below 2^30. */
    const int32_t half1 = (int32_t)((v[1] >> 1) - (v[0] >> 1)), half2 = (int32_t)((v[2] >> 1) - (v[0] >> 1));
    if (s->sides->is_short && ((uint32_t)((half1 >> 29) + 1) | (uint32_t)((half2 >> 29) + 1)) <= 1) {
        scaled_plane(out, s, v[0], (int32_t)(v[1] - v[0]), (int32_t)(v[2] - v[0]), limit);
    } else {
        *out = wide_plane(s, v[0], (int64_t)v[1] - v[0], (int64_t)v[2] - v[0], limit);
    }
}

/* The plane through the light of three corners. */
static void light_plane(struct ph_plane *out, const struct plane_base *s, const struct ph_vertex *const v[3])
{
    const int32_t d1 = v[1]->light - v[0]->light, d2 = v[2]->light - v[0]->light;
    const int drop = ((uint32_t)((d1 >> 15) + 1) | (uint32_t)((d2 >> 15) + 1)) > 1;
    out->base = (uint32_t)v[0]->light << 16;
    if (s->sides->is_short) {
        small_plane(out, s, d1 >> drop, d2 >> drop, 16 + drop, 31);
    } else {
        *out = wide_plane(s, out->base, (int64_t)d1 * 65536, (int64_t)d2 * 65536, 31);
    }
}

/* The plane through three unsigned values to its last bit, for formats that keep 24 bits of them. */
static struct ph_plane exact_plane(const struct plane_base *s, const uint32_t v[3], int limit)
{
    const struct gradient g = wide_gradient(s, (int64_t)v[1] - v[0], (int64_t)v[2] - v[0], limit);
    const int32_t x = s->x * 256 + s->part_x, y = s->y * 256 + s->part_y;
    const uint32_t right = (uint32_t)(fx_mul_wide(g.x, x) >> 8), down = (uint32_t)(fx_mul_wide(g.y, y) >> 8);
    return (struct ph_plane){v[0] + right + down, (uint32_t)g.x, (uint32_t)g.y};
}

static void depth_plane(const struct ph_renderer *r, const struct plane_base *s, const uint32_t v[3], int limit,
                        struct ph_plane *out)
{
    if (r->stats.depth_format >= PH_DEPTH_FIXED24) {
        *out = exact_plane(s, v, limit);
    } else {
        plane_of(out, s, v, limit);
    }
}

static int least_exponent(const struct ph_vertex *const v[3])
{
    const int a = v[0]->s < v[1]->s ? v[0]->s : v[1]->s;
    return v[2]->s < a ? v[2]->s : a;
}

static inline struct ph_quotient ph_depth_of(const struct ph_vertex *v)
{
    return (struct ph_quotient){v->q, v->s};
}

/* N/w to the exponent `least` of the nearest corner, in units of 2^-(28 + least): below 2^29. */
static uint32_t corner_over_w(const struct ph_vertex *v, int least)
{
    const int down = v->s - least + 2;
    return down < 32 ? v->q >> down : 0;
}

static uint32_t depth_bias(const struct ph_material *material)
{
    return material->depth_bias < 56 ? material->depth_bias : 56;
}

/* Depth of the corners in units of the fixed formats. */
static inline void fixed_depths(const struct ph_renderer *r, const struct ph_vertex *const v[3], uint32_t bias,
                                uint32_t d[3])
{
    const uint32_t far = ph_depth_far(&r->lens, 0), offset = PH_DEPTH_BIAS_FIXED16 + (bias << 16);
    for (int i = 0; i < 3; i++) {
        d[i] = ph_depth_before(ph_depth_of(v[i]), far, 0) + offset;
    }
}

/* The same of the floats; returns the block exponent of a triangle that crosses octaves, or PH_BLOCK_NONE. */
static NOINLINE uint8_t block_depths(const struct ph_renderer *r, const struct ph_vertex *const v[3], uint32_t bias,
                                     uint32_t d[3])
{
    const int block = max_int(least_exponent(v) - 2, 0);
    const uint32_t far = ph_depth_far(&r->lens, block);
    for (int i = 0; i < 3; i++) {
        d[i] = ph_depth_before(ph_depth_of(v[i]), far, block);
    }
    const int octave = ph_depth_octave(d[0], block);
    if (!ph_depth_in_octave(d[1], octave, block) || !ph_depth_in_octave(d[2], octave, block)) {
        return (uint8_t)block;
    }
    const uint32_t offset = ph_depth_float16_offset(octave, block) + (bias << 13);
    for (int i = 0; i < 3; i++) { /* all in one octave: no different from the fixed formats */
        d[i] = ph_depth_float16_value(d[i], octave) + offset;
    }
    return PH_BLOCK_NONE;
}

static NOINLINE void setup_linear(const struct ph_renderer *r, const struct plane_base *s,
                                  const struct ph_vertex *const v[3], uint32_t bias, struct ph_triangle *t)
{
    const int least = least_exponent(v);
    const uint32_t w[3] = {corner_over_w(v[0], least), corner_over_w(v[1], least), corner_over_w(v[2], least)};
    t->block = PH_BLOCK_LINEAR;
    t->depth = exact_plane(s, w, 29);
    t->linear = r->lens.linear;
    t->linear.bias = (uint8_t)(t->linear.bias + bias);
    t->linear.down = (int8_t)(t->linear.down - least);
}

static void setup_depth(const struct ph_renderer *r, const struct plane_base *s, const struct ph_vertex *const v[3],
                        struct ph_triangle *t)
{
    const uint32_t bias = depth_bias(t->material);
    const unsigned format = r->stats.depth_format;
    t->block = PH_BLOCK_NONE;
    uint32_t d[3];
    if (format == PH_DEPTH_FLOAT16 || format == PH_DEPTH_FLOAT24) {
        t->block = block_depths(r, v, bias, d);
        depth_plane(r, s, d, 27, &t->depth);
    } else if (format == PH_DEPTH_LINEAR_W && r->lens.kind != PH_ORTHOGRAPHIC) {
        setup_linear(r, s, v, bias, t);
    } else {
        fixed_depths(r, v, bias, d);
        depth_plane(r, s, d, 28, &t->depth);
    }
}

/*
 * u or v of the corners, Q16.16, from a whole number of repeats on (then without a sign); returns the log2 of their
 * range.
 */
static int texture_range(const struct ph_texture *texture, const fx_t *const uv[3], int axis, uint32_t out[3])
{
    const bool repeats = texture->wrap == PH_WRAP_REPEAT;
    const int32_t a = uv[0][axis], b = uv[1][axis], c = uv[2][axis], ab = a < b ? a : b, least = ab < c ? ab : c;
    uint32_t most = 1;
    for (int i = 0; i < 3; i++) {
        out[i] = (uint32_t)uv[i][axis] - (repeats ? (uint32_t)least & ~(uint32_t)0xffff : 0);
        const uint32_t size = repeats ? out[i] : fx_magnitude((int32_t)out[i]);
        most = size > most ? size : most;
    }
    return max_int(16 - fx_clz32(most - 1), 0);
}

static NOINLINE void setup_texture(const struct ph_renderer *r, const struct plane_base *s,
                                   const struct ph_vertex *const v[3], const fx_t *const corner_uv[3],
                                   struct ph_triangle *t)
{
    static const fx_t origin[2];
    static const fx_t *const origins[3] = {origin, origin, origin};
    const fx_t *const *from = corner_uv != NULL ? corner_uv : origins;
    const struct ph_texture *const texture = t->material->texture;
    const uint32_t positive = (uint32_t)1 << 28;
    uint32_t uv[2][3];
    const int range_u = texture_range(texture, from, 0, uv[0]);
    const int range = max_int(range_u, texture_range(texture, from, 1, uv[1]));
    const bool perspective = r->lens.kind != PH_ORTHOGRAPHIC;
    const int least = least_exponent(v);
    uint32_t w[3]; /* 1/w to a common exponent, up to 2^29 */
    for (int i = 0; i < 3; i++) {
        w[i] = perspective ? corner_over_w(v[i], least) : (uint32_t)1 << 28;
    }
    for (int axis = 0; axis < 2; axis++) {
        uint32_t over_w[3]; /* u over its range and w, and over 4: at most 2^27, made positive */
        for (int i = 0; i < 3; i++) {
            const uint32_t u = uv[axis][i];
            const int32_t share = range <= 14 ? (int32_t)(u << (14 - range)) : (int32_t)u >> (range - 14); /* Q2.30 */
            over_w[i] = (uint32_t)(fx_mul_wide(share, (int32_t)w[i]) >> 32) + positive;
        }
        plane_of(&t->attribute[axis], s, over_w, 31);
        t->attribute[axis].base -= positive;
    }
    if (t->block != PH_BLOCK_LINEAR) { /* it is there already */
        plane_of(&t->attribute[2], s, w, 31);
    }
    t->range_log2 = (uint8_t)range;
}

/* Entry of the ramp for a light. */
static uint16_t ramp_colour(const struct ph_material *material, uint16_t light)
{
    return material->ramp != NULL ? material->ramp[light >> 9] : material->colour;
}

static void setup_shading(const struct ph_renderer *r, const struct plane_base *s, const struct ph_vertex *const v[3],
                          const fx_t *const uv[3], struct ph_triangle *t)
{
    const struct ph_material *material = t->material;
    t->kind = PH_KIND_FLAT;
    switch (material->shading) {
    case PH_SHADE_FLAT:
        t->colour = ramp_colour(material, v[0]->light);
        return;
    case PH_SHADE_GOURAUD:
        if (material->ramp != NULL) {
            t->kind = PH_KIND_GOURAUD;
            light_plane(&t->attribute[0], s, v);
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
            setup_texture(r, s, v, uv, t);
            return;
        }
        break;
    default:
        break;
    }
    t->colour = material->colour;
}

static inline int32_t min_int(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

/* No pixel centre between the outermost columns, or none of them in the picture. */
static inline bool misses_columns(int32_t width, const struct ph_vertex *const v[3])
{
    const int32_t a = v[0]->x, b = v[1]->x, c = v[2]->x;
    const int32_t from = ph_first_row(min_int(min_int(a, b), c)), to = ph_first_row(max_int(max_int(a, b), c));
    return from >= to || to <= 0 || from >= width;
}

/*
 * Rows and edges; false where no row of the picture is covered. Corners in the order of v run counter-clockwise. Of two
 * corners with the same first row either may be the upper one: the edge between them has no row.
 */
static FX_APART bool setup_outline(int32_t height, const struct ph_vertex *const v[3], struct ph_triangle *t)
{
    const struct ph_vertex *top = v[0], *left = v[1], *right = v[2];
    int32_t row_top = ph_first_row(top->y), row_left = ph_first_row(left->y), row_right = ph_first_row(right->y);
    while (row_left < row_top || row_right < row_top) { /* at most twice: the corners turn */
        const struct ph_vertex *const corner = top;
        const int32_t row = row_top;
        top = left, row_top = row_left;
        left = right, row_left = row_right;
        right = corner, row_right = row;
    }
    t->long_left = row_left > row_right;
    const struct ph_vertex *const mid = t->long_left ? right : left, *const low = t->long_left ? left : right;
    const int32_t y_top = max_int(row_top, 0), y_bottom = min_int(max_int(row_left, row_right), height);
    const int32_t y_mid = max_int(min_int(min_int(row_left, row_right), height), 0);
    if (y_top >= y_bottom) {
        return false;
    }
    t->y_top = (int16_t)y_top;
    t->y_mid = (int16_t)y_mid;
    t->y_bottom = (int16_t)y_bottom;
    setup_edge(top, low, y_top, &t->long_edge);
    if (y_mid > y_top) {
        setup_edge(top, mid, y_top, &t->upper);
    }
    if (y_bottom > y_mid) {
        setup_edge(mid, low, y_mid, &t->lower);
    }
    return true;
}

int32_t ph_wide_area_sign(int32_t dx1, int32_t dy1, int32_t dx2, int32_t dy2)
{
    const int64_t area = fx_mul_wide(dx2, dy1) - fx_mul_wide(dx1, dy2);
    return (int32_t)(area >> 32) | (area > 0);
}

static NOINLINE bool setup_any(struct ph_renderer *r, const struct ph_material *material,
                               const struct ph_vertex *const v[3], const fx_t *const uv[3],
                               const struct ph_sides *sides, struct ph_triangle *t)
{
    if (misses_columns(r->config.width, v) || !setup_outline(r->config.height, v, t)) {
        return false;
    }
    struct plane_base base;
    t->material = material;
    plane_base(v[0], sides, &base);
    setup_depth(r, &base, v, t);
    setup_shading(r, &base, v, uv, t);
    return true;
}

/* Whether corners between from and to keep a pixel off the borders. */
static bool is_between(int32_t a, int32_t b, int32_t c, int32_t size)
{
    return min_int(min_int(a, b), c) >= 256 && max_int(max_int(a, b), c) <= (size - 1) * 256;
}

/* Whether a small triangle keeps a pixel off the borders: most do so by far. */
static inline bool is_inside(const struct ph_renderer *r, const struct ph_vertex *const v[3])
{
    const uint32_t margin = PH_SMALL + 256;
    return ((uint32_t)v[0]->x - margin < r->inner_x && (uint32_t)v[0]->y - margin < r->inner_y) ||
           (is_between(v[0]->x, v[1]->x, v[2]->x, r->config.width) &&
            is_between(v[0]->y, v[1]->y, v[2]->y, r->config.height));
}

static inline bool is_small(const struct ph_sides *s)
{
    const uint32_t dx1 = (uint32_t)s->dx1, dx2 = (uint32_t)s->dx2, dy1 = (uint32_t)s->dy1, dy2 = (uint32_t)s->dy2;
    return ((dx1 + PH_SMALL) | (dy1 + PH_SMALL) | (dx2 + PH_SMALL) | (dy2 + PH_SMALL) | (dx2 - dx1 + PH_SMALL)) <
           2 * PH_SMALL;
}

/* A triangle may miss the centres of all columns. */
static inline bool is_thin(const struct ph_sides *s)
{
    return (((uint32_t)s->dx1 + 256) | ((uint32_t)s->dx2 + 256)) < 512;
}

/* Any triangle but a small one of a part that has such. */
static NOINLINE bool setup_listed(struct ph_renderer *r, const struct ph_material *material,
                                  const struct ph_vertex *const v[3], const fx_t *const uv[3],
                                  const struct ph_sides *sides)
{
    const uint32_t n = r->triangle_count;
    struct ph_triangle no_room, *const t = n < r->config.triangle_max ? &ph_triangles(r)[n] : &no_room;
    if (!setup_any(r, material, v, uv, sides, t)) {
        return false;
    }
    if (t == &no_room) {
        r->stats.triangles_dropped++;
        return true;
    }
    r->triangle_count = n + 1;
    r->stats.triangles_drawn++;
    return true;
}

void ph_setup_part(struct ph_renderer *r, const struct ph_material *material)
{
    const unsigned format = r->stats.depth_format;
    const bool shaded = material->shading == PH_SHADE_GOURAUD && material->ramp != NULL;
    r->small.material = shaded && format <= PH_DEPTH_FLOAT16 ? material : NULL;
    r->small.floats = format == PH_DEPTH_FLOAT16;
    r->small.far = ph_depth_far(&r->lens, 0);
    r->small.bias = r->small.floats ? PH_DEPTH_BIAS_FLOAT16 + (depth_bias(material) << 13)
                                    : PH_DEPTH_BIAS_FIXED16 + (depth_bias(material) << 16);
}

bool ph_setup_front(struct ph_renderer *r, const struct ph_material *material, const struct ph_vertex *const v[3],
                    const fx_t *const uv[3], const struct ph_sides *sides)
{
    const uint32_t n = r->triangle_count;
    if (material != r->small.material || n >= r->config.triangle_max || !is_small(sides) || !is_inside(r, v)) {
        return setup_listed(r, material, v, uv, sides);
    }
    struct ph_triangle *const t = &ph_triangles(r)[n];
    uint32_t d[3];
    t->kind = PH_KIND_SMALL;
    t->block = PH_BLOCK_NONE;
    t->material = material;
    t->small.ramp = material->ramp;
    if (r->small.floats) {
        if (!ph_float_depths(&r->lens, v, r->small.bias, d)) {
            t->block = block_depths(r, v, depth_bias(material), d);
        }
    } else {
        for (int i = 0; i < 3; i++) {
            d[i] = ph_depth_before(ph_depth_of(v[i]), r->small.far, 0) + r->small.bias;
        }
        if (((d[0] ^ d[1]) | (d[0] ^ d[2])) >> 31 != 0) { /* too far apart for ph_setup_small */
            return setup_listed(r, material, v, uv, sides);
        }
    }
    if ((is_thin(sides) && misses_columns(r->config.width, v)) || !ph_setup_small(t, v, sides, d)) {
        return false;
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
