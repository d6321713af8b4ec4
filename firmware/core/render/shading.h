/*
 * shading: what the names of shadings stand for. Private to firmware/core.
 *
 * A material points to its shading, and a shading to the functions that draw in it. Nothing else refers to these, so
 * the linker leaves out what no material of a program names. Only shadings.c knows all of them.
 */
#ifndef PH_SHADING_H
#define PH_SHADING_H

#include "light.h"
#include "sides.h"
#include "triangle.h"

struct ph_band;
struct ph_part_context;
struct ph_part_lighting;
struct ph_plane_base;
struct ph_row_piece;
struct ph_setting;
struct ph_small_texels;
struct ph_texel_lighting;

/* Lights vertices: light.h says how. */
struct ph_lighting {
    void (*light_prepare)(struct ph_local_lights *local, const struct ph_renderer *r, const struct ph_xform *to_world,
                          const struct ph_material *material, bool coloured);
    uint16_t (*light_vertex)(const struct ph_local_lights *local, const int16_t normal[3],
                             const struct fx_vec3 *position);
    const struct ph_part_lighting *parts; /* mesh.h */
};

/* Takes pixels from a texture; all are NULL in a shading without. */
struct ph_texturing {
    /* Small triangles: texels.h, small_texels.h. */
    bool (*set_texels)(struct ph_triangle *t, const struct ph_setting *s, const struct ph_vertex *const v[3],
                       const fx_t *const uv[3]);
    /* setup.h */
    enum ph_excess (*excess_of)(const struct ph_setting *s, const struct ph_sides *sides,
                                const struct ph_vertex *const v[3]);
    bool (*take_small_depth)(struct ph_triangle *t, const struct ph_setting *s, const struct ph_vertex *const v[3],
                             const struct ph_sides *sides, bool fits);
    uint32_t (*draw_texels)(const struct ph_triangle *t, const struct ph_band *band);
    void (*begin_texels)(struct ph_small_texels *s, const struct ph_triangle *t, int32_t y, uint32_t stride_bytes);
    uint32_t (*draw_texel_rows)(struct ph_small_texels *s, const struct ph_small_triangle *small, uint16_t *depth,
                                uint16_t *pixels);
    void (*draw_texel_piece)(struct ph_small_texels *s, const struct ph_row_piece *piece, uint16_t *depth,
                             uint16_t *pixels);
    /* Any triangle: planes.h, texture.h. */
    void (*set_texel_planes)(const struct ph_renderer *r, const struct ph_plane_base *s,
                             const struct ph_vertex *const v[3], const fx_t *const uv[3], struct ph_triangle *t);
    uint32_t (*draw_textured)(const struct ph_triangle *t, const struct ph_band *band);
    const struct ph_texel_lighting *lighting; /* texel_light.h; NULL: texels are shown without light */
};

/* What only Gouraud triangles without a texture need: gouraud.h. */
struct ph_gouraud {
    /* Makes a small triangle of one that has a plane of codes, if it is as narrow as a small one: it is drawn and
     * carried on faster. Edges and planes stay what they are. */
    void (*take_tall)(struct ph_triangle *t, const struct ph_renderer *r, const struct ph_vertex *const v[3],
                      const struct ph_sides *sides);
    void (*set_light)(const struct ph_plane_base *s, const struct ph_vertex *const v[3],
                      struct ph_triangle *t);                                       /* planes.h: ph_set_light */
    uint32_t (*draw_long)(const struct ph_triangle *t, const struct ph_band *band); /* raster_rows.h: ph_draw_long */
};

/* Of which corners a triangle takes the light. */
enum ph_lit_corners { PH_NO_CORNER, PH_FIRST_CORNER, PH_EACH_CORNER };

struct ph_shading {
    uint8_t corners;                                     /* enum ph_lit_corners */
    void (*draw_edges)(const struct ph_part_context *c); /* edges, no triangles; NULL: triangles */
    const struct ph_lighting *lighting;                  /* NULL: PH_NO_CORNER */
    const struct ph_gouraud *gouraud;                    /* PH_EACH_CORNER without a texture; else NULL */
    struct ph_texturing texturing;
    const struct ph_shading *texels; /* with a texture: the one that shows its texels without light */
};

static inline bool ph_is_wire(const struct ph_material *material)
{
    return material->shading != NULL && material->shading->draw_edges != NULL;
}

/* Of which corners a material takes the light. */
static inline unsigned ph_lit_corners_of(const struct ph_material *material)
{
    return material->shading != NULL ? material->shading->corners : PH_NO_CORNER;
}

/* Whether the shading of a material takes pixels from a texture; without a texture they have its colour. */
static inline bool ph_takes_texture(const struct ph_material *material)
{
    return material->shading != NULL && material->shading->texturing.set_texels != NULL;
}

/* Whether pixels are taken from a texture. */
static inline bool ph_is_textured(const struct ph_material *material)
{
    return ph_takes_texture(material) && material->texture != NULL;
}

#endif
