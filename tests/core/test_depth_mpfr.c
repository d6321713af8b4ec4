/*
 * The depth lab is compared with arbitrary precision. All codes, S_eff, S_worst and pair counts are computed again from
 * the definitions in depth.h and lab.h, in rational numbers (GMP) and MPFR, by other methods (inverse functions, whole
 * arrays), on a grid of near and far planes and for all formats.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>

#include "depth.h"
#include "lab.h"
#include "lab_search.h"

#include <gmp.h>
#include <math.h>
#include <mpfr.h>
#include <stdlib.h>
#include <string.h>

struct planes {
    double near_z, far_z;
};

static const struct planes grid[] = {{.1, 1000}, {.5, 100}, {1, 1000}, {.01, 20000}, {5, 7}, {.1, 3}};
#define GRID (sizeof grid / sizeof grid[0])

static fx_t fx_of(double m)
{
    return (fx_t)(m * 65536 + .5);
}

/* ---- exact codes --------------------------------------------------------------------------------------------- */

/* Numbers that stay allocated over a test. */
struct exact {
    const struct lab_format *format;
    fx_t near_z, far_z;
    mpq_t code, d, term;
    mpz_t whole, part;
    mpfr_t log, range, ratio;
    /*
     * How far the drawn code of the last w may be from its definition before it is rounded down: N/w is good to
     * 2^-29 of itself, and the last bits of 32 are lost.
     */
    double doubt;
};

static void exact_open(struct exact *e, const struct lab_format *format, fx_t near_z, fx_t far_z)
{
    *e = (struct exact){.format = format, .near_z = near_z, .far_z = far_z};
    mpq_inits(e->code, e->d, e->term, NULL);
    mpz_inits(e->whole, e->part, NULL);
    mpfr_inits2(160, e->log, e->range, e->ratio, NULL);
    mpfr_set_si(e->ratio, far_z, MPFR_RNDN);
    mpfr_div_si(e->ratio, e->ratio, near_z, MPFR_RNDN);
    mpfr_log(e->range, e->ratio, MPFR_RNDN);
}

static void exact_close(struct exact *e)
{
    mpq_clears(e->code, e->d, e->term, NULL);
    mpz_clears(e->whole, e->part, NULL);
    mpfr_clears(e->log, e->range, e->ratio, NULL);
}

/* q = numerator / denominator of products that may pass 64 bits. */
static void set_ratio(mpq_t q, int64_t a, int64_t b, int64_t c, int64_t d)
{
    mpz_set_si(mpq_numref(q), a);
    mpz_mul_si(mpq_numref(q), mpq_numref(q), b);
    mpz_set_si(mpq_denref(q), c);
    mpz_mul_si(mpq_denref(q), mpq_denref(q), d);
    mpq_canonicalize(q);
}

/* q = q 2^up + add / 2^16 */
static void scale_add(struct exact *e, int up, int64_t add_q16)
{
    e->doubt = ldexp(1, up - 29);
    if (up >= 0) {
        mpq_mul_2exp(e->code, e->d, (mp_bitcnt_t)up);
    } else {
        mpq_div_2exp(e->code, e->d, (mp_bitcnt_t)-up);
    }
    mpq_set_si(e->term, add_q16, 65536);
    mpq_canonicalize(e->term);
    mpq_add(e->code, e->code, e->term);
}

/* A float's bits of exponent, 0 for other formats: the rule of render.h. */
static int bits_of(const struct exact *e)
{
    const bool is_float = e->format->format->coding == PH_DEPTH_IS_FLOAT;
    const int64_t ratio_up = ((int64_t)e->far_z + e->near_z - 1) / e->near_z;
    return !is_float                  ? 0
           : e->format->exponent != 0 ? e->format->exponent
           : ratio_up <= 64           ? 3
           : ratio_up <= 16384        ? 4
                                      : 5;
}

