/* fx_wide: the product and the quotient of 64 bits. See fx_wide.h, fx.h. */
#include "fx_wide.h"
#include "tier.h"

uint64_t fx_mulhi_u64(uint64_t a, uint64_t b)
{
    const uint32_t ah = (uint32_t)(a >> 32);
    const uint32_t bh = (uint32_t)(b >> 32);
    const uint64_t m1 = fx_mul_wide_u(ah, (uint32_t)b);
    const uint64_t m2 = fx_mul_wide_u((uint32_t)a, bh);
    const uint64_t low = fx_mulhi_u32((uint32_t)a, (uint32_t)b);
    const uint64_t middle = low + (uint32_t)m1 + (uint32_t)m2;
    return fx_mul_wide_u(ah, bh) + (m1 >> 32) + (m2 >> 32) + (middle >> 32);
}

/* A copy of the inline function, for files whose compiler does not inline it. */
PH_TIER(seldom) extern inline uint64_t fx_quotient_u64(uint64_t n, uint64_t d);

/* Long division: d goes up to n (at most 63 times, because d > 0) and down again. */
PH_TIER(seldom) uint64_t fx_quotient_bits(uint64_t n, uint64_t d)
{
    uint64_t bit = 1, q = 0;
    while (d <= n >> 1) {
        d <<= 1;
        bit <<= 1;
    }
    for (; bit != 0; bit >>= 1, d >>= 1) {
        if (n >= d) {
            n -= d;
            q += bit;
        }
    }
    return q;
}

PH_TIER(scenery) uint32_t fx_quotient_far(uint32_t n, uint32_t d)
{
    return d > 1 ? fx_quotient_u32(n, d) : n;
}
