/* ph_fill of kernels.h, in C for any CPU. */
#include "kernels.h"

typedef uint32_t __attribute__((may_alias)) two_pixels;

enum { TURN = 128 }; /* pixels; the compiler stores them in the largest units that the CPU has */

void ph_fill(uint16_t *to, uint16_t value, uint32_t n)
{
    if (((uintptr_t)to & 2) != 0 && n > 0) {
        *to++ = value;
        n--;
    }
    const uint32_t both = (uint32_t)value << 16 | value;
    for (; n >= TURN; n -= TURN, to += TURN) {
        two_pixels *const pair = (two_pixels *)(void *)to;
        for (int i = 0; i < TURN / 2; i++) {
            pair[i] = both;
        }
    }
    for (; n > 0; n--) {
        *to++ = value;
    }
}
