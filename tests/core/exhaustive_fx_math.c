/*
 * Every unary function of fx_math.h is checked over all its 2^32 raw inputs. exhaustive.h has the usage; SHARE=K/N runs
 * every N-th check.
 *
 * Where a result can change, MPFR gives it: at each input of the exponentials and of the arcs, for the logarithms at
 * the inputs where the rounded result changes next. Radians are multiples of a factor, which is known in 128 bits.
 */
#include <mpfr.h>

#include "exhaustive.h"
#include "fx_math.h"
#include "fx_oracle.h"

/* Compares f with the oracle within low .. high; below and above it must be constant. */
static bool agrees(fx_t (*f)(fx_t), int32_t (*oracle)(int32_t), int32_t low, int32_t high, struct range r,
                   uint32_t *wrong)
{
    const int32_t below = oracle(low), above = oracle(high);
    for (uint32_t a = r.first;; a++) {
        const int32_t v = (int32_t)a;
        if (f(v) != (v < low ? below : v > high ? above : oracle(v))) {
            *wrong = a;
            return false;
        }
        if (a == r.last) {
            return true;
        }
    }
}

static bool check_exp2(struct range r, uint32_t *wrong)
{
    return agrees(fx_exp2_sat, oracle_exp2, FX_INT(-18), FX_INT(15), r, wrong);
}

static bool check_exp(struct range r, uint32_t *wrong)
{
    return agrees(fx_exp_sat, oracle_exp, FX_INT(-12), FX_INT(11), r, wrong);
}

static bool check_sinh(struct range r, uint32_t *wrong)
{
    return agrees(fx_sinh_sat, oracle_sinh, FX_INT(-12), FX_INT(12), r, wrong);
}

static bool check_cosh(struct range r, uint32_t *wrong)
{
    return agrees(fx_cosh_sat, oracle_cosh, FX_INT(-12), FX_INT(12), r, wrong);
}

static bool check_tanh(struct range r, uint32_t *wrong)
{
    return agrees(fx_tanh, oracle_tanh, FX_INT(-8), FX_INT(8), r, wrong);
}

static bool check_asin(struct range r, uint32_t *wrong)
{
    return agrees(fx_asin, oracle_asin, -FX_ONE, FX_ONE, r, wrong);
}

static bool check_acos(struct range r, uint32_t *wrong)
{
    return agrees(fx_acos, oracle_acos, -FX_ONE, FX_ONE, r, wrong);
}

/* The largest a whose logarithm is below result + 1/2; power is the inverse of the logarithm. */
static uint32_t until(int (*power)(mpfr_t, const mpfr_t, mpfr_rnd_t), int32_t result)
{
    mpfr_t v;
    mpfr_init2(v, ORACLE_BITS);
    mpfr_set_si_2exp(v, 2 * (long)result + 1, -17, MPFR_RNDN);
    power(v, v, MPFR_RNDN);
    mpfr_mul_2ui(v, v, 16, MPFR_RNDN);
    mpfr_floor(v, v);
    const uint32_t a = mpfr_cmp_ui(v, UINT32_MAX) > 0 ? UINT32_MAX : (uint32_t)mpfr_get_ui(v, MPFR_RNDD);
    mpfr_clear(v);
    return a;
}

static bool check_logarithm(fx_t (*f)(fx_t), int (*power)(mpfr_t, const mpfr_t, mpfr_rnd_t), struct range r,
                            uint32_t *wrong)
{
    uint32_t end = 0;
    int32_t result = FX_MIN;
    for (uint32_t a = r.first;; a++) {
        if (a > end && a <= INT32_MAX) {
            result = f((fx_t)a);
            end = until(power, result);
            if (a > end || (result != FX_MIN && a <= until(power, result - 1))) {
                *wrong = a;
                return false;
            }
        }
        if (f((fx_t)a) != (a <= INT32_MAX ? result : FX_MIN)) {
            *wrong = a;
            return false;
        }
        if (a == r.last) {
            return true;
        }
    }
}

static bool check_log2(struct range r, uint32_t *wrong)
{
    return check_logarithm(fx_log2_sat, mpfr_exp2, r, wrong);
}

static bool check_log(struct range r, uint32_t *wrong)
{
    return check_logarithm(fx_log_sat, mpfr_exp, r, wrong);
}

/* ---- multiples --------------------------------------------------------------------------------------------- */

static __int128 radian, turn; /* 1 / (2 pi) in 2^-90, 2 pi in 2^-90, rounded to nearest */

static __int128 in_128(mpfr_t v)
{
    mpfr_t high;
    mpfr_init2(high, ORACLE_BITS);
    mpfr_mul_2ui(v, v, 30, MPFR_RNDN);
    mpfr_floor(high, v);
    mpfr_sub(v, v, high, MPFR_RNDN);
    mpfr_mul_2ui(v, v, 60, MPFR_RNDN);
    const __int128 result = ((__int128)mpfr_get_ui(high, MPFR_RNDN) << 60) + mpfr_get_ui(v, MPFR_RNDN);
    mpfr_clear(high);
    return result;
}

static void make_factors(void)
{
    mpfr_t v;
    oracle_angle(v, 1, 0);
    turn = in_128(v);
    mpfr_clear(v);
    oracle_angle(v, 1, 0);
    mpfr_ui_div(v, 1, v, MPFR_RNDN);
    radian = in_128(v);
    mpfr_clear(v);
}

