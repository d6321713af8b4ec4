/*
 * fx: Q16.16 fixed-point arithmetic.
 *
 * An fx_t is an int32_t that counts 1/65536ths: range -32768 .. 32767.99998, one LSB = 2^-16 = 0.0000153.
 * The name says what overflow does: _sat clamps to FX_MIN or FX_MAX, _wrap keeps the low 32 bits.
 * Rounding is to nearest; a tie goes towards +infinity unless the function says otherwise.
 * Angles are binary turns. In an fx_t 65536 is one turn; in a uint32_t ("turn32") 2^32 is one turn.
 * No function divides by zero, loops without bound, or depends on the compiler: >> of a negative number is
 * arithmetic on every compiler that we support (checked in tests/core/test_fx.c).
 *
 * Error bounds below are proved over every input by `make test-exhaustive` (unary) and against 128-bit
 * integers on all edges squared (binary). Tables: 1368 bytes in all.
 */
#ifndef FX_H
#define FX_H

#include <stdint.h>

typedef int32_t fx_t;

#define FX_ONE     ((fx_t)65536)
#define FX_HALF    ((fx_t)32768)
#define FX_MAX     INT32_MAX
#define FX_MIN     INT32_MIN
#define FX_INT(i)  ((fx_t)((int32_t)(i)*65536)) /* i: -32768 .. 32767 */
#define FX_Q30_ONE ((int32_t)1 << 30)           /* one in Q2.30, the format of rotations */

/*
 * Cost is in instructions on a Cortex-M0+ (armv6m) and a Cortex-M3 (armv7m), the call included, gcc -O3, mean of 4000
 * inputs of all magnitudes: small enough to call per vertex, or only per frame.
 */

/* Sum, difference, negative and absolute value. Cost: 20, 12. */
fx_t fx_add_sat(fx_t a, fx_t b);
fx_t fx_sub_sat(fx_t a, fx_t b);
fx_t fx_add_wrap(fx_t a, fx_t b);
fx_t fx_sub_wrap(fx_t a, fx_t b);
fx_t fx_neg_sat(fx_t a);
fx_t fx_abs_sat(fx_t a);

/* v clamped to 32 bits: by comparing words, which is half the instructions of 64-bit comparisons. */
static inline int32_t fx_sat64(int64_t v)
{
    const int32_t low = (int32_t)v, high = (int32_t)(v >> 32);
    return high == low >> 31 ? low : high < 0 ? INT32_MIN : INT32_MAX;
}

/* |a| without a sign bit, hence also of FX_MIN. */
static inline uint32_t fx_magnitude(int32_t a)
{
    return a < 0 ? 0u - (uint32_t)a : (uint32_t)a;
}

/* a * b, error <= 0.5 LSB (before the clamp, or modulo 2^32). Cost: 41, 14 (wrap 32, 8). */
fx_t fx_mul_sat(fx_t a, fx_t b);
fx_t fx_mul_wrap(fx_t a, fx_t b);

/* a / b, error <= 0.5 LSB. a / 0 is FX_MAX for a > 0, FX_MIN for a < 0, and 0 for a = 0. Cost: 194, 76. */
fx_t fx_div_sat(fx_t a, fx_t b);

/* 1 / a, error <= 0.5 LSB. 1 / 0 is FX_MAX. Only |a| of 0, 1 and +2 LSB clamp. Cost: 74, 50. */
fx_t fx_rcp_sat(fx_t a);

/* Square root, error <= 0.5 LSB; 0 for a <= 0. Cost: 202, 49. */
fx_t fx_sqrt(fx_t a);

/* 1 / sqrt(a), error <= 0.5 LSB; FX_MAX for a <= 0. At most 256, of 1 LSB. Cost: 215, 48. */
fx_t fx_rsqrt_sat(fx_t a);

/* Sine, cosine of an angle in turns (65536 = one turn; only the lower 16 bits count), error <= 0.5 LSB. Cost: 375, 70.
 */
fx_t fx_sin(fx_t turns);
fx_t fx_cos(fx_t turns);

/*
 * Tangent of an angle in turns, error <= 0.5 LSB; a quarter turn gives FX_MAX, three quarters FX_MIN (no other angle
 * comes near: 10430 is the largest). Cost: 3800, 660.
 */
fx_t fx_tan_sat(fx_t turns);

/*
 * Angle of (x, y) in turns, -32768 < result <= 32768 (half a turn); 0 for (0, 0). An angle just short of minus half a
 * turn that rounds to it is given as half a turn. Error <= 0.5 LSB + 2^-27 LSB: a vector that close to the middle
 * between two results may get the other one. Cost: 265, 108.
 */
fx_t fx_atan2(fx_t y, fx_t x);

