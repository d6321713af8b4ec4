/*
 * fx_math.h is compared with MPFR and 128-bit integers on edge values and a dense sample, its tables with their
 * formulas. exhaustive_fx_math.c takes every input.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <mpfr.h>

#include "fx_math.h"
#include "fx_inputs.h"
#include "fx_oracle.h"
#include "fx_wide.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define COUNT(a) (sizeof(a) / sizeof((a)[0]))
#define STRIDE   40009 /* of the sample; a prime, 107,000 inputs */

/* ---- inputs ------------------------------------------------------------------------------------------------ */

static int make_edges(void **state)
{
    (void)state;
    add_bit_edges();
    for (int64_t whole = 3; whole <= 20; whole++) {
        add_edge(whole * FX_ONE);
        add_edge(-whole * FX_ONE);
    }
    assert_true(edge_count > 200 && edge_count < EDGES_MOST);
    return 0;
}

static void same(const char *name, int32_t a, int32_t b, int64_t got, int64_t expected)
{
    if (got != expected) {
        fail_msg("%s(%d, %d) is %lld, not %lld", name, a, b, (long long)got, (long long)expected);
    }
}

static int32_t clamp(__int128 v)
{
    return v > INT32_MAX ? INT32_MAX : v < INT32_MIN ? INT32_MIN : (int32_t)v;
}

static void unary_agrees(const char *name, fx_t (*f)(fx_t), int32_t (*oracle)(int32_t))
{
    for (size_t i = 0; i < edge_count; i++) {
        same(name, edges[i], 0, f(edges[i]), oracle(edges[i]));
    }
    for (int32_t a = FX_INT(-19); a <= FX_INT(17); a += 37) {
        same(name, a, 0, f(a), oracle(a));
    }
    for (int64_t a = INT32_MIN; a <= INT32_MAX; a += STRIDE) {
        same(name, (int32_t)a, 0, f((fx_t)a), oracle((int32_t)a));
    }
}

/* ---- tables ------------------------------------------------------------------------------------------------ */

/* round(f(num / den) 2^bits) of one of MPFR's functions, or of -f. */
static uint64_t entry(int (*f)(mpfr_t, const mpfr_t, mpfr_rnd_t), bool negative, long num, int den_bits, int bits)
{
    mpfr_t v;
    mpfr_init2(v, ORACLE_BITS);
    mpfr_set_si_2exp(v, num, -den_bits, MPFR_RNDN);
    f(v, v, MPFR_RNDN);
    mpfr_mul_2ui(v, v, (unsigned long)bits, MPFR_RNDN);
    if (negative) {
        mpfr_neg(v, v, MPFR_RNDN);
    }
    mpfr_rint(v, v, MPFR_RNDN);
    const uint64_t result = mpfr_get_uj(v, MPFR_RNDN);
    mpfr_clear(v);
    return result;
}

static void tables_are_what_their_formulas_give(void **state)
{
    (void)state;
    for (int i = 0; i < 16; i++) {
        assert_true(fx_exp2_coarse[i] == entry(mpfr_exp2, false, i, 4, 63));
        assert_true(fx_exp2_fine[i] == entry(mpfr_exp2, false, i, 8, 63));
        assert_int_equal(fx_log_factor_first[i], (64 * 16 + 15 + i) / (16 + i));
        assert_true(fx_log_first[i] == entry(mpfr_log2, true, fx_log_factor_first[i], 6, 64));
    }
    for (int i = 0; i < 19; i++) {
        assert_int_equal(1024 - fx_log_factor_second[i], (1024 * 256 + 255 + i) / (256 + i));
        assert_true(fx_log_second[i] == entry(mpfr_log2, true, 1024 - fx_log_factor_second[i], 10, 64));
    }
    for (int i = 0; i < 256;
         i++) { /* the middle of d = 2^31 + i 2^23 and the next; 2^43 / d = 2^21 / (512 + 2 i + 1) */
        assert_int_equal(fx_rcp_table[i], (2 * (1 << 21) / (513 + 2 * i) + 1) / 2);
    }
    mpfr_t e;
    mpfr_init2(e, ORACLE_BITS);
    mpfr_set_ui(e, 1, MPFR_RNDN);
    mpfr_exp(e, e, MPFR_RNDN);
    mpfr_log2(e, e, MPFR_RNDN);
    mpfr_mul_2ui(e, e, 58, MPFR_RNDN);
    mpfr_rint(e, e, MPFR_RNDN);
    assert_true(FX_LOG2_E_Q58 == mpfr_get_sj(e, MPFR_RNDN));
    mpfr_clear(e);
}

