/* See texel_row.h. */
/* Kits on armv6m: -O2. */
#include "texel_row_portable.h"
#include "tier.h"

PH_TIER(scenery) void ph_texel_row_nearest(const struct ph_texel_row *r)
{
    ph_texel_row_unfiltered(r, false);
}
