/* See exact.h. */
#include "exact.h"

#include "edge.h"
#include "lift.h"
#include "planes.h"

PH_TIER(seldom) static void store(uint32_t to[2], uint64_t value)
{
    to[0] = (uint32_t)value;
    to[1] = (uint32_t)(value >> 32);
}

PH_TIER(seldom) static uint64_t load(const uint32_t from[2])
{
    return (uint64_t)from[1] << 32 | from[0];
}

PH_TIER(seldom) static PH_NOINLINE uint64_t magnitude(uint64_t value)
{
    return (int64_t)value < 0 ? 0u - value : value;
}

/* 2^16 n / area, rounded towards 0, modulo 2^64. |n| is below 2^63, area below 2^48. For short sides the last 8 bits
 * may be missing, which saves a division. */
PH_TIER(seldom) static uint64_t divide(int64_t n, uint64_t area, bool is_short)
{
    const uint64_t m = magnitude((uint64_t)n);
    const uint32_t high = (uint32_t)(m >> 32);
    const int zeros = high != 0 ? fx_clz32(high) : 32, up = ph_min(zeros, 16);
    const uint64_t whole = fx_quotient_u64(m << up, area);
    uint64_t quotient = whole << (16 - up);
    if (!is_short && up < 16) {
        quotient += fx_quotient_u64(((m << up) - whole * area) << (16 - up), area);
    }
    return n < 0 ? 0u - quotient : quotient;
}

/* A quotient of depth.h in 2^-40. */
PH_TIER(seldom) static int64_t in_40_bits(uint32_t q, int s)
{
    return s <= 10 ? (int64_t)((uint64_t)q << (10 - s)) : s < 42 ? q >> (s - 10) : 0;
}

/* The plane through d, 2^-40, of the corners, and their range. */
PH_TIER(seldom)
static void set_plane(struct ph_exact *e, const int64_t d[3], const struct ph_vertex *first,
                      const struct ph_sides *sides)
{
    const uint64_t area = (uint64_t)ph_wide_area(sides);
    const int64_t d1 = d[1] - d[0], d2 = d[2] - d[0], x = 128 - first->x, y = 128 - first->y;
    const uint64_t gx = divide(d2 * sides->dy1 - d1 * sides->dy2, area, sides->is_short); /* per 1/256 px */
    const uint64_t gy = divide(d1 * sides->dx2 - d2 * sides->dx1, area, sides->is_short);
    const int64_t low = d1 < d2 ? d1 : d2, high = d1 < d2 ? d2 : d1, least = low < 0 ? low : 0;
    store(e->base, ((uint64_t)d[0] << 16) + gx * (uint64_t)x + gy * (uint64_t)y);
    store(e->gx, gx << 8);
    store(e->gy, gy << 8);
    store(e->low, (uint64_t)(d[0] + least) << 16);
    store(e->size, (uint64_t)((high > 0 ? high : 0) - least) << 16);
}

/* Depths that become codes with one slope: bottom .. bottom + size. */
struct range {
    uint64_t bottom, size;
};

/* Where codes have octaves; a fixed format has none of it. */
struct ph_exact_ways {
    struct range (*range_of)(const struct ph_exact *e, int octave);
    /* linear-w; else NULL */
    void (*lift)(const struct ph_exact *e, struct ph_linear *linear, uint64_t by);
    void (*set_scale)(const struct ph_triangle *t, int octave, struct ph_triangle *run);
};

/* How depth becomes codes. */
PH_TIER(seldom) static void set_codes(struct ph_exact *e, const struct ph_renderer *r)
{
    e->coding = (uint8_t)ph_depth_coding(r);
    e->down = (int8_t)(e->coding == PH_DEPTH_IS_LINEAR ? r->lens.linear.down : r->lens.float_down);
    e->unit = (uint8_t)(e->coding == PH_DEPTH_IS_FLOAT ? 24 + r->lens.float_down : 27);
}

