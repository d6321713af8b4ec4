/*
 * Arithmetic, roots and angles of fx.h are compared with MPFR and 128-bit integers, on all edge values and a dense
 * sample. exhaustive_fx.c takes every input.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <mpfr.h>

#include "fx.h"
#include "fx_armv6m.h"
#include "fx_inputs.h"
#include "fx_oracle.h"
#include "fx_tangent.h"

#include <stdbool.h>
#include <stdio.h>

#define COUNT(a) (sizeof(a) / sizeof((a)[0]))
#define STRIDE   10007 /* of the sample; a prime, 429,000 inputs */

/* ---- inputs ------------------------------------------------------------------------------------------------ */

static int make_edges(void **state)
{
    static const int32_t odd[] = {3,     5,     7,     10,      45,       97,         360,      46340,
                                  46341, 65521, 99991, 1000003, 16777213, 1431655765, 715827883};
    (void)state;
    add_bit_edges();
    for (size_t i = 0; i < COUNT(odd); i++) {
        add_edge(odd[i]);
        add_edge(-(int64_t)odd[i]);
    }
    assert_true(edge_count > 200 && edge_count < EDGES_MOST);
    return 0;
}

static void same(const char *name, int32_t a, int32_t b, int32_t got, int32_t expected)
{
    if (got != expected) {
        fail_msg("%s(%d, %d) is %d, not %d", name, a, b, got, expected);
    }
}

static void unary_agrees(const char *name, fx_t (*f)(fx_t), int32_t (*oracle)(int32_t))
{
    for (size_t i = 0; i < edge_count; i++) {
        same(name, edges[i], 0, f(edges[i]), oracle(edges[i]));
    }
    for (int32_t a = -5000; a <= 5000; a++) {
        same(name, a, 0, f(a), oracle(a));
    }
    for (int64_t a = INT32_MIN; a <= INT32_MAX; a += STRIDE) {
        same(name, (int32_t)a, 0, f((fx_t)a), oracle((int32_t)a));
    }
}

/* ---- 128-bit integers -------------------------------------------------------------------------------------- */

static int32_t clamp(__int128 v)
{
    return v > INT32_MAX ? INT32_MAX : v < INT32_MIN ? INT32_MIN : (int32_t)v;
}

/* floor(n / d + 1/2), d > 0. */
static __int128 nearest(__int128 n, __int128 d)
{
    const __int128 twice = 2 * n + d;
    return twice / (2 * d) - (twice % (2 * d) < 0);
}

static int32_t exact_mul(int32_t a, int32_t b)
{
    return clamp(nearest((__int128)a * b, 65536));
}

static int32_t exact_mul_wrap(int32_t a, int32_t b)
{
    return (int32_t)(uint32_t)nearest((__int128)a * b, 65536);
}

static int32_t exact_div(int32_t a, int32_t b)
{
    if (b == 0) {
        return a > 0 ? INT32_MAX : a < 0 ? INT32_MIN : 0;
    }
    return clamp(nearest((b < 0 ? -(__int128)a : (__int128)a) * 65536, b < 0 ? -(__int128)b : (__int128)b));
}

static int32_t exact_add(int32_t a, int32_t b)
{
    return clamp((__int128)a + b);
}

static int32_t exact_sub(int32_t a, int32_t b)
{
    return clamp((__int128)a - b);
}

static int32_t exact_add_wrap(int32_t a, int32_t b)
{
    return (int32_t)(uint32_t)((__int128)a + b);
}

static int32_t exact_sub_wrap(int32_t a, int32_t b)
{
    return (int32_t)(uint32_t)((__int128)a - b);
}

