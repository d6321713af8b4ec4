/* Filling rows with one value: see hot.h. */
#include "hot.h"

typedef uint32_t __attribute__((may_alias)) two_pixels;

void ph_fill(uint16_t *to, uint16_t value, uint32_t n)
{
    if (((uintptr_t)to & 2) != 0 && n > 0) {
        *to++ = value;
        n--;
    }
    two_pixels *pair = (two_pixels *)(void *)to;
    const uint32_t both = (uint32_t)value << 16 | value;
    for (; n >= 16; n -= 16, pair += 8) {
        pair[0] = pair[1] = pair[2] = pair[3] = pair[4] = pair[5] = pair[6] = pair[7] = both;
    }
    for (to = (uint16_t *)(void *)pair; n > 0; n--) {
        *to++ = value;
    }
}
