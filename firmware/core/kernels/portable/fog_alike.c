/* ph_fog_alike of kernels.h, in C for any CPU. */
#include "fog.h"
#include "kernels.h"

uint32_t ph_fog_alike(uint16_t *pixels, const uint16_t *codes, uint32_t n, uint32_t from, uint32_t size,
                      const struct ph_fog_mix *mix)
{
    uint32_t i = 0;
    for (; i < n && codes[i] - from < size; i++) {
        if (mix != NULL) {
            pixels[i] = ph_fold(ph_fogged(mix, ph_spread(pixels[i])));
        }
    }
    return i;
}
