/* ph_span_seen of kernels.h, in C for any CPU. */
#include "kernels.h"

uint32_t ph_span_seen(const uint16_t *codes, const uint16_t *depth, uint32_t n, bool same, bool seen)
{
    uint32_t i = 0;
    while (i < n && (codes[i] + same > depth[i]) == seen) {
        i++;
    }
    return i;
}
