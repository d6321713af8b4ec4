/* fx_trig: sine and cosine. See fx.h. */
/* Kits on armv6m: -O2. */
#include "fx.h"
#include "tier.h"

#include <stdbool.h>

/* Entry k is sin(k pi / 128) in 2^-32, rounded down, so that even 1 fits as 1 - 2^-32; SINE_HALF makes up for it. */
static const uint32_t sine[65] = {
    0x00000000, 0x0648557d, 0x0c8fb2f8, 0x12d52092, 0x1917a6bc, 0x1f564e56, 0x259020dd, 0x2bc42889, 0x31f17078,
    0x381704d4, 0x3e33f2f6, 0x4447498a, 0x4a5018bb, 0x504d7250, 0x563e69d6, 0x5c2214c3, 0x61f78a9a, 0x67bde50e,
    0x6d744027, 0x7319ba64, 0x78ad74e0, 0x7e2e936f, 0x839c3cc9, 0x88f59aa0, 0x8e39d9cd, 0x93682a66, 0x987fbfe7,
    0x9d7fd149, 0xa2679928, 0xa73655df, 0xabeb49a4, 0xb085baa8, 0xb504f333, 0xb96841bf, 0xbdaef913, 0xc1d8705f,
    0xc5e40358, 0xc9d1124c, 0xcd9f023f, 0xd14d3d02, 0xd4db3148, 0xd84852c0, 0xdb941a28, 0xdebe0563, 0xe1c5978c,
    0xe4aa5909, 0xe76bd7a1, 0xea09a68a, 0xec835e79, 0xeed89db6, 0xf1090827, 0xf3144762, 0xf4fa0ab6, 0xf6ba073b,
    0xf853f7dc, 0xf9c79d63, 0xfb14be7f, 0xfc3b27d3, 0xfd3aabf8, 0xfe132387, 0xfec46d1e, 0xff4e6d68, 0xffb10f1b,
    0xffec4304, 0xffffffff,
};
#define SINE_HALF 8 /* in 2^-36 */

struct sincos {
    int64_t sine, cosine;
};

/*
 * Sine and cosine, in 2^-36, of an angle f below a quarter turn (2^30). The nearest of 65 nodes is turned by the rest
 * d, |d| < 0.0123 rad, with sin d = d - d^3/6 and cos d = 1 - h, h = d^2/2 - d^4/24, both to 2^-38.
 */
PH_TIER(seldom) static struct sincos quarter(uint32_t f)
{
    const uint32_t node = (f + ((uint32_t)1 << 23)) >> 24;
    const int32_t rest = (int32_t)(f - (node << 24));
    const int32_t d = (int32_t)(fx_mul_wide(rest, 1686629713) >> 23); /* 2^-37 rad */
    const uint32_t dd = (uint32_t)(fx_mul_wide(d, d) >> 30);          /* d^2 in 2^-44 */
    const uint32_t dd_6 = fx_mulhi_u32(dd, 715827883);
    const uint32_t dddd_24 = fx_mulhi_u32(fx_mulhi_u32(dd, dd), 178956971) >> 12;
    const int32_t sd = d - (int32_t)(fx_mul_wide(d, (int32_t)dd_6) >> 44); /* 2^-37 */
    const uint32_t h = (dd >> 1) - dddd_24;                                /* 2^-44 */
    const uint32_t s = sine[node];
    const uint32_t c = sine[64 - node];
    return (struct sincos){
        .sine = ((int64_t)s << 4) - (fx_mulhi_u32(s, h) >> 8) + (fx_mul_wide((int32_t)(c >> 1), sd) >> 32),
        .cosine = ((int64_t)c << 4) - (fx_mulhi_u32(c, h) >> 8) - (fx_mul_wide((int32_t)(s >> 1), sd) >> 32),
    };
}

/* Sine and cosine in 2^-(36 - drop), rounded in the first quarter turn and then turned: so the four quarters mirror. */
PH_TIER(seldom) static void rounded(uint32_t turn32, int drop, int32_t *sin_out, int32_t *cos_out)
{
    const struct sincos v = quarter(turn32 & (((uint32_t)1 << 30) - 1));
    const int64_t half = ((int64_t)1 << (drop - 1)) + SINE_HALF;
    const int32_t s = (int32_t)((v.sine + half) >> drop);
    const int32_t c = (int32_t)((v.cosine + half) >> drop);
    const bool quarter_turn = (turn32 >> 30 & 1) != 0, half_turn = turn32 >> 31 != 0;
    const int32_t turned_s = quarter_turn ? c : s, turned_c = quarter_turn ? -s : c;
    *sin_out = half_turn ? -turned_s : turned_s;
    *cos_out = half_turn ? -turned_c : turned_c;
}

PH_TIER(seldom) void fx_sincos_q30(uint32_t turn32, int32_t *sin_q30, int32_t *cos_q30)
{
    rounded(turn32, 6, sin_q30, cos_q30);
}

PH_TIER(seldom) fx_t fx_sin(fx_t turns)
{
    int32_t s, c;
    rounded((uint32_t)turns << 16, 20, &s, &c);
    return s;
}

PH_TIER(seldom) fx_t fx_cos(fx_t turns)
{
    int32_t s, c;
    rounded((uint32_t)turns << 16, 20, &s, &c);
    return c;
}
