/* See fx_tangent.h. */
#include "fx_tangent.h"
#include "fx_wide.h"
#include "tier.h"

/* Lambert's continued fraction x / (1 - x^2 / (3 - x^2 / (5 - ...))), from the inside, as a ratio without division. */
PH_TIER(seldom) struct fx_ratio fx_tangent_ratio(uint64_t eighth)
{
    const uint64_t x = fx_mulhi_u64(eighth, 0xc90fdaa22168c234u); /* the factor is pi/4 in 2^-64; x is in 2^-63 */
    const uint64_t xx = fx_mulhi_u64(x, x) << 1;                  /* 2^-63 */
    uint64_t a = (uint64_t)17 << 52;
    uint64_t b = (uint64_t)1 << 52;
    for (int n = 15; n > 0; n -= 2) {
        if (a >> 58 != 0) { /* makes room for the factor n */
            a >>= 5;
            b >>= 5;
        }
        const uint64_t next = (uint32_t)n * a - (fx_mulhi_u64(xx, b) << 1);
        b = a;
        a = next;
    }
    return (struct fx_ratio){fx_mulhi_u64(x, b) << 1, a};
}
