/* ph_small_gouraud of kernels.h for x86-64, with edges and planes in vectors (small_rows.h). */
#include "kernels.h"
#include "small_rows.h"

uint32_t ph_small_gouraud(const struct ph_small_triangle *small, uint16_t *depth, uint16_t *pixels,
                          uint32_t stride_bytes)
{
    return small_draw(small, depth, pixels, stride_bytes, false, PH_LIGHT_DOWN);
}
