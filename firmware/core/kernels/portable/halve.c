/* ph_halve of kernels.h. Most fours of samples are of one colour. */
#include "blend.h"
#include "kernels.h"

void ph_halve(uint16_t *to, const uint16_t *upper, const uint16_t *lower, uint32_t n)
{
    for (; n > 0; n--, upper += 2, lower += 2) {
        const uint16_t first = upper[0];
        const bool is_one = first == upper[1] && first == lower[0] && first == lower[1];
        *to++ = is_one ? first : ph_mean(first, upper[1], lower[0], lower[1]);
    }
}
