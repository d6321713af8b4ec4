/* See texture_tile.h. */
#include "texture_tile.h"

#include "texture_tile_portable.h"

void ph_texture_tile(struct ph_tile_rows *r)
{
    ph_texture_tile_portable(r);
}
