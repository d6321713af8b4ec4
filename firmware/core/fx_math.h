/*
 * fx_math: the functions of a mathematics library for the numbers of fx.h (Q16.16, rounded to nearest, ties up).
 *
 * "Error <= 0.5 LSB" means that the result is the nearest number to the exact value; `make test-exhaustive` proves it
 * for every input of a function of one argument. No function uses floating point, and an image links only those it
 * calls. Cost is counted as in fx.h. The tables of the exponentials have 256 bytes, those of the logarithms 315.
 *
 * Sources: tables and short series as P. T. P. Tang, Table-driven implementation of the exponential function (1989) and
 * of the logarithm function (1990), ACM Transactions on Mathematical Software 15 and 16.
 */
#ifndef FX_MATH_H
#define FX_MATH_H

#include "fx.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- powers and logarithms ------------------------------------------------------------------------------------- */

/* 2^a and e^a, error <= 0.5 LSB. FX_MAX from 15 and from 10.39721 on; 0 below -17 and below -11.78350. Cost: 972, 168.
 */
fx_t fx_exp2_sat(fx_t a);
fx_t fx_exp_sat(fx_t a);

/*
 * Logarithms to base 2 and e, error <= 0.5 LSB; FX_MIN for a <= 0. Any other result is in -16 .. 15. Cost: 611, 116;
 * base e 775, 141.
 */
fx_t fx_log2_sat(fx_t a);
fx_t fx_log_sat(fx_t a);

/*
 * x^y, error <= 0.5 LSB + 2^-7 LSB. For x < 0 and a whole y the sign is that of (-1)^y; for x < 0 and any other y,
 * which has no real power, the result is 0. x^0 is 1. 0^y is 0 for y > 0, FX_MAX for y < 0. Cost: 1500, 291.
 */
fx_t fx_pow_sat(fx_t x, fx_t y);

/*
 * The hyperbolic sine, cosine and tangent, error <= 0.5 LSB. The sine saturates beyond 11.09035 and below -11.09035,
 * the cosine beyond both; the tangent is 1 or -1 from 6.2383 on. Cost: 1910, 365; 1905, 365; 2660, 500.
 */
fx_t fx_sinh_sat(fx_t a);
fx_t fx_cosh_sat(fx_t a);
fx_t fx_tanh(fx_t a);

/* sqrt(x^2 + y^2), error <= 0.5 LSB. Cost: 378, 96. */
fx_t fx_hypot_sat(fx_t x, fx_t y);

/* ---- angles ---------------------------------------------------------------------------------------------------- */

/*
 * The angle in turns whose sine is a, -1/4 .. 1/4, and whose cosine is a, 0 .. 1/2. Error <= 0.5 LSB. An a beyond -1 ..
 * 1 counts as -1 or 1. Cost: 540, 200.
 */
fx_t fx_asin(fx_t a);
fx_t fx_acos(fx_t a);

/* Radians to turns and back, error <= 0.5 LSB. fx_rad_from_turns_sat saturates beyond 5215.18 turns. Cost: 89, 23. */
fx_t fx_turns_from_rad(fx_t rad);
fx_t fx_rad_from_turns_sat(fx_t turns);

/* Radians to turn32, modulo one turn, error <= (1/2 + 2^-19) LSB. Cost: 76, 19. */
uint32_t fx_turn32_from_rad(fx_t rad);

/*
 * cot(deg / 2) in Q12.20 for a field of view in degrees, 0 .. 180: the scale of a perspective. Error <= 0.501 LSB.
 * INT32_MAX where it is 2048 or more, below 0.056 degrees; 0 from 180 degrees on. Cost: 560, 130.
 */
int32_t fx_cot_half_q20(fx_t deg);

/* ---- whole numbers, remainders, limits ------------------------------------------------------------------------- */

/* The next whole number at or below a. */
static inline fx_t fx_floor(fx_t a)
{
    return (fx_t)((uint32_t)a & 0xffff0000u);
}

/* The next whole number at or above a, and the nearest one (a tie goes up); FX_MAX where it is 32768. */
fx_t fx_ceil_sat(fx_t a);
fx_t fx_round_sat(fx_t a);

/* a - b trunc(a / b), exactly: its sign is that of a, and |result| < |b|. 0 for b = 0. Cost: 108, 13. */
fx_t fx_fmod(fx_t a, fx_t b);

