/* ph_span_flat of kernels.h, with four pixels in each turn. */
#include "kernels.h"
#include "span.h"

void ph_span_flat(uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd, uint16_t colour)
{
    for (; n >= 4; n -= 4, pixels += 4, depth += 4) {
        ph_pixel_flat(pixels, depth, d, colour);
        ph_pixel_flat(pixels + 1, depth + 1, d += gd, colour);
        ph_pixel_flat(pixels + 2, depth + 2, d += gd, colour);
        ph_pixel_flat(pixels + 3, depth + 3, d += gd, colour);
        d += gd;
    }
    for (; n > 0; n--, d += gd) {
        ph_pixel_flat(pixels++, depth++, d, colour);
    }
}
