/*
 * fx_cpu: the words of a CPU for fx.h, ARMv6-M (Cortex-M0, M0+): a 32-bit product of one cycle, but no long one and
 * no CLZ. See fx.h for what each one gives.
 */
#ifndef FX_CPU_H
#define FX_CPU_H

#include <stdint.h>

static inline int fx_clz32(uint32_t v)
{
    int zeros = 0;
    if (v == 0) {
        return 32;
    }
    if (v >> 16 == 0) {
        v <<= 16;
        zeros += 16;
    }
    if (v >> 24 == 0) {
        v <<= 8;
        zeros += 8;
    }
    if (v >> 28 == 0) {
        v <<= 4;
        zeros += 4;
    }
    if (v >> 30 == 0) {
        v <<= 2;
        zeros += 2;
    }
    return zeros + (v >> 31 == 0);
}

/* Four products of 16 bits; the sums of two never carry out of 32 bits. */
static inline uint32_t fx_mulhi_u32(uint32_t a, uint32_t b)
{
    const uint32_t al = a & 0xffff, ah = a >> 16;
    const uint32_t bl = b & 0xffff, bh = b >> 16;
    const uint32_t m1 = ah * bl + ((al * bl) >> 16);
    const uint32_t m2 = al * bh + (m1 & 0xffff);
    return ah * bh + (m1 >> 16) + (m2 >> 16);
}

static inline int64_t fx_mul_wide(int32_t a, int32_t b)
{
    const uint32_t al = (uint32_t)a & 0xffff, bl = (uint32_t)b & 0xffff;
    const int32_t ah = a >> 16, bh = b >> 16;
    const int32_t m1 = ah * (int32_t)bl + (int32_t)((al * bl) >> 16);
    const int32_t m2 = (int32_t)al * bh + (m1 & 0xffff);
    const uint32_t high = (uint32_t)(ah * bh + (m1 >> 16) + (m2 >> 16));
    return (int64_t)((uint64_t)high << 32 | (uint32_t)a * (uint32_t)b);
}

static inline uint64_t fx_mul_wide_u(uint32_t a, uint32_t b)
{
    return (uint64_t)fx_mulhi_u32(a, b) << 32 | a * b;
}

/* A straight line within 1/17, two steps of Newton's, then exact. */
static inline uint32_t fx_rcp16(uint32_t d)
{
    const uint32_t r0 = 46261 - (d * 30841 >> 16);                              /* 2^-14 */
    const int32_t miss0 = (int32_t)((uint32_t)1 << 30) - (int32_t)(d * r0);     /* 2^-30 */
    const uint32_t r1 = 2 * r0 + (uint32_t)((int32_t)r0 * (miss0 >> 15) >> 14); /* 2^-15 */
    const int32_t miss1 = (int32_t)(((uint32_t)1 << 31) - d * r1);              /* 2^-31 */
    uint32_t r = r1 + (uint32_t)((int32_t)r1 * (miss1 >> 16) >> 15);
    uint32_t rest = 0x7fffffffu - r * d;
    while ((int32_t)rest < 0) { /* at most twice each */
        rest += d;
        r--;
    }
    while (rest >= d) {
        rest -= d;
        r++;
    }
    return r;
}

#endif
