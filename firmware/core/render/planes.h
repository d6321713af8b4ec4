/* planes: depth, light and texture of a triangle as planes on the screen. Private to firmware/core. */
#ifndef PH_PLANES_H
#define PH_PLANES_H

#include "depth_ways.h"
#include "shading.h"
#include "sides.h"
#include "triangle.h"

/* 2^(61 - *shift) / w for products of 64 bits; *shift: leading zeros of w. */
static inline int32_t ph_wide_reciprocal(uint32_t w, int *shift)
{
    return (int32_t)(fx_rcp_norm(w, shift) >> 1);
}

/* What the texels of a triangle are drawn with; `first` is its first corner. */
static inline struct ph_texel_light ph_texture_light(const struct ph_material *material, const struct ph_vertex *first)
{
    const unsigned corners = material->shading->corners;
    const unsigned light = corners == PH_FIRST_CORNER
                               ? fx_quotient_far((uint32_t)(first->light - PH_LIGHT_ZERO) * 33, PH_LIGHT_SPAN + 1)
                               : 32;
    return (struct ph_texel_light){(uint8_t)light, corners == PH_EACH_CORNER};
}

static inline struct ph_quotient ph_depth_of(const struct ph_vertex *v)
{
    return (struct ph_quotient){v->q, v->s};
}

/* Depth of the corners in a float format. If all lie in one octave they become 16.16 codes, and PH_BLOCK_NONE is
 * returned; else the block exponent of the triangle. */
uint8_t ph_block_depths(const struct ph_renderer *r, const struct ph_vertex *const v[3], uint32_t bias, uint32_t d[3]);

/* The depth code of what keeps its distance, which is 1 or more; bias: codes, as in a material. */
uint32_t ph_depth_code(const struct ph_renderer *r, struct ph_quotient quotient, uint32_t bias);

/* The plane of 16.16 codes d. False if it is too steep for 32 bits. */
bool ph_depth_plane(struct ph_plane *out, const struct ph_vertex *first, const struct ph_sides *sides,
                    const uint32_t d[3]);

/* Set depth and block in one format, with the biases of the material. False if 32 bits are not enough: see exact.h.
 * Only formats name them. */
bool ph_set_fixed16(const struct ph_renderer *r, const struct ph_plane_base *s, const struct ph_vertex *const v[3],
                    const struct ph_material *material, struct ph_depth *depth, uint8_t *block);
bool ph_set_fixed24(const struct ph_renderer *r, const struct ph_plane_base *s, const struct ph_vertex *const v[3],
                    const struct ph_material *material, struct ph_depth *depth, uint8_t *block);
bool ph_set_float(const struct ph_renderer *r, const struct ph_plane_base *s, const struct ph_vertex *const v[3],
                  const struct ph_material *material, struct ph_depth *depth, uint8_t *block);
bool ph_set_linear(const struct ph_renderer *r, const struct ph_plane_base *s, const struct ph_vertex *const v[3],
                   const struct ph_material *material, struct ph_depth *depth, uint8_t *block);

/* Sets depth and block in the format of the frame. False if 32 bits are not enough: see exact.h. */
bool ph_set_depth(const struct ph_renderer *r, const struct ph_material *material, const struct ph_vertex *const v[3],
                  const struct ph_sides *sides, struct ph_depth *depth, uint8_t *block);

/* Sets what the pixels of a large triangle take: all but rows and edges; material is set already.
 * uv: those of each corner; NULL if the material has no texture. False if 32 bits are not enough for depth. */
bool ph_set_planes(struct ph_triangle *t, const struct ph_renderer *r, const struct ph_vertex *const v[3],
                   const fx_t *const uv[3], const struct ph_sides *sides);

/* Sets kind, light and planes of a triangle with a texture. uv: as above. Only shadings with a texture name it. */
void ph_set_texel_planes(const struct ph_renderer *r, const struct ph_plane_base *s, const struct ph_vertex *const v[3],
                         const fx_t *const uv[3], struct ph_triangle *t);

/* Sets the plane of the light of such a triangle. Only the light of texels names it. */
void ph_set_texel_light(const struct ph_plane_base *s, const struct ph_vertex *const v[3], struct ph_triangle *t);

/* Sets kind and plane of light of a Gouraud triangle. Only ph_gouraud names it. */
void ph_set_light(const struct ph_plane_base *s, const struct ph_vertex *const v[3], struct ph_triangle *t);

/* After ph_set_planes: a triangle of PH_DRAW_COLOURS gets its colours. flat: that of its first corner. */
void ph_set_colours(struct ph_triangle *t, const struct ph_vertex *const v[3], const struct ph_sides *sides, bool flat);

#endif
