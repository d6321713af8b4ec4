/* fx_tan: the tangent, and the cotangent of a lens. See fx.h and fx_math.h. */
#include "fx_math.h"
#include "fx_wide.h"
#include "tier.h"

#include <stdbool.h>

#define Q33(num, den) ((uint32_t)((((uint64_t)1 << 33) * (num) + (den) / 2) / (den)))

/* 1/3, 1/45, .. : the factors of z^k in (1 - y cot y) / z, z = y^2, are 2 zeta(2 k + 2) / pi^(2 k + 2). */
static const uint32_t series[8] = {
    Q33(1, 3),     Q33(1, 45),           Q33(2, 945),      Q33(1, 4725),
    Q33(2, 93555), Q33(1382, 638512875), Q33(4, 18243225), 191, /* 3617 / 162820783125 */
};

/* (1 - y cot y) / z in 2^-33; z is y^2 in 2^-32. */
static inline __attribute__((always_inline)) uint32_t series_at(uint32_t z)
{
    uint32_t sum = 0;
    for (int i = 7; i > 0; i--) {
        sum = fx_mulhi_u32(z, sum + series[i]);
    }
    return sum + series[0];
}

/*
 * 2^17 k cot y in 2^-20, for the angle y of k 2^-16 turn, 0 < k < 8192. It is 2^33 / (2 pi) y cot y; the constant is
 * less by the mean of what z loses, 2^-32 / 6.
 */
PH_TIER(seldom) static uint64_t cotangent(uint32_t k)
{
    const uint32_t z = fx_mulhi_u32(k * k << 6, 2649351758); /* y^2 in 2^-32: (2 pi k)^2 */
    const uint64_t g = fx_mul_wide_u(z, series_at(z)) >> 31; /* 1 - y cot y in 2^-34 */
    return 1433540284750036u - (fx_mul_wide_u(2734261102, (uint32_t)g) >> 15);
}

PH_TIER(seldom) fx_t fx_tan_sat(fx_t turns)
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
        const uint32_t r = fx_rcp_top((uint32_t)(cotangent(k) >> 19));
        t = (uint32_t)((fx_mul_wide_u(k, r) + (1 << 27)) >> 28);
    } else if (k > 8192) {
        const uint32_t rest = 16384 - k;
        t = fx_quotient_u32((uint32_t)(cotangent(rest) >> 20) + rest, 2 * rest);
    }
    return half_turn <= 16384 ? (fx_t)t : -(fx_t)t;
}

/* num / (d 2^(20 - shift)), rounded to nearest, up to 2^-23 further off. d = 2^31 .. 2^32 - 1, num below 2^63, the
 * result below 2^32; 9 <= shift <= 20. */
PH_TIER(seldom) static uint32_t quotient(uint64_t num, uint32_t d, int shift)
{
    const uint32_t r = fx_rcp_top(d), high = fx_mulhi_u32((uint32_t)(num >> 31), r);
    const uint32_t q = shift < 20 ? high >> (19 - shift) : high << 1; /* up to 5 too small */
    const uint64_t rest = num - (fx_mul_wide_u(q, d) << (20 - shift));
    return q + (uint32_t)((fx_mul_wide_u((uint32_t)(rest >> (28 - shift)), r) + ((uint64_t)1 << 53)) >> 54);
}

/*
 * With y = e 2^-16 pi / 360, the half of the field of view or of what it lacks to 180 degrees, and u = y cot y: the
 * result is u / y, or y / u. e is normalised so that y^2 keeps 30 bits, however small it is.
 */
PH_TIER(seldom) int32_t fx_cot_half_q20(fx_t deg)
{
    const uint32_t straight = (uint32_t)FX_INT(180), d = (uint32_t)deg;
    if (deg <= 0 || d >= straight) {
        return deg <= 0 ? INT32_MAX : 0;
    }
    const bool over_right = d > straight / 2;
    const uint32_t e = over_right ? straight - d : d;
    const int shift = fx_clz32(e); /* 9 or more */
    /* NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): e > 0 */
    const uint32_t m = e << shift;
    const uint32_t square = fx_mulhi_u32(fx_mulhi_u32(m, m), 2679443161); /* y^2 in 2^-(13 + 2 shift) */
    const uint32_t z = shift < 10 ? square << 1 : shift < 26 ? square >> (2 * shift - 19) : 0;
    const uint32_t g = fx_mulhi_u32(square, series_at(z)); /* 1 - u in 2^-(14 + 2 shift) */
    if (over_right) {
        const uint32_t u = ~(shift < 25 ? g >> (2 * shift - 18) : 0);
        return (int32_t)quotient(e * (uint64_t)614083138197, u, 10); /* pi / 360 2^46 */
    }
    if (shift > 20) {
        return INT32_MAX;
    }
    const uint64_t u_k = 8257192040480628449 - (fx_mul_wide_u(g, 3845054675) >> (2 * shift - 17)); /* u 360 / pi 2^56 */
    const uint32_t cot = quotient(u_k, m, shift);
    return cot < INT32_MAX ? (int32_t)cot : INT32_MAX;
}
