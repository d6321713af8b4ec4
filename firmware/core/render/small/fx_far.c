/* The functions of fx_cpu.h. */
#include "fx.h"

int fx_clz_far(uint32_t v)
{
    int zeros = 32;
    for (int step = 16; step > 0; step >>= 1) {
        if (v >> step != 0) {
            v >>= step;
            zeros -= step;
        }
    }
    return zeros - (int)v;
}

/* Four products of 16 bits; the sums of two never carry out of 32 bits. */
uint32_t fx_mulhi_far(uint32_t a, uint32_t b)
{
    const uint32_t al = a & 0xffff, ah = a >> 16, bl = b & 0xffff, bh = b >> 16;
    const uint32_t m1 = ah * bl + ((al * bl) >> 16), m2 = al * bh + (m1 & 0xffff);
    return ah * bh + (m1 >> 16) + (m2 >> 16);
}

int64_t fx_mul_far(int32_t a, int32_t b)
{
    const uint32_t high =
        fx_mulhi_far((uint32_t)a, (uint32_t)b) - (a < 0 ? (uint32_t)b : 0) - (b < 0 ? (uint32_t)a : 0);
    return (int64_t)((uint64_t)high << 32 | (uint32_t)a * (uint32_t)b);
}

uint32_t fx_rcp16_far(uint32_t d)
{
    return 0x7fffffffu / d; /* NOLINT(clang-analyzer-core.DivideZero): d > 0, see fx.h */
}
