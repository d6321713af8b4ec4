/* fisheye: how the equidistant projection fits into the pipeline. Private to firmware/core; see fisheye.c. */
#ifndef PH_FISHEYE_H
#define PH_FISHEYE_H

#include "pipeline.h"

/* The lens of a frame `height` pixels high. */
void ph_fisheye_lens(struct ph_lens *lens, const struct ph_projection *p, int32_t height);

/* Place on the screen, depth and clip codes of the point: NEAR: all else is not set; GUARD: ask ph_fisheye_triangle. */
void ph_fisheye_vertex(const struct ph_lens *lens, int32_t x, int32_t y, int32_t w, struct ph_vertex *v);

/* Whether three vertices without clip codes are so close together that their triangle needs no subdivision. */
bool ph_fisheye_is_small(const struct ph_lens *lens, const struct ph_vertex *a, const struct ph_vertex *b,
                         const struct ph_vertex *c);

/* Subdivides, clips and sets up; x, y, w of the corners is their place, z their distance. Counts as ph_draw_clipped. */
void ph_fisheye_triangle(struct ph_renderer *r, const struct ph_material *material, const struct ph_clip_vertex in[3]);
void ph_fisheye_line(struct ph_renderer *r, const struct ph_material *material, const struct ph_clip_vertex ends[2]);

#endif
