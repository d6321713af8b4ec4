/* clip: polygons and lines clipped before the divide. Private to firmware/core. */
#ifndef PH_CLIP_H
#define PH_CLIP_H

#include "render.h"

/* A corner in clip coordinates. Its place on the screen is centre + 2^focal_log2 (x, y) / w. */
#define PH_CLIP_VALUES 7
struct ph_clip_vertex {
    union {
        struct {
            int32_t x, y, w, z; /* Q16.16. z is the distance along the view; w = z, or 1 if orthographic; fisheye: see
                                   fisheye.h */
            int32_t light;      /* 0 .. 65535 */
            fx_t uv[2];
        };
        int32_t value[PH_CLIP_VALUES]; /* all of them */
    };
};

/* a + (b - a) t of every member, t in Q2.30; each is rounded once. */
struct ph_clip_vertex ph_clip_between(const struct ph_clip_vertex *a, const struct ph_clip_vertex *b, int32_t t_q30);

/* Clips a polygon of n = 2 (a line) or 3 corners; out has room for PH_CLIP_MAX. Returns the number of corners left. */
#define PH_CLIP_MAX 9
int ph_clip(const struct ph_lens *lens, const struct ph_clip_vertex *in, int n, struct ph_clip_vertex *out);

#endif
