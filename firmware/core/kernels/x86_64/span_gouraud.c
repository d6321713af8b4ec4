/* ph_span_gouraud of kernels.h for x86-64, 8 pixels at once. */
#include "gouraud8.h"
#include "kernels.h"

void ph_span_gouraud(uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd, uint32_t light,
                     uint32_t glight, const uint16_t *ramp)
{
    const __m128i step = _mm_setr_epi32((int)gd, 0, (int)glight, 0), first = _mm_setr_epi32((int)d, 0, (int)light, 0);
    const struct gouraud8 g = gouraud8_of(step, ramp, depth, pixels);
    gouraud8_row(&g, depth + n, n, _mm_sub_epi32(first, step));
}
