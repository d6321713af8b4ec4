/*
 * Planes: from the values at three corners to a value at the centre of pixel (0, 0) and its gradients. See plane.h.
 *
 * Short sides take 32 bits and a reciprocal of 16; all others take products of 64 bits.
 */
#include "plane.h"

#include "edge.h"

#define NOINLINE __attribute__((noinline)) /* keeps rare work out of the registers of what is usual */

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

/* The reciprocal for products of 64 bits. */
static void wide_base(struct ph_plane_base *s)
{
    const int64_t area = ph_wide_area(s->sides);
    const int excess = max_int(bits_of(area) - 32, 0);
    s->reciprocal = (int32_t)(fx_rcp_norm((uint32_t)(area >> excess), &s->shift) >> 1);
    s->shift -= excess;
}

void ph_plane_base(struct ph_plane_base *s, const struct ph_vertex *first, const struct ph_sides *sides)
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
static struct ph_plane hang_plane(const struct ph_plane_base *s, uint32_t value, int32_t gx, int32_t gy)
{
    const uint32_t whole = (uint32_t)s->x * (uint32_t)gx + (uint32_t)s->y * (uint32_t)gy;
    const uint32_t part = (uint32_t)(gx >> 8) * (uint32_t)s->part_x + (uint32_t)(gy >> 8) * (uint32_t)s->part_y;
    return (struct ph_plane){value + whole + part, (uint32_t)gx, (uint32_t)gy};
}

struct pixel_gradient {
    int32_t x, y; /* per pixel */
};

/*
 * Gradient from the differences d1, d2 (below 2^32) between the second or third corner and the first:
 * x = (d2 dy1 - d1 dy2) / area, y = (d1 dx2 - d2 dx1) / area. For limit see ph_plane_through.
 */
static struct pixel_gradient wide_gradient(const struct ph_plane_base *any, int64_t d1, int64_t d2, int limit)
{
    struct ph_plane_base base = *any, *const s = &base;
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
    return (struct pixel_gradient){(int32_t)((px + half) >> down), (int32_t)((py + half) >> down)};
}

/* The plane with that gradient through `value` at the first corner. */
static NOINLINE struct ph_plane wide_plane(const struct ph_plane_base *s, uint32_t value, int64_t d1, int64_t d2,
                                           int limit)
{
    const struct pixel_gradient g = wide_gradient(s, d1, d2, limit);
    return hang_plane(s, value, g.x, g.y);
}

/* n r / 2^16; n is below 2^30, r has 16 bits. */
static inline int32_t times_q16(int32_t n, int32_t r)
{
    return (n >> 16) * r + (int32_t)(((uint32_t)n & 0xffff) * (uint32_t)r >> 16);
}

/*
 * The same for short sides, in 32 bits. d1, d2 (below 2^15) are the differences over 2^drop. On entry out->base is the
 * value at the first corner.
 */
static FX_APART void short_plane(struct ph_plane *out, const struct ph_plane_base *s, int32_t d1, int32_t d2, int drop,
                                 int limit)
{
    const struct ph_sides *const t = s->sides;
    int32_t gx = times_q16(d2 * t->dy1 - d1 * t->dy2, s->reciprocal);
    int32_t gy = times_q16(d1 * t->dx2 - d2 * t->dx1, s->reciprocal);
    int down = 23 - s->shift - drop; /* g 2^-down is the gradient; |g| < 2^30 */
    const int room = down + limit;   /* bits that g may have */
    if (room < 30 && ((uint32_t)((gx >> room) + 1) | (uint32_t)((gy >> room) + 1)) > 1) {
        down = max_int(down, 32 - fx_clz32(ph_without_sign(gx) | ph_without_sign(gy)) - limit);
    }
    gx = down >= 0 ? gx >> down : gx * (1 << -down);
    gy = down >= 0 ? gy >> down : gy * (1 << -down);
    *out = hang_plane(s, out->base, gx, gy);
}

/* The same for differences below 2^30, of which the upper 16 bits are taken. */
static inline void scaled_plane(struct ph_plane *out, const struct ph_plane_base *s, uint32_t value, int32_t d1,
                                int32_t d2, int limit)
{
    const int spare = fx_clz32(ph_without_sign(d1) | ph_without_sign(d2));
    const int drop = spare < 17 ? 17 - spare : 0;
    const int32_t half = (1 << drop) >> 1;
    out->base = value;
    short_plane(out, s, (d1 + half) >> drop, (d2 + half) >> drop, drop, limit);
}

void ph_plane_through(struct ph_plane *out, const struct ph_plane_base *s, const uint32_t v[3], int limit)
{
    /* If the halves differ by less than 2^29, the differences are below 2^30. */
    const int32_t half1 = (int32_t)((v[1] >> 1) - (v[0] >> 1)), half2 = (int32_t)((v[2] >> 1) - (v[0] >> 1));
    if (s->sides->is_short && ((uint32_t)((half1 >> 29) + 1) | (uint32_t)((half2 >> 29) + 1)) <= 1) {
        scaled_plane(out, s, v[0], (int32_t)(v[1] - v[0]), (int32_t)(v[2] - v[0]), limit);
    } else {
        *out = wide_plane(s, v[0], (int64_t)v[1] - v[0], (int64_t)v[2] - v[0], limit);
    }
}

void ph_plane_light(struct ph_plane *out, const struct ph_plane_base *s, const struct ph_vertex *const v[3])
{
    const int32_t d1 = v[1]->light - v[0]->light, d2 = v[2]->light - v[0]->light;
    const int drop = ((uint32_t)((d1 >> 15) + 1) | (uint32_t)((d2 >> 15) + 1)) > 1;
    out->base = (uint32_t)v[0]->light << 16;
    if (s->sides->is_short) {
        short_plane(out, s, d1 >> drop, d2 >> drop, 16 + drop, 31);
    } else {
        *out = wide_plane(s, out->base, (int64_t)d1 * 65536, (int64_t)d2 * 65536, 31);
    }
}

struct ph_plane ph_plane_exact(const struct ph_plane_base *s, const uint32_t v[3], int limit)
{
    const struct pixel_gradient g = wide_gradient(s, (int64_t)v[1] - v[0], (int64_t)v[2] - v[0], limit);
    const int32_t x = s->x * 256 + s->part_x, y = s->y * 256 + s->part_y;
    const uint32_t right = (uint32_t)(fx_mul_wide(g.x, x) >> 8), down = (uint32_t)(fx_mul_wide(g.y, y) >> 8);
    return (struct ph_plane){v[0] + right + down, (uint32_t)g.x, (uint32_t)g.y};
}
