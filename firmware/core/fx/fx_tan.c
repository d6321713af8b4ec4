/* fx_tan: the tangent. See fx.h. */
#include "fx_wide.h"

#define Q33(num, den) ((uint32_t)((((uint64_t)1 << 33) * (num) + (den) / 2) / (den)))

/* 1/3, 1/45, .. : the factors of z^k in (1 - y cot y) / z, z = y^2, are 2 zeta(2 k + 2) / pi^(2 k + 2). */
static const uint32_t series[8] = {
    Q33(1, 3),     Q33(1, 45),           Q33(2, 945),      Q33(1, 4725),
    Q33(2, 93555), Q33(1382, 638512875), Q33(4, 18243225), 191, /* 3617 / 162820783125 */
};

/*
 * 2^17 k cot y in 2^-20, for the angle y of k 2^-16 turn, 0 < k < 8192. It is 2^33 / (2 pi) y cot y; the constant is
 * less by the mean of what z loses, 2^-32 / 6.
 */
static uint64_t cotangent(uint32_t k)
{
    const uint32_t z = fx_mulhi_u32(k * k << 6, 2649351758); /* y^2 in 2^-32: (2 pi k)^2 */
    uint32_t sum = 0;
    for (int i = 7; i > 0; i--) {
        sum = fx_mulhi_u32(z, sum + series[i]);
    }
    const uint64_t g = fx_mul_wide_u(z, sum + series[0]) >> 31; /* 1 - y cot y in 2^-34 */
    return 1433540284750036u - (fx_mul_wide_u(2734261102, (uint32_t)g) >> 15);
}

fx_t fx_tan_sat(fx_t turns)
{
    const uint32_t half_turn = (uint32_t)turns & 0x7fff;
    const uint32_t k = half_turn <= 16384 ? half_turn : 32768 - half_turn; /* mirrored into the first quarter */
    uint32_t t = FX_ONE;
    if (k == 0) {
        return 0;
    }
    if (k == 16384) {
        return ((uint32_t)turns & 0x8000) != 0 ? FX_MIN : FX_MAX;
    }
    if (k < 8192) {
        const uint32_t r = fx_rcp_newton((uint32_t)(cotangent(k) >> 19));
        t = (uint32_t)((fx_mul_wide_u(k, r) + (1 << 27)) >> 28);
    } else if (k > 8192) {
        const uint32_t rest = 16384 - k;
        t = fx_quotient_u32((uint32_t)(cotangent(rest) >> 20) + rest, 2 * rest);
    }
    return half_turn <= 16384 ? (fx_t)t : -(fx_t)t;
}
