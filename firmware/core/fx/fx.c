/* fx: sums, products, quotients. See fx.h. */
/* Kits on armv6m: -O2. */
#include "fx.h"
#include "tier.h"

fx_t fx_add_sat(fx_t a, fx_t b)
{
    return fx_sat64((int64_t)a + b);
}

fx_t fx_sub_sat(fx_t a, fx_t b)
{
    return fx_sat64((int64_t)a - b);
}

fx_t fx_add_wrap(fx_t a, fx_t b)
{
    return (fx_t)((uint32_t)a + (uint32_t)b);
}

fx_t fx_sub_wrap(fx_t a, fx_t b)
{
    return (fx_t)((uint32_t)a - (uint32_t)b);
}

fx_t fx_neg_sat(fx_t a)
{
    return a == FX_MIN ? FX_MAX : -a;
}

fx_t fx_abs_sat(fx_t a)
{
    return a < 0 ? fx_neg_sat(a) : a;
}

PH_TIER(mesh) fx_t fx_mul_sat(fx_t a, fx_t b)
{
    return fx_sat64((fx_mul_wide(a, b) + FX_HALF) >> 16);
}

fx_t fx_mul_wrap(fx_t a, fx_t b)
{
    return (fx_t)(uint32_t)((uint64_t)(fx_mul_wide(a, b) + FX_HALF) >> 16);
}

fx_t fx_div_sat(fx_t a, fx_t b)
{
    if (b == 0) {
        return a > 0 ? FX_MAX : a < 0 ? FX_MIN : 0;
    }
    const uint32_t negative = (a < 0) != (b < 0);
    const uint32_t n = fx_magnitude(a);
    const uint32_t d = fx_magnitude(b);
    if (n >> 15 >= d) { /* 2^31 or more */
        return negative ? FX_MIN : FX_MAX;
    }
    int shift;
    const uint32_t r = fx_rcp_norm(d, &shift);
    uint32_t q = (uint32_t)(fx_mul_wide_u(n, r) >> (46 - shift)); /* r is up to 2^-30 too small, q up to 2 */
    uint64_t rest = ((uint64_t)n << 16) - fx_mul_wide_u(q, d);
    while (rest >= d) {
        rest -= d;
        q++;
    }
    q += 2 * rest > d || (2 * rest == d && !negative); /* a tie rounds up */
    return fx_sat64(negative ? -(int64_t)q : (int64_t)q);
}

PH_TIER(mesh) fx_t fx_rcp_sat(fx_t a)
{
    const uint32_t d = fx_magnitude(a);
    if (d <= 1) {
        return a < 0 ? FX_MIN : FX_MAX;
    }
    int shift;
    const uint32_t r = fx_rcp_norm(d, &shift);
    const uint32_t q = shift == 30 ? r : (r + ((uint32_t)1 << (29 - shift))) >> (30 - shift);
    if (a < 0) {
        return (fx_t)(0u - q);
    }
    return q > (uint32_t)FX_MAX ? FX_MAX : (fx_t)q;
}

fx_t fx_lerp_sat(fx_t a, fx_t b, fx_t t)
{
    const int64_t product = ((int64_t)b - a) * t; /* at most (2^32 - 1) 2^31, which fits with the half added */
    return fx_sat64(a + ((product + FX_HALF) >> 16));
}

uint32_t fx_turn32_from_deg(fx_t deg)
{
    /* deg 2^16 / 360 = deg 8192 / 45. Quotient and remainder of deg / 45 avoid a division of 64 bits. */
    int32_t q = deg / 45;
    int32_t r = deg % 45;
    if (r < 0) {
        r += 45;
        q -= 1;
    }
    return (uint32_t)q * 8192u + ((uint32_t)r * 8192u + 22u) / 45u;
}
