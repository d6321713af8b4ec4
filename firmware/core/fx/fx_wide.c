/* fx_wide: the product of 64 bits. See fx_wide.h. */
#include "fx_wide.h"

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
