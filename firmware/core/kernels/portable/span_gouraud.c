/* ph_span_gouraud of kernels.h, with two pixels in each turn. */
#include "kernels.h"
#include "span.h"

void ph_span_gouraud(uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd, uint32_t light,
                     uint32_t glight, const uint16_t *ramp)
{
    for (; n >= 2; n -= 2, pixels += 2, depth += 2) {
        ph_pixel_gouraud(pixels, depth, d, light, ramp);
        d += gd;
        light += glight;
        ph_pixel_gouraud(pixels + 1, depth + 1, d, light, ramp);
        d += gd;
        light += glight;
    }
    if (n > 0) {
        ph_pixel_gouraud(pixels, depth, d, light, ramp);
    }
}