/*
 * Sine and cosine in Q2.30 of an angle whose unit is 2^-32 turn, for rotations. Error <= 0.67 LSB; exact at the quarter
 * turns, and the quarters mirror each other exactly. Cost: 374, 80.
 */
void fx_sincos_q30(uint32_t turn32, int32_t *sin_q30, int32_t *cos_q30);

/* Degrees (Q16.16, any value) to turn32, rounded to nearest, modulo one turn. Cost: 350, 21. */
uint32_t fx_turn32_from_deg(fx_t deg);

/* a + (b - a) t, exact before its one rounding; t in Q16.16, any value; saturates. Cost: 77, 25. */
fx_t fx_lerp_sat(fx_t a, fx_t b, fx_t t);

/* Leading zeros of v, 32 for 0. */
static inline int fx_clz32(uint32_t v);

/* High 32 bits of the 64-bit product, rounded down. */
static inline uint32_t fx_mulhi_u32(uint32_t a, uint32_t b);

/* Full products: 34 instructions on a Cortex-M0+, one on a Cortex-M3. */
static inline int64_t fx_mul_wide(int32_t a, int32_t b);
static inline uint64_t fx_mul_wide_u(uint32_t a, uint32_t b);

/* floor((2^31 - 1) / d) for d = 2^15 .. 2^16 - 1: the short reciprocal, 16 bits. */
static inline uint32_t fx_rcp16(uint32_t d);

extern const uint16_t fx_rcp_table[256]; /* for fx_rcp_norm and a CPU's fx_rcp16 alone */

#include <fx_cpu.h> /* the one of the CPU, whose folder -I names before firmware/core */

/* floor(2^62 / d) for d = 2^31 .. 2^32 - 1, in products of 32 bits. */
static inline uint32_t fx_rcp_newton(uint32_t d)
{
    const uint32_t r0 = fx_rcp_table[(d >> 23) & 255];                    /* 2^43 / d, 8.8 bits */
    const int32_t e0 = (int32_t)(0u - r0 * (d >> 4));                     /* 1 - r0 d in 2^-39 */
    const int32_t u = (e0 >> 12) + (((e0 >> 16) * (e0 >> 16)) >> 19) + 6; /* e0 + e0^2 in 2^-27, half a LSB of r1 */
    const uint32_t r1 = (r0 << 12) + (uint32_t)(((int32_t)r0 * u) >> 15); /* 2^55 / d, less than 1 off */
    const int32_t e1 = (int32_t)(0u - r1 * (d >> 1) - ((r1 & (0u - (d & 1))) >> 1)); /* 1 - r1 d in 2^-54 */
    const int32_t half = ((int32_t)(r1 >> 9) * ((e1 >> 16) + 48)) >> 21; /* halves to add to 2^7 r1, nearest */
    const uint32_t q = (r1 << 7) + (uint32_t)(half >> 1);
    /* A half more than q leaves no doubt; else the remainder, less than d / 2 either way, has a sign in 32 bits. */
    return q - (((0u - q * d) >> 31) & ~(uint32_t)half);
}

/*
 * Normalised reciprocal: *shift = leading zeros of w, result = floor(2^62 / (w << *shift)), in 2^30 .. 2^31.
 * So 1/w = result * 2^(*shift - 62) for an integer w. Exactly this integer on every CPU, hence monotone.
 * w = 0 counts as 1. Cost: 57, 36.
 */
static inline uint32_t fx_rcp_norm(uint32_t w, int *shift)
{
    const uint32_t v = w != 0 ? w : 1;
    *shift = fx_clz32(v);
    const uint32_t d = v << *shift;
    /* NOLINTNEXTLINE(clang-analyzer-core.DivideZero): the top bit of d is set */
    return FX_DIVIDES_64 ? (uint32_t)(((uint64_t)1 << 62) / d) : fx_rcp_newton(d);
}

#define FX_TEXT_SIZE 24 /* longest text is "-32767.9999847412109375" and its zero */

/* Exact decimal text of a, shortest form without trailing zeros. Returns its length. Same in every locale. */
int fx_to_text(fx_t a, char text[FX_TEXT_SIZE]);

/*
 * Decimal text of any length ("-1.5", ".25", "3.", "1e-3") to Q16.16, nearest, a tie towards +infinity. No spaces
 * before, no grouping, no hexadecimal; an e without digits behind it does not belong to the number.
 * Out:    *out, which stays as it was on an error; *end (if not NULL) is the first character not used, so `text` for
 *         EINVAL, and behind the number for ERANGE.
 * Errors: -22 (EINVAL) where text is no number (nan and inf are none), -34 (ERANGE) where the nearest value is outside
 *         -32768 .. 32767.99998. Otherwise 0.
 */
int fx_from_text(const char *text, fx_t *out, const char **end);

#endif