/* N of depth.h, in units of 2^-9 LSBs. */
static int64_t near512_of(const struct exact *e)
{
    const int bits = bits_of(e);
    return e->near_z * (int64_t)(bits > 4 ? 512 - (1 << (bits - 4)) : 511);
}

/* F of depth.h, in 16-bit codes. */
static void float_code(struct exact *e)
{
    int octave = 0;
    const int bits = bits_of(e), lowest = (1 << bits) - 2;
    mpq_set_si(e->term, 1, 2);
    while (octave < lowest && mpq_cmp(e->d, e->term) < 0) {
        octave++;
        mpq_div_2exp(e->term, e->term, 1);
    }
    scale_add(e, 17 - bits + octave, (int64_t)(lowest - octave) * (65536 >> bits) * 65536 + PH_DEPTH_BIAS_FLOAT16);
    e->doubt *= bits > 4 ? 2 : 1; /* N/f is as good, and so many octaves reach down to its last bits */
}

/* e->code: the code of a drawn format at w before it is rounded down. */
static void drawn_code(struct exact *e, fx_t w)
{
    const int64_t n = e->near_z, f = e->far_z;
    if (e->format->format->coding == PH_DEPTH_IS_LINEAR) {
        set_ratio(e->d, 511, f - w, 512, f - n);
        scale_add(e, 16, PH_DEPTH_BIAS_FIXED16 & 0xffff0000u);
        e->doubt = 1 / 1024.0;
        return;
    }
    set_ratio(e->d, near512_of(e), f - w, 512 * (int64_t)w, f);
    const bool is_float = e->format->format->coding == PH_DEPTH_IS_FLOAT;
    if (is_float) {
        float_code(e);
    } else { /* stretched over all codes */
        const int64_t range = f - n > f / 8 ? f - n : f / 8 + 1;
        set_ratio(e->term, f, 1, range, 1);
        mpq_mul(e->d, e->d, e->term);
        scale_add(e, 16, PH_DEPTH_BIAS_FIXED16);
        e->doubt *= (double)f / (double)range;
    }
    e->doubt *= (double)n / w;
    if (e->format->bits == 24) {
        mpq_mul_2exp(e->code, e->code, 8);
        e->doubt = e->doubt * 256 + 1 / 64.0;
    } else {
        e->doubt += 1 / 1024.0;
    }
}

/* a / b to the nearest, a tie up, in Q16.16, saturated. */
static int64_t nearest_q16(struct exact *e, int64_t a, int64_t b, int64_t c, int64_t d)
{
    set_ratio(e->d, a, b, c, d);
    mpq_set_si(e->term, 1, 2);
    mpq_add(e->d, e->d, e->term);
    mpz_fdiv_q(e->whole, mpq_numref(e->d), mpq_denref(e->d));
    return mpz_cmp_si(e->whole, INT32_MAX) > 0 ? INT32_MAX : mpz_get_si(e->whole);
}

/* What others do; lab.h. */
static uint32_t others_code(struct exact *e, fx_t w)
{
    const int64_t n = e->near_z, f = e->far_z, largest = ((int64_t)1 << e->format->bits) - 1;
    const int64_t scale = nearest_q16(e, f, 65536, f - n, 1), bias = nearest_q16(e, f, n, f - n, 1);
    const int64_t clip = nearest_q16(e, scale, w, 65536, 1) - bias;
    mpz_set_si(e->whole, clip);
    if (e->format->kind == LAB_NDC_Q16) {
        mpz_mul_2exp(e->whole, e->whole, 16);
        mpz_tdiv_q_ui(e->whole, e->whole, (unsigned long)w);
    } else if (e->format->kind == LAB_RECIP_Q16) {
        mpz_set_ui(e->part, 1);
        mpz_mul_2exp(e->part, e->part, 32);
        mpz_fdiv_q_ui(e->part, e->part, (unsigned long)w);
        mpz_mul(e->whole, e->whole, e->part);
        mpz_add_ui(e->whole, e->whole, 32768);
        mpz_fdiv_q_2exp(e->whole, e->whole, 16);
    } else { /* S clip / w to the nearest */
        mpz_mul_si(e->whole, e->whole, 2 * largest);
        mpz_add_ui(e->whole, e->whole, (unsigned long)w);
        mpz_fdiv_q_ui(e->whole, e->whole, 2 * (unsigned long)w);
    }
    if (e->format->kind != LAB_CLIP_Q16) {
        mpz_mul_2exp(e->whole, e->whole, (mp_bitcnt_t)(e->format->bits - 16));
    }
    const int64_t code = mpz_get_si(e->whole);
    return (uint32_t)(largest - (code < 0 ? 0 : code > largest ? largest : code));
}

