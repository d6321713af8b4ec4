/* texel_rows: rows of texels within a tile or a small triangle. Private to firmware/core. */
#ifndef PH_TEXEL_ROWS_H
#define PH_TEXEL_ROWS_H

#include "shading.h"
#include "texel_filter.h"
#include "texel_map.h"
#include "texel_row.h"
#include "texture_tile.h"
#include "triangle.h"

/* How the pixels of a tile or of a small triangle are drawn. */
struct ph_tile_kind {
    const struct ph_triangle *triangle;
    const uint16_t *texels;
    uint32_t u_mask, v_mask, log2_width;
    int u_down, v_down; /* from u, v to whole texels */
    bool lit_or_filtered;
    uint8_t clamp;     /* ways in which pixels may lie outside of a clamped texture: bits of enum ph_wrap */
    bool depth24;      /* as in struct ph_band */
    bool fast;         /* ph_texture_tile can draw them */
    int32_t from, end; /* columns of the picture, as the tile's columns count */
    /* NULL: nearest texels; light is full everywhere. `texel` is the filter's, which is read for each pixel. */
    const struct ph_filter *filter;
    const struct ph_texel_lighting *lighting;
    uint16_t (*texel)(const struct ph_tile_kind *k, uint32_t u, uint32_t v);
};

/* Whether light changes texels. */
static inline bool ph_is_lit(const struct ph_texel_light *light)
{
    return light->shaded || light->light != 32;
}

/* A column or a line of texels, brought into 0 .. mask. */
static inline int32_t ph_texel_clamped(int32_t texel, uint32_t mask)
{
    return texel < 0 ? 0 : (uint32_t)texel > mask ? (int32_t)mask : texel;
}

/* Sets how texels of that map are drawn; k->triangle, k->clamp and k->fast are set already. k->u_down and k->v_down
 * are set for k->fast. */
static inline void ph_set_texel_kind(struct ph_tile_kind *k, struct ph_tile_rows *r, const struct ph_texture *map,
                                     const struct ph_texel_light *light)
{
    const int width = map->log2_width, height = map->log2_height;
    k->texels = r->row.texels = map->texels;
    k->u_mask = r->row.u_mask = (1u << width) - 1;
    k->v_mask = (1u << height) - 1;
    k->log2_width = map->log2_width;
    k->lighting = ph_is_lit(light) ? k->triangle->material->shading->texturing.lighting : NULL;
    k->filter = map->filter;
    k->texel = map->filter != NULL ? map->filter->texel : NULL;
    k->lit_or_filtered = k->lighting != NULL || map->filter != NULL;
    r->row.v_mask = k->v_mask << width;
    r->outside = r->u_outside = r->v_outside = 0;
    if (k->fast) {
        k->u_down = 22;
        k->v_down = k->filter != NULL ? 22 : (int)ph_texel_v_down(r->row.v_mask) + width;
        if ((k->clamp & PH_WRAP_CLAMP_U) != 0) {
            r->u_outside = UINT32_MAX << width << k->u_down;
        }
        if ((k->clamp & PH_WRAP_CLAMP_V) != 0) {
            r->v_outside = UINT32_MAX << height << k->v_down;
        }
        r->outside = r->u_outside | r->v_outside;
    }
}

/* The texel in that column and line; they are clamped or repeated. */
static inline uint16_t ph_texel_in(const struct ph_tile_kind *k, int32_t column, int32_t line)
{
    if ((k->clamp & PH_WRAP_CLAMP_U) != 0) {
        column = ph_texel_clamped(column, k->u_mask);
    }
    if ((k->clamp & PH_WRAP_CLAMP_V) != 0) {
        line = ph_texel_clamped(line, k->v_mask);
    }
    return k->texels[((uint32_t)line & k->v_mask) << k->log2_width | ((uint32_t)column & k->u_mask)];
}

/* Draws a row, of which all but light is set; light at its first pixel. */
void ph_draw_texel_row(const struct ph_tile_kind *k, struct ph_texel_row *row, uint32_t light, uint32_t glight);

/* Draws rows whose depth is in codes. */
void ph_draw_fast_rows(const struct ph_tile_kind *k, struct ph_tile_rows *r);

/* Draws rows whose depth may have several pieces each. r->row.d and r->row.gd are in units of the triangle's plane.
 * Pieces begin with the triangle's row, as in all other shadings, not with the tile. */
void ph_draw_rows_in_pieces(const struct ph_tile_kind *k, struct ph_tile_rows *r);

#endif
