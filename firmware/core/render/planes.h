/* planes: depth, light and texture of a triangle as planes on the screen. Private to firmware/core. */
#ifndef PH_PLANES_H
#define PH_PLANES_H

#include "sides.h"
#include "triangle.h"

/* 2^(61 - *shift) / w for products of 64 bits; *shift: leading zeros of w. */
static inline int32_t ph_wide_reciprocal(uint32_t w, int *shift)
{
    return (int32_t)(fx_rcp_norm(w, shift) >> 1);
}

/* The material's bias, within its range. */
static inline uint32_t ph_depth_bias(const struct ph_material *material)
{
    return material->depth_bias < 56 ? material->depth_bias : 56;
}

/* Light of a textured triangle, 0 .. 32; `first` is its first corner. */
static inline uint16_t ph_texture_light(const struct ph_material *material, const struct ph_vertex *first)
{
    return material->shading == PH_SHADE_TEXTURE_LIT
               ? (uint16_t)(((uint32_t)(first->light - PH_LIGHT_ZERO) * 33) / (PH_LIGHT_SPAN + 1))
               : 32;
}

static inline struct ph_quotient ph_depth_of(const struct ph_vertex *v)
{
    return (struct ph_quotient){v->q, v->s};
}

/* Depth of the corners in a float format. If all lie in one octave they become 16.16 codes, and PH_BLOCK_NONE is
 * returned; else the block exponent of the triangle. */
uint8_t ph_block_depths(const struct ph_renderer *r, const struct ph_vertex *const v[3], uint32_t bias, uint32_t d[3]);

/* Whether the plane of ph_setup_small does for depths (units of 2^-(32 + block)) across octaves. Two at most; and its
 * gradients are off by up to 2^8 units a pixel. Over 16 columns and rows, in octave `far`, these are 2^(far - down - 3)
 * codes: half a code, or one in the octave beside it, up to far = down + 2. Beyond, near the far plane, they are many.
 */
bool ph_small_plane_does(const uint32_t d[3], int block);

/* The plane of 16.16 codes d. False if it is too steep for 32 bits. */
bool ph_depth_plane(struct ph_plane *out, const struct ph_vertex *first, const struct ph_sides *sides,
                    const uint32_t d[3]);

/* Sets t->depth and t->block. False if 32 bits do not do: see exact.h. */
bool ph_set_depth(struct ph_triangle *t, const struct ph_renderer *r, const struct ph_vertex *const v[3],
                  const struct ph_sides *sides);

/* Sets what the pixels of a triangle take: kind, colour, depth, block, attribute, range_log2; material is set already.
 * uv: those of each corner; NULL if the material has no texture. False if 32 bits do not do for depth. */
bool ph_set_planes(struct ph_triangle *t, const struct ph_renderer *r, const struct ph_vertex *const v[3],
                   const fx_t *const uv[3], const struct ph_sides *sides);

#endif