static uint32_t log_code(struct exact *e, fx_t w)
{
    mpfr_set_si(e->log, e->far_z, MPFR_RNDN);
    mpfr_div_si(e->log, e->log, w, MPFR_RNDN);
    mpfr_log(e->log, e->log, MPFR_RNDN);
    mpfr_div(e->log, e->log, e->range, MPFR_RNDN);
    mpfr_mul_ui(e->log, e->log, ((unsigned long)1 << e->format->bits) - 1, MPFR_RNDN);
    return (uint32_t)mpfr_get_ui(e->log, MPFR_RNDD);
}

/* n/w as a float with 4 bits of exponent, rounded down: by comparing with powers of two. */
static uint32_t over_w_code(struct exact *e, fx_t w)
{
    const int mantissa = e->format->bits - 4;
    int octave = 0;
    while (octave < 14 && (int64_t)e->near_z << (octave + 1) < w) {
        octave++;
    }
    set_ratio(e->d, e->near_z, (int64_t)1 << octave, w, 1);
    mpq_mul_2exp(e->d, e->d, (mp_bitcnt_t)mantissa + 1);
    mpz_fdiv_q(e->whole, mpq_numref(e->d), mpq_denref(e->d));
    const uint32_t code = (uint32_t)mpz_get_ui(e->whole) + ((uint32_t)(14 - octave) << mantissa);
    const uint32_t largest = ((uint32_t)1 << e->format->bits) - 1;
    return code > largest ? largest : code;
}

/* The code at w, and whether a drawn one may also be its neighbour *other. */
static uint32_t exact_code(struct exact *e, fx_t w, uint32_t *other)
{
    uint32_t code;
    switch (e->format->kind) {
    case LAB_DRAWN:
        drawn_code(e, w);
        mpz_fdiv_q(e->whole, mpq_numref(e->code), mpq_denref(e->code));
        code = (uint32_t)mpz_get_ui(e->whole);
        const double past = mpq_get_d(e->code) - code;
        *other = past < e->doubt ? code - 1 : past > 1 - e->doubt ? code + 1 : code;
        return code;
    case LAB_LINEAR:
        set_ratio(e->d, ((int64_t)1 << e->format->bits) - 1, e->far_z - w, e->far_z - e->near_z, 1);
        mpz_fdiv_q(e->whole, mpq_numref(e->d), mpq_denref(e->d));
        code = (uint32_t)mpz_get_ui(e->whole);
        break;
    case LAB_OVER_W:
        code = over_w_code(e, w);
        break;
    case LAB_LOG:
        code = log_code(e, w);
        break;
    default:
        code = others_code(e, w);
        break;
    }
    *other = code;
    return code;
}

/* ---- codes ------------------------------------------------------------------------------------------------------ */

/* Calls check for each format and each pair of planes. */
static void for_each(void (*check)(struct exact *e, struct lab_probe *p))
{
    struct lab_probe *p = malloc(sizeof *p);
    assert_non_null(p);
    for (size_t g = 0; g < GRID; g++) {
        for (uint32_t i = 0; i < lab_format_count; i++) {
            struct exact e;
            exact_open(&e, &lab_formats[i], fx_of(grid[g].near_z), fx_of(grid[g].far_z));
            assert_int_equal(lab_probe_open(p, e.format, e.near_z, e.far_z), 0);
            check(&e, p);
            exact_close(&e);
        }
    }
    free(p);
}

