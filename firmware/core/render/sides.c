/* See sides.h. */
#include "sides.h"

int32_t ph_wide_area_sign(int32_t dx1, int32_t dy1, int32_t dx2, int32_t dy2)
{
    const int64_t area = fx_mul_wide(dx2, dy1) - fx_mul_wide(dx1, dy2);
    return (int32_t)(area >> 32) | (area > 0);
}