static void binary_agrees(const char *name, fx_t (*f)(fx_t, fx_t), int32_t (*exact)(int32_t, int32_t))
{
    for (size_t i = 0; i < edge_count; i++) {
        for (size_t j = 0; j < edge_count; j++) {
            same(name, edges[i], edges[j], f(edges[i], edges[j]), exact(edges[i], edges[j]));
        }
    }
    for (int i = 0; i < 500000; i++) {
        const int32_t a = noise_any(), b = noise_any();
        same(name, a, b, f(a, b), exact(a, b));
    }
}

/* ---- tests ------------------------------------------------------------------------------------------------- */

static void shifting_right_a_negative_number_rounds_down(void **state)
{
    (void)state;
    for (size_t i = 0; i < edge_count; i++) {
        for (int bit = 0; bit < 31; bit++) {
            const int64_t step = (int64_t)1 << bit;
            const int64_t floored = edges[i] / step - (edges[i] % step < 0);
            assert_int_equal(edges[i] >> bit, floored);
            assert_int_equal((int64_t)edges[i] * 65536 >> (bit + 16), floored);
        }
    }
    assert_int_equal((int32_t)UINT32_C(0x80000000), INT32_MIN);
}

static void sums_clamp_or_wrap_as_named(void **state)
{
    (void)state;
    binary_agrees("add_sat", fx_add_sat, exact_add);
    binary_agrees("sub_sat", fx_sub_sat, exact_sub);
    binary_agrees("add_wrap", fx_add_wrap, exact_add_wrap);
    binary_agrees("sub_wrap", fx_sub_wrap, exact_sub_wrap);
}

static void negative_and_absolute_value_of_the_smallest_is_the_largest(void **state)
{
    (void)state;
    for (size_t i = 0; i < edge_count; i++) {
        const int64_t a = edges[i];
        assert_int_equal(fx_neg_sat(edges[i]), clamp(-a));
        assert_int_equal(fx_abs_sat(edges[i]), clamp(a < 0 ? -a : a));
    }
    assert_int_equal(fx_neg_sat(FX_MIN), FX_MAX);
    assert_int_equal(fx_abs_sat(FX_MIN), FX_MAX);
}

static void product_is_the_nearest_and_a_tie_goes_up(void **state)
{
    (void)state;
    binary_agrees("mul_sat", fx_mul_sat, exact_mul);
    binary_agrees("mul_wrap", fx_mul_wrap, exact_mul_wrap);
    assert_int_equal(fx_mul_sat(1, FX_HALF), 1);
    assert_int_equal(fx_mul_sat(-1, FX_HALF), 0);
    assert_int_equal(fx_mul_sat(FX_MIN, FX_MIN), FX_MAX);
    assert_int_equal(fx_mul_wrap(FX_MIN, FX_MIN), 0);
}

static void quotient_is_the_nearest_and_a_tie_goes_up(void **state)
{
    (void)state;
    binary_agrees("div_sat", fx_div_sat, exact_div);
    assert_int_equal(fx_div_sat(1, 2 * FX_ONE), 1);
    assert_int_equal(fx_div_sat(-1, 2 * FX_ONE), 0);
    assert_int_equal(fx_div_sat(1, -2 * FX_ONE), 0);
}

static void quotient_by_zero_has_the_sign_of_the_dividend(void **state)
{
    (void)state;
    assert_int_equal(fx_div_sat(5, 0), FX_MAX);
    assert_int_equal(fx_div_sat(-5, 0), FX_MIN);
    assert_int_equal(fx_div_sat(0, 0), 0);
}

/* Products a hair below, on and above a middle between two results, and quotients that come close to one. */
static void results_next_to_a_tie_are_right(void **state)
{
    (void)state;
    for (int i = 0; i < 300000; i++) {
        const int32_t b = noise_any();
        const int32_t q = noise_any();
        const __int128 a = (__int128)b * (2 * (__int128)q + 1) / 131072;
        for (int off = -1; off <= 1; off++) {
            const int32_t near = clamp(a + off);
            same("div_sat", near, b, fx_div_sat(near, b), exact_div(near, b));
        }
    }
}

