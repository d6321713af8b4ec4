/*
 * A straight edge becomes a curve under a fisheye. So triangles and lines are subdivided until their edges are straight
 * enough, and the pieces are drawn like all triangles. See fisheye_ray.h.
 *
 * An edge is divided where the bisector of the angle between its ends meets it: there the direction is a + b, made a
 * unit vector again, and 1 / distance, which is linear in direction, is the sum of both over |a + b|. An edge is
 * divided when its ends are more than 1/20 turn apart in the picture, or when the dividing point is more than 1/2 px
 * off the straight line. A chord of L px is at most k L^2 / 8 f px off, with k below .96 where theta < 120 degrees,
 * below 1.72 where it is < 150, and below 4.6 elsewhere; edges that are short enough by that are not tested; edges
 * below 2^-5 radian are never divided. All of this depends on the ends of the edge alone, so two triangles that share
 * an edge divide it alike and no crack opens.
 */
/* Kits on armv6m: -O2. */
#include "fisheye.h"
#include "fisheye_ray.h"

#define SHORT ((uint32_t)1 << 16) /* shorter edges, below 2^-5 radian, are never divided; squared Q26 */

/* The square of a chord, (1/128 px)^2; UINT32_MAX from 256 px along an axis on. The order of its ends does not
 * matter. */
static inline uint32_t chord2(int32_t ax, int32_t ay, int32_t bx, int32_t by)
{
    const uint32_t dx = fx_magnitude(bx - ax) >> 1, dy = fx_magnitude(by - ay) >> 1;
    return (dx | dy) >> 15 != 0 ? UINT32_MAX : dx * dx + dy * dy;
}

PH_TIER(few) static uint32_t chord_of(const struct ph_ray *a, const struct ph_ray *b)
{
    return chord2(a->at.x, a->at.y, b->at.x, b->at.y);
}

/* The square of the longest chord that may stay whole, (1/128 px)^2. */
static inline uint32_t longest2(const struct ph_lens *lens)
{
    const uint32_t half = (uint32_t)lens->chord_max >> 1;
    return half * half;
}

/* The square of the chord below which no edge is divided, because it is less than 1/2 px off, (1/128 px)^2. `zones`:
 * the flags BEFORE and ASIDE that both ends have. */
static inline uint32_t shortest2(const struct ph_lens *lens, unsigned zones)
{
    const uint32_t f = lens->chord_min2, least = (zones & PH_RAY_BEFORE) != 0  ? f
                                                 : (zones & PH_RAY_ASIDE) != 0 ? f / 2
                                                                               : f / 4;
    return least < longest2(lens) ? least : longest2(lens);
}

PH_TIER(few) static unsigned zone_at(const struct ph_lens *lens, const struct ph_vertex *v)
{
    const uint32_t x = fx_magnitude(v->x - lens->centre_x), y = fx_magnitude(v->y - lens->centre_y);
    return ph_fisheye_zone(lens, x > y ? x : y);
}

PH_TIER(few)
static PH_NOINLINE bool chords_are_within(uint32_t limit, const struct ph_vertex *a, const struct ph_vertex *b,
                                          const struct ph_vertex *c)
{
    return chord2(a->x, a->y, b->x, b->y) <= limit && chord2(b->x, b->y, c->x, c->y) <= limit &&
           chord2(c->x, c->y, a->x, a->y) <= limit;
}

PH_TIER(few)
bool ph_fisheye_is_small(const struct ph_lens *lens, const struct ph_vertex *a, const struct ph_vertex *b,
                         const struct ph_vertex *c)
{
    return chords_are_within(shortest2(lens, zone_at(lens, a) & zone_at(lens, b) & zone_at(lens, c)), a, b, c);
}

/* The square of the distance between two unit vectors, Q26, rounded down; below 2^29. For a small angle it is the
 * square of the angle. */
PH_TIER(few) static uint32_t apart2(const struct ph_ray *a, const struct ph_ray *b)
{
    uint32_t sum = 0;
    for (int i = 0; i < 3; i++) {
        const uint32_t d = fx_magnitude(a->direction[i] - b->direction[i]);
        sum += fx_mulhi_u32(d, d);
    }
    return sum;
}

/* 1/distance of the dividing point of an edge whose ends' directions differ by the angle A: mean / cos(A / 2). more_q32
 * is 1 / cos(A / 2) - 1. */
