/* See texture_small.h. */
#include "texture_small_portable.h"

uint32_t ph_texture_small(struct ph_texel_run *r)
{
    return ph_texture_small_rows(r, 0);
}
