/*
 * Every unary function of fx.h is checked over all its 2^32 raw inputs. exhaustive.h has the usage; SHARE=K/N runs
 * every N-th check.
 *
 * Where a function is monotone, MPFR gives the input at which its rounded result changes next, and all inputs before it
 * must give the same result. Sine, cosine and tangent have 65536 distinct inputs. The sine in Q2.30 is compared with a
 * rotating long double vector that MPFR corrects every 4096 steps. The rest is exact in integers.
 */
#include <mpfr.h>

#include "exhaustive.h"
#include "fx.h"
#include "fx_armv6m.h"
#include "fx_oracle.h"

#include <stdatomic.h>
#include <stdio.h>

#define RESEED 4096

static int32_t sines[65536], cosines[65536], tangents[65536];

/* ---- monotone functions ------------------------------------------------------------------------------------ */

/* floor(v) in 32 bits; takes v. */
static uint32_t whole(mpfr_t v)
{
    mpfr_floor(v, v);
    const uint32_t result = mpfr_cmp_ui(v, UINT32_MAX) > 0 ? UINT32_MAX : (uint32_t)mpfr_get_ui(v, MPFR_RNDD);
    mpfr_clear(v);
    return result;
}

static void middle_below(mpfr_t v, uint32_t result)
{
    mpfr_init2(v, ORACLE_BITS);
    mpfr_set_ui_2exp(v, 2 * (unsigned long)result - 1, -1, MPFR_RNDN);
}

/* The largest a with 2^32 / a >= result - 1/2. */
static uint32_t rcp_until(uint32_t result)
{
    mpfr_t v;
    middle_below(v, result);
    mpfr_ui_div(v, 1, v, MPFR_RNDN);
    mpfr_mul_2ui(v, v, 32, MPFR_RNDN);
    return whole(v);
}

/* The largest a with 2^24 / sqrt(a) >= result - 1/2. */
static uint32_t rsqrt_until(uint32_t result)
{
    mpfr_t v;
    middle_below(v, result);
    mpfr_sqr(v, v, MPFR_RNDN);
    mpfr_ui_div(v, 1, v, MPFR_RNDN);
    mpfr_mul_2ui(v, v, 48, MPFR_RNDN);
    return whole(v);
}

/* The largest a with sqrt(65536 a) < result + 1/2. */
static uint32_t sqrt_until(uint32_t result)
{
    mpfr_t v;
    middle_below(v, result + 1);
    mpfr_sqr(v, v, MPFR_RNDN);
    mpfr_div_2ui(v, v, 16, MPFR_RNDN); /* exact, and never an integer */
    return whole(v);
}

static bool run_of(fx_t (*f)(fx_t), bool negative, uint32_t from, uint32_t to, fx_t result, uint32_t *wrong)
{
    for (uint32_t a = from;; a++) {
        const uint32_t raw = negative ? 0u - a : a;
        if (f((fx_t)raw) != result) {
            *wrong = raw;
            return false;
        }
        if (a == to) {
            return true;
        }
    }
}

/* Follows a falling function of the magnitude a, from..to, run by run. */
static bool falling(fx_t (*f)(fx_t), uint32_t (*until)(uint32_t), bool negative, uint32_t from, uint32_t to,
                    uint32_t *wrong)
{
    while (from <= to) {
        const fx_t result = f((fx_t)(negative ? 0u - from : from));
        const uint32_t size = negative ? 0u - (uint32_t)result : (uint32_t)result;
        const uint32_t limit = size == 0 ? 0 : until(size);
        const uint32_t before = until(size + 1);
        *wrong = negative ? 0u - from : from;
        if (from > limit || from <= before) {
            return false;
        }
        const uint32_t end = limit < to ? limit : to;
        if (!run_of(f, negative, from, end, result, wrong)) {
            return false;
        }
        from = end + 1;
    }
    return true;
}

/* Magnitudes of a range that does not cross 0 (or FX_MIN); `first` of 0, 1 and 2 is left to the caller. */
static bool check_rcp(struct range r, uint32_t *wrong)
{
    const bool negative = r.first >> 31 != 0;
    uint32_t from = negative ? 0u - r.last : r.first;
    const uint32_t to = negative ? 0u - r.first : r.last;
    for (; from <= 2; from++) {
        const uint32_t raw = negative ? 0u - from : from;
        if (fx_rcp_sat((fx_t)raw) != oracle_rcp((int32_t)raw)) {
            *wrong = raw;
            return false;
        }
    }
    return falling(fx_rcp_sat, rcp_until, negative, from, to, wrong);
}

