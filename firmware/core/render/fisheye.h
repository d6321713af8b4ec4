/* fisheye: the equidistant projection. Private to firmware/core; the method is in fisheye_*.c. */
#ifndef PH_FISHEYE_H
#define PH_FISHEYE_H

#include "clip.h"
#include "vertex.h"

/* What the renderer calls where the projection bends straight lines. A projection names it, so that the linker leaves
 * it out of a program without such a projection. */
struct ph_curved_lens {
    /* Sets the fisheye's part of the lens for a picture `height` pixels high. */
    void (*set_lens)(struct ph_lens *lens, const struct ph_projection *p, int32_t height);

    /* Projects the point (x, y, w): screen position, depth and clip code of v. PH_NEAR: nothing else of v is set.
     * PH_GUARD: only draw_curved can draw what meets this vertex. */
    void (*place_curved)(const struct ph_lens *lens, int32_t x, int32_t y, int32_t w, struct ph_vertex *v);

    /* Whether three vertices without clip code are so close together that their triangle needs no subdivision. */
    bool (*is_straight)(const struct ph_lens *lens, const struct ph_vertex *a, const struct ph_vertex *b,
                        const struct ph_vertex *c);

    /* Whether three vertices without clip code are so far beyond a side of the picture that nothing of it can be
     * seen. */
    bool (*misses_picture)(const struct ph_renderer *r, const struct ph_vertex *const v[3]);

    /* Subdivide, clip and list a triangle, or a line. Corners have their position in x, y, w; their z is not read.
     * Statistics count as in ph_draw_clipped. */
    void (*draw_curved)(struct ph_renderer *r, const struct ph_material *material, uint32_t kind,
                        const struct ph_clip_vertex in[3]);
    void (*draw_curved_line)(struct ph_renderer *r, const struct ph_material *material,
                             const struct ph_clip_vertex ends[2]);
};

/* The parts of the fisheye, see above. */
void ph_fisheye_lens(struct ph_lens *lens, const struct ph_projection *p, int32_t height);
void ph_fisheye_vertex(const struct ph_lens *lens, int32_t x, int32_t y, int32_t w, struct ph_vertex *v);
bool ph_fisheye_is_small(const struct ph_lens *lens, const struct ph_vertex *a, const struct ph_vertex *b,
                         const struct ph_vertex *c);
bool ph_fisheye_misses(const struct ph_renderer *r, const struct ph_vertex *const v[3]);

/* bounds.h: whether a sphere around (x, y, w), within 4096.0, lies off the picture. It is weak, so that a program links
 * it if it names both a fisheye and bounds; bounds.c calls it under a fisheye only. */
__attribute__((weak)) bool ph_fisheye_misses_sphere(const struct ph_renderer *r, int32_t x, int32_t y, int32_t w,
                                                    int32_t radius);
void ph_fisheye_triangle(struct ph_renderer *r, const struct ph_material *material, uint32_t kind,
                         const struct ph_clip_vertex in[3]);
void ph_fisheye_line(struct ph_renderer *r, const struct ph_material *material, const struct ph_clip_vertex ends[2]);

#endif