static void reciprocal_is_the_nearest(void **state)
{
    (void)state;
    unary_agrees("rcp_sat", fx_rcp_sat, oracle_rcp);
    assert_int_equal(fx_rcp_sat(0), FX_MAX);
}

static void square_root_is_the_nearest_and_zero_below_zero(void **state)
{
    (void)state;
    unary_agrees("sqrt", fx_sqrt, oracle_sqrt);
    for (int32_t r = 0; r < 46341; r++) { /* squares of k / 256 are exact, and next to them it steps */
        same("sqrt", r * r, 0, fx_sqrt(r * r), r * 256);
    }
}

static void reciprocal_square_root_is_the_nearest(void **state)
{
    (void)state;
    unary_agrees("rsqrt_sat", fx_rsqrt_sat, oracle_rsqrt);
}

static void every_sine_and_cosine_is_the_nearest(void **state)
{
    (void)state;
    for (int32_t a = 0; a < 65536; a++) {
        same("sin", a, 0, fx_sin(a), oracle_sin(a));
        same("cos", a, 0, fx_cos(a), oracle_cos(a));
    }
    for (size_t i = 0; i < edge_count; i++) { /* one turn more is the same angle */
        same("sin", edges[i], 0, fx_sin(edges[i]), fx_sin(edges[i] & 0xffff));
        same("cos", edges[i], 0, fx_cos(edges[i]), fx_cos(edges[i] & 0xffff));
    }
}

static void every_tangent_is_the_nearest(void **state)
{
    (void)state;
    for (int32_t a = -32768; a < 32768; a++) {
        same("tan_sat", a, 0, fx_tan_sat(a), oracle_tan(a));
    }
    for (size_t i = 0; i < edge_count; i++) {
        same("tan_sat", edges[i], 0, fx_tan_sat(edges[i]), fx_tan_sat(edges[i] & 0xffff));
    }
    assert_int_equal(fx_tan_sat(FX_ONE / 4), FX_MAX);
    assert_int_equal(fx_tan_sat(FX_ONE / 4 * 3), FX_MIN);
}

static void arctangent_of_all_edges_squared_is_the_nearest(void **state)
{
    (void)state;
    for (size_t i = 0; i < edge_count; i++) {
        for (size_t j = 0; j < edge_count; j++) {
            same("atan2", edges[i], edges[j], fx_atan2(edges[i], edges[j]), oracle_atan2(edges[i], edges[j]));
        }
    }
    for (int i = 0; i < 20000; i++) {
        const int32_t y = noise_any(), x = noise_any();
        same("atan2", y, x, fx_atan2(y, x), oracle_atan2(y, x));
    }
}

/* Vectors as near as integers come to an angle halfway between two results. */
static void arctangent_next_to_every_boundary_is_the_nearest(void **state)
{
    mpfr_t v;
    (void)state;
    for (int32_t k = -32767; k < 32768; k += 2) {
        const int32_t x = (int32_t)(noise() >> (1 + noise() % 8)) | 1;
        oracle_angle(v, k, 17);
        mpfr_tan(v, v, MPFR_RNDN);
        mpfr_mul_si(v, v, x, MPFR_RNDN);
        const __int128 y = mpfr_cmp_si(v, INT32_MAX) > 0   ? INT32_MAX
                           : mpfr_cmp_si(v, INT32_MIN) < 0 ? INT32_MIN
                                                           : mpfr_get_si(v, MPFR_RNDD);
        mpfr_clear(v);
        for (int off = 0; off <= 1; off++) {
            const int32_t near = clamp(y + off);
            const int32_t sign = noise() & 1 ? 1 : -1;
            same("atan2", near, sign * x, fx_atan2(near, sign * x), oracle_atan2(near, sign * x));
            same("atan2", sign * x, near, fx_atan2(sign * x, near), oracle_atan2(sign * x, near));
        }
    }
}

