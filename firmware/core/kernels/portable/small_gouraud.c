/* ph_small_gouraud of kernels.h, in C for any CPU. */
#include "gouraud_portable.h"
#include "kernels.h"

uint32_t ph_small_gouraud(const struct ph_small_triangle *rows, uint16_t *depth, uint16_t *pixels,
                          uint32_t stride_bytes)
{
    return draw_halves(rows, depth, pixels, stride_bytes, PH_LIGHT_DOWN, draw_small_rows);
}
