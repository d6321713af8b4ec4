/* texel_map: the levels of a texture. Private to firmware/core. */
#ifndef PH_TEXEL_MAP_H
#define PH_TEXEL_MAP_H

#include "render.h"

/* Texels of the first level from pixel to pixel, in 2^-16, on both axes of the texture. */
struct ph_texel_slope {
    int32_t u, v;
};

/* How many 2^-16 of v's units the texture's height has, as a logarithm. A nearest texel makes an index of v (see struct
 * ph_tile_rows); a filter takes u and v alike. */
static inline int ph_texel_v_unit(const struct ph_texture *texture)
{
    const int unit = texture->log2_height + (texture->filter == PH_FILTER_NEAREST ? texture->log2_width : 6);
    return unit > 16 ? unit - 4 : unit;
}

/* v is in 2^-(16 + n) of a texel row, and this is n. */
static inline int ph_texel_row_up(const struct ph_texture *texture)
{
    return ph_texel_v_unit(texture) - texture->log2_height;
}

/* Whether u and v of 2^range repeats fit into their units beside the sign, with room for as many again. */
static inline bool ph_fits_clamped(const struct ph_texture *texture, int range)
{
    return range + texture->log2_width <= 8 && range + ph_texel_v_unit(texture) <= 14;
}

/* The length, at most 8 % too long. */
static inline uint32_t ph_texel_length(const struct ph_texel_slope *s)
{
    const uint32_t u = fx_magnitude(s->u), v = fx_magnitude(s->v);
    return u > v ? u + (v >> 3) * 3 : v + (u >> 3) * 3;
}

/* The level in which a pixel's step to the right or down, whichever is longer, is nearest to one texel. */
static inline unsigned ph_texel_level(const struct ph_texture *texture, const struct ph_texel_slope *right,
                                      const struct ph_texel_slope *down)
{
    if (texture->filter != PH_FILTER_MIPMAP) {
        return 0;
    }
    const uint32_t a = ph_texel_length(right), b = ph_texel_length(down), most = a > b ? a : b;
    const uint32_t turned = (most >> 1) + (most >> 3) + (most >> 4) + (most >> 6); /* over sqrt 2 */
    const int level = 17 - fx_clz32(turned | 1 << 14);
    return level < texture->levels ? (unsigned)level : texture->levels;
}

/* A level as a texture of its own. */
static inline struct ph_texture ph_texel_map(const struct ph_texture *texture, unsigned level)
{
    struct ph_texture map = *texture;
    for (; level > 0; level--) {
        map.texels += (size_t)1 << (map.log2_width + map.log2_height);
        map.log2_width = (uint8_t)(map.log2_width - (map.log2_width > 0));
        map.log2_height = (uint8_t)(map.log2_height - (map.log2_height > 0));
    }
    return map;
}

#endif
