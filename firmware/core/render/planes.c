/*
 * Planes: from the values at the corners of a triangle to a value at the centre of pixel (0, 0) and its gradients. See
 * planes.h; the depth formats are in depth.h.
 *
 * Short sides take 32 bits and a reciprocal of 16; all others take products of 64 bits.
 */
#include "planes.h"

#include "colour.h"
#include "edge.h"
#include "knee.h"
#include "lift.h"
#include "texel_light.h"

enum {
    STEEP = 42,       /* for 16.16 codes: 4 codes; see is_steep */
    FINE_STEP = 29,   /* short_plane gives gradients in 2^6 units of 2^-32 a pixel, or finer: 1/8 code in 128 px */
    FINE_DROP = 13,   /* of differences below 2^28: 1/16 code by them, and 1/8 by a reciprocal of 16 bits */
    LINEAR_ZEROS = 7, /* of 1/w at the farthest corner of such a plane; the nearest has 3 */
};

/* What all planes of a triangle share: the place of its first corner, and the reciprocal of its area. */
struct ph_plane_base {
    const struct ph_sides *sides;
    int32_t x, y;           /* from the first corner to the centre of pixel (0, 0): whole pixels */
    int32_t part_x, part_y; /* and the rest, 1/256 px */
    int32_t reciprocal;     /* is_short: 2^(47 - shift) / area; else 2^(61 - shift) / area */
    int shift;
};

/* Bits of |v|. */
PH_TIER(scenery) static int bits_of(int64_t v)
{
    const uint64_t m = v < 0 ? 0u - (uint64_t)v : (uint64_t)v;
    const uint32_t high = (uint32_t)(m >> 32);
    return high != 0 ? 64 - fx_clz32(high) : 32 - fx_clz32((uint32_t)m);
}

/* The reciprocal for products of 64 bits. */
PH_TIER(scenery) static void wide_base(struct ph_plane_base *s)
{
    const int64_t area = ph_wide_area(s->sides);
    const int excess = ph_max(bits_of(area) - 32, 0);
    s->reciprocal = ph_wide_reciprocal((uint32_t)(area >> excess), &s->shift);
    s->shift -= excess;
}

/* The base of the planes; `first` is the first corner. */
PH_TIER(scenery)
static inline void plane_base(struct ph_plane_base *s, const struct ph_vertex *first, const struct ph_sides *sides)
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

/* The plane with gradients gx, gy through `value` at the first corner, but for the last 8 bits of the fraction. */
PH_TIER(scenery)
static struct ph_plane hang_plane(const struct ph_plane_base *s, uint32_t value, int32_t gx, int32_t gy)
{
    const uint32_t whole = (uint32_t)s->x * (uint32_t)gx + (uint32_t)s->y * (uint32_t)gy;
    const uint32_t part = (uint32_t)(gx >> 8) * (uint32_t)s->part_x + (uint32_t)(gy >> 8) * (uint32_t)s->part_y;
    return (struct ph_plane){value + whole + part, (uint32_t)gx, (uint32_t)gy};
}

struct pixel_gradient {
    int32_t x, y; /* per pixel */
};

/* d n, where |d| is below 2^32: one product of 32 bits and what carries. */
PH_TIER(scenery) static inline int64_t times_wide(int64_t d, int32_t n)
{
    const uint32_t low = (uint32_t)d, carry = (uint32_t)(d >> 32) + (low >> 31); /* -1, 0 or 1 */
    return fx_mul_wide((int32_t)low, n) + (int64_t)((uint64_t)(carry * (uint32_t)n) << 32);
}

/*
 * Gradient from the differences d1, d2 (below 2^32) between the second or third corner and the first: x = (d2 dy1 - d1
 * dy2) / area, y = (d1 dx2 - d2 dx1) / area. plane_through describes *halved.
 */
