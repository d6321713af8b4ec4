/* texel_map: the units of u and v on a texture. Private to firmware/core. */
#ifndef PH_TEXEL_MAP_H
#define PH_TEXEL_MAP_H

#include "render.h"

/* How many 2^-16 of v's units the texture's height has, as a logarithm. A nearest texel makes an index of v (see struct
 * ph_tile_rows); a filter takes u and v alike. */
static inline int ph_texel_v_unit(const struct ph_texture *texture)
{
    const int unit = texture->log2_height + (texture->filter == NULL ? texture->log2_width : 6);
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

#endif