/* ---- powers and logarithms --------------------------------------------------------------------------------- */

static void exponentials_are_the_nearest(void **state)
{
    (void)state;
    unary_agrees("exp2_sat", fx_exp2_sat, oracle_exp2);
    unary_agrees("exp_sat", fx_exp_sat, oracle_exp);
    assert_int_equal(fx_exp2_sat(FX_INT(-17)), 1); /* a tie */
    assert_int_equal(fx_exp2_sat(FX_INT(-17) - 1), 0);
    assert_int_equal(fx_exp2_sat(FX_INT(15)), FX_MAX);
    assert_int_equal(fx_exp_sat(FX_ONE), 178145); /* e */
}

static void hyperbolics_are_the_nearest(void **state)
{
    (void)state;
    unary_agrees("sinh_sat", fx_sinh_sat, oracle_sinh);
    unary_agrees("cosh_sat", fx_cosh_sat, oracle_cosh);
    unary_agrees("tanh", fx_tanh, oracle_tanh);
    for (int32_t off = -50; off <= 50; off++) { /* where they begin to saturate, and where the tangent becomes 1 */
        for (int side = -1; side <= 1; side += 2) {
            same("sinh_sat", side * (726817 + off), 0, fx_sinh_sat(side * (726817 + off)),
                 oracle_sinh(side * (726817 + off)));
            same("cosh_sat", side * (726817 + off), 0, fx_cosh_sat(side * (726817 + off)),
                 oracle_cosh(side * (726817 + off)));
            same("tanh", side * (408834 + off), 0, fx_tanh(side * (408834 + off)), oracle_tanh(side * (408834 + off)));
        }
    }
}

static void logarithms_are_the_nearest(void **state)
{
    (void)state;
    unary_agrees("log2_sat", fx_log2_sat, oracle_log2);
    unary_agrees("log_sat", fx_log_sat, oracle_log);
    for (int bit = 0; bit < 31; bit++) {
        assert_int_equal(fx_log2_sat((fx_t)1 << bit), FX_INT(bit - 16));
    }
    assert_int_equal(fx_log_sat(0), FX_MIN);
    assert_int_equal(fx_log2_sat(-1), FX_MIN);
}

/* |x|^y within (1/2 + 2^-7) LSB, and its sign. */
static void power_agrees(int32_t x, int32_t y)
{
    const fx_t got = fx_pow_sat(x, y);
    mpfr_t base, v;
    oracle_load(base, x);
    oracle_load(v, y);
    mpfr_pow(v, base, v, MPFR_RNDN);
    mpfr_mul_2ui(v, v, 16, MPFR_RNDN);
    if (mpfr_nan_p(v)) {
        same("pow_sat", x, y, got, 0);
    } else if (mpfr_cmp_si(v, INT32_MAX) >= 0 || mpfr_cmp_si(v, INT32_MIN) <= 0) {
        same("pow_sat", x, y, got, mpfr_sgn(v) > 0 ? FX_MAX : FX_MIN);
    } else {
        mpfr_sub_si(v, v, got, MPFR_RNDN);
        const double error = mpfr_get_d(v, MPFR_RNDN);
        if (error > 0.5 + 1. / 128 || error < -0.5 - 1. / 128) {
            fail_msg("pow_sat(%d, %d) is %d, off by %g LSB", x, y, got, error);
        }
    }
    mpfr_clears(base, v, (mpfr_ptr)0);
}

static void powers_keep_their_bound(void **state)
{
    (void)state;
    for (size_t i = 0; i < edge_count; i++) {
        for (size_t j = 0; j < edge_count; j++) {
            power_agrees(edges[i], edges[j]);
        }
    }
    for (int i = 0; i < 100000; i++) {
        power_agrees(noise_any(), noise_any());
        power_agrees(FX_ONE + (noise_any() >> 12), noise_any()); /* near one, where large powers fit */
    }
    for (int32_t n = 2; n < 16; n++) { /* exact ones: n^k */
        for (int64_t k = 0, power = 1; power <= 32767; k++, power *= n) {
            same("pow_sat", n, (int32_t)k, fx_pow_sat(FX_INT(n), FX_INT(k)), power * FX_ONE);
            same("pow_sat", -n, (int32_t)k, fx_pow_sat(FX_INT(-n), FX_INT(k)), (k % 2 != 0 ? -power : power) * FX_ONE);
        }
    }
    assert_int_equal(fx_pow_sat(0, 0), FX_ONE);
    assert_int_equal(fx_pow_sat(0, -1), FX_MAX);
    assert_int_equal(fx_pow_sat(-FX_ONE, FX_HALF), 0);
    assert_int_equal(fx_pow_sat(FX_MIN, FX_ONE), FX_MIN);
}