/* The smaller of two numbers. */
static inline fx_t fx_min(fx_t a, fx_t b)
{
    return a < b ? a : b;
}

/* The larger of two numbers. */
static inline fx_t fx_max(fx_t a, fx_t b)
{
    return a > b ? a : b;
}

/* a, but at least low and at most high; low <= high. */
static inline fx_t fx_clamp(fx_t a, fx_t low, fx_t high)
{
    return a < low ? low : a > high ? high : a;
}

/* ---- other Q formats ------------------------------------------------------------------------------------------- */

/*
 * A number with from_bits bits of fraction (0 .. 31) as one with to_bits (0 .. 31), rounded to nearest, a tie upwards;
 * it saturates. Q8.24 has 24 bits, Q2.30 has 30, Q1.31 31, Q16.16 16, and an integer none. Cost: 26, 21.
 */
int32_t fx_convert_sat(int32_t a, int from_bits, int to_bits);

/* Q2.30 to Q16.16, rounded to nearest. */
static inline fx_t fx_from_q30(int32_t a)
{
    return (a >> 14) + (a >> 13 & 1);
}

/* Q16.16 to Q2.30. */
static inline int32_t fx_to_q30_sat(fx_t a)
{
    return fx_sat64((int64_t)a * (1 << 14));
}

/* ---- sums in Q32.32 -------------------------------------------------------------------------------------------- */

/*
 * A number in Q32.32: -2^31 to just below 2^31, in steps of 2^-32. A product of two numbers of Q16.16 has 32 bits of
 * fraction; a sum of products in Q32.32 is rounded once, at its end.
 */
typedef int64_t fx_sum_t;

/* a in Q32.32, exactly. */
static inline fx_sum_t fx_sum_of(fx_t a)
{
    return (fx_sum_t)a * FX_ONE;
}

/* a + b, and sum + a b: exact, or the nearest that Q32.32 holds. A sum that once was cut off stays wrong, so the order
 * counts then. Cost: 38, 21; 69, 18. */
fx_sum_t fx_sum_add_sat(fx_sum_t a, fx_sum_t b);
fx_sum_t fx_sum_mul_sat(fx_sum_t sum, fx_t a, fx_t b);

/* A sum in Q16.16, rounded to nearest. */
fx_t fx_from_sum_sat(fx_sum_t sum);

/* ---- arrays of n numbers; cost is that of an element ----------------------------------------------------------- */

/* to[i] = a[i] + b[i], a[i] - b[i], a[i] b[i], a[i] by: as fx_add_sat, fx_sub_sat and fx_mul_sat have it. `to` may be a
 * or b. Cost: 18, 9; 18, 9; 46, 13; 44, 12. */
void fx_add_array_sat(fx_t *to, const fx_t *a, const fx_t *b, size_t n);
void fx_sub_array_sat(fx_t *to, const fx_t *a, const fx_t *b, size_t n);
void fx_mul_array_sat(fx_t *to, const fx_t *a, const fx_t *b, size_t n);
void fx_scale_array_sat(fx_t *to, const fx_t *a, fx_t by, size_t n);

/* to[i] = f(a[i]), where f is any function of one number, as fx_sqrt. `to` may be a. */
void fx_map_array(fx_t *to, const fx_t *a, size_t n, fx_t (*f)(fx_t));

/* a[0] + .. + a[n - 1], exactly if n <= 65536; and a[0] b[0] + .. + a[n - 1] b[n - 1]. 0 for n = 0. Cost: 26,
 * 8; 59, 7. */
fx_sum_t fx_sum_array_sat(const fx_t *a, size_t n);
fx_sum_t fx_dot_array_sat(const fx_t *a, const fx_t *b, size_t n);

/* ---- text ------------------------------------------------------------------------------------------------------ */

/*
 * Decimal text of a with exactly `places` decimals (0 .. 16; what is beyond counts as the nearest), rounded to nearest,
 * a tie upwards: 2.5 is "3", -2.5 is "-2". What rounds to zero has no sign. Returns the length. The text is exact from
 * 16 places on. fx_to_text (fx.h) writes as many as there are.
 */
int fx_to_text_rounded(fx_t a, int places, char text[FX_TEXT_SIZE]);

#ifdef __cplusplus
}
#endif

#endif
