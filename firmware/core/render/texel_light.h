/*
 * texel_light: how light falls on texels. Private to firmware/core.
 *
 * A shading with a texture and light names ph_texel_lighting, and nothing else refers to what it names: so the linker
 * leaves it out of a program whose textures are shown without light.
 */
#ifndef PH_TEXEL_LIGHT_H
#define PH_TEXEL_LIGHT_H

#include "texture_small.h"
#include "triangle.h"
#include "vertex.h"

struct ph_filter;
struct ph_plane_base;

struct ph_texel_lighting {
    /* texel_row.h, texture_small.h: draw nearest texels in a light of 0 .. 32 32nds. */
    ph_texel_row_kernel *draw_nearest;
    ph_texel_run_kernel *draw_rows;
    /* Draws a row in which light is beyond 32 32nds: a highlight. */
    void (*draw_shining_row)(const struct ph_texel_row *row, const struct ph_filter *filter);
    /* Brings the light (2^-24 of a 32nd) of a row's ends into its range. */
    void (*clamp_light)(uint32_t *light, uint32_t *glight, uint32_t n);
    /* planes.h: sets the plane of light of a triangle that is not small. */
    void (*set_texel_light)(const struct ph_plane_base *s, const struct ph_vertex *const v[3], struct ph_triangle *t);
};

extern const struct ph_texel_lighting ph_texel_lighting; /* texel_highlights.c */

/* The light of a texel at a vertex, in 2^-8 of a 32nd: 32 32nds give its colour, 64 white. */
static inline int32_t ph_texel_light_of(const struct ph_material *material, const struct ph_vertex *v)
{
    const fx_t specular = material->specular < 0 ? 0 : material->specular > FX_ONE ? FX_ONE : material->specular;
    const uint32_t light = (uint32_t)(v->light - PH_LIGHT_ZERO) * (uint32_t)(256 + (specular >> 8)) >> 9;
    const uint32_t scaled = light * 17624 >> 16; /* 32 * 512 / PH_LIGHT_SPAN = 17624 / 65536 */
    return scaled > 62 * 256 ? 62 * 256 : (int32_t)scaled;
}

#define PH_TEXEL_LIGHT_UP 255 /* light is rounded up to a 32nd, since what it scales is rounded down */

#endif