/* What fx_atan2 compares with: at the odd k lie the boundaries. */
static void every_boundary_of_the_arctangent_is_within_2_to_the_minus_40(void **state)
{
    const double bound = 1.0 / ((int64_t)1 << 40);
    mpfr_t v, den;
    (void)state;
    mpfr_init2(den, ORACLE_BITS);
    for (uint32_t k = 1; k < 16384; k++) {
        const struct fx_ratio r = fx_tangent_ratio((uint64_t)k << 49);
        oracle_angle(v, k, 17);
        mpfr_tan(v, v, MPFR_RNDN);
        mpfr_set_ui_2exp(den, r.den, 0, MPFR_RNDN);
        mpfr_mul(v, v, den, MPFR_RNDN);
        mpfr_set_ui_2exp(den, r.num, 0, MPFR_RNDN);
        mpfr_reldiff(v, v, den, MPFR_RNDN);
        const double off = mpfr_get_d(v, MPFR_RNDN);
        mpfr_clear(v);
        if (off > bound || off < -bound) {
            fail_msg("tangent %u is off by %g", k, off);
        }
    }
    mpfr_clear(den);
}

static void sincos_q30_agrees(uint32_t turn32)
{
    mpfr_t s, c;
    int32_t sine, cosine;
    oracle_angle(s, turn32, 32);
    mpfr_init2(c, ORACLE_BITS);
    mpfr_sin_cos(s, c, s, MPFR_RNDN);
    fx_sincos_q30(turn32, &sine, &cosine);
    const long double es = mpfr_get_ld(s, MPFR_RNDN) * 0x1p30L - sine;
    const long double ec = mpfr_get_ld(c, MPFR_RNDN) * 0x1p30L - cosine;
    mpfr_clears(s, c, (mpfr_ptr)0);
    const long double bound = SINCOS_Q30_BOUND;
    if (es > bound || -es > bound || ec > bound || -ec > bound) {
        fail_msg("sincos_q30(0x%08x) is off by %Lf and %Lf LSB", turn32, es, ec);
    }
}

static void sine_in_q30_keeps_its_bound(void **state)
{
    (void)state;
    for (size_t i = 0; i < edge_count; i++) {
        sincos_q30_agrees((uint32_t)edges[i]);
    }
    for (uint32_t node = 0; node < 512; node++) { /* on both sides of where the nodes meet */
        sincos_q30_agrees((node << 23) - 1);
        sincos_q30_agrees(node << 23);
    }
    for (uint64_t a = 0; a <= UINT32_MAX; a += 100003) {
        sincos_q30_agrees((uint32_t)a);
    }
}

static void quarter_turns_in_q30_are_exact_and_quarters_mirror(void **state)
{
    (void)state;
    for (uint32_t quarter = 0; quarter < 4; quarter++) {
        static const int32_t value[4] = {0, FX_Q30_ONE, 0, -FX_Q30_ONE};
        int32_t s, c;
        fx_sincos_q30(quarter << 30, &s, &c);
        assert_int_equal(s, value[quarter]);
        assert_int_equal(c, value[(quarter + 1) & 3]);
    }
    for (int i = 0; i < 100000; i++) {
        const uint32_t a = noise();
        int32_t s, c, s2, c2;
        fx_sincos_q30(a, &s, &c);
        fx_sincos_q30(a + 0x40000000u, &s2, &c2);
        assert_true(s2 == c && c2 == -s);
    }
}

static void degrees_become_the_nearest_turn32(void **state)
{
    (void)state;
    for (int64_t deg = INT32_MIN; deg <= INT32_MAX; deg += STRIDE) {
        assert_int_equal(fx_turn32_from_deg((fx_t)deg), oracle_turn32_from_deg((int32_t)deg));
    }
    for (size_t i = 0; i < edge_count; i++) {
        assert_int_equal(fx_turn32_from_deg(edges[i]), oracle_turn32_from_deg(edges[i]));
    }
    assert_int_equal(fx_turn32_from_deg(FX_INT(90)), 0x40000000);
    assert_int_equal(fx_turn32_from_deg(FX_INT(-90)), 0xc0000000);
    assert_int_equal(fx_turn32_from_deg(FX_INT(720)), 0);
}