/* ---- roots ------------------------------------------------------------------------------------------------- */

static void root_is_the_floor(uint64_t v)
{
    const uint64_t root = fx_sqrt_u64(v);
    if (root * root > v || v - root * root > 2 * root) {
        fail_msg("sqrt_u64(%llu) is %llu", (unsigned long long)v, (unsigned long long)root);
    }
}

static void integer_root_is_the_floor(void **state)
{
    (void)state;
    for (uint64_t v = 0; v < 100000; v++) {
        root_is_the_floor(v);
        root_is_the_floor(UINT64_MAX - v);
    }
    for (int i = 0; i < 1000000; i++) { /* around squares, where it steps */
        const uint64_t root = noise() >> (noise() % 32), square = root * root;
        root_is_the_floor(square);
        root_is_the_floor(square - (square != 0));
        root_is_the_floor(square + 2 * root);
    }
}

static void hypot_agrees(int32_t x, int32_t y)
{
    const unsigned __int128 sum = 4 * ((unsigned __int128)((__int128)x * x) + (unsigned __int128)((__int128)y * y));
    const fx_t got = fx_hypot_sat(x, y);
    const unsigned __int128 low =
        (unsigned __int128)(2 * (__int128)got - 1) * (unsigned __int128)(2 * (__int128)got - 1);
    const unsigned __int128 high =
        (unsigned __int128)(2 * (__int128)got + 1) * (unsigned __int128)(2 * (__int128)got + 1);
    if (got < 0 || (got > 0 && sum < low) || (sum > high && got != FX_MAX)) {
        fail_msg("hypot_sat(%d, %d) is %d", x, y, got);
    }
}

static void length_in_the_plane_is_the_nearest(void **state)
{
    (void)state;
    for (size_t i = 0; i < edge_count; i++) {
        for (size_t j = 0; j < edge_count; j++) {
            hypot_agrees(edges[i], edges[j]);
        }
    }
    for (int i = 0; i < 500000; i++) {
        hypot_agrees(noise_any(), noise_any());
    }
    assert_int_equal(fx_hypot_sat(FX_INT(3), FX_INT(-4)), FX_INT(5));
    assert_int_equal(fx_hypot_sat(FX_MIN, 0), FX_MAX);
}

/* ---- angles ------------------------------------------------------------------------------------------------ */

static void every_arc_is_the_nearest(void **state)
{
    (void)state;
    for (int32_t a = -FX_ONE - 2; a <= FX_ONE + 2; a++) {
        same("asin", a, 0, fx_asin(a), oracle_asin(a));
        same("acos", a, 0, fx_acos(a), oracle_acos(a));
    }
    assert_int_equal(fx_asin(FX_MAX), FX_ONE / 4);
    assert_int_equal(fx_acos(FX_MIN), FX_ONE / 2);
}

static void radians_agree(int32_t a)
{
    same("turns_from_rad", a, 0, fx_turns_from_rad(a), oracle_radians(a, -1, 16));
    same("rad_from_turns_sat", a, 0, fx_rad_from_turns_sat(a), clamp(oracle_radians(a, 1, 16)));
    const uint32_t turn32 = fx_turn32_from_rad(a);
    const uint32_t off = turn32 - (uint32_t)oracle_radians(a, -1, 32);
    assert_true(off + 1 <= 2); /* 2^-19 LSB can turn the rounding over; exhaustive_fx_math.c has the bound */
}

static void radians_become_the_nearest_angle_and_back(void **state)
{
    (void)state;
    for (size_t i = 0; i < edge_count; i++) {
        radians_agree(edges[i]);
    }
    for (int64_t a = INT32_MIN; a <= INT32_MAX; a += STRIDE) {
        radians_agree((int32_t)a);
    }
    assert_int_equal(fx_turns_from_rad(205887), FX_HALF); /* pi */
}

