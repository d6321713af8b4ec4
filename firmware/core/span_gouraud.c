/* A Gouraud span: see hot.h. */
#include "hot.h"
#include "span.h"

void ph_span_gouraud(uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd, uint32_t light,
                     uint32_t glight, const uint16_t *ramp)
{
    for (; n > 0; n--, d += gd, light += glight) {
        ph_pixel_gouraud(pixels++, depth++, d, light, ramp);
    }
}