/* The lowest octave of a float. */
PH_TIER(seldom) static int lowest_of(const struct ph_exact *e)
{
    return ph_depth_lowest(0, e->down);
}

/* The octave in which d becomes codes; 3 shifts d to the unit of the fixed formats. For linear-w it ends at 30: the
 * exponent of a corner is 31 at most, and see scale_linear. */
PH_TIER(seldom) static int octave_of(const struct ph_exact *e, uint64_t d)
{
    const uint32_t high = (uint32_t)(d >> 24);
    return e->coding == PH_DEPTH_IS_FIXED   ? 3
           : e->coding == PH_DEPTH_IS_FLOAT ? ph_depth_octave(high, lowest_of(e))
                                            : ph_min(fx_clz32(high), 30);
}

/* A depth or a gradient in the unit of codes, which is `down` bits larger. halves: 0 cuts it off, 1 rounds it. */
static inline uint32_t in_codes(uint64_t d, int down, uint64_t halves)
{
    return down <= 0 ? (uint32_t)(d << -down) : (uint32_t)((int64_t)(d + (halves << (down - 1))) >> down);
}

/* 16.16 code of linear-w. */
PH_TIER(seldom) static uint32_t linear_code(const struct ph_exact *e, const struct ph_linear *linear, uint64_t over_w)
{
    struct ph_linear l = *linear;
    const int octave = octave_of(e, over_w);
    l.down = (int8_t)(e->down - (octave + 1));
    return ph_depth_linear_code(&l, in_codes(over_w, e->unit - octave, 0));
}

PH_TIER(seldom) static void lift_linear(const struct ph_exact *e, struct ph_linear *linear, uint64_t by)
{
    const uint64_t low = load(e->low);
    ph_lift_codes(linear, linear_code(e, linear, low), linear_code(e, linear, low + by),
                  linear_code(e, linear, low + load(e->size)));
}

/* Moves the plane towards the viewer: see depth_bias_slope in scene.h. */
PH_TIER(seldom)
static void lift(const struct ph_renderer *r, struct ph_exact *e, struct ph_linear *linear, uint32_t slope)
{
    const uint64_t low = load(e->low), size = load(e->size);
    const uint32_t top = ph_depth_top(&r->lens), high = (uint32_t)((low + size) >> 24);
    const uint64_t room = (uint64_t)(high < top ? top - high : 0) << 24;
    const uint64_t right = magnitude(load(e->gx)), below = magnitude(load(e->gy));
    const uint64_t part = (right > below ? right : below) >> 4,
                   by = part < size && part * slope < size ? part * slope : size; /* the product may wrap if not */
    if (e->coding == PH_DEPTH_IS_LINEAR) {
        ph_depth_ways(r)->exact->lift(e, linear, by);
        return;
    }
    const uint64_t up = by < room ? by : room;
    store(e->base, load(e->base) + up);
    store(e->low, low + up);
}

PH_TIER(seldom)
void ph_set_exact(const struct ph_renderer *r, const struct ph_material *material, const struct ph_vertex *const v[3],
                  const struct ph_sides *sides, struct ph_depth *depth)
{
    struct ph_exact *const e = &depth->as.exact;
    int64_t d[3];
    set_codes(e, r);
    for (int i = 0; i < 3; i++) {
        const int64_t far = e->coding == PH_DEPTH_IS_LINEAR ? 0 : in_40_bits(r->lens.far_q, r->lens.far_s);
        const int64_t before = in_40_bits(v[i]->q, v[i]->s) - far;
        d[i] = before > 0 ? before : 0;
    }
    set_plane(e, d, v[0], sides);
    if (material->depth_bias_slope != 0) {
        lift(r, e, &depth->over_w.linear, material->depth_bias_slope);
    }
}