static void scale_of_every_1000th_field_of_view_keeps_its_bound(void **state)
{
    (void)state;
    for (size_t i = 0; i < edge_count; i++) {
        assert_true(oracle_is_cot_half(edges[i], fx_cot_half_q20(edges[i])));
    }
    for (int32_t deg = 1; deg < FX_INT(180); deg += deg < 70000 ? 3 : 997) {
        assert_true(oracle_is_cot_half(deg, fx_cot_half_q20(deg)));
    }
    assert_int_equal(fx_cot_half_q20(FX_INT(90)), 1 << 20);
}

/* ---- whole numbers, remainders, formats -------------------------------------------------------------------- */

static void whole_numbers_are_next_to_a(void **state)
{
    static const struct {
        fx_t a, floor, ceil, round;
    } known[] = {
        {0, 0, 0, 0},
        {1, 0, FX_ONE, 0},
        {-1, -FX_ONE, 0, 0},
        {FX_HALF, 0, FX_ONE, FX_ONE},
        {-FX_HALF, -FX_ONE, 0, 0},
        {-FX_HALF - 1, -FX_ONE, 0, -FX_ONE},
        {FX_MIN, FX_MIN, FX_MIN, FX_MIN},
        {FX_MAX, FX_INT(32767), FX_MAX, FX_MAX},
        {FX_INT(32767), FX_INT(32767), FX_INT(32767), FX_INT(32767)},
        {FX_INT(32767) + 1, FX_INT(32767), FX_MAX, FX_INT(32767)},
    };
    (void)state;
    for (size_t i = 0; i < COUNT(known); i++) {
        same("floor", known[i].a, 0, fx_floor(known[i].a), known[i].floor);
        same("ceil_sat", known[i].a, 0, fx_ceil_sat(known[i].a), known[i].ceil);
        same("round_sat", known[i].a, 0, fx_round_sat(known[i].a), known[i].round);
    }
}

static void remainder_agrees(int32_t a, int32_t b)
{
    const uint32_t n = (uint32_t)a, d = (uint32_t)b;
    if (d > 1) {
        same("quotient_rcp", a, b, fx_quotient_rcp(n, d), n / d);
    }
    if (d > 0) {
        same("quotient_far", a, b, fx_quotient_far(n, d), n / d);
    }
    same("fmod", a, b, fx_fmod(a, b), b == 0 ? 0 : (int64_t)a % b);
}

static void remainders_are_exact(void **state)
{
    (void)state;
    for (size_t i = 0; i < edge_count; i++) {
        for (size_t j = 0; j < edge_count; j++) {
            remainder_agrees(edges[i], edges[j]);
        }
    }
    for (int i = 0; i < 500000; i++) {
        const int32_t b = noise_any();
        remainder_agrees(noise_any(), b);
        remainder_agrees((int32_t)((uint32_t)b * (noise() % 9)), b); /* multiples */
    }
}

static void limits_are_the_nearer_bound(void **state)
{
    (void)state;
    assert_true(fx_min(-1, 1) == -1 && fx_min(1, -1) == -1 && fx_max(-1, 1) == 1 && fx_max(1, -1) == 1);
    assert_int_equal(fx_clamp(5, -1, 3), 3);
    assert_int_equal(fx_clamp(-5, -1, 3), -1);
    assert_int_equal(fx_clamp(2, -1, 3), 2);
}

static void conversion_agrees(int32_t a, int from, int to)
{
    /* In 2^-33 of the result, exact. */
    const __int128 twice = (((__int128)a * ((__int128)1 << 33)) >> from) * ((__int128)1 << to);
    const int32_t expected = clamp((twice + ((__int128)1 << 32)) >> 33);
    if (fx_convert_sat(a, from, to) != expected) {
        fail_msg("convert_sat(%d, %d, %d) is not %d", a, from, to, expected);
    }
}

