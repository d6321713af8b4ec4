/* ph_span_blend of kernels.h, in C for any CPU. */
#include "blend.h"
#include "kernels.h"

void ph_span_blend(uint16_t *pixels, const uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd, uint32_t source,
                   uint32_t rest)
{
    for (; n > 0; n--, d += gd, pixels++, depth++) {
        if (d >> 16 > *depth) {
            *pixels = ph_fold((ph_spread(*pixels) * rest + source) >> 5 & PH_SPREAD);
        }
    }
}
