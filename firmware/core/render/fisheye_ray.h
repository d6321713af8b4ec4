/*
 * fisheye_ray: a vertex as the fisheye's division sees it, a ray from the eye. fisheye.c projects it, fisheye_edges.c
 * divides edges, fisheye_clip.c clips pieces, and fisheye_draw.c draws triangles and lines. Private to these files.
 */
#ifndef PH_FISHEYE_RAY_H
#define PH_FISHEYE_RAY_H

#include "clip.h"
#include "vertex.h"

#define PH_FISHEYE_BLIND (-528715000) /* cos 170 degrees, Q29: behind it nothing is drawn */

/* 1 / distance: m 2^(s - 62), m in 2^30 .. 2^31, for a distance in units of Q16.16. */
struct ph_inverse {
    uint32_t m;
    int s;
};

/* Flags of a ray. NEAR, FAR: beyond that sphere; BLIND: behind 170 degrees; BEYOND: set-up cannot take the position;
 * BEFORE, ASIDE: less than 120 or 150 degrees from the axis. CUT: it cannot be drawn as it is. */
enum {
    PH_RAY_NEAR = 1,
    PH_RAY_FAR = 2,
    PH_RAY_BLIND = 4,
    PH_RAY_CUT = 7,
    PH_RAY_BEYOND = 8,
    PH_RAY_BEFORE = 16,
    PH_RAY_ASIDE = 32,
};

struct ph_ray {
    int32_t direction[3]; /* unit vector: x, y, along the view; Q2.29 */
    struct ph_inverse inverse;
    struct {
        int32_t x, y; /* 1/256 px */
    } at;
    fx_t uv[2];
    uint16_t light, flags;
};

/* What is known of an edge: the square of its chord, (1/128 px)^2; or LONG, and the square of its angle, Q26, because
 * it has to be divided. FAR_APART: it is over twice as long as edges that need not be. */
#define PH_ARC_LONG      ((uint32_t)1 << 31)
#define PH_ARC_FAR_APART ((uint32_t)1 << 30)

/* Edge k of a triangle runs from corner ph_next_corner[k] to ph_next_corner[k + 1]. */
PH_TIER(few) static const uint8_t ph_next_corner[4] = {1, 2, 0, 1};

static inline bool ph_inverse_is_less(struct ph_inverse a, struct ph_inverse b)
{
    return a.s != b.s ? a.s < b.s : a.m < b.m;
}

/* The signed product's high word. */
static inline int32_t ph_high_product(int32_t a, int32_t b)
{
    return (int32_t)(fx_mul_wide(a, b) >> 32);
}

/* ---- fisheye.c ---- */

/* The unit vector of v, Q29, which is 2^-25 off; zero gives the view direction. *inverse: 1 / |v|. */
void ph_fisheye_unit(const int32_t v[3], int32_t unit[3], struct ph_inverse *inverse);

/* BEFORE and ASIDE, from the larger coordinate of a point from the centre, 1/256 px. */
unsigned ph_fisheye_zone(const struct ph_lens *lens, uint32_t size);

/* Sets the place in the picture and the flags. */
void ph_fisheye_place(const struct ph_lens *lens, struct ph_ray *v);

/* The ray of a vertex. */
void ph_fisheye_ray(const struct ph_lens *lens, const struct ph_clip_vertex *in, struct ph_ray *v);

struct ph_corner ph_ray_corner(const struct ph_lens *lens, const struct ph_ray *v);

/* ---- fisheye_edges.c ---- */

/* Measures the edge from a to b; the result is described at PH_ARC_LONG. */
uint32_t ph_fisheye_arc(const struct ph_lens *lens, const struct ph_ray *a, const struct ph_ray *b);

/* The edge of a triangle that has to be divided, or -1; its dividing point becomes *middle. Edge k is opposite corner
 * k; bit k of *straight: it need not be divided. */
int ph_fisheye_edge_to_divide(const struct ph_renderer *r, const struct ph_ray *const v[3], const uint32_t arcs[3],
                              uint8_t *straight, struct ph_ray *middle);

/* Whether a line has to be divided, at *middle. Sets *misses if not, and nothing of it can be seen. */
bool ph_fisheye_divides_line(const struct ph_renderer *r, const struct ph_ray *const ends[2], struct ph_ray *middle,
                             bool *misses);

/* ---- fisheye_clip.c ---- */

/* Clips n = 2 or 3 rays to near and far sphere and to the cone that is visible. Returns the corners left, at most
 * PH_CLIP_MAX. Sets *beyond if set-up cannot take one of them. */
int ph_fisheye_clip(const struct ph_lens *lens, const struct ph_ray *const v[3], int n, struct ph_corner *out,
                    bool *beyond);

#endif