/* The octave of a depth in the corners' range, cut off where that ends. */
PH_TIER(seldom) static struct range octave_range(const struct ph_exact *e, int octave)
{
    const uint64_t low = load(e->low), high = low + load(e->size), half = (uint64_t)1 << (55 - octave);
    const uint64_t first = e->coding == PH_DEPTH_IS_FLOAT && octave == lowest_of(e) ? 0 : half;
    const uint64_t bottom = first > low ? first : low, top = 2 * half - 1 < high ? 2 * half - 1 : high;
    return (struct range){bottom, top - bottom};
}

static inline struct range range_of(const struct ph_exact *e, const struct ph_exact_ways *ways, int octave)
{
    return e->coding == PH_DEPTH_IS_FIXED ? (struct range){load(e->low), load(e->size)} : ways->range_of(e, octave);
}

static inline bool holds(const struct range *range, uint64_t d)
{
    return d - range->bottom <= range->size;
}

static inline uint64_t depth_at(const struct ph_exact *e, uint32_t x, uint32_t y)
{
    return load(e->base) + load(e->gx) * x + load(e->gy) * y;
}

/* What is added to the codes of an octave. */
PH_TIER(seldom)
static uint32_t offset_of(const struct ph_exact *e, const struct ph_material *material, int octave)
{
    const uint32_t bias = ph_depth_bias(material);
    return e->coding == PH_DEPTH_IS_LINEAR  ? 0
           : e->coding == PH_DEPTH_IS_FLOAT ? ph_depth_float16_offset(octave, 0, e->down) + (bias << 13)
                                            : PH_DEPTH_BIAS_FIXED16 + (bias << 16);
}

PH_TIER(seldom) static struct ph_plane scaled(const struct ph_plane *p, int up)
{
    return (struct ph_plane){p->base << up, p->gx << up, p->gy << up};
}

/* For linear-w: the unit of 1/w, and of u/w and v/w with it. It is not larger than that of t, which is the nearest
 * corner's. */
PH_TIER(seldom)
static void scale_linear(const struct ph_triangle *t, int octave, struct ph_triangle *run)
{
    struct ph_linear *const linear = &run->as.large.depth.over_w.linear;
    *linear = t->as.large.depth.over_w.linear;
    linear->down = (int8_t)(t->as.large.depth.as.exact.down - (octave + 1));
    run->block = PH_BLOCK_LINEAR;
    if (t->kind == PH_KIND_TEXTURE) {
        const int up = t->as.large.depth.over_w.linear.down - linear->down;
        run->as.large.of.map.u = scaled(&t->as.large.of.map.u, up);
        run->as.large.of.map.v = scaled(&t->as.large.of.map.v, up);
    }
}

/* The plane of a run, through d at pixel (x, y). */
PH_TIER(seldom)
static void set_run(const struct ph_triangle *t, const struct ph_exact_ways *ways, uint64_t d, int octave, uint32_t x,
                    uint32_t y, struct ph_triangle *run)
{
    const struct ph_exact *const e = &t->as.large.depth.as.exact;
    const int down = e->unit - octave;
    const uint32_t gx = in_codes(load(e->gx), down, 1), gy = in_codes(load(e->gy), down, 1);
    const uint32_t offset = offset_of(e, t->material, octave);
    run->as.large.depth.as.plane = (struct ph_plane){in_codes(d, down, 0) + offset - x * gx - y * gy, gx, gy};
    run->block = PH_BLOCK_NONE;
    if (e->coding == PH_DEPTH_IS_LINEAR) {
        ways->set_scale(t, octave, run);
    }
}

const struct ph_exact_ways ph_exact_float = {.range_of = octave_range};
const struct ph_exact_ways ph_exact_linear = {.range_of = octave_range, .lift = lift_linear, .set_scale = scale_linear};

/* The outline of a run: rows y .. y_end - 1 between two edges, which are given at row y. */
PH_TIER(seldom)
static void set_rows(struct ph_triangle *run, int32_t y, int32_t y_end, struct ph_edge left, struct ph_edge right)
{
    struct ph_large *const large = &run->as.large;
    run->y_top = (int16_t)y;
    large->y_mid = run->y_bottom = (int16_t)y_end;
    large->upper = left;
    large->long_edge = right;
    large->long_left = false;
}

