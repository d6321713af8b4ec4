/* ph_span_gouraud of kernels.h for x86-64, 8 pixels at once. */
#include "gouraud8.h"
#include "kernels.h"

void ph_span_gouraud(uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd, uint32_t light,
                     uint32_t glight, const uint16_t *ramp)
{
    const struct gouraud8 g = {steps8_of(gd), steps8_of(glight), ramp};
    gouraud8_row(&g, pixels, depth, n, d, light);
}
