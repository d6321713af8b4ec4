/* See texel_row.h. */
#include "texel_row_portable.h"

void ph_texel_row_smooth_lit(const struct ph_texel_row *r)
{
    ph_texel_row_any(r, true, true, 0);
}