static bool check_rsqrt(struct range r, uint32_t *wrong)
{
    if (r.first >> 31 != 0) {
        return run_of(fx_rsqrt_sat, false, r.first, r.last, FX_MAX, wrong);
    }
    if (r.first == 0) {
        *wrong = 0;
        if (fx_rsqrt_sat(0) != FX_MAX) {
            return false;
        }
        r.first = 1;
    }
    return falling(fx_rsqrt_sat, rsqrt_until, false, r.first, r.last, wrong);
}

static bool check_sqrt(struct range r, uint32_t *wrong)
{
    if (r.first >> 31 != 0) {
        return run_of(fx_sqrt, false, r.first, r.last, 0, wrong);
    }
    uint32_t from = r.first;
    while (from <= r.last) {
        const fx_t result = fx_sqrt((fx_t)from);
        *wrong = from;
        if (result < 0 || from > sqrt_until((uint32_t)result) ||
            (result > 0 && from <= sqrt_until((uint32_t)result - 1))) {
            return false;
        }
        const uint32_t limit = sqrt_until((uint32_t)result);
        const uint32_t end = limit < r.last ? limit : r.last;
        if (!run_of(fx_sqrt, false, from, end, result, wrong)) {
            return false;
        }
        from = end + 1;
    }
    return true;
}

/* ---- angles ------------------------------------------------------------------------------------------------ */

static bool periodic(fx_t (*f)(fx_t), const int32_t table[65536], struct range r, uint32_t *wrong)
{
    for (uint32_t a = r.first;; a++) {
        if (f((fx_t)a) != table[a & 0xffff]) {
            *wrong = a;
            return false;
        }
        if (a == r.last) {
            return true;
        }
    }
}

static bool check_sin(struct range r, uint32_t *wrong)
{
    return periodic(fx_sin, sines, r, wrong);
}

static bool check_cos(struct range r, uint32_t *wrong)
{
    return periodic(fx_cos, cosines, r, wrong);
}

static bool check_tan(struct range r, uint32_t *wrong)
{
    return periodic(fx_tan_sat, tangents, r, wrong);
}

struct rotor {
    long double s, c; /* times 2^30 */
};

static struct rotor rotor_at(uint32_t turn32, long double scale)
{
    mpfr_t v, c;
    oracle_angle(v, turn32, 32);
    mpfr_init2(c, ORACLE_BITS);
    mpfr_sin_cos(v, c, v, MPFR_RNDN);
    const struct rotor r = {mpfr_get_ld(v, MPFR_RNDN) * scale, mpfr_get_ld(c, MPFR_RNDN) * scale};
    mpfr_clears(v, c, (mpfr_ptr)0);
    return r;
}

static long double distance(long double a, long double b)
{
    return a > b ? a - b : b - a;
}

static _Atomic uint32_t worst_sincos; /* 2^-24 LSB */

static void keep_worst(uint32_t v)
{
    uint32_t was = atomic_load(&worst_sincos);
    while (v > was && !atomic_compare_exchange_weak(&worst_sincos, &was, v)) {
    }
}

static bool check_sincos_q30(struct range r, uint32_t *wrong)
{
    const long double bound = SINCOS_Q30_BOUND - 0x1p-20L; /* what 4096 rotations may be off */
    const struct rotor step = rotor_at(1, 1.0L);
    long double worst = 0;
    struct rotor v = {0, 0};
    for (uint32_t a = r.first;; a++) {
        int32_t s, c;
        if (a % RESEED == 0) {
            v = rotor_at(a, 0x1p30L);
        }
        fx_sincos_q30(a, &s, &c);
        const long double es = distance((long double)s, v.s), ec = distance((long double)c, v.c);
        worst = es > worst ? es : worst;
        worst = ec > worst ? ec : worst;
        if (worst > bound) {
            *wrong = a;
            return false;
        }
        if (a == r.last) {
            keep_worst((uint32_t)(worst * 0x1p24L));
            return true;
        }
        v = (struct rotor){v.s * step.c + v.c * step.s, v.c * step.c - v.s * step.s};
    }
}

