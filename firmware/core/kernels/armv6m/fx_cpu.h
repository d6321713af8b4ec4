/*
 * fx_cpu: the words of a CPU for fx.h, ARMv6-M (Cortex-M0, M0+): a 32-bit product of one cycle, but no long one and
 * no CLZ. See fx.h for what each one gives.
 */
#ifndef FX_CPU_H
#define FX_CPU_H

#include <stdint.h>

extern const uint8_t fx_clz_table[256]; /* leading zeros of 8 bits: fx_clz.c */

#define FX_DIVIDES_64 0                         /* whether a 64-bit division is one instruction */
#define FX_DIVIDES_32 0                         /* whether a 32-bit one is */
#define FX_MULTIPLIES 0                         /* whether a product of 64 bits takes a few instructions */
#define FX_APART      __attribute__((noinline)) /* 8 registers do not hold two of the stages at once */

inline int fx_clz32(uint32_t v)
{
    int zeros = 16;
    if (v >> 16 != 0) {
        v >>= 16;
        zeros = 0;
    }
    return v >> 8 != 0 ? zeros + fx_clz_table[v >> 8] : zeros + 8 + fx_clz_table[v];
}

/* Four products of 16 bits; the sums of two never carry out of 32 bits. */
inline uint32_t fx_mulhi_u32(uint32_t a, uint32_t b)
{
    const uint32_t al = a & 0xffff, ah = a >> 16;
    const uint32_t bl = b & 0xffff, bh = b >> 16;
    const uint32_t m1 = ah * bl + ((al * bl) >> 16);
    const uint32_t m2 = al * bh + (m1 & 0xffff);
    return ah * bh + (m1 >> 16) + (m2 >> 16);
}

/* One copy for all files: a copy in each took 2.8 KB. */
static inline int64_t fx_mul_wide(int32_t a, int32_t b)
{
    return fx_mul_far(a, b);
}

static inline uint64_t fx_mul_wide_u(uint32_t a, uint32_t b)
{
    return (uint64_t)fx_mulhi_u32(a, b) << 32 | a * b;
}

/* The table's 8.8 bits and one step of Newton's: the result, or one less. */
static inline uint32_t fx_rcp16(uint32_t d)
{
    const uint32_t r0 = fx_rcp_table[(d >> 7) & 255];             /* 2^27 / d */
    const int32_t miss = (int32_t)(((uint32_t)1 << 27) - r0 * d); /* 1 - r0 d in 2^-27 */
    const uint32_t r = (r0 << 4) + (uint32_t)(((int32_t)r0 * (miss >> 6)) >> 17);
    return r + 1 - ((r + 1) * d >> 31); /* one more where that is still below 2^31 */
}

#endif