static struct pixel_gradient wide_gradient(const struct ph_plane_base *any, int64_t d1, int64_t d2, int *halved)
{
    struct ph_plane_base base = *any, *const s = &base;
    if (any->sides->is_short) {
        wide_base(&base);
    }
    const struct ph_sides *t = s->sides;
    const int64_t nx = times_wide(d2, t->dy1) - times_wide(d1, t->dy2);
    const int64_t ny = times_wide(d1, t->dx2) - times_wide(d2, t->dx1);
    const int excess = ph_max(ph_max(bits_of(nx), bits_of(ny)) - 31, 0);
    const int64_t px = fx_mul_wide((int32_t)(nx >> excess), s->reciprocal);
    const int64_t py = fx_mul_wide((int32_t)(ny >> excess), s->reciprocal);
    const int unit = 53 - s->shift - excess, down = ph_max(ph_max(unit, ph_max(bits_of(px), bits_of(py)) - 31), 1);
    const int64_t half = (int64_t)1 << (down - 1); /* down is 22 or more without excess, else 29 or more */
    *halved = down - unit;
    /* rounded up it may be 2^31 */
    return (struct pixel_gradient){fx_sat64((px + half) >> down), fx_sat64((py + half) >> down)};
}

/* The plane with that gradient through `value` at the first corner. */
PH_TIER(scenery)
static PH_NOINLINE int wide_plane(struct ph_plane *out, const struct ph_plane_base *s, uint32_t value, int64_t d1,
                                  int64_t d2)
{
    int halved;
    const struct pixel_gradient g = wide_gradient(s, d1, d2, &halved);
    *out = hang_plane(s, value, g.x, g.y);
    return halved;
}

/* n r / 2^16; n is below 2^30, r has 16 bits. */
static inline int32_t times_q16(int32_t n, int32_t r)
{
    return (n >> 16) * r + (int32_t)(((uint32_t)n & 0xffff) * (uint32_t)r >> 16);
}

/*
 * wide_plane for short sides, in 32 bits. d1, d2 (below 2^15) are the differences over 2^drop. On entry out->base is
 * the value at the first corner.
 */
PH_TIER(scenery)
static FX_APART int short_plane(struct ph_plane *out, const struct ph_plane_base *s, int32_t d1, int32_t d2, int drop)
{
    const struct ph_sides *const t = s->sides;
    int32_t gx = times_q16(d2 * t->dy1 - d1 * t->dy2, s->reciprocal);
    int32_t gy = times_q16(d1 * t->dx2 - d2 * t->dx1, s->reciprocal);
    const int unit = 23 - s->shift - drop; /* the gradient is g 2^-unit, with |g| < 2^30 */
    const int down = unit >= 0 ? unit : ph_max(unit, 1 - fx_clz32(ph_without_sign(gx) | ph_without_sign(gy)));
    gx = down >= 0 ? gx >> down : gx * (1 << -down);
    gy = down >= 0 ? gy >> down : gy * (1 << -down);
    *out = hang_plane(s, out->base, gx, gy);
    return down - unit;
}

/*
 * The plane through three unsigned values. A gradient of 2^31 per pixel or more is halved until it fits, so that it
 * does not wrap: the triangle becomes flatter. Returns how often. fine: as right as depth must be.
 */
PH_TIER(scenery)
static PH_NOINLINE int plane_through(struct ph_plane *out, const struct ph_plane_base *s, const uint32_t v[3],
                                     bool fine)
{
    /* If the halves differ by less than 2^29, the differences are below 2^30. */
    const int32_t half1 = (int32_t)((v[1] >> 1) - (v[0] >> 1)), half2 = (int32_t)((v[2] >> 1) - (v[0] >> 1));
    if (s->sides->is_short && ((uint32_t)((half1 >> 29) + 1) | (uint32_t)((half2 >> 29) + 1)) <= 1) {
        const int32_t d1 = (int32_t)(v[1] - v[0]), d2 = (int32_t)(v[2] - v[0]);
        const int spare = fx_clz32(ph_without_sign(d1) | ph_without_sign(d2));
        const int drop = spare < 17 ? 17 - spare : 0; /* the upper 16 bits are taken */
        const int32_t half = (1 << drop) >> 1;
        if (!fine || (drop <= FINE_DROP && s->shift + drop <= FINE_STEP)) {
            out->base = v[0];
            return short_plane(out, s, (d1 + half) >> drop, (d2 + half) >> drop, drop);
        }
    }
    return wide_plane(out, s, v[0], (int64_t)v[1] - v[0], (int64_t)v[2] - v[0]);
}