static void check_code(struct exact *e, struct lab_probe *p, fx_t w)
{
    uint32_t other;
    const uint32_t code = exact_code(e, w, &other), drawn = lab_code(p, w);
    const double value = mpq_get_d(e->code), doubt = e->format->kind == LAB_DRAWN ? e->doubt : 0;
    if (drawn != code && (doubt == 0 || drawn < floor(value - doubt) || drawn > floor(value + doubt))) {
        fail_msg("%s %d bits, near %d far %d: code at %d is %u, exactly %u", e->format->name, e->format->bits,
                 (int)e->near_z, (int)e->far_z, (int)w, (unsigned)drawn, (unsigned)code);
    }
}

/* Both ends, each power of two and its neighbours, and a few thousand spread evenly over all magnitudes. */
static void check_codes(struct exact *e, struct lab_probe *p)
{
    uint64_t state = 1;
    for (int i = 0; i < 2000; i++) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        const fx_t w = (fx_t)((uint32_t)(state >> 33) >> (state & 15));
        if (w >= e->near_z && w <= e->far_z) {
            check_code(e, p, w);
        }
    }
    for (int64_t power = 1; power <= INT32_MAX; power *= 2) {
        for (int64_t w = power - 1; w <= power + 1; w++) {
            if (w >= e->near_z && w <= e->far_z) {
                check_code(e, p, (fx_t)w);
            }
        }
    }
    for (int i = 0; i < 200; i++) {
        check_code(e, p, e->near_z + i);
        check_code(e, p, e->far_z - i);
    }
}

static void codes_are_what_their_definition_says(void **state)
{
    (void)state;
    for_each(check_codes);
}

/* ---- S_eff ------------------------------------------------------------------------------------------------------ */

static uint32_t exact_floor(struct exact *e, fx_t w)
{
    uint32_t other;
    return exact_code(e, w, &other);
}

/* Length of the exact plateau on which w lies; *first, *last: its ends. By steps that double, then halve. */
static int64_t exact_plateau(struct exact *e, int64_t w, int64_t *first, int64_t *last)
{
    const uint32_t code = exact_floor(e, (fx_t)w);
    for (int side = -1; side <= 1; side += 2) {
        const int64_t end = side < 0 ? e->near_z : e->far_z;
        int64_t at = w, step = 1;
        while ((end - at) * side > 0 && step > 0) {
            const int64_t next = (end - at) * side < step ? end : at + side * step;
            if (exact_floor(e, (fx_t)next) == code) {
                at = next;
                step *= 2;
            } else {
                step = step > 1 ? ((next - at) * side) / 2 : 0;
            }
        }
        *(side < 0 ? first : last) = at;
    }
    return *last - *first + 1;
}

/* The plateau of w, or its neighbour where a plane cuts it. */
static int64_t exact_at(struct exact *e, int64_t w)
{
    int64_t first, last, other_first, other_last, length = exact_plateau(e, w, &first, &last);
    if (last == e->far_z && first > e->near_z) {
        const int64_t beside = exact_plateau(e, first - 1, &other_first, &other_last);
        length = beside > length ? beside : length;
    }
    if (first == e->near_z && last < e->far_z) {
        const int64_t beside = exact_plateau(e, last + 1, &other_first, &other_last);
        length = beside > length ? beside : length;
    }
    return length;
}

