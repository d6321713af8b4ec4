/* fx_root: the table of the normalised reciprocal; square roots. See fx.h. */
/* Kits on armv6m: -O2. */
#include "fx.h"
#include "tier.h"

/* Entry i is 2^43 / d in the middle of the interval of all d that begin with a 1 and the eight bits of i. */
PH_TIER(mesh)
const uint16_t fx_rcp_table[256] = {
    4088, 4072, 4056, 4041, 4025, 4010, 3995, 3979, 3964, 3949, 3935, 3920, 3905, 3891, 3876, 3862, 3848, 3834, 3820,
    3806, 3792, 3779, 3765, 3752, 3738, 3725, 3712, 3699, 3686, 3673, 3660, 3647, 3635, 3622, 3610, 3597, 3585, 3573,
    3561, 3548, 3537, 3525, 3513, 3501, 3489, 3478, 3466, 3455, 3444, 3432, 3421, 3410, 3399, 3388, 3377, 3366, 3355,
    3345, 3334, 3324, 3313, 3303, 3292, 3282, 3272, 3262, 3251, 3241, 3231, 3221, 3212, 3202, 3192, 3182, 3173, 3163,
    3154, 3144, 3135, 3125, 3116, 3107, 3098, 3089, 3080, 3071, 3062, 3053, 3044, 3035, 3026, 3017, 3009, 3000, 2992,
    2983, 2975, 2966, 2958, 2950, 2941, 2933, 2925, 2917, 2909, 2901, 2893, 2885, 2877, 2869, 2861, 2853, 2846, 2838,
    2830, 2823, 2815, 2807, 2800, 2792, 2785, 2778, 2770, 2763, 2756, 2749, 2741, 2734, 2727, 2720, 2713, 2706, 2699,
    2692, 2685, 2678, 2672, 2665, 2658, 2651, 2645, 2638, 2631, 2625, 2618, 2612, 2605, 2599, 2592, 2586, 2580, 2573,
    2567, 2561, 2554, 2548, 2542, 2536, 2530, 2524, 2518, 2512, 2506, 2500, 2494, 2488, 2482, 2476, 2470, 2464, 2459,
    2453, 2447, 2441, 2436, 2430, 2424, 2419, 2413, 2408, 2402, 2397, 2391, 2386, 2380, 2375, 2370, 2364, 2359, 2354,
    2348, 2343, 2338, 2333, 2328, 2322, 2317, 2312, 2307, 2302, 2297, 2292, 2287, 2282, 2277, 2272, 2267, 2262, 2257,
    2253, 2248, 2243, 2238, 2233, 2229, 2224, 2219, 2215, 2210, 2205, 2201, 2196, 2191, 2187, 2182, 2178, 2173, 2169,
    2164, 2160, 2155, 2151, 2147, 2142, 2138, 2133, 2129, 2125, 2120, 2116, 2112, 2108, 2103, 2099, 2095, 2091, 2087,
    2083, 2078, 2074, 2070, 2066, 2062, 2058, 2054, 2050,
};

/* Copies of inline functions, for files whose compiler does not inline them. */
PH_TIER(mesh) extern inline int fx_clz32(uint32_t v);
PH_TIER(mesh) extern inline uint32_t fx_mulhi_u32(uint32_t a, uint32_t b);
PH_TIER(mesh) extern inline uint32_t fx_rcp_newton(uint32_t d);
PH_TIER(mesh) extern inline uint32_t fx_rcp_norm(uint32_t w, int *shift);

PH_TIER(few) uint32_t fx_rcp_far(uint32_t w, int *shift)
{
    return fx_rcp_norm(w, shift);
}

/* Entry i is 2^23 / sqrt(m) in the middle of the interval of all m with the upper byte 64 + i. */
PH_TIER(mesh)
static const uint8_t rsqrt_table[192] = {
    255, 253, 251, 249, 247, 246, 244, 242, 241, 239, 237, 236, 234, 233, 231, 230, 228, 227, 225, 224, 223, 221,
    220, 219, 218, 216, 215, 214, 213, 212, 211, 210, 208, 207, 206, 205, 204, 203, 202, 201, 200, 199, 198, 198,
    197, 196, 195, 194, 193, 192, 191, 191, 190, 189, 188, 187, 187, 186, 185, 184, 184, 183, 182, 181, 181, 180,
    179, 179, 178, 177, 177, 176, 175, 175, 174, 173, 173, 172, 172, 171, 170, 170, 169, 169, 168, 167, 167, 166,
    166, 165, 165, 164, 164, 163, 163, 162, 162, 161, 161, 160, 160, 159, 159, 158, 158, 157, 157, 156, 156, 155,
    155, 155, 154, 154, 153, 153, 152, 152, 152, 151, 151, 150, 150, 150, 149, 149, 148, 148, 148, 147, 147, 146,
    146, 146, 145, 145, 145, 144, 144, 144, 143, 143, 143, 142, 142, 141, 141, 141, 140, 140, 140, 140, 139, 139,
    139, 138, 138, 138, 137, 137, 137, 136, 136, 136, 135, 135, 135, 135, 134, 134, 134, 133, 133, 133, 133, 132,
    132, 132, 132, 131, 131, 131, 130, 130, 130, 130, 129, 129, 129, 129, 128, 128,
};

