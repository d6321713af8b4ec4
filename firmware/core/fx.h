/*
 * fx: Q16.16 fixed-point arithmetic.
 *
 * An fx_t is an int32_t that counts 1/65536ths. Its range is -32768 .. 32767.99998; one LSB is 2^-16 = 0.0000153.
 * The name of a function says what overflow does: _sat clamps to FX_MIN or FX_MAX, _wrap keeps the low 32 bits.
 * Results are rounded to nearest; a tie goes towards +infinity unless the function says otherwise.
 * Angles are binary turns. In an fx_t 65536 is one turn; in a uint32_t ("turn32") 2^32 is one turn.
 * No function divides by zero, loops without bound, or depends on the compiler: >> of a negative number is arithmetic
 * on every compiler that we support (checked in tests/core/test_fx.c).
 *
 * The error bounds below are proved by `make test-exhaustive`: for every input of the unary functions, and against
 * 128-bit integers for all pairs of edge values of the binary ones. All tables together have 1264 bytes.
 * fx_math.h has further functions, and fx/fx.hpp a number type for C++.
 */
#ifndef FX_H
#define FX_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A number in Q16.16. */
typedef int32_t fx_t;

/* Constants in Q16.16. */
#define FX_ONE     ((fx_t)65536)
#define FX_HALF    ((fx_t)32768)
#define FX_MAX     INT32_MAX
#define FX_MIN     INT32_MIN
#define FX_INT(i)  ((fx_t)((int32_t)(i)*65536)) /* i: -32768 .. 32767 */
#define FX_Q30_ONE ((int32_t)1 << 30)           /* one in Q2.30, the format of rotations */

/*
 * Cost is the number of instructions on a Cortex-M0+ (armv6m) and on a Cortex-M3 (armv7m), with the call, by gcc -O3,
 * as the mean over 4000 inputs of all magnitudes (tests/bench/maths.sh).
 */

/* Sum, difference, negative, absolute value. Cost: 20, 12. */
fx_t fx_add_sat(fx_t a, fx_t b);
fx_t fx_sub_sat(fx_t a, fx_t b);
fx_t fx_add_wrap(fx_t a, fx_t b);
fx_t fx_sub_wrap(fx_t a, fx_t b);
fx_t fx_neg_sat(fx_t a);
fx_t fx_abs_sat(fx_t a);

/* v clamped to 32 bits. Comparing words takes half the instructions of 64-bit comparisons. */
static inline int32_t fx_sat64(int64_t v)
{
    const int32_t low = (int32_t)v, high = (int32_t)(v >> 32);
    return high == low >> 31 ? low : high < 0 ? INT32_MIN : INT32_MAX;
}

/* |a| as an unsigned number, so that |FX_MIN| fits, too. */
static inline uint32_t fx_magnitude(int32_t a)
{
    return a < 0 ? 0u - (uint32_t)a : (uint32_t)a;
}

/* a * b, error <= 0.5 LSB (before the clamp, or modulo 2^32). Cost: 41, 14 (wrap 32, 8). */
fx_t fx_mul_sat(fx_t a, fx_t b);
fx_t fx_mul_wrap(fx_t a, fx_t b);

/* a / b, error <= 0.5 LSB. a / 0 is FX_MAX for a > 0, FX_MIN for a < 0, and 0 for a = 0. Cost: 194, 76. */
fx_t fx_div_sat(fx_t a, fx_t b);

/* 1 / a, error <= 0.5 LSB. 1 / 0 is FX_MAX. Only a of 0, -1, +1 and +2 LSB clamp. Cost: 74, 50. */
fx_t fx_rcp_sat(fx_t a);

/* Square root, error <= 0.5 LSB; 0 for a <= 0. Cost: 202, 49. */
fx_t fx_sqrt(fx_t a);

/* floor(sqrt(v)) of an integer, exactly. Cost: 291, 70. */
uint32_t fx_sqrt_u64(uint64_t v);

/* 1 / sqrt(a), error <= 0.5 LSB; FX_MAX for a <= 0. The largest other result is 256. Cost: 215, 48. */
fx_t fx_rsqrt_sat(fx_t a);

/* 2^45 / sqrt(m) for 2^30 <= m < 2^32, relative error < 2^-25. */
uint32_t fx_rsqrt_norm(uint32_t m);

/* 2^31 / sqrt(m) for 2^30 <= m < 2^32, relative error < 6.2e-5. */
uint32_t fx_rsqrt16(uint32_t m);

/* Sine, cosine of an angle in turns (only its low 16 bits count), error <= 0.5 LSB. Cost: 375, 70. */
fx_t fx_sin(fx_t turns);
fx_t fx_cos(fx_t turns);

/*
 * Tangent of an angle in turns, error <= 0.5 LSB. A quarter turn gives FX_MAX, three quarters give FX_MIN; the largest
 * other result is 10430. Cost: 308, 78.
 */
fx_t fx_tan_sat(fx_t turns);

/*
 * Angle of (x, y) in turns, -32768 < result <= 32768 (half a turn); 0 for (0, 0). An angle that rounds to minus half a
 * turn is returned as half a turn. Error <= 0.5 LSB + 2^-27 LSB. Cost: 265, 108.
 */
fx_t fx_atan2(fx_t y, fx_t x);

/*
 * Sine and cosine in Q2.30 of an angle in 2^-32 turn, for rotations. Error <= 0.67 LSB. They are exact at the quarter
 * turns, and the four quarters mirror each other exactly. Cost: 374, 80.
 */
void fx_sincos_q30(uint32_t turn32, int32_t *sin_q30, int32_t *cos_q30);

/* Degrees (Q16.16, any value) to turn32, rounded to nearest, modulo one turn. Cost: 350, 21. */
uint32_t fx_turn32_from_deg(fx_t deg);