/* The plane through the light of the corners, in 2^-16. */
PH_TIER(scenery) static void plane_light(struct ph_plane *out, const struct ph_plane_base *s, const int32_t light[3])
{
    const int32_t d1 = light[1] - light[0], d2 = light[2] - light[0];
    const int drop = ((uint32_t)((d1 >> 15) + 1) | (uint32_t)((d2 >> 15) + 1)) > 1;
    out->base = (uint32_t)light[0] << 16;
    if (s->sides->is_short) {
        short_plane(out, s, d1 >> drop, d2 >> drop, 16 + drop);
    } else {
        wide_plane(out, s, out->base, (int64_t)d1 * 65536, (int64_t)d2 * 65536);
    }
}

/* plane_through to its last bit, for formats that keep 24 bits of the values. */
PH_TIER(seldom) static int plane_exact(struct ph_plane *out, const struct ph_plane_base *s, const uint32_t v[3])
{
    int halved;
    const struct pixel_gradient g = wide_gradient(s, (int64_t)v[1] - v[0], (int64_t)v[2] - v[0], &halved);
    const int32_t x = s->x * 256 + s->part_x, y = s->y * 256 + s->part_y;
    const uint32_t right = (uint32_t)(fx_mul_wide(g.x, x) >> 8), down = (uint32_t)(fx_mul_wide(g.y, y) >> 8);
    *out = (struct ph_plane){v[0] + right + down, (uint32_t)g.x, (uint32_t)g.y};
    return halved;
}

/* The exponent of the nearest corner. */
PH_TIER(scenery) static int least_exponent(const struct ph_vertex *const v[3])
{
    const int a = v[0]->s < v[1]->s ? v[0]->s : v[1]->s;
    return v[2]->s < a ? v[2]->s : a;
}

/* N/w of a corner in units of 2^-(28 + least), with the exponent `least` of the nearest corner: below 2^29. */
PH_TIER(scenery) static uint32_t corner_over_w(const struct ph_vertex *v, int least)
{
    const int down = v->s - least + 2;
    return down < 32 ? v->q >> down : 0;
}

/* Twice the extent of a triangle along an axis. */
PH_TIER(scenery) static inline uint32_t twice_extent(int32_t d1, int32_t d2)
{
    return fx_magnitude(d1) + fx_magnitude(d2) + fx_magnitude(d2 - d1);
}

/* How far a centre may lie outside the corners by the rounding of edges, 2^-24 px: 2^-16 px a row, and on short sides
 * 2^-15 px a column. */
PH_TIER(scenery) static uint32_t outside(const struct ph_sides *s)
{
    const uint32_t rows = twice_extent(s->dy1, s->dy2) >> 1;
    return s->is_short ? rows + twice_extent(s->dx1, s->dx2) : rows;
}

/* Whether a centre outside the corners could be more than 2^(down - 24) beyond their range: for 16.16 codes see STEEP.
 */
PH_TIER(scenery) static bool is_steep(const struct ph_sides *s, const struct ph_plane *plane, int down)
{
    const uint32_t gx = ph_without_sign((int32_t)plane->gx);
    const int most = s->is_short ? 17 : 24; /* bits of outside() */
    return gx >> (down - most) != 0 && fx_mulhi_u32(gx, outside(s)) >> (down - 32) != 0;
}

/*
 * The plane of depth d: to its last bit for codes of 24 bits, and across octaves, where the far ones are
 * the finest. Returns how often its gradient was halved.
 */
static inline int depth_plane(const struct ph_plane_base *s, bool exact, const uint32_t d[3], struct ph_plane *out)
{
    return exact ? plane_exact(out, s, d) : plane_through(out, s, d, true);
}