/* All quotients y / 2^30 by the code: (y, 2^30) below the diagonal; the staircase's steps by MPFR. Mirrored by sign
 * bits. */
static bool check_atan2(struct range r, uint32_t *wrong)
{
    const int32_t x = (r.first >> 30 & 1) != 0 ? -(1 << 30) : 1 << 30;
    const bool negative = r.first >> 31 != 0;
    const uint32_t mask = ((uint32_t)1 << 30) - 1;
    uint32_t y = r.first & mask;
    const uint32_t last = r.last & mask;
    while (y <= last) {
        const int32_t sign = negative ? -1 : 1;
        const int32_t expected = oracle_atan2(sign * (int32_t)y, x);
        uint32_t same = y; /* the last that MPFR says has this angle: by doubling, then halving the step */
        for (uint32_t up = 1 << 20; up != 0; up >>= 1) {
            while (last - same >= up && oracle_atan2(sign * (int32_t)(same + up), x) == expected) {
                same += up;
            }
        }
        for (; y <= same; y++) {
            if (fx_atan2(sign * (int32_t)y, x) != expected) {
                *wrong = y | (r.first & ~mask);
                return false;
            }
        }
    }
    return true;
}

/* ---- exact in integers ------------------------------------------------------------------------------------- */

static bool check_turn32_from_deg(struct range r, uint32_t *wrong)
{
    for (uint32_t a = r.first;; a++) {
        if (fx_turn32_from_deg((fx_t)a) != oracle_turn32_from_deg((int32_t)a)) {
            *wrong = a;
            return false;
        }
        if (a == r.last) {
            return true;
        }
    }
}

/* The quotient q by q d <= 2^62 < (q + 1) d; d has its first bit set and is w shifted. */
static bool check_rcp_norm(struct range r, uint32_t *wrong)
{
    const uint64_t one = (uint64_t)1 << 62;
    for (uint32_t w = r.first;; w++) {
        int shift;
        const uint64_t q = fx_rcp_norm(w, &shift);
        const uint32_t v = w != 0 ? w : 1;
        const uint32_t d = v << shift;
        if (d >> 31 == 0 || d >> shift != v || q * d > one || q * d + d <= one || fx_rcp_newton(d) != q) {
            *wrong = w;
            return false;
        }
        if (w == r.last) {
            return true;
        }
    }
}

static bool check_clz32(struct range r, uint32_t *wrong)
{
    for (uint32_t w = r.first;; w++) {
        const int zeros = fx_clz32(w);
        const bool right = w == 0 ? zeros == 32 : (w << zeros) >> 31 == 1 && w >> (31 - zeros) == 1;
        if (!right || armv6m_clz32(w) != zeros) {
            *wrong = w;
            return false;
        }
        if (w == r.last) {
            return true;
        }
    }
}

static bool check_text(struct range r, uint32_t *wrong)
{
    for (uint32_t a = r.first;; a++) {
        char text[FX_TEXT_SIZE];
        fx_t back = 0;
        const char *end;
        const int length = fx_to_text((fx_t)a, text);
        if (fx_from_text(text, &back, &end) != 0 || back != (fx_t)a || end != text + length || *end != '\0') {
            *wrong = a;
            return false;
        }
        if (a == r.last) {
            return true;
        }
    }
}

/* ---- running ----------------------------------------------------------------------------------------------- */

static const struct check checks[] = {
    {"clz32", check_clz32},
    {"rcp_norm", check_rcp_norm},
    {"rcp_sat", check_rcp},
    {"sqrt", check_sqrt},
    {"rsqrt_sat", check_rsqrt},
    {"turn32_from_deg", check_turn32_from_deg},
    {"sin", check_sin},
    {"cos", check_cos},
    {"tan_sat", check_tan},
    {"sincos_q30", check_sincos_q30},
    {"atan2_of_quotient", check_atan2},
    {"text_round_trip", check_text},
};

int main(int argc, char **argv)
{
    for (int32_t i = 0; i < 65536; i++) {
        sines[i] = oracle_sin(i);
        cosines[i] = oracle_cos(i);
        tangents[i] = oracle_tan(i);
    }
    const int status = exhaustive_main(argc, argv, checks, sizeof checks / sizeof checks[0]);
    if (worst_sincos != 0) {
        printf("# sincos_q30: at most %.6f LSB\n", (double)worst_sincos / 0x1p24);
    }
    return status;
}