/* Within what doubtful codes can move both ends, on the plateau of z or one that such a code puts there. */
static bool plausible(struct exact *e, int64_t z, int64_t measured)
{
    exact_floor(e, (fx_t)z);
    const double doubt = e->doubt;
    const int64_t near_by = doubt > 0 ? (int64_t)(doubt * (double)measured) + 2 : 0;
    for (int side = -1; side <= 1; side++) {
        int64_t w = z + side * near_by;
        w = w < e->near_z ? e->near_z : w > e->far_z ? e->far_z : w;
        const int64_t length = exact_at(e, w);
        const int64_t slack = doubt > 0 ? (int64_t)(2 * doubt * (double)length) + 2 : 0;
        if (measured >= length - slack && measured <= length + slack) {
            return true;
        }
    }
    return false;
}

static void check_resolve(struct exact *e, struct lab_probe *p)
{
    struct lab_search *s = malloc(sizeof *s);
    assert_non_null(s);
    if (lab_is_monotone(e->format)) {
        lab_search_open(s, p);
        double z = e->near_z;
        for (int i = 0; i < 40; i++) {
            const fx_t w = z < e->far_z ? (fx_t)z : e->far_z;
            const uint32_t measured = lab_search_at(s, p, w);
            if (!plausible(e, w, measured)) {
                fail_msg("%s %d bits, near %d far %d: S_eff at %d is %u, exactly %d", e->format->name, e->format->bits,
                         (int)e->near_z, (int)e->far_z, (int)w, (unsigned)measured, (int)exact_at(e, w));
            }
            z *= 1.37;
        }
    }
    free(s);
}

static void the_plateaus_of_monotone_formats_are_exact(void **state)
{
    (void)state;
    for_each(check_resolve);
}

/* The largest w whose exact code, before it is rounded down, is `code` or more: by the inverse of depth.h. */
static int64_t inverse(const struct exact *e, uint32_t code)
{
    const bool is_float = e->format->format->coding == PH_DEPTH_IS_FLOAT;
    const double unit = e->format->bits == 24 ? 256 : 1;
    const double biased = code / unit - (is_float ? PH_DEPTH_BIAS_FLOAT16 : PH_DEPTH_BIAS_FIXED16) / 65536.0;
    double d = biased / 65536;
    if (is_float) {
        const int bits = bits_of(e), lowest = (1 << bits) - 2;
        int octave = lowest;
        while (octave > 0 && biased >= ldexp(lowest + 2 - octave, 16 - bits)) {
            octave--;
        }
        d = ldexp(biased - ldexp(lowest - octave, 16 - bits), bits - 17 - octave);
    }
    const double stretch = is_float ? 1 : fmin((double)e->far_z / (e->far_z - e->near_z), 8);
    const double near512 = stretch * (double)near512_of(e) / 512;
    return d <= 0 ? e->far_z : (int64_t)(near512 / (d + near512 / e->far_z));
}

/* S_worst from the inverse: the longest step between the distances at which each code begins. */
static int64_t exact_worst(const struct exact *e, uint32_t from, uint32_t to)
{
    int64_t worst = 0, before = e->far_z;
    for (uint32_t code = from; code <= to; code++) {
        const int64_t ends = inverse(e, code + 1);
        const int64_t first = ends < e->near_z - 1 ? e->near_z - 1 : ends;
        worst = before - first > worst ? before - first : worst;
        before = first;
    }
    return worst;
}

/* The 16-bit formats of w^-1, all codes; 24 bits where they are longest, at the far plane. */
static void check_worst(struct exact *e, struct lab_probe *p)
{
    if (e->format->kind != LAB_DRAWN || e->format->format->coding == PH_DEPTH_IS_LINEAR ||
        e->far_z - e->near_z > FX_INT(1000)) {
        return;
    }
    if (e->format->bits == 24 && (e->format->format->coding == PH_DEPTH_IS_FLOAT || e->far_z < FX_INT(1000))) {
        return;
    }
    struct lab_search *s = malloc(sizeof *s);
    assert_non_null(s);
    lab_search_open(s, p);
    const uint32_t low = lab_code(p, e->far_z), high = lab_code(p, e->near_z);
    const int64_t exact = exact_worst(e, low, e->format->bits == 24 ? low + 100000 : high);
    const int64_t measured = lab_search_worst(s, p),
                  slack = (int64_t)((double)exact / 8) / (e->format->bits == 24 ? 1 : 64) + 2;
    if (measured < exact - slack || measured > exact + slack) {
        fail_msg("%s: near %d far %d: S_worst is %d, exactly %d", e->format->name, (int)e->near_z, (int)e->far_z,
                 (int)measured, (int)exact);
    }
    free(s);
}