/* Depth of the corners in the fixed formats. */
static inline void fixed_depths(const struct ph_renderer *r, const struct ph_vertex *const v[3], uint32_t bias,
                                uint32_t d[3])
{
    const uint32_t far = ph_depth_far(&r->lens, 0), offset = PH_DEPTH_BIAS_FIXED16 + (bias << 16);
    for (int i = 0; i < 3; i++) {
        d[i] = ph_depth_before(ph_depth_of(v[i]), far, 0) + offset;
    }
}

/* d of the corners, in units of 2^-(32 + block). */
static PH_NOINLINE void depths_in_block(const struct ph_renderer *r, const struct ph_vertex *const v[3], int block,
                                        uint32_t d[3])
{
    const uint32_t far = ph_depth_far(&r->lens, block);
    for (int i = 0; i < 3; i++) {
        d[i] = ph_depth_before(ph_depth_of(v[i]), far, block);
    }
}

/* The largest block exponent with which d of the nearest corner stays below 2^31. */
static int largest_block(const struct ph_vertex *const v[3])
{
    return ph_max(least_exponent(v) - 2, 0);
}

PH_NOINLINE uint8_t ph_block_depths(const struct ph_renderer *r, const struct ph_vertex *const v[3], uint32_t bias,
                                    uint32_t d[3])
{
    const int block = largest_block(v), down = r->lens.float_down, lowest = ph_depth_lowest(block, down);
    depths_in_block(r, v, block, d);
    const int octave = ph_depth_octave(d[0], lowest);
    if (!ph_depth_in_octave(d[1], octave, lowest) || !ph_depth_in_octave(d[2], octave, lowest)) {
        return ph_block_of(block, down);
    }
    const uint32_t offset = ph_depth_float16_offset(octave, block, down) + (bias << 13);
    for (int i = 0; i < 3; i++) { /* in one octave a floating-point code is a fixed number with another slope */
        d[i] = ph_depth_float16_value(d[i], octave - down) + offset;
    }
    return PH_BLOCK_NONE;
}

uint32_t ph_depth_code(const struct ph_renderer *r, struct ph_quotient quotient, uint32_t bias)
{
    const struct ph_vertex v = {.q = quotient.q, .s = quotient.s}, *const corners[3] = {&v, &v, &v};
    const struct ph_depth_ways *const ways = ph_depth_ways(r);
    uint32_t d[3];
    if (ways->block_depths != NULL) {
        ways->block_depths(r, corners, bias, d);
    } else if (ph_depth_coding(r) == PH_DEPTH_IS_LINEAR) {
        struct ph_linear linear = r->lens.linear;
        linear.bias = (uint8_t)(linear.bias + bias);
        linear.down = (int8_t)(linear.down - quotient.s);
        d[0] = ph_depth_linear_code(&linear, quotient.q >> 2);
    } else {
        d[0] = ph_depth_at(&r->lens, quotient, 0) + PH_DEPTH_BIAS_FIXED16 + (bias << 16);
    }
    return d[0] >> (32 - r->stats.depth_format->bits);
}

/*
 * Rounds a plane that crosses octaves, so that its codes are the same from wherever a row is begun: no bit of a
 * gradient is lost when it is shifted to the slope of an octave. Over many octaves that would cost the far end its
 * precision: such a plane stays as it is.
 */
PH_TIER(scenery) static void round_depth(struct ph_plane *plane, int bits)
{
    const uint32_t half = (1u << bits) >> 1, mask = UINT32_MAX << bits;
    plane->base = (plane->base + half) & mask;
    plane->gx = (plane->gx + half) & mask;
    plane->gy = (plane->gy + half) & mask;
}

