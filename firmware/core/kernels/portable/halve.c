/* ph_halve of kernels.h. Most fours of samples are of one colour. */
#include "blend.h"
#include "kernels.h"

void ph_halve(uint16_t *to, const uint16_t *upper, const uint16_t *lower, uint32_t n)
{
    const uint32_t half = 2u << 21 | 2u << 11 | 2u;
    for (; n > 0; n--, upper += 2, lower += 2) {
        const uint16_t first = upper[0];
        if (first == upper[1] && first == lower[0] && first == lower[1]) {
            *to++ = first;
        } else {
            const uint32_t sum = ph_spread(first) + ph_spread(upper[1]) + ph_spread(lower[0]) + ph_spread(lower[1]);
            *to++ = ph_fold((sum + half) >> 2 & PH_SPREAD);
        }
    }
}