/* The column of an edge so many rows further down. */
PH_TIER(seldom) static int32_t column_below(struct ph_edge edge, int32_t rows)
{
    return (int32_t)((uint32_t)edge.x + (uint32_t)rows * (uint32_t)edge.dx) >> 16;
}

PH_TIER(seldom)
bool ph_exact_rows(const struct ph_triangle *t, const struct ph_exact_strip *strip, struct ph_triangle *run)
{
    const struct ph_exact *const e = &t->as.large.depth.as.exact;
    const int32_t more = strip->rows.y_end - 1 - strip->rows.y;
    const int32_t left = strip->rows.left.x >> 16, left_end = column_below(strip->rows.left, more);
    const int32_t right = strip->rows.right.x >> 16, right_end = column_below(strip->rows.right, more);
    const int32_t x = ph_max(ph_min(left, left_end), 0), x_end = ph_min(ph_max(right, right_end), strip->width);
    if (x >= x_end || x_end - x > PH_EXACT_RUN) {
        return false;
    }
    const uint32_t x0 = (uint32_t)x, x1 = (uint32_t)x_end - 1, y0 = (uint32_t)strip->rows.y,
                   y1 = (uint32_t)strip->rows.y_end - 1;
    const uint64_t d = depth_at(e, x0, y0);
    const int octave = octave_of(e, d);
    const struct range range = range_of(e, strip->ways, octave);
    if (d - load(e->low) > load(e->size) || !holds(&range, depth_at(e, x1, y0)) ||
        !holds(&range, depth_at(e, x0, y1)) || !holds(&range, depth_at(e, x1, y1))) {
        return false;
    }
    const uint32_t x_mid = (x0 + x1) / 2, y_mid = (y0 + y1) / 2; /* there the rounding of the gradients counts least */
    set_run(t, strip->ways, depth_at(e, x_mid, y_mid), octave, x_mid, y_mid, run);
    set_rows(run, strip->rows.y, strip->rows.y_end, strip->rows.left, strip->rows.right);
    return true;
}

/* How many of n pixels from (x, y) on stay in the range. The first has depth d, which is in it. */
PH_TIER(seldom) static uint32_t pixels_in(const struct range *range, uint64_t d, uint64_t gd, uint32_t n)
{
    uint32_t count = 1;
    if (holds(range, d + gd * (n - 1))) { /* then so are all between, because depth is linear */
        return n;
    }
    while (count < n && holds(range, d += gd)) {
        count++;
    }
    return count;
}

PH_TIER(seldom)
int32_t ph_exact_run(const struct ph_triangle *t, const struct ph_exact_ways *ways, int32_t x, int32_t x_end, int32_t y,
                     struct ph_triangle *run)
{
    const struct ph_exact *const e = &t->as.large.depth.as.exact;
    const uint64_t low = load(e->low), size = load(e->size);
    const uint32_t n = (uint32_t)ph_min(x_end - x, PH_EXACT_RUN);
    uint64_t d = depth_at(e, (uint32_t)x, (uint32_t)y);
    uint32_t count = 1;
    const bool clamped = d - low > size;
    if (clamped) {
        d = (int64_t)(d - low) < 0 ? low : low + size;
    }
    const int octave = octave_of(e, d);
    if (!clamped && n > 1) {
        const struct range range = range_of(e, ways, octave);
        count = pixels_in(&range, d, load(e->gx), n);
    }
    const uint32_t mid = (count - 1) / 2;
    set_run(t, ways, d + mid * load(e->gx), octave, (uint32_t)x + mid, (uint32_t)y, run);
    set_rows(run, y, y + 1, (struct ph_edge){x * 65536, 0}, (struct ph_edge){(x + (int32_t)count) * 65536, 0});
    return (int32_t)count;
}