static void lerp_agrees(int32_t a, int32_t b, int32_t t)
{
    const int32_t expected = clamp(nearest((__int128)a * 65536 + ((__int128)b - a) * t, 65536));
    const int32_t got = fx_lerp_sat(a, b, t);
    if (got != expected) {
        fail_msg("lerp_sat(%d, %d, %d) is %d, not %d", a, b, t, got, expected);
    }
}

static void lerp_rounds_once(void **state)
{
    (void)state;
    for (size_t i = 0; i < edge_count; i++) {
        for (size_t j = 0; j < edge_count; j++) {
            for (size_t k = 0; k < edge_count; k++) {
                lerp_agrees(edges[i], edges[j], edges[k]);
            }
        }
    }
}

static void quotient_of_64_bits_is_that_of_the_machine(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 64 * 7; i++) {
        const uint64_t n = ((uint64_t)1 << i / 7) + i % 7 - 3;
        for (uint64_t j = 0; j < 63 * 7; j++) {
            const uint64_t d = ((uint64_t)1 << j / 7) + j % 7 - 3, multiple = d * (n >> j / 7);
            if (d == 0 || d >> 63 != 0) {
                continue;
            }
            assert_true(fx_quotient_bits(n, d) == n / d);
            assert_true(fx_quotient_bits(multiple, d) == multiple / d);
            assert_true(fx_quotient_bits(multiple - 1, d) == (multiple - 1) / d);
            assert_true(fx_quotient_u64(n, d) == n / d);
        }
    }
}

static void normalised_reciprocal_is_the_exact_quotient(void **state)
{
    (void)state;
    for (uint64_t w = 0; w <= UINT32_MAX; w += w < 100000 ? 1 : STRIDE) {
        int shift, zeros = 0;
        const uint32_t got = fx_rcp_norm((uint32_t)w, &shift);
        const uint64_t v = w != 0 ? w : 1;
        while (v << zeros >> 31 == 0) {
            zeros++;
        }
        assert_int_equal(shift, zeros);
        assert_int_equal(got, ((uint64_t)1 << 62) / (v << zeros));
        assert_int_equal(fx_rcp_newton((uint32_t)(v << zeros)), got);
    }
}

/* |r sqrt(m) / 2^scale - 1| < parts 2^-26, by r^2 m beside 2^(2 scale) (1 -+ parts 2^-26)^2, exact in 128 bits. */
static void root_is_within(const char *name, uint32_t m, uint32_t r, int scale, uint32_t parts)
{
    const unsigned __int128 one = 1 << 26, unit = (unsigned __int128)1 << (2 * scale - 52);
    const unsigned __int128 square = (unsigned __int128)r * r * m;
    if (square <= unit * (one - parts) * (one - parts) || square >= unit * (one + parts) * (one + parts)) {
        fail_msg("%s(%u) is %u: more than %u / 2^26 off", name, m, r, parts);
    }
}

static void normalised_reciprocal_roots_keep_their_bounds(void **state)
{
    static const uint32_t low[] = {0, 1, 0x8000, 0xFFFF};
    (void)state;
    for (uint32_t upper = 1 << 14; upper < 1 << 16; upper++) { /* fx_rsqrt16 reads no more of m */
        for (size_t i = 0; i < COUNT(low); i++) {
            const uint32_t m = upper << 16 | low[i];
            root_is_within("fx_rsqrt16", m, fx_rsqrt16(m), 31, 4160); /* 6.2e-5 */
            root_is_within("fx_rsqrt_norm", m, fx_rsqrt_norm(m), 45, 2);
        }
    }
}

