/* fx_hyperbolic: hyperbolic sine, cosine and tangent. See fx_math.h. */
#include "fx_math.h"
#include "fx_wide.h"

#include <stdbool.h>

/* From here on the sine and the cosine are above FX_MAX. */
#define SINH_END (FX_INT(23) / 2)
/* From here on the tangent is nearer to 1 than to the number below it. */
#define TANH_END FX_INT(7)

/* e^a / 2 in 2^-46, to the nearest; |a| < SINH_END. */
static uint64_t half_exp(fx_t a)
{
    int32_t n;
    const uint64_t e = fx_exp2_parts(a, FX_LOG2_E_Q58, &n); /* n is -17 .. 16 */
    return (e + ((uint64_t)1 << (16 - n))) >> (17 - n);
}

/* A number in 2^-46, and whether it is negative, as the nearest fx_t. */
static fx_t nearest_sat(uint64_t size, bool is_negative)
{
    const int64_t rounded = (int64_t)((size + ((uint64_t)1 << 29)) >> 30);
    return fx_sat64(is_negative ? -rounded : rounded);
}

fx_t fx_sinh_sat(fx_t a)
{
    const uint32_t size = fx_magnitude(a);
    if (size >= (uint32_t)SINH_END) {
        return a < 0 ? FX_MIN : FX_MAX;
    }
    return nearest_sat(half_exp((fx_t)size) - half_exp(-(fx_t)size), a < 0);
}

fx_t fx_cosh_sat(fx_t a)
{
    return fx_magnitude(a) >= (uint32_t)SINH_END ? FX_MAX : nearest_sat(half_exp(a) + half_exp(-a), false);
}

/* 2^93 / d, rounded down; d is 2^46 .. 2^48. */
static uint64_t quotient_of(uint64_t d)
{
    const uint64_t high = fx_quotient_u64((uint64_t)1 << 63, d), rest = ((uint64_t)1 << 63) - high * d;
    const uint64_t middle = fx_quotient_u64(rest << 15, d), last = (rest << 15) - middle * d;
    return high << 30 | middle << 15 | fx_quotient_u64(last << 15, d);
}

/* tanh(a) = 1 - 2 / (e^(2a) + 1) */
fx_t fx_tanh(fx_t a)
{
    const uint32_t size = fx_magnitude(a);
    if (size >= (uint32_t)TANH_END) {
        return a < 0 ? -FX_ONE : FX_ONE;
    }
    int32_t n;
    const uint64_t e = fx_exp2_parts(2 * (fx_t)size, FX_LOG2_E_Q58, &n); /* n is 0 .. 20 */
    const uint64_t d = (e >> 16) + (((uint64_t)1 << 46) >> n);           /* e^(2a) + 1 in 2^(n - 46) */
    return nearest_sat(((uint64_t)1 << 46) - (quotient_of(d) >> n), a < 0);
}