static void the_worst_separation_is_that_of_the_inverse_function(void **state)
{
    (void)state;
    for_each(check_worst);
}

/* ---- what is not monotone: whole arrays ----------------------------------------------------------------------------
 */

/* The largest j - i + 1, i <= i_max, j >= j_min, codes[j] >= codes[i]: for each i the furthest j, by its definition. */
static uint32_t brute_force(const uint32_t *codes, uint32_t n, uint32_t i_max, uint32_t j_min)
{
    uint32_t best = 0;
    for (uint32_t i = 0; i <= i_max; i++) {
        for (uint32_t j = n - 1; j > i + best && j >= j_min; j--) {
            if (codes[j] >= codes[i]) {
                best = j - i;
            }
        }
    }
    return best + 1;
}

static void check_search(const struct lab_format *format, fx_t near_z, fx_t far_z)
{
    struct exact e;
    struct lab_probe *p = malloc(sizeof *p);
    struct lab_search *s = malloc(sizeof *s);
    const uint32_t n = (uint32_t)(far_z - near_z) + 1;
    uint32_t *codes = malloc(n * sizeof *codes), other;
    assert_non_null(p);
    assert_non_null(s);
    assert_non_null(codes);
    exact_open(&e, format, near_z, far_z);
    assert_int_equal(lab_probe_open(p, format, near_z, far_z), 0);
    lab_search_open(s, p);
    for (uint32_t i = 0; i < n; i++) {
        codes[i] = format->kind == LAB_DRAWN ? lab_code(p, near_z + (fx_t)i) : exact_code(&e, near_z + (fx_t)i, &other);
    }
    assert_int_equal(lab_search_worst(s, p), brute_force(codes, n, n - 1, 0));
    for (uint32_t k = 1; k < 8 && !lab_is_monotone(format); k++) {
        const uint32_t i = (uint32_t)((uint64_t)(n - 1) * k / 8);
        assert_int_equal(lab_search_at(s, p, near_z + (fx_t)i), brute_force(codes, n, i, i));
    }
    exact_close(&e);
    free(codes);
    free(s);
    free(p);
}

static void searches_find_what_trying_every_pair_finds(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < lab_format_count; i++) {
        check_search(&lab_formats[i], 700, 9000);
        check_search(&lab_formats[i], 6554, 6554 + 7000);
        check_search(&lab_formats[i], 1, 5000);
    }
}

/* ---- pairs --------------------------------------------------------------------------------------------------------
 */

struct text {
    char bytes[65536];
    size_t length;
};

static void append(void *context, const char *text)
{
    struct text *to = context;
    const size_t n = strlen(text);
    assert_true(to->length + n < sizeof to->bytes);
    memcpy(to->bytes + to->length, text, n + 1);
    to->length += n;
}

/* Distance i of count + 1, by MPFR. */
static int64_t exact_distance(struct exact *e, uint8_t spacing, uint32_t i, uint32_t count)
{
    if (spacing == LAB_LINEAR_SPACED) {
        set_ratio(e->d, e->far_z - e->near_z, i, count, 1);
        mpq_set_si(e->term, 1, 2);
        mpq_add(e->d, e->d, e->term);
        mpz_fdiv_q(e->whole, mpq_numref(e->d), mpq_denref(e->d));
        return e->near_z + mpz_get_si(e->whole);
    }
    if (i == 0 || i == count) {
        return i == 0 ? e->near_z : e->far_z;
    }
    mpfr_mul_ui(e->log, e->range, i, MPFR_RNDN);
    mpfr_div_ui(e->log, e->log, count, MPFR_RNDN);
    mpfr_exp(e->log, e->log, MPFR_RNDN);
    mpfr_mul_si(e->log, e->log, e->near_z, MPFR_RNDN);
    return mpfr_get_si(e->log, MPFR_RNDU);
}