PH_TIER(scenery)
bool ph_set_float(const struct ph_renderer *r, const struct ph_plane_base *s, const struct ph_vertex *const v[3],
                  const struct ph_material *material, struct ph_depth *any, uint8_t *block)
{
    struct ph_plane *const depth = &any->as.plane;
    const bool is_short = r->stats.depth_format->bits <= 16;
    uint32_t d[3];
    *block = ph_block_depths(r, v, ph_depth_bias(material), d);
    const int halved = depth_plane(s, !is_short || *block != PH_BLOCK_NONE, d, depth);
    ph_lift_plane(material, *block == PH_BLOCK_NONE ? PH_TOP_CODE : ph_depth_top(&r->lens), d, depth);
    if (*block == PH_BLOCK_NONE) {
        return halved <= 0 && !is_steep(s->sides, depth, STEEP);
    }
    const struct ph_octaves at = ph_octaves_of(d, *block);
    const int octaves = at.far - at.near, down = r->lens.float_down; /* codes are as steep as d in octave `down` */
    round_depth(depth, is_short ? down : ph_max(down - at.near, 0));
    return halved <= 0 && octaves <= r->stats.depth_format->octaves &&
           !is_steep(s->sides, depth, ph_max(STEEP + down - at.far, 32));
}

/* Sets depth in a fixed format; exact: as depth_plane has it. */
static inline __attribute__((always_inline)) bool set_fixed(const struct ph_renderer *r, const struct ph_plane_base *s,
                                                            const struct ph_vertex *const v[3],
                                                            const struct ph_material *material, bool exact,
                                                            struct ph_plane *plane)
{
    uint32_t d[3];
    fixed_depths(r, v, ph_depth_bias(material), d);
    const int halved = depth_plane(s, exact, d, plane);
    ph_lift_plane(material, PH_TOP_CODE, d, plane);
    return halved <= 0 && !is_steep(s->sides, plane, STEEP);
}

PH_TIER(scenery)
bool ph_set_fixed16(const struct ph_renderer *r, const struct ph_plane_base *s, const struct ph_vertex *const v[3],
                    const struct ph_material *material, struct ph_depth *depth, uint8_t *block)
{
    *block = PH_BLOCK_NONE;
    return set_fixed(r, s, v, material, false, &depth->as.plane);
}

PH_TIER(scenery)
bool ph_set_fixed24(const struct ph_renderer *r, const struct ph_plane_base *s, const struct ph_vertex *const v[3],
                    const struct ph_material *material, struct ph_depth *depth, uint8_t *block)
{
    *block = PH_BLOCK_NONE;
    return set_fixed(r, s, v, material, true, &depth->as.plane);
}

bool ph_set_linear(const struct ph_renderer *r, const struct ph_plane_base *s, const struct ph_vertex *const v[3],
                   const struct ph_material *material, struct ph_depth *depth, uint8_t *block)
{
    if (r->lens.kind == PH_ORTHOGRAPHIC) { /* the distance is linear in d */
        return ph_set_fixed24(r, s, v, material, depth, block);
    }
    *block = PH_BLOCK_LINEAR;
    struct ph_linear *const linear = &depth->over_w.linear;
    const int least = least_exponent(v);
    const uint32_t w[3] = {corner_over_w(v[0], least), corner_over_w(v[1], least), corner_over_w(v[2], least)};
    const int halved = plane_exact(&depth->as.plane, s, w);
    *linear = r->lens.linear;
    linear->bias = (uint8_t)(linear->bias + ph_depth_bias(material));
    linear->down = (int8_t)(linear->down - least);
    const uint32_t least_w = w[0] < w[1] ? w[0] : w[1];
    const int zeros = fx_clz32(least_w < w[2] ? least_w : w[2]), far_zeros = 3 + r->lens.far_s - least;
    /* At the far plane w changes by as much of itself as 1/w does, before it by less in codes. */
    const bool fits = halved <= 0 && zeros <= LINEAR_ZEROS &&
                      !is_steep(s->sides, &depth->as.plane, ph_min(STEEP - 1 - 2 * zeros + far_zeros, 48));
    if (fits && material->depth_bias_slope != 0) {
        ph_lift_linear(material, w, depth);
    }
    return fits;
}

/* Sets depth and block of a triangle. False if 32 bits are not enough. */
static inline bool setup_depth(const struct ph_renderer *r, const struct ph_plane_base *s,
                               const struct ph_material *material, const struct ph_vertex *const v[3],
                               struct ph_depth *depth, uint8_t *block)
{
    return ph_depth_ways(r)->set_plane(r, s, v, material, depth, block);
}

