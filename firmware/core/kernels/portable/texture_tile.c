/* Rows of a textured tile: see kernels.h. */
#include "texture_tile_plain.h"

void ph_texture_tile(struct ph_texel_rows *r)
{
    ph_rows_texture_plain(r);
}