/*
 * floor(a factor + 1/2) of a factor in 2^-bits. The product is off by at most 2^31 of its units: *near says whether
 * that could change the result.
 */
static int64_t product(int32_t a, __int128 factor, int bits, bool *near)
{
    const __int128 half = (__int128)1 << (bits - 1), off = (__int128)1 << 31;
    const __int128 low = (a * factor + half - off) >> bits, high = (a * factor + half + off) >> bits;
    *near = a != 0 && low != high;
    return (int64_t)high;
}

static int32_t clamp(int64_t v)
{
    return v > INT32_MAX ? INT32_MAX : v < INT32_MIN ? INT32_MIN : (int32_t)v;
}

/* fx_turn32_from_rad: within (1/2 + 2^-19) LSB of a / (2 pi), modulo one turn. */
static bool is_turn32(int32_t a, uint32_t turn32)
{
    const __int128 exact = a * radian, lsb = (__int128)1 << 74;
    const int32_t off = (int32_t)(turn32 - (uint32_t)(exact >> 74)); /* from the LSB below */
    const __int128 error = off * lsb - (exact & (lsb - 1));
    const __int128 bound = lsb / 2 + (lsb >> 19);
    return error <= bound && error >= -bound;
}

static bool check_radians(struct range r, uint32_t *wrong)
{
    for (uint32_t a = r.first;; a++) {
        const int32_t v = (int32_t)a;
        bool near[2];
        const int64_t turns = product(v, radian, 90, &near[0]), rad = product(v, turn, 90, &near[1]);
        if (fx_turns_from_rad(v) != turns || fx_rad_from_turns_sat(v) != clamp(rad) || near[0] || near[1] ||
            !is_turn32(v, fx_turn32_from_rad(v))) {
            *wrong = a;
            return false;
        }
        if (a == r.last) {
            return true;
        }
    }
}

/* Fields of view of 2^-16 degree: within 0.501 LSB, and 0 or the largest where the result is outside. */
static bool check_cot_half(struct range r, uint32_t *wrong)
{
    for (uint32_t a = r.first;; a++) {
        if (!oracle_is_cot_half((int32_t)a, fx_cot_half_q20((fx_t)a))) {
            *wrong = a;
            return false;
        }
        if (a == r.last) {
            return true;
        }
    }
}

/* ---- exact in integers ------------------------------------------------------------------------------------- */

static bool check_whole(struct range r, uint32_t *wrong)
{
    for (uint32_t a = r.first;; a++) {
        const int64_t v = (int32_t)a, below = v - (v & 0xffff);
        if (fx_floor((fx_t)a) != below || fx_ceil_sat((fx_t)a) != clamp(below == v ? v : below + FX_ONE) ||
            fx_round_sat((fx_t)a) != clamp(below + (v - below >= FX_HALF ? FX_ONE : 0))) {
            *wrong = a;
            return false;
        }
        if (a == r.last) {
            return true;
        }
    }
}

/* A number in another format, and back from it: to Q2.30, Q8.24, Q24.8 and Q1.31. */
static bool check_convert(struct range r, uint32_t *wrong)
{
    static const int formats[] = {0, 8, 16, 24, 30, 31};
    for (uint32_t a = r.first;; a++) {
        for (int i = 0; i < 6; i++) {
            const int from = formats[i], to = formats[(i + a) % 6];
            const __int128 twice =
                (((__int128)(int32_t)a * ((__int128)1 << 33)) >> from) * ((__int128)1 << to); /* 2^-33 of the result */
            const int64_t nearest = (int64_t)((twice + ((__int128)1 << 32)) >> 33);
            if (fx_convert_sat((int32_t)a, from, to) != clamp(nearest)) {
                *wrong = a;
                return false;
            }
        }
        if (fx_to_q30_sat((fx_t)a) != fx_convert_sat((int32_t)a, 16, 30) ||
            fx_from_q30((int32_t)a) != fx_convert_sat((int32_t)a, 30, 16)) {
            *wrong = a;
            return false;
        }
        if (a == r.last) {
            return true;
        }
    }
}

/*
 * The root of 2^32 a, and of the last number before 2^32 (a + 1). The numbers between share the first estimate, which
 * Newton's step follows in a straight line. Smaller numbers are shifted up to those with a >= 2^30.
 */
static bool check_sqrt_u64(struct range r, uint32_t *wrong)
{
    for (uint32_t a = r.first;; a++) {
        for (int i = 0; i < 2; i++) {
            const uint64_t v = (uint64_t)a << 32 | (i == 0 ? 0 : UINT32_MAX), root = fx_sqrt_u64(v);
            if (root * root > v || v - root * root > 2 * root) {
                *wrong = a;
                return false;
            }
        }
        if (a == r.last) {
            return true;
        }
    }
}

static const struct check checks[] = {
    {"exp2_sat", check_exp2},
    {"exp_sat", check_exp},
    {"sinh_sat", check_sinh},
    {"cosh_sat", check_cosh},
    {"tanh", check_tanh},
    {"log2_sat", check_log2},
    {"log_sat", check_log},
    {"asin", check_asin},
    {"acos", check_acos},
    {"radians", check_radians},
    {"cot_half_q20", check_cot_half},
    {"floor_ceil_round", check_whole},
    {"convert_sat", check_convert},
    {"sqrt_u64", check_sqrt_u64},
};

int main(int argc, char **argv)
{
    make_factors();
    return exhaustive_main(argc, argv, checks, sizeof checks / sizeof checks[0]);
}
