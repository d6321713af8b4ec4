/* fx_tangent: the tangent as a ratio, and what is scaled by it. See fx_tangent.h and fx_math.h. */
#include "fx_tangent.h"
#include "fx_math.h"
#include "fx_wide.h"

#include <stdbool.h>

/* Lambert's continued fraction x / (1 - x^2 / (3 - x^2 / (5 - ...))), from the inside, as a ratio without division. */
struct fx_ratio fx_tangent_ratio(uint64_t eighth)
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

int32_t fx_cot_half_q20(fx_t deg)
{
    const uint32_t straight = (uint32_t)FX_INT(180);
    const uint32_t d = (uint32_t)deg;
    if (deg <= 0) {
        return INT32_MAX;
    }
    if (d >= straight) {
        return 0;
    }
    const bool over_right = d > straight / 2;
    struct fx_ratio r = fx_tangent_ratio(((uint64_t)(over_right ? straight - d : d) << 41) / 45 << 5);
    if (!over_right) {
        r = (struct fx_ratio){r.den, r.num};
    }
    while (r.den >= (uint64_t)1 << 42) {
        r.num >>= 1;
        r.den >>= 1;
    }
    if (r.num >> 11 >= r.den) {
        return INT32_MAX;
    }
    const uint64_t twice = (r.num / r.den << 21) + ((r.num % r.den) << 21) / r.den;
    return fx_sat64((int64_t)((twice + 1) >> 1));
}