/* Finds u or v of the corners, Q16.16; not negative if the texture repeats that way. Returns the log2 of their range.
 */
PH_TIER(scenery)
static int texture_range(const struct ph_texture *texture, const fx_t *const uv[3], int axis, uint32_t out[3])
{
    const bool repeats = (texture->wrap >> axis & 1) == 0;
    const int32_t a = uv[0][axis], b = uv[1][axis], c = uv[2][axis], ab = a < b ? a : b, least = ab < c ? ab : c;
    uint32_t most = 1;
    for (int i = 0; i < 3; i++) {
        out[i] = (uint32_t)uv[i][axis] - (repeats ? (uint32_t)least & ~(uint32_t)0xffff : 0);
        const uint32_t size = repeats ? out[i] : fx_magnitude((int32_t)out[i]);
        most = size > most ? size : most;
    }
    const int log2 = 16 - fx_clz32(most - 1);
    return log2 > 0 ? log2 : 0;
}

/* Sets the planes of u/w, v/w and 1/w; t->block is set already. uv: the texture coordinates of each corner; NULL counts
 * as 0. */
PH_TIER(scenery)
static PH_NOINLINE void setup_texture(const struct ph_renderer *r, const struct ph_plane_base *s,
                                      const struct ph_vertex *const v[3], const fx_t *const corner_uv[3],
                                      struct ph_triangle *t)
{
    static const fx_t origin[2];
    static const fx_t *const origins[3] = {origin, origin, origin};
    const fx_t *const *from = corner_uv != NULL ? corner_uv : origins;
    const struct ph_texture *const texture = t->material->texture;
    struct ph_map *const map = &t->as.large.of.map;
    struct ph_plane *const planes[2] = {&map->u, &map->v};
    const uint32_t positive = (uint32_t)1 << 28;
    uint32_t uv[2][3];
    const int range_u = texture_range(texture, from, 0, uv[0]), range_v = texture_range(texture, from, 1, uv[1]);
    const int range = range_u > range_v ? range_u : range_v;
    const bool perspective = r->lens.kind != PH_ORTHOGRAPHIC;
    const int least = least_exponent(v);
    uint32_t w[3]; /* 1/w to a common exponent, up to 2^29 */
    for (int i = 0; i < 3; i++) {
        w[i] = perspective ? corner_over_w(v[i], least) : (uint32_t)1 << 28;
    }
    for (int axis = 0; axis < 2; axis++) {
        uint32_t over_w[3]; /* u / (4 range w): at most 2^27; then made positive */
        for (int i = 0; i < 3; i++) {
            const uint32_t u = uv[axis][i];
            const int32_t share = range <= 14 ? (int32_t)(u << (14 - range)) : (int32_t)u >> (range - 14); /* Q2.30 */
            over_w[i] = (uint32_t)(fx_mul_wide(share, (int32_t)w[i]) >> 32) + positive;
        }
        plane_through(planes[axis], s, over_w, false);
        planes[axis]->base -= positive;
    }
    if (t->block != PH_BLOCK_LINEAR) { /* linear-w has it as its depth */
        plane_through(&t->as.large.depth.over_w.plane, s, w, false);
    }
    map->range_log2 = (uint8_t)range;
}

void ph_set_texel_light(const struct ph_plane_base *s, const struct ph_vertex *const v[3], struct ph_triangle *t)
{
    int32_t light[3];
    for (int i = 0; i < 3; i++) {
        light[i] = ph_texel_light_of(t->material, v[i]) + PH_TEXEL_LIGHT_UP;
    }
    plane_light(&t->as.large.of.map.shades, s, light);
}

PH_TIER(scenery)
void ph_set_texel_planes(const struct ph_renderer *r, const struct ph_plane_base *s, const struct ph_vertex *const v[3],
                         const fx_t *const uv[3], struct ph_triangle *t)
{
    t->kind = PH_KIND_TEXTURE;
    t->as.large.of.map.light = ph_texture_light(t->material, v[0]);
    setup_texture(r, s, v, uv, t);
    if (t->as.large.of.map.light.shaded) {
        t->material->shading->texturing.lighting->set_texel_light(s, v, t);
    }
}