PH_TIER(few) static struct ph_inverse inverse_between(struct ph_inverse a, struct ph_inverse b, uint32_t more_q32)
{
    const struct ph_inverse far = ph_inverse_is_less(a, b) ? a : b, near = ph_inverse_is_less(a, b) ? b : a;
    const int down = near.s - far.s;
    const uint32_t mean = (near.m + (down < 32 ? far.m >> down : 0)) >> 1, m = mean + fx_mulhi_u32(mean, more_q32);
    return m < (uint32_t)1 << 30 ? (struct ph_inverse){2 * m, near.s - 1}
           : m >> 31 != 0        ? (struct ph_inverse){m >> 1, near.s + 1}
                                 : (struct ph_inverse){m, near.s};
}

/* 1 / cos(A / 2) - 1 in Q32, from (2 sin(A / 2))^2 / 4 = e in Q28, e <= 1/16: (1 - e)^-1/2 - 1 to e^5. */
static inline uint32_t over_cosine(uint32_t e_q28)
{
    const uint32_t e = e_q28 << 4, e16 = e >> 16;
    const uint32_t high = 24576 + (e16 * (20480 + (e16 * (17920 + (e16 * 16128 >> 16)) >> 16)) >> 16);
    return fx_mulhi_u32(e, ((uint32_t)1 << 31) + fx_mulhi_u32(e, high << 16));
}

/* Light and texture of the dividing point: at t = |a| / (|a| + |b|). */
PH_TIER(few) static void divide_attributes(const struct ph_ray *a, const struct ph_ray *b, struct ph_ray *m)
{
    int shift;
    const struct ph_inverse of_a = a->inverse, of_b = b->inverse;
    const int s = of_a.s > of_b.s ? of_a.s : of_b.s;
    const uint32_t part_a = s - of_a.s < 32 ? of_a.m >> (s - of_a.s) : 0;
    const uint32_t part_b = s - of_b.s < 32 ? of_b.m >> (s - of_b.s) : 0;
    const uint32_t reciprocal = fx_rcp_norm(part_a + part_b, &shift);
    const int32_t t = (int32_t)fx_mulhi_u32(part_b << shift, reciprocal);
    const struct ph_clip_vertex from = {.light = a->light, .uv = {a->uv[0], a->uv[1]}};
    const struct ph_clip_vertex to = {.light = b->light, .uv = {b->uv[0], b->uv[1]}};
    const struct ph_clip_vertex middle = ph_clip_between(&from, &to, t);
    m->light = (uint16_t)middle.light;
    m->uv[0] = middle.uv[0];
    m->uv[1] = middle.uv[1];
}

/* Sets the dividing point of an edge. The order of the two ends does not change its place. */
PH_TIER(few)
static void divide(const struct ph_lens *lens, const struct ph_ray *a, const struct ph_ray *b, struct ph_ray *m)
{
    const uint32_t e_q28 = apart2(a, b);
    if (e_q28 <= (uint32_t)1 << 24) {
        const uint32_t more = over_cosine(e_q28);
        for (int i = 0; i < 3; i++) {
            const int32_t half = (a->direction[i] + b->direction[i]) >> 1;
            m->direction[i] = half + ph_high_product(half, (int32_t)more);
        }
        m->inverse = inverse_between(a->inverse, b->inverse, more);
    } else {
        struct ph_inverse over; /* 1 / |a + b|, where a and b are 2^29 long: it is 2 or more of its unit, 2^-30 */
        const int32_t sum[3] = {a->direction[0] + b->direction[0], a->direction[1] + b->direction[1],
                                a->direction[2] + b->direction[2]};
        ph_fisheye_unit(sum, m->direction, &over);
        const struct ph_inverse mean = inverse_between(a->inverse, b->inverse, 0);
        const uint32_t product = fx_mulhi_u32(mean.m << 1, over.m); /* 2^29 .. 2^31 */
        const int low = product >> 30 == 0;
        m->inverse = (struct ph_inverse){product << low, mean.s + over.s - 1 - low};
    }
    m->light = a->light;
    m->uv[0] = a->uv[0];
    m->uv[1] = a->uv[1];
    if (a->light != b->light || a->uv[0] != b->uv[0] || a->uv[1] != b->uv[1]) {
        divide_attributes(a, b, m);
    }
    ph_fisheye_place(lens, m);
}

PH_TIER(few) uint32_t ph_fisheye_arc(const struct ph_lens *lens, const struct ph_ray *a, const struct ph_ray *b)
{
    const uint32_t chord = chord_of(a, b), longest = longest2(lens);
    if (chord <= longest) {
        return chord;
    }
    const uint32_t angle = apart2(a, b);
    return (chord > 4 * longest ? PH_ARC_FAR_APART : 0) | (angle >= SHORT ? PH_ARC_LONG | angle : 0);
}

/* The angle of an edge that is not long, but bends: its dividing point *m, which is set then, is over 1/2 px off the
 * chord. Squared as in apart2; 0 if it need not be divided. */
