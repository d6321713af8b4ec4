/* See band.h. */
#include "band.h"

#include "tier.h"

PH_TIER(loop)
bool ph_rows_of_half_apart(const struct ph_triangle *t, const struct ph_band *band, int half, struct ph_half_rows *in)
{
    return ph_rows_of_half(t, band, half, in);
}
