/*
 * fx_oracle: the results that the functions of fx.h must return, computed by MPFR in 192 bits. Include <mpfr.h> first.
 * Each is the nearest value, clamped to 32 bits; only integers give ties.
 */
#ifndef FX_ORACLE_H
#define FX_ORACLE_H

#include <stdint.h>

#define ORACLE_BITS      192
#define SINCOS_Q30_BOUND 0.67L /* LSB, as fx.h says */

/* floor(v * 2^16 + 1/2), clamped. */
static inline int32_t oracle_nearest(mpfr_t v)
{
    mpfr_mul_2si(v, v, 17, MPFR_RNDN);
    mpfr_add_ui(v, v, 1, MPFR_RNDN);
    mpfr_div_2ui(v, v, 1, MPFR_RNDN);
    mpfr_floor(v, v);
    if (mpfr_cmp_si(v, INT32_MAX) > 0) {
        return INT32_MAX;
    }
    return mpfr_cmp_si(v, INT32_MIN) < 0 ? INT32_MIN : (int32_t)mpfr_get_si(v, MPFR_RNDN);
}

/* An int32_t in 2^-16. */
static inline void oracle_load(mpfr_t v, int32_t raw)
{
    mpfr_init2(v, ORACLE_BITS);
    mpfr_set_si_2exp(v, raw, -16, MPFR_RNDN);
}

/* Radians of count 2^-bits turns. */
static inline void oracle_angle(mpfr_t v, int64_t count, int bits)
{
    mpfr_init2(v, ORACLE_BITS);
    mpfr_const_pi(v, MPFR_RNDN);
    mpfr_mul_si(v, v, (long)count, MPFR_RNDN);
    mpfr_div_2si(v, v, bits - 1, MPFR_RNDN);
}

static inline int32_t oracle_take(mpfr_t v)
{
    const int32_t result = oracle_nearest(v);
    mpfr_clear(v);
    return result;
}

static inline int32_t oracle_rcp(int32_t a)
{
    mpfr_t v;
    if (a == 0) {
        return INT32_MAX;
    }
    oracle_load(v, a);
    mpfr_ui_div(v, 1, v, MPFR_RNDN);
    return oracle_take(v);
}

static inline int32_t oracle_sqrt(int32_t a)
{
    mpfr_t v;
    if (a <= 0) {
        return 0;
    }
    oracle_load(v, a);
    mpfr_sqrt(v, v, MPFR_RNDN);
    return oracle_take(v);
}

static inline int32_t oracle_rsqrt(int32_t a)
{
    mpfr_t v;
    if (a <= 0) {
        return INT32_MAX;
    }
    oracle_load(v, a);
    mpfr_rec_sqrt(v, v, MPFR_RNDN);
    return oracle_take(v);
}

static inline int32_t oracle_sin(int32_t turns)
{
    mpfr_t v;
    if ((turns & 0x7fff) == 0) {
        return 0; /* pi in 192 bits is not pi */
    }
    oracle_angle(v, turns, 16);
    mpfr_sin(v, v, MPFR_RNDN);
    return oracle_take(v);
}

static inline int32_t oracle_cos(int32_t turns)
{
    mpfr_t v;
    if ((turns & 0x7fff) == 0x4000) {
        return 0;
    }
    oracle_angle(v, turns, 16);
    mpfr_cos(v, v, MPFR_RNDN);
    return oracle_take(v);
}

static inline int32_t oracle_tan(int32_t turns)
{
    mpfr_t v;
    if ((turns & 0x7fff) == 0) {
        return 0;
    }
    if ((turns & 0x7fff) == 0x4000) {
        return (turns & 0x8000) != 0 ? INT32_MIN : INT32_MAX;
    }
    oracle_angle(v, turns, 16);
    mpfr_tan(v, v, MPFR_RNDN);
    return oracle_take(v);
}

/* Turns of the vector (x, y); half a turn is positive. */
static inline int32_t oracle_atan2(int32_t y, int32_t x)
{
    mpfr_t v, pi;
    if (x == 0 && y == 0) {
        return 0;
    }
    mpfr_inits2(ORACLE_BITS, v, pi, (mpfr_ptr)0);
    mpfr_set_si(v, y, MPFR_RNDN);
    mpfr_set_si(pi, x, MPFR_RNDN);
    mpfr_atan2(v, v, pi, MPFR_RNDN);
    mpfr_const_pi(pi, MPFR_RNDN);
    mpfr_div(v, v, pi, MPFR_RNDN);
    mpfr_div_2ui(v, v, 1, MPFR_RNDN);
    mpfr_clear(pi);
    const int32_t turns = oracle_take(v);
    return turns == -32768 ? 32768 : turns;
}