PH_TIER(few)
static uint32_t bent_angle(const struct ph_lens *lens, const struct ph_ray *a, const struct ph_ray *b, uint32_t chord,
                           struct ph_ray *m)
{
    const uint32_t angle = chord > shortest2(lens, a->flags & b->flags) ? apart2(a, b) : 0;
    if (angle < SHORT) {
        return 0;
    }
    divide(lens, a, b, m);
    const int32_t dx = b->at.x - a->at.x, dy = b->at.y - a->at.y;
    const int64_t area = fx_mul_wide(m->at.x - a->at.x, dy) - fx_mul_wide(dx, m->at.y - a->at.y);
    const int64_t most = (int64_t)(fx_magnitude(dx) > fx_magnitude(dy) ? fx_magnitude(dx) : fx_magnitude(dy)) << 7;
    return area > most || area < -most ? angle : 0;
}

enum { ALL_SIDES = 15 };

/* A bit for each side of the picture beyond which a point lies by more than the margin: an edge between two such points
 * that is at most twice as long does not reach the picture, however it bends. The bits are signs of distances. */
static inline uint32_t sides_of(const struct ph_renderer *r, int32_t x, int32_t y, int32_t margin)
{
    const int32_t right = r->config.width * 256 + margin, bottom = r->config.height * 256 + margin;
    return (uint32_t)(margin + x) >> 31 | (uint32_t)(right - x) >> 31 << 1 | (uint32_t)(margin + y) >> 31 << 2 |
           (uint32_t)(bottom - y) >> 31 << 3;
}

/* Whether all vertices are beyond one side of the picture. Edges are at most twice as long as the longest that are
 * drawn; if they are short, chords may be 17/32 f behind the viewer: over half of these is the margin. */
PH_TIER(few) static bool misses_picture(const struct ph_renderer *r, const struct ph_ray *const v[], int n)
{
    const int32_t margin = r->lens.chord_max;
    uint32_t outside = ALL_SIDES;
    for (int i = 0; i < n && outside != 0; i++) {
        outside &= sides_of(r, v[i]->at.x, v[i]->at.y, margin);
    }
    return outside != 0;
}

PH_TIER(few) bool ph_fisheye_misses(const struct ph_renderer *r, const struct ph_vertex *const v[3])
{
    const int32_t margin = r->lens.chord_max;
    uint32_t outside = ALL_SIDES;
    for (int i = 0; i < 3 && outside != 0; i++) {
        outside &= sides_of(r, v[i]->x, v[i]->y, margin);
    }
    return outside != 0 && chords_are_within(4 * longest2(&r->lens), v[0], v[1], v[2]);
}

PH_TIER(few)
int ph_fisheye_edge_to_divide(const struct ph_renderer *r, const struct ph_ray *const v[3], const uint32_t arcs[3],
                              uint8_t *straight, struct ph_ray *middle)
{
    uint32_t most = 0;
    int edge = -1;
    for (int k = 0; k < 3; k++) {
        const uint32_t angle = (arcs[k] & PH_ARC_LONG) != 0 ? arcs[k] & (PH_ARC_FAR_APART - 1) : 0;
        edge = angle > most ? k : edge;
        most = angle > most ? angle : most;
    }
    const bool far_apart = ((arcs[0] | arcs[1] | arcs[2]) & PH_ARC_FAR_APART) != 0;
    if ((edge < 0 || !far_apart) && misses_picture(r, v, 3)) {
        return -1;
    }
    if (edge >= 0) {
        divide(&r->lens, v[ph_next_corner[edge]], v[ph_next_corner[edge + 1]], middle);
        return edge;
    }
    for (int k = 0; k < 3; k++) {
        const struct ph_ray *const from = v[ph_next_corner[k]], *const to = v[ph_next_corner[k + 1]];
        struct ph_ray m;
        const uint32_t angle = (*straight >> k & 1) == 0 ? bent_angle(&r->lens, from, to, arcs[k], &m) : 0;
        if (angle > most) {
            edge = k;
            most = angle;
            *middle = m;
        }
        *straight |= (uint8_t)((angle == 0) << k);
    }
    return edge;
}

PH_TIER(few)
bool ph_fisheye_divides_line(const struct ph_renderer *r, const struct ph_ray *const ends[2], struct ph_ray *middle,
                             bool *misses)
{
    const uint32_t arc = ph_fisheye_arc(&r->lens, ends[0], ends[1]);
    const bool is_long = (arc & PH_ARC_LONG) != 0;
    *misses = !is_long && misses_picture(r, ends, 2);
    if (is_long) {
        divide(&r->lens, ends[0], ends[1], middle);
    }
    return is_long || (!*misses && bent_angle(&r->lens, ends[0], ends[1], arc, middle) > 0);
}
