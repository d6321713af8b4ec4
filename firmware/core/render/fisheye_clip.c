/*
 * Pieces of a triangle or a line are clipped to the near and the far sphere and to a cone. The point straight behind
 * the eye would become a circle in the picture: the cone ends 10 degrees before it. See fisheye_ray.h.
 */
#include "fisheye_ray.h"

#include "edge.h"

/* The distance that belongs to an inverse, in units of 2^up of Q16.16. */
PH_TIER(few) static int32_t distance_of(struct ph_inverse inverse, int up)
{
    int shift;
    const uint32_t r = fx_rcp_norm(inverse.m, &shift); /* 2^61 / m */
    const int down = inverse.s - 1 + up;
    return down <= 0 ? FX_MAX : down < 32 ? (int32_t)(r >> down) : 0;
}

/* A sphere's distance in units of 2^up. */
PH_TIER(few) static int32_t scaled(fx_t distance, int up)
{
    return up >= 32 ? 0 : up >= 0 ? distance >> up : fx_sat64((int64_t)((uint64_t)distance << (up > -31 ? -up : 31)));
}

PH_TIER(few) static int32_t along(int32_t direction, int32_t distance)
{
    return (int32_t)(fx_mul_wide(direction, distance) >> 29);
}

/* A vertex as a corner, with its distance between both spheres: that is not linear along an edge, and a point that
 * clipping has made may be 1/80 off its sphere. */
PH_TIER(few) static struct ph_corner cut_corner(const struct ph_lens *lens, const struct ph_ray *v)
{
    const struct ph_inverse near = {lens->near_over, lens->near_zeros}, far = {lens->far_over, lens->far_zeros};
    struct ph_ray corner = *v;
    corner.inverse = ph_inverse_is_less(near, v->inverse)  ? near
                     : ph_inverse_is_less(v->inverse, far) ? far
                                                           : v->inverse;
    return ph_ray_corner(lens, &corner);
}

/* Clips a polygon to the cone that is visible, as to a far plane: z is -cosine. Returns the corners left. */
PH_TIER(few)
static int clip_cone(const struct ph_lens *lens, struct ph_clip_vertex *in, int n, struct ph_clip_vertex *out)
{
    PH_TIER(few) static const struct ph_lens cone = {.kind = PH_FISHEYE, .near_z = FX_MIN, .far_z = -PH_FISHEYE_BLIND};
    struct ph_ray at;
    for (int i = 0; i < n; i++) {
        ph_fisheye_ray(lens, &in[i], &at);
        in[i].z = -at.direction[2];
    }
    return ph_clip(&cone, in, n, out);
}

/* Coordinates are scaled so that the farthest has 29 bits: the cut is as fine where the scene is tiny. */
PH_TIER(few)
int ph_fisheye_clip(const struct ph_lens *lens, const struct ph_ray *const v[3], int n, struct ph_corner *out,
                    bool *beyond)
{
    struct ph_clip_vertex in[3], cut[PH_CLIP_MAX], polygon[PH_CLIP_MAX];
    int least = v[0]->inverse.s;
    for (int i = 1; i < n; i++) {
        least = ph_min(least, v[i]->inverse.s);
    }
    const int up = 3 - least;
    for (int i = 0; i < n; i++) {
        const int32_t distance = distance_of(v[i]->inverse, up), *const d = v[i]->direction;
        in[i] = (struct ph_clip_vertex){.x = along(d[0], distance),
                                        .y = along(d[1], distance),
                                        .w = along(d[2], distance),
                                        .z = distance,
                                        .light = v[i]->light,
                                        .uv = {v[i]->uv[0], v[i]->uv[1]}};
    }
    const struct ph_lens spheres = {
        .kind = PH_FISHEYE, .near_z = scaled(lens->near_z, up), .far_z = scaled(lens->far_z, up)};
    const int count = clip_cone(lens, cut, ph_clip(&spheres, in, n, cut), polygon);
    for (int i = 0; i < count; i++) {
        struct ph_ray at;
        const struct ph_ray *from = &at;
        ph_fisheye_ray(lens, &polygon[i], &at);
        at.inverse.s -= up;
        for (int k = 0; k < n; k++) { /* a corner that was one before keeps its place to the last bit */
            const bool same = polygon[i].x == in[k].x && polygon[i].y == in[k].y && polygon[i].w == in[k].w;
            from = same ? v[k] : from;
        }
        *beyond |= (from->flags & PH_RAY_BEYOND) != 0;
        out[i] = cut_corner(lens, from);
    }
    return count;
}