void ph_set_light(const struct ph_plane_base *s, const struct ph_vertex *const v[3], struct ph_triangle *t)
{
    const int32_t light[3] = {v[0]->light, v[1]->light, v[2]->light};
    t->kind = PH_KIND_GOURAUD;
    plane_light(&t->as.large.of.light, s, light);
}

/* The colour that a material's ramp has for a light. */
PH_TIER(scenery) static uint16_t ramp_colour(const struct ph_material *material, uint16_t light)
{
    return material->ramp != NULL ? material->ramp[light >> 9] : material->colour;
}

/* plane_base as a function of its own, for triangles that are rare. */
PH_TIER(scenery)
static PH_NOINLINE void general_base(struct ph_plane_base *base, const struct ph_vertex *first,
                                     const struct ph_sides *sides)
{
    plane_base(base, first, sides);
}

void ph_set_colours(struct ph_triangle *t, const struct ph_vertex *const v[3], const struct ph_sides *sides, bool flat)
{
    static const uint8_t from[3] = {11, 5, 0}, bits[3] = {5, 6, 5};
    struct ph_plane_base base;
    t->kind = flat || t->block == PH_BLOCK_LINEAR ? PH_KIND_FLAT : PH_KIND_COLOURS;
    if (t->kind == PH_KIND_FLAT) {
        t->as.large.of.colour = ph_wire16(v[0]->light);
        return;
    }
    general_base(&base, v[0], sides);
    for (int k = 0; k < 3; k++) {
        uint32_t at[3];
        for (int i = 0; i < 3; i++) {
            at[i] = ((uint32_t)v[i]->light >> from[k]) << (32 - bits[k]) | (uint32_t)1 << (31 - bits[k]);
        }
        plane_through(&t->as.large.of.colours[k], &base, at, false);
    }
}

/* Sets what gives the pixels their colour: a plane of light, a texture, or one colour. */
PH_TIER(scenery)
static void setup_shading(const struct ph_renderer *r, const struct ph_plane_base *s,
                          const struct ph_vertex *const v[3], const fx_t *const uv[3], struct ph_triangle *t)
{
    const struct ph_material *const material = t->material;
    const struct ph_shading *const shading = material->shading;
    if (ph_is_textured(material)) {
        shading->texturing.set_texel_planes(r, s, v, uv, t);
        return;
    }
    if (shading != NULL && shading->gouraud != NULL && material->ramp != NULL) {
        shading->gouraud->set_light(s, v, t);
        return;
    }
    t->kind = PH_KIND_FLAT;
    t->as.large.of.colour = ph_lit_corners_of(material) == PH_FIRST_CORNER && !ph_takes_texture(material)
                                ? ramp_colour(material, v[0]->light)
                                : material->colour;
}

PH_TIER(scenery)
bool ph_set_planes(struct ph_triangle *t, const struct ph_renderer *r, const struct ph_vertex *const v[3],
                   const fx_t *const uv[3], const struct ph_sides *sides)
{
    struct ph_plane_base base;
    plane_base(&base, v[0], sides);
    const bool fits = setup_depth(r, &base, t->material, v, &t->as.large.depth, &t->block);
    setup_shading(r, &base, v, uv, t);
    return fits;
}

PH_TIER(scenery)
bool ph_set_depth(const struct ph_renderer *r, const struct ph_material *material, const struct ph_vertex *const v[3],
                  const struct ph_sides *sides, struct ph_depth *depth, uint8_t *block)
{
    struct ph_plane_base base;
    general_base(&base, v[0], sides);
    return setup_depth(r, &base, material, v, depth, block);
}

PH_TIER(scenery)
bool ph_depth_plane(struct ph_plane *out, const struct ph_vertex *first, const struct ph_sides *sides,
                    const uint32_t d[3])
{
    struct ph_plane_base base;
    general_base(&base, first, sides);
    return depth_plane(&base, false, d, out) <= 0 && !is_steep(sides, out, STEEP);
}