static inline uint32_t oracle_turn32_from_deg(int32_t deg)
{
    const __int128 twice = (__int128)deg * 16384; /* deg 2^32 / (65536 360) = deg 8192 / 45 */
    __int128 q = (twice + 45) / 90;
    q -= (twice + 45) % 90 < 0;
    return (uint32_t)q;
}

/* f(a) where f is one of MPFR's functions; a takes the place of the result. */
static inline int32_t oracle_of(int (*f)(mpfr_t, const mpfr_t, mpfr_rnd_t), int32_t a)
{
    mpfr_t v;
    oracle_load(v, a);
    f(v, v, MPFR_RNDN);
    return oracle_take(v);
}

static inline int32_t oracle_exp2(int32_t a)
{
    return oracle_of(mpfr_exp2, a);
}

static inline int32_t oracle_exp(int32_t a)
{
    return oracle_of(mpfr_exp, a);
}

static inline int32_t oracle_sinh(int32_t a)
{
    return oracle_of(mpfr_sinh, a);
}

static inline int32_t oracle_cosh(int32_t a)
{
    return oracle_of(mpfr_cosh, a);
}

static inline int32_t oracle_tanh(int32_t a)
{
    return oracle_of(mpfr_tanh, a);
}

static inline int32_t oracle_log2(int32_t a)
{
    return a <= 0 ? INT32_MIN : oracle_of(mpfr_log2, a);
}

static inline int32_t oracle_log(int32_t a)
{
    return a <= 0 ? INT32_MIN : oracle_of(mpfr_log, a);
}

/* 1 / (2 pi) times the angle that f gives for a, which is clamped to -1 .. 1. */
static inline int32_t oracle_arc(int (*f)(mpfr_t, const mpfr_t, mpfr_rnd_t), int32_t a)
{
    mpfr_t v, pi;
    oracle_load(v, a < -65536 ? -65536 : a > 65536 ? 65536 : a);
    mpfr_init2(pi, ORACLE_BITS);
    f(v, v, MPFR_RNDN);
    mpfr_const_pi(pi, MPFR_RNDN);
    mpfr_div(v, v, pi, MPFR_RNDN);
    mpfr_div_2ui(v, v, 1, MPFR_RNDN);
    mpfr_clear(pi);
    return oracle_take(v);
}

static inline int32_t oracle_asin(int32_t a)
{
    return oracle_arc(mpfr_asin, a);
}

static inline int32_t oracle_acos(int32_t a)
{
    return oracle_arc(mpfr_acos, a);
}

/* a (2 pi)^power, power = 1 or -1, times 2^bits, rounded to nearest, before any clamp. */
static inline int64_t oracle_radians(int32_t a, int power, int bits)
{
    mpfr_t v, twice_pi;
    oracle_load(v, a);
    oracle_angle(twice_pi, 1, 0);
    (power > 0 ? mpfr_mul : mpfr_div)(v, v, twice_pi, MPFR_RNDN);
    mpfr_mul_2si(v, v, bits, MPFR_RNDN);
    mpfr_rint(v, v, MPFR_RNDN);
    const int64_t result = mpfr_get_si(v, MPFR_RNDN);
    mpfr_clears(v, twice_pi, (mpfr_ptr)0);
    return result;
}

/* Whether got is within 0.501 LSB of cot(deg / 2) in Q12.20, with the values of fx_math.h outside. */
static inline int oracle_is_cot_half(int32_t deg, int32_t got)
{
    mpfr_t v;
    if (deg <= 0 || deg >= 180 * 65536) {
        return got == (deg <= 0 ? INT32_MAX : 0);
    }
    oracle_angle(v, deg, 16);
    mpfr_div_ui(v, v, 720, MPFR_RNDN);
    mpfr_cot(v, v, MPFR_RNDN);
    mpfr_mul_2ui(v, v, 20, MPFR_RNDN);
    const int outside = mpfr_cmp_si(v, INT32_MAX) >= 0;
    mpfr_sub_si(v, v, got, MPFR_RNDN);
    const double error = mpfr_get_d(v, MPFR_RNDN);
    mpfr_clear(v);
    return outside ? got == INT32_MAX : error <= 0.501 && error >= -0.501;
}

#endif
