/*
 * texel_filter: what the names of filters stand for. Private to firmware/core.
 *
 * A texture points to its filter, and a filter to the functions that draw with it. Nothing else refers to these, so the
 * linker leaves out what no texture of a program names. The nearest texel needs no filter.
 */
#ifndef PH_TEXEL_FILTER_H
#define PH_TEXEL_FILTER_H

#include "texel_light.h"

struct ph_surface;
struct ph_tile;
struct ph_tile_kind;

/* Which level of a texture is drawn. */
struct ph_levels {
    unsigned (*level_of_tile)(const struct ph_triangle *t, const struct ph_tile *tile, const struct ph_surface *s);
    /* Sets the level of a small triangle, whose u and v are those of the first level. */
    void (*set_level)(struct ph_small_map *map, const struct ph_texture *texture);
    /* A level as a texture of its own. */
    struct ph_texture (*map_of)(const struct ph_texture *texture, unsigned level);
};

struct ph_filter {
    ph_texel_row_kernel *draw_row, *draw_lit_row;
    /* The filtered texel at u, v: of a row as texel_row.h has it, and of any tile. */
    uint16_t (*texel_of_row)(const struct ph_texel_row *row, uint32_t u, uint32_t v);
    uint16_t (*texel)(const struct ph_tile_kind *k, uint32_t u, uint32_t v);
    const struct ph_levels *levels; /* NULL: the first one */
};

/* What chooses the level of a texture; or NULL. */
static inline const struct ph_levels *ph_levels_of(const struct ph_texture *texture)
{
    return texture->filter != NULL ? texture->filter->levels : NULL;
}

/* What draws a row of texels; lighting: NULL without light. */
static inline ph_texel_row_kernel *ph_row_kernel(const struct ph_filter *filter,
                                                 const struct ph_texel_lighting *lighting)
{
    return filter == NULL     ? (lighting != NULL ? lighting->draw_nearest : ph_texel_row_nearest)
           : lighting != NULL ? filter->draw_lit_row
                              : filter->draw_row;
}

#endif