static void short_reciprocal_is_the_exact_quotient_on_every_cpu(void **state)
{
    (void)state;
    for (uint32_t d = 32768; d < 65536; d++) {
        assert_int_equal(fx_rcp16(d), 0x7fffffff / d);
        assert_int_equal(armv6m_rcp16(d), 0x7fffffff / d);
    }
}

static void products_and_zeros_are_the_same_on_every_cpu(void **state)
{
    (void)state;
    for (size_t i = 0; i < edge_count; i++) {
        const uint32_t a = (uint32_t)edges[i];
        int zeros = 0;
        while (zeros < 32 && a >> (31 - zeros) == 0) {
            zeros++;
        }
        assert_int_equal(fx_clz32(a), zeros);
        assert_int_equal(armv6m_clz32(a), zeros);
        for (size_t j = 0; j < edge_count; j++) {
            const uint32_t b = (uint32_t)edges[j];
            const uint64_t product = (uint64_t)((unsigned __int128)a * b);
            const int64_t product_signed = (int64_t)((__int128)edges[i] * edges[j]);
            assert_true(fx_mulhi_u32(a, b) == product >> 32 && armv6m_mulhi_u32(a, b) == product >> 32);
            assert_true(fx_mul_wide_u(a, b) == product && armv6m_mul_wide_u(a, b) == product);
            assert_true(fx_mul_wide(edges[i], edges[j]) == product_signed);
            assert_true(armv6m_mul_wide(edges[i], edges[j]) == product_signed);
        }
    }
    for (int i = 0; i < 1000000; i++) {
        const int32_t a = noise_any(), b = noise_any();
        const uint64_t product = (uint64_t)((unsigned __int128)(uint32_t)a * (uint32_t)b);
        assert_true(armv6m_mul_wide_u((uint32_t)a, (uint32_t)b) == product);
        assert_true(armv6m_mul_wide(a, b) == (int64_t)((__int128)a * b));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shifting_right_a_negative_number_rounds_down),
        cmocka_unit_test(sums_clamp_or_wrap_as_named),
        cmocka_unit_test(negative_and_absolute_value_of_the_smallest_is_the_largest),
        cmocka_unit_test(product_is_the_nearest_and_a_tie_goes_up),
        cmocka_unit_test(quotient_is_the_nearest_and_a_tie_goes_up),
        cmocka_unit_test(quotient_by_zero_has_the_sign_of_the_dividend),
        cmocka_unit_test(results_next_to_a_tie_are_right),
        cmocka_unit_test(reciprocal_is_the_nearest),
        cmocka_unit_test(square_root_is_the_nearest_and_zero_below_zero),
        cmocka_unit_test(reciprocal_square_root_is_the_nearest),
        cmocka_unit_test(every_sine_and_cosine_is_the_nearest),
        cmocka_unit_test(every_tangent_is_the_nearest),
        cmocka_unit_test(arctangent_of_all_edges_squared_is_the_nearest),
        cmocka_unit_test(arctangent_next_to_every_boundary_is_the_nearest),
        cmocka_unit_test(every_boundary_of_the_arctangent_is_within_2_to_the_minus_40),
        cmocka_unit_test(sine_in_q30_keeps_its_bound),
        cmocka_unit_test(quarter_turns_in_q30_are_exact_and_quarters_mirror),
        cmocka_unit_test(degrees_become_the_nearest_turn32),
        cmocka_unit_test(lerp_rounds_once),
        cmocka_unit_test(quotient_of_64_bits_is_that_of_the_machine),
        cmocka_unit_test(normalised_reciprocal_is_the_exact_quotient),
        cmocka_unit_test(normalised_reciprocal_roots_keep_their_bounds),
        cmocka_unit_test(short_reciprocal_is_the_exact_quotient_on_every_cpu),
        cmocka_unit_test(products_and_zeros_are_the_same_on_every_cpu),
    };
    return cmocka_run_group_tests(tests, make_edges, NULL);
}