static void formats_convert_to_the_nearest(void **state)
{
    (void)state;
    for (int from = 0; from < 32; from++) {
        for (int to = 0; to < 32; to++) {
            for (size_t i = 0; i < edge_count; i++) {
                conversion_agrees(edges[i], from, to);
            }
        }
    }
    assert_int_equal(fx_convert_sat(FX_ONE, 16, 30), FX_Q30_ONE);
    assert_int_equal(fx_convert_sat(FX_INT(2), 16, 30), INT32_MAX);
    assert_int_equal(fx_convert_sat(FX_INT(-2), 16, 30), INT32_MIN);
    assert_int_equal(fx_convert_sat((1 << 24) + 128, 24, 16), FX_ONE + 1); /* a tie */
    for (size_t i = 0; i < edge_count; i++) {
        assert_int_equal(fx_from_q30(edges[i]), fx_convert_sat(edges[i], 30, 16));
        assert_int_equal(fx_to_q30_sat(edges[i]), fx_convert_sat(edges[i], 16, 30));
    }
}

/* ---- text -------------------------------------------------------------------------------------------------- */

/* The text of round(a 10^places / 2^16), from 128-bit integers. */
static void rounded_text_agrees(int32_t a, int places)
{
    char got[FX_TEXT_SIZE], expected[64];
    unsigned __int128 ten = 1;
    for (int i = 0; i < places; i++) {
        ten *= 10;
    }
    const __int128 twice = (__int128)a * (__int128)ten * 2 + 65536;
    const __int128 nearest = twice >= 0 ? twice / 131072 : -((-twice + 131071) / 131072);
    const unsigned __int128 size = (unsigned __int128)(nearest < 0 ? -nearest : nearest);
    int n = snprintf(expected, sizeof expected, "%s%d", nearest < 0 ? "-" : "", (int)(size / ten));
    if (places > 0) {
        snprintf(expected + n, sizeof expected - (size_t)n, ".%0*llu", places, (unsigned long long)(size % ten));
    }
    n = fx_to_text_rounded(a, places, got);
    assert_string_equal(got, expected);
    assert_int_equal(n, strlen(got));
}

static void rounded_text_is_the_nearest_at_every_number_of_places(void **state)
{
    char text[FX_TEXT_SIZE];
    (void)state;
    for (int places = 0; places <= 16; places++) {
        for (size_t i = 0; i < edge_count; i++) {
            rounded_text_agrees(edges[i], places);
        }
        for (int32_t a = -65540; a <= 65540; a += 3) { /* every third fraction */
            rounded_text_agrees(a, places);
        }
        for (int i = 0; i < 10000; i++) {
            rounded_text_agrees(noise_any(), places);
        }
    }
    static const struct {
        fx_t a;
        int places;
        const char *text;
    } known[] = {
        {FX_INT(5) / 2, 0, "3"},
        {-FX_INT(5) / 2, 0, "-2"},
        {-FX_HALF, 0, "0"},
        {-1, 2, "0.00"},
        {FX_MAX, 2, "32768.00"},
        {FX_MIN, 1, "-32768.0"},
        {FX_INT(10) - 1, 3, "10.000"},
        {FX_ONE / 8, 2, "0.13"},
        {-FX_ONE / 8, 2, "-0.12"},
        {FX_ONE, -7, "1"},
        {FX_HALF, 99, "0.5000000000000000"},
        {FX_MIN + 1, 16, "-32767.9999847412109375"},
    };
    for (size_t i = 0; i < COUNT(known); i++) {
        fx_to_text_rounded(known[i].a, known[i].places, text);
        assert_string_equal(text, known[i].text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_are_what_their_formulas_give),
        cmocka_unit_test(exponentials_are_the_nearest),
        cmocka_unit_test(hyperbolics_are_the_nearest),
        cmocka_unit_test(logarithms_are_the_nearest),
        cmocka_unit_test(powers_keep_their_bound),
        cmocka_unit_test(integer_root_is_the_floor),
        cmocka_unit_test(length_in_the_plane_is_the_nearest),
        cmocka_unit_test(every_arc_is_the_nearest),
        cmocka_unit_test(radians_become_the_nearest_angle_and_back),
        cmocka_unit_test(scale_of_every_1000th_field_of_view_keeps_its_bound),
        cmocka_unit_test(whole_numbers_are_next_to_a),
        cmocka_unit_test(remainders_are_exact),
        cmocka_unit_test(limits_are_the_nearer_bound),
        cmocka_unit_test(formats_convert_to_the_nearest),
        cmocka_unit_test(rounded_text_is_the_nearest_at_every_number_of_places),
    };
    return cmocka_run_group_tests(tests, make_edges, NULL);
}