/* Finds the root's reciprocal by one Newton step from the table, in 32 bits. */
PH_TIER(mesh) uint32_t fx_rsqrt16(uint32_t m)
{
    const uint32_t y = rsqrt_table[(m >> 24) - 64];                            /* 2^23 / sqrt(m) */
    const int32_t miss = (int32_t)(((uint32_t)1 << 30) - (m >> 16) * (y * y)); /* 1 - m y^2 in 2^-30 */
    return (y << 8) + (uint32_t)(((int32_t)y * (miss >> 8)) >> 15);
}

/* Finds the root's reciprocal by two Newton steps y += y (1 - m y^2) / 2. */
PH_TIER(mesh) uint32_t fx_rsqrt_norm(uint32_t m)
{
    uint32_t y = (uint32_t)rsqrt_table[(m >> 24) - 64] << 22;
    for (int i = 0; i < 2; i++) {
        const uint32_t square = (uint32_t)(fx_mul_wide_u(y, y) >> 29); /* 2^61 / m */
        const int32_t e = (int32_t)(((uint32_t)1 << 29) - fx_mulhi_u32(m, square));
        y += (uint32_t)(fx_mul_wide((int32_t)y, e) >> 30);
    }
    return y;
}

/*
 * fx_sqrt and fx_rsqrt_sat compare exactly with r + 1/2, where r is an estimate of the root. It is enough that the
 * estimate before rounding down is less than 1/2 off: if r is one too small, r + 1 is the nearest, and if one too
 * large, r is.
 */
fx_t fx_sqrt(fx_t a)
{
    if (a <= 0) {
        return 0;
    }
    const int shift = fx_clz32((uint32_t)a) & ~1;
    const uint32_t m = (uint32_t)a << shift;
    const uint32_t r = fx_mulhi_u32(m, fx_rsqrt_norm(m)) >> (5 + shift / 2); /* from 2^13 sqrt(m) to 2^8 sqrt(a) */
    const int64_t rest = (int64_t)((uint64_t)(uint32_t)a << 16) - (int64_t)fx_mul_wide_u(r, r);
    return (fx_t)(r + (rest > (int64_t)r)); /* above (r + 1/2)^2 = r^2 + r + 1/4 */
}

PH_TIER(mesh) fx_t fx_rsqrt_sat(fx_t a)
{
    if (a <= 0) {
        return FX_MAX;
    }
    const int shift = fx_clz32((uint32_t)a) & ~1;
    const int drop = 21 - shift / 2; /* from 2^45 / sqrt(m) to 2^24 / sqrt(a) */
    const uint32_t r = fx_rsqrt_norm((uint32_t)a << shift) >> drop;
    return (fx_t)(r + (fx_mul_wide_u(2 * r + 1, 2 * r + 1) * (uint32_t)a <= (uint64_t)1 << 50)); /* above r + 1/2 */
}

/*
 * floor(sqrt(v)). The estimate is 2^-24 off in relation to the root; Newton's step leaves less than 1, and the
 * remainder decides.
 */
uint32_t fx_sqrt_u64(uint64_t v)
{
    if (v == 0) {
        return 0;
    }
    const uint32_t high = (uint32_t)(v >> 32);
    const int shift = (high != 0 ? fx_clz32(high) : 32 + fx_clz32((uint32_t)v)) & ~1;
    const uint64_t w = v << shift; /* 2^62 .. 2^64 */
    const uint32_t y = fx_rsqrt_norm((uint32_t)(w >> 32));
    const uint32_t estimate = fx_mulhi_u32((uint32_t)(w >> 32), y); /* 2^-3 sqrt(w), 2^28 .. 2^29 */
    uint32_t r = (estimate >> 29 != 0 ? ((uint32_t)1 << 29) - 1 : estimate) << 3;
    const int64_t error = (int64_t)(w - fx_mul_wide_u(r, r));               /* |error| < 2^41 */
    r += (uint32_t)(fx_mul_wide((int32_t)(error >> 11), (int32_t)y) >> 51); /* error / (2 r), y is 2^61 / r */
    const int64_t rest = (int64_t)(w - fx_mul_wide_u(r, r));
    r += rest < 0 ? (uint32_t)-1 : rest > 2 * (int64_t)r;
    return r >> (shift / 2);
}
