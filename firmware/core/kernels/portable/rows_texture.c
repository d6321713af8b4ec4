/* Rows of a textured tile: see hot.h. */
#include "rows_texture_plain.h"

void ph_rows_texture(struct ph_texel_rows *r)
{
    ph_rows_texture_plain(r);
}
