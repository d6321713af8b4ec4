/* ph_fill of kernels.h for x86-64, 8 pixels in a store. */
#include "kernels.h"

#include <emmintrin.h>

enum { TURN = 256 }; /* pixels */

void ph_fill(uint16_t *to, uint16_t value, uint32_t n)
{
    const __m128i eight = _mm_set1_epi16((short)value);
    if (n < 8) {
        for (; n > 0; n--) {
            *to++ = value;
        }
        return;
    }
    _mm_storeu_si128((__m128i *)(void *)(to + n - 8), eight); /* what is left of a division by 8 */
    for (; n >= TURN; n -= TURN, to += TURN) {
#pragma GCC unroll 32
        for (int i = 0; i < TURN; i += 8) {
            _mm_storeu_si128((__m128i *)(void *)(to + i), eight);
        }
    }
    for (; n >= 8; n -= 8, to += 8) {
        _mm_storeu_si128((__m128i *)(void *)to, eight);
    }
}
