/*
 * depth_ways: what the names of depth formats stand for. Private to firmware/core.
 *
 * A config points to its format, and a format to the functions that make and draw its codes. Nothing else refers to
 * these, so the linker leaves out those of formats that a program does not name. Only depth_formats.c knows all of
 * them.
 */
#ifndef PH_DEPTH_WAYS_H
#define PH_DEPTH_WAYS_H

#include "depth.h"
#include "kernels.h"
#include "triangle.h"

struct ph_band;
struct ph_exact_ways;
struct ph_octave;
struct ph_place;
struct ph_plane_base;
struct ph_run;
struct ph_sides;
struct ph_small_texels;

/* Small triangles and rows whose depth is a float of 16 bits. */
struct ph_octave_ways {
    /* kernels.h: ph_float_depths, ph_small_knee */
    ph_codes_kernel *set_codes;
    ph_gouraud_kernel *draw_knee;
    /* setup.h, knee.h */
    bool (*finish_depth)(struct ph_triangle *t, const struct ph_renderer *r, const struct ph_vertex *const v[3],
                         const struct ph_sides *sides, const uint32_t d[3], bool has_plane);
    void (*set_knee)(struct ph_triangle *t, const uint32_t d[3]);
    /* raster_rows.h, raster_walk.h */
    uint32_t (*draw_split)(const struct ph_triangle *t, const struct ph_band *band);
    uint32_t (*draw_rows_split)(const struct ph_triangle *t, struct ph_small_triangle *r, const struct ph_place *at,
                                struct ph_small_texels *texels);
    void (*draw_flat)(const struct ph_triangle *t, const struct ph_band *band, struct ph_octave *octave,
                      const struct ph_run *row);
};

struct ph_depth_ways {
    /* lens.h: N of depth.h; NULL: the near plane's distance, and what else the lens of linear-w has, or NULL. */
    uint32_t (*set_near)(const struct ph_projection *p, int *shift);
    struct ph_linear (*linear_of)(const struct ph_lens *lens);
    /* planes.h: depth and block of a large triangle, and the depth of corners in a float format, or NULL. */
    bool (*set_plane)(const struct ph_renderer *r, const struct ph_plane_base *s, const struct ph_vertex *const v[3],
                      const struct ph_material *material, struct ph_depth *depth, uint8_t *block);
    uint8_t (*block_depths)(const struct ph_renderer *r, const struct ph_vertex *const v[3], uint32_t bias,
                            uint32_t d[3]);
    const struct ph_exact_ways *exact;    /* exact.h; NULL: fixed */
    const struct ph_octave_ways *octaves; /* float16; else NULL */
    /* raster_walk.h: a run of pixels, and a triangle in linear-w or with codes of 24 bits. */
    void (*draw_run)(const struct ph_triangle *t, const struct ph_run *run);
    uint32_t (*walk)(const struct ph_triangle *t, const struct ph_band *band);
};

static inline const struct ph_depth_ways *ph_depth_ways(const struct ph_renderer *r)
{
    return r->stats.depth_format->ways;
}

#endif