static void check_pairs_of(struct exact *e, uint8_t spacing, uint32_t count, const char *row)
{
    uint32_t equal = 0, swap = 0, doubtful = 0, *codes = malloc((count + 1) * sizeof *codes);
    int64_t wrong = 0, *z = malloc((count + 1) * sizeof *z);
    assert_non_null(codes);
    assert_non_null(z);
    for (uint32_t i = 0; i <= count; i++) {
        uint32_t other;
        z[i] = exact_distance(e, spacing, i, count);
        codes[i] = exact_code(e, (fx_t)z[i], &other);
        doubtful += other != codes[i];
        equal += i > 0 && codes[i] == codes[i - 1];
        swap += i > 0 && codes[i] > codes[i - 1];
    }
    for (uint32_t i = 0; i <= count; i++) { /* the furthest that is not below */
        uint32_t j = count;
        while (codes[j] < codes[i]) {
            j--;
        }
        wrong = j > i && z[j] - z[i] > wrong ? z[j] - z[i] : wrong;
    }
    const char *at = row;
    for (int comma = 0; comma < 6; comma++) {
        at = strchr(at, ',') + 1;
    }
    char *end;
    const unsigned long got_equal = strtoul(at, &end, 10);
    assert_true(end > at && *end == ',');
    at = end + 1;
    const unsigned long got_swap = strtoul(at, &end, 10);
    assert_true(end > at && *end == ',');
    at = end + 1;
    const double got_wrong = strtod(at, &end);
    assert_true(end > at);
    if (got_equal + 2 * doubtful < equal || got_equal > equal + 2 * doubtful || got_swap != swap) {
        fail_msg("%.60s: exactly %u equal (%u doubtful), %u swapped", row, (unsigned)equal, (unsigned)doubtful,
                 (unsigned)swap);
    }
    if (doubtful == 0) {
        assert_true(fabs(got_wrong - (double)wrong / 65536) <= 5e-6 * got_wrong);
    }
    free(codes);
    free(z);
}

static void check_pairs(struct exact *e, uint8_t spacing, uint32_t count)
{
    static struct text text;
    struct lab lab = {.near_z = e->near_z,
                      .far_z = e->far_z,
                      .formats = (uint32_t)1 << (e->format - lab_formats),
                      .count = count,
                      .spacing = spacing,
                      .put = append,
                      .context = &text};
    lab.memory_bytes = lab_bytes(&lab);
    lab.memory = malloc(lab.memory_bytes);
    assert_non_null(lab.memory);
    text.length = 0;
    assert_int_equal(lab_pairs(&lab), 0);
    check_pairs_of(e, spacing, count, strchr(text.bytes, '\n') + 1);
    free(lab.memory);
}

static void check_all_pairs(struct exact *e, struct lab_probe *p)
{
    (void)p;
    check_pairs(e, LAB_LINEAR_SPACED, 1000);
    check_pairs(e, LAB_LINEAR_SPACED, 777);
    check_pairs(e, LAB_LOG_SPACED, 500);
}

static void pair_counts_are_those_of_exact_codes(void **state)
{
    (void)state;
    for_each(check_all_pairs);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(codes_are_what_their_definition_says),
        cmocka_unit_test(the_plateaus_of_monotone_formats_are_exact),
        cmocka_unit_test(the_worst_separation_is_that_of_the_inverse_function),
        cmocka_unit_test(searches_find_what_trying_every_pair_finds),
        cmocka_unit_test(pair_counts_are_those_of_exact_codes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
