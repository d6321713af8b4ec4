/*
 * Clipping before the divide (Sutherland and Hodgman, 1974): against the near and the far plane, then against the four
 * sides of the guard band. A crossing is always computed from the inner to the outer corner. So two triangles that
 * share an edge get the same point, and the cut stays watertight. See clip.h.
 */
#include "clip.h"
#include "tier.h"

enum { PLANE_NEAR, PLANE_FAR, PLANE_LEFT, PLANE_RIGHT, PLANE_TOP, PLANE_BOTTOM, PLANES };

/* Distance from a plane, positive inside. Its scale does not matter; it is below 2^46. */
PH_TIER(few) static int64_t distance(const struct ph_lens *lens, const struct ph_clip_vertex *v, int plane)
{
    if (plane <= PLANE_FAR) {
        return plane == PLANE_NEAR ? (int64_t)v->z - lens->near_z : (int64_t)lens->far_z - v->z;
    }
    const int64_t guard = (int64_t)v->w * 8;
    const int64_t at = (int64_t)((uint64_t)(int64_t)v->value[(plane - PLANE_LEFT) / 2] << lens->guard_up); /* x or y */
    return (plane - PLANE_LEFT) % 2 == 0 ? guard + at : guard - at;
}

PH_TIER(few) static int32_t lerp_q30(int32_t a, int32_t b, int32_t t_q30)
{
    return (int32_t)(a + ((((int64_t)b - a) * t_q30 + (1 << 29)) >> 30));
}

PH_TIER(few)
struct ph_clip_vertex ph_clip_between(const struct ph_clip_vertex *a, const struct ph_clip_vertex *b, int32_t t_q30)
{
    struct ph_clip_vertex v;
    for (int i = 0; i < PH_CLIP_VALUES; i++) {
        v.value[i] = lerp_q30(a->value[i], b->value[i], t_q30);
    }
    return v;
}

/* part / whole in Q2.30, rounded down; part <= whole, whole > 0. */
PH_TIER(few) static int32_t share_q30(uint32_t part, uint32_t whole)
{
    int shift;
    const uint32_t r = fx_rcp_far(whole, &shift), q = (uint32_t)(fx_mul_wide_u(part, r) >> (32 - shift));
    const uint64_t rest = ((uint64_t)part << 30) - fx_mul_wide_u(q, whole); /* q is right, or one too small */
    return (int32_t)(q + (rest >= whole));
}

/* Where the edge from inside (distance from >= 0) to outside (to < 0) meets the plane. */
PH_TIER(few)
static struct ph_clip_vertex crossing(const struct ph_lens *lens, const struct ph_clip_vertex *inside,
                                      const struct ph_clip_vertex *outside, int64_t from, int64_t to, int plane)
{
    uint64_t whole = (uint64_t)(from - to);
    while (whole >> 32 != 0) { /* at most 15 times */
        whole >>= 1;
        from >>= 1;
    }
    struct ph_clip_vertex v = ph_clip_between(inside, outside, share_q30((uint32_t)from, (uint32_t)whole));
    if (plane == PLANE_NEAR || plane == PLANE_FAR) { /* the point lies exactly on the plane, however it was rounded */
        v.z = plane == PLANE_NEAR ? lens->near_z : lens->far_z;
        v.w = lens->kind == PH_PERSPECTIVE ? v.z : v.w;
    }
    return v;
}

/*
 * Clips against one plane. Returns the number of corners left: at most one more. Only a sliver a few LSB thin that lies
 * in the plane may cross it more often; what does not fit PH_CLIP_MAX is left out then.
 */
PH_TIER(few)
static int clip_plane(const struct ph_lens *lens, const struct ph_clip_vertex *in, int n, struct ph_clip_vertex *out,
                      int plane)
{
    int count = 0;
    for (int i = 0; i < n && count < PH_CLIP_MAX; i++) {
        const struct ph_clip_vertex *a = &in[i], *b = &in[i + 1 < n ? i + 1 : 0];
        const int64_t d[2] = {distance(lens, a, plane), distance(lens, b, plane)};
        const int inner = d[0] < 0; /* the end of the edge that is inside, if one is */
        if (inner == 0) {
            out[count++] = *a;
        }
        if (n == 2 && i == 1) { /* a line has one edge only */
            break;
        }
        if ((d[0] < 0) != (d[1] < 0) && count < PH_CLIP_MAX) {
            out[count++] = crossing(lens, inner == 0 ? a : b, inner == 0 ? b : a, d[inner], d[1 - inner], plane);
        }
    }
    return count;
}

PH_TIER(few) static bool is_inside(const struct ph_lens *lens, const struct ph_clip_vertex *v, int n, int plane)
{
    while (n > 0 && distance(lens, &v[n - 1], plane) >= 0) {
        n--;
    }
    return n == 0;
}

PH_TIER(few) int ph_clip(const struct ph_lens *lens, const struct ph_clip_vertex *in, int n, struct ph_clip_vertex *out)
{
    struct ph_clip_vertex work[2][PH_CLIP_MAX];
    const struct ph_clip_vertex *from = in;
    const int planes = lens->kind == PH_FISHEYE ? PLANE_LEFT : PLANES;
    for (int plane = 0; plane < planes && n >= 2; plane++) {
        if (!is_inside(lens, from, n, plane)) {
            struct ph_clip_vertex *const to = work[from == work[0]];
            n = clip_plane(lens, from, n, to, plane);
            from = to;
        }
    }
    for (int i = 0; i < n; i++) {
        out[i] = from[i];
    }
    return n;
}
