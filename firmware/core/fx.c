/* fx: sums, products, quotients and roots. See fx.h. */
#include "fx.h"

static fx_t clamp64(int64_t v)
{
    if (v > FX_MAX) {
        return FX_MAX;
    }
    return v < FX_MIN ? FX_MIN : (fx_t)v;
}

fx_t fx_add_sat(fx_t a, fx_t b)
{
    return clamp64((int64_t)a + b);
}

fx_t fx_sub_sat(fx_t a, fx_t b)
{
    return clamp64((int64_t)a - b);
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

fx_t fx_mul_sat(fx_t a, fx_t b)
{
    return clamp64((fx_mul_wide(a, b) + FX_HALF) >> 16);
}

fx_t fx_mul_wrap(fx_t a, fx_t b)
{
    return (fx_t)(uint32_t)((uint64_t)(fx_mul_wide(a, b) + FX_HALF) >> 16);
}

/* |a|, also of FX_MIN. */
static uint32_t magnitude(fx_t a)
{
    return a < 0 ? 0u - (uint32_t)a : (uint32_t)a;
}

fx_t fx_div_sat(fx_t a, fx_t b)
{
    if (b == 0) {
        return a > 0 ? FX_MAX : a < 0 ? FX_MIN : 0;
    }
    const uint32_t negative = (a < 0) != (b < 0);
    const uint32_t d = magnitude(b);
    const uint64_t n = (uint64_t)magnitude(a) << 16;
    uint64_t q = n / d;
    const uint64_t r2 = 2 * (n % d);
    q += r2 > d || (r2 == d && !negative); /* a tie goes up */
    return clamp64(negative ? -(int64_t)q : (int64_t)q);
}

fx_t fx_rcp_sat(fx_t a)
{
    const uint32_t d = magnitude(a);
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

fx_t fx_sqrt(fx_t a)
{
    if (a <= 0) {
        return 0;
    }
    const uint64_t n = (uint64_t)(uint32_t)a << 16; /* the result is sqrt(n), 24 bits */
    uint32_t r = 0;
    for (uint32_t bit = (uint32_t)1 << 23; bit != 0; bit >>= 1) {
        if (fx_mul_wide_u(r | bit, r | bit) <= n) {
            r |= bit;
        }
    }
    return (fx_t)(r + (n - fx_mul_wide_u(r, r) > r)); /* above (r + 1/2)^2 = r^2 + r + 1/4 */
}

fx_t fx_rsqrt_sat(fx_t a)
{
    if (a <= 0) {
        return FX_MAX;
    }
    /* The result is 2^24 / sqrt(a); s counts its halves, 26 bits: the largest s with s^2 a <= 2^50. */
    const uint64_t limit = (uint64_t)1 << 50;
    uint32_t s = 0;
    for (uint32_t bit = (uint32_t)1 << 25; bit != 0; bit >>= 1) {
        const uint64_t square = fx_mul_wide_u(s | bit, s | bit);
        if (square <= limit && (square >> 32) * (uint32_t)a <= limit >> 32 && square * (uint32_t)a <= limit) {
            s |= bit;
        }
    }
    return (fx_t)((s + 1) >> 1);
}

fx_t fx_lerp_sat(fx_t a, fx_t b, fx_t t)
{
    const int64_t product = ((int64_t)b - a) * t; /* at most (2^32 - 1) 2^31: fits, also with the half */
    return clamp64(a + ((product + FX_HALF) >> 16));
}

uint32_t fx_turn32_from_deg(fx_t deg)
{
    /* deg * 2^16 / 360 = deg * 8192 / 45; the whole part of deg / 45 needs no division of 64 bits. */
    int32_t q = deg / 45;
    int32_t r = deg % 45;
    if (r < 0) {
        r += 45;
        q -= 1;
    }
    return (uint32_t)q * 8192u + ((uint32_t)r * 8192u + 22u) / 45u;
}

uint32_t fx_rcp_norm(uint32_t w, int *shift)
{
    const uint32_t v = w != 0 ? w : 1;
    *shift = fx_clz32(v);
    return (uint32_t)(((uint64_t)1 << 62) / (v << *shift));
}
