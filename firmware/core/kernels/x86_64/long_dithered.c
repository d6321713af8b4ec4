/* ph_long_dithered of kernels.h for x86-64, 8 pixels at once (long_rows.h). */
#include "kernels.h"
#include "long_rows.h"

uint32_t ph_long_dithered(const struct ph_small_triangle *rows, uint16_t *depth, uint16_t *pixels,
                          uint32_t stride_bytes)
{
    return long_draw(rows, depth, pixels, stride_bytes, PH_DITHERED_DOWN);
}