/* a + (b - a) t for any t in Q16.16, error <= 0.5 LSB. Cost: 77, 25. */
fx_t fx_lerp_sat(fx_t a, fx_t b, fx_t t);

/* Number of leading zeros of v; 32 for 0. */
inline int fx_clz32(uint32_t v);

/* High 32 bits of the 64-bit product, rounded down. */
inline uint32_t fx_mulhi_u32(uint32_t a, uint32_t b);

/* Full products. Cost: 34, 1. */
static inline int64_t fx_mul_wide(int32_t a, int32_t b);
static inline uint64_t fx_mul_wide_u(uint32_t a, uint32_t b);

int64_t fx_mul_far(int32_t a, int32_t b); /* fx_mul_wide as a function, for a CPU's fx_mul_wide only */

/* The short reciprocal, 16 bits: floor((2^31 - 1) / d) for d = 2^15 .. 2^16 - 1. */
static inline uint32_t fx_rcp16(uint32_t d);

extern const uint16_t fx_rcp_table[256]; /* only for fx_rcp_norm and a CPU's fx_rcp16 */

/* The CPU's own or the portable one, whichever folder of kernels/ -I names; where Pinhole is installed the portable
 * one, which stands beside this file there. */
#ifdef __has_include
#if __has_include(<fx_cpu.h>)
#include <fx_cpu.h>
#elif __has_include("fx_cpu.h")
#include "fx_cpu.h"
#else
#error "fx_cpu.h is not found: add -I firmware/core/kernels/portable, or the folder of your CPU and that one"
#endif
#else
#include <fx_cpu.h>
#endif

/* floor(2^62 / d) for d = 2^31 .. 2^32 - 1, by Newton's method with products of 32 bits. */
inline uint32_t fx_rcp_newton(uint32_t d)
{
    const uint32_t r0 = fx_rcp_table[(d >> 23) & 255];                    /* 2^43 / d, 8.8 bits */
    const int32_t e0 = (int32_t)(0u - r0 * (d >> 4));                     /* 1 - r0 d in 2^-39 */
    const int32_t u = (e0 >> 12) + (((e0 >> 16) * (e0 >> 16)) >> 19) + 6; /* e0 + e0^2 in 2^-27, half a LSB of r1 */
    const uint32_t r1 = (r0 << 12) + (uint32_t)(((int32_t)r0 * u) >> 15); /* 2^55 / d, less than 1 off */
    const int32_t e1 = (int32_t)(0u - r1 * (d >> 1) - ((r1 & (0u - (d & 1))) >> 1)); /* 1 - r1 d in 2^-54 */
    const int32_t half = ((int32_t)(r1 >> 9) * ((e1 >> 16) + 48)) >> 21; /* halves to add to 2^7 r1, to nearest */
    const uint32_t q = (r1 << 7) + (uint32_t)(half >> 1);
    /* An odd half: q is right. Otherwise the sign of the remainder, which is below d / 2 either way, decides. */
    return q - (((0u - q * d) >> 31) & ~(uint32_t)half);
}

/* floor(n / d), 0 < d < 2^63, bit by bit: for fx_quotient_u64 only. */
uint64_t fx_quotient_bits(uint64_t n, uint64_t d);

/* floor(n / d) of integers, 0 < d < 2^63. On a CPU without a division the compiler's library would take 1 KB for it. */
inline uint64_t fx_quotient_u64(uint64_t n, uint64_t d)
{
    /* NOLINTNEXTLINE(clang-analyzer-core.DivideZero): d > 0 */
    return FX_DIVIDES_32 ? n / d : fx_quotient_bits(n, d);
}

/* floor(n / d), d > 0, for callers that run rarely. The compiler's library would take 270 bytes for it. */
uint32_t fx_quotient_far(uint32_t n, uint32_t d);

/* floor(2^62 / d) for d = 2^31 .. 2^32 - 1. */
inline __attribute__((always_inline)) uint32_t fx_rcp_top(uint32_t d)
{
    return FX_DIVIDES_64 ? (uint32_t)fx_quotient_u64((uint64_t)1 << 62, d) : fx_rcp_newton(d);
}

/*
 * Normalised reciprocal: *shift is the number of leading zeros of w, and the result floor(2^62 / (w << *shift)) is in
 * 2^30 .. 2^31. So 1/w = result * 2^(*shift - 62) for an integer w. It is this integer on every CPU, hence monotone.
 * w = 0 counts as 1. Cost: 57, 36.
 */
inline uint32_t fx_rcp_norm(uint32_t w, int *shift)
{
    const uint32_t v = w != 0 ? w : 1;
    *shift = fx_clz32(v);
    return fx_rcp_top(v << *shift);
}

/* fx_rcp_norm as a function, for callers that run rarely. */
uint32_t fx_rcp_far(uint32_t w, int *shift);

#define FX_TEXT_SIZE 24 /* the longest text is "-32767.9999847412109375", with its final zero */

/* Exact decimal text of a without trailing zeros, the same in every locale. Returns its length. */
int fx_to_text(fx_t a, char text[FX_TEXT_SIZE]);

/*
 * Decimal text of any length ("-1.5", ".25", "3.", "1e-3") to Q16.16, rounded to nearest.
 * In:     text without spaces in front, grouping or hexadecimal. An e without digits is not part of the number.
 * Out:    *out; on an error it stays as it was. *end, if not NULL, is the first character after the number.
 * Errors: PH_ERR_INVAL (-22): text is no number (nan, inf), and *end is text. PH_ERR_RANGE (-34): the nearest value is
 *         outside -32768 .. 32767.99998.
 */
int fx_from_text(const char *text, fx_t *out, const char **end);

#ifdef __cplusplus
}
#endif

#endif
