/*
 * fx_to_text is compared with printf of the exact double, fx_from_text with MPFR, which rounds decimals of any length.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <mpfr.h>

#include "fx.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(a) (sizeof(a) / sizeof((a)[0]))
#define EINVAL_  (-22)
#define ERANGE_  (-34)

static uint64_t noise_state = 88172645463325252u;

static uint32_t noise(void)
{
    noise_state ^= noise_state << 13;
    noise_state ^= noise_state >> 7;
    noise_state ^= noise_state << 17;
    return (uint32_t)(noise_state >> 16);
}

/* printf writes a double exactly: 16 decimals, of which the last zeros and the point go. */
static void printed(fx_t a, char text[64])
{
    int n = snprintf(text, 64, "%.16f", a / 65536.0);
    while (text[n - 1] == '0') {
        n--;
    }
    n -= text[n - 1] == '.';
    text[n] = '\0';
}

static void text_is_exact(fx_t a)
{
    char text[FX_TEXT_SIZE], expected[64];
    fx_t back = ~a;
    const char *end;
    const int length = fx_to_text(a, text);
    printed(a, expected);
    assert_string_equal(text, expected);
    assert_int_equal(length, strlen(text));
    assert_int_equal(fx_from_text(text, &back, &end), 0);
    assert_int_equal(back, a);
    assert_ptr_equal(end, text + length);
}

static void every_fraction_and_every_whole_is_written_exactly(void **state)
{
    (void)state;
    for (int32_t i = -32768; i < 32768; i++) {
        text_is_exact(FX_INT(i));
        text_is_exact(i);
        text_is_exact((fx_t)((uint32_t)i * 65537u));
        text_is_exact((fx_t)(0x80000000u | (uint32_t)(i + 32768)));
        text_is_exact((fx_t)(0x7fff0000u | (uint32_t)(i + 32768)));
    }
}

static void known_texts(void **state)
{
    static const struct {
        fx_t a;
        const char *text;
    } known[] = {
        {0, "0"},
        {FX_ONE, "1"},
        {-FX_ONE - FX_HALF, "-1.5"},
        {1, "0.0000152587890625"},
        {-1, "-0.0000152587890625"},
        {FX_MAX, "32767.9999847412109375"},
        {FX_MIN, "-32768"},
        {FX_MIN + 1, "-32767.9999847412109375"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT(known); i++) {
        char text[FX_TEXT_SIZE];
        assert_int_equal(fx_to_text(known[i].a, text), strlen(known[i].text));
        assert_string_equal(text, known[i].text);
    }
}

/* Nearest of 2^16 text + 1/2, downwards; the precision holds every digit of the texts below. */
static int expected_of(const char *text, fx_t *out)
{
    mpfr_t v;
    int status = 0;
    mpfr_init2(v, 8192);
    mpfr_strtofr(v, text, NULL, 10, MPFR_RNDN);
    mpfr_mul_2ui(v, v, 16, MPFR_RNDN);
    mpfr_add_d(v, v, 0.5, MPFR_RNDN);
    mpfr_floor(v, v);
    if (mpfr_cmp_si(v, FX_MAX) > 0 || mpfr_cmp_si(v, FX_MIN) < 0) {
        status = ERANGE_;
    } else {
        *out = (fx_t)mpfr_get_si(v, MPFR_RNDN);
    }
    mpfr_clear(v);
    return status;
}

static void agrees(const char *text)
{
    fx_t expected = 4711, got = 4711;
    const char *end;
    const int status = expected_of(text, &expected);
    const int got_status = fx_from_text(text, &got, &end);
    if (got_status != status || got != expected || *end != '\0') {
        fail_msg("\"%s\" is %d (status %d), not %d (status %d)", text, got, got_status, expected, status);
    }
}

static void numbers_are_read_to_the_nearest(void **state)
{
    static const char *const texts[] = {
        "0",
        "-0",
        "+0",
        "1",
        "+1",
        "-1.5",
        ".25",
        "-.25",
        "3.",
        "00012.500",
        "1e-3",
        "1E3",
        "1e+4",
        "-32.768e3",
        "0.00032767e8",
        "32767.99998",
        "32767.9999923",
        "32767.9999924",
        "32768",
        "-32768",
        "-32768.0000076",
        "-32768.0000077",
        "-32769",
        "99999",
        "100000",
        "1e5",
        "1e4",
        "0.1e6",
        "1e-5",
        "7.6e-6",
        "7.7e-6",
        "1e-17",
        "1e-18",
        "1e999999999",
        "-1e999999999",
        "0e999999999",
        "1e-999999999",
        "0.00000e5",
        "65536e-5",
    };
    (void)state;
    for (size_t i = 0; i < COUNT(texts); i++) {
        agrees(texts[i]);
    }
}

/* One digit more than a tie's text, at any distance behind it, decides. */
static void a_tie_goes_up_and_a_digit_far_behind_breaks_it(void **state)
{
    static char text[4096];
    (void)state;
    for (int i = 0; i < 400; i++) {
        const int64_t odd = 2 * (int64_t)(int32_t)noise() / (i % 2 != 0 ? 1 : 100000) | 1;
        const size_t n = (size_t)snprintf(text, sizeof text, "%.17f", (double)odd / 131072.0);
        agrees(text);
        const size_t zeros = noise() % 2000;
        memset(text + n, '0', zeros);
        text[n + zeros] = '\0';
        agrees(text);
        text[n + zeros] = '1';
        text[n + zeros + 1] = '\0';
        agrees(text);
        text[n - 1]--; /* ...4999: just below the tie */
        memset(text + n, '9', zeros);
        agrees(text);
    }
}

static void random_texts_agree(void **state)
{
    (void)state;
    for (int i = 0; i < 50000; i++) {
        char text[128];
        int n = 0;
        static const char *const signs[] = {"", "-", "+"};
        n += snprintf(text, sizeof text, "%s", signs[noise() % 3]);
        const uint32_t before = noise() % 8, behind = noise() % 24 + (before == 0);
        for (uint32_t k = 0; k < before; k++) {
            text[n++] = (char)('0' + noise() % 10);
        }
        text[n++] = '.';
        for (uint32_t k = 0; k < behind; k++) {
            text[n++] = (char)('0' + noise() % 10);
        }
        text[n] = '\0';
        if (noise() % 2 != 0) {
            snprintf(text + n, sizeof text - (size_t)n, "e%d", (int)(noise() % 30) - 15);
        }
        agrees(text);
    }
}

static void what_is_no_number_is_refused_and_leaves_the_result(void **state)
{
    static const char *const texts[] = {"",    "+",   "-",   ".",   "-.",       "+.e1", "e5",
                                        "E",   "nan", "NaN", "inf", "-inf",     " 1",   "\t1",
                                        "--1", "+-1", "x",   "-x",  "infinity", "..1",  "- 1"};
    (void)state;
    for (size_t i = 0; i < COUNT(texts); i++) {
        fx_t out = 4711;
        const char *end = NULL;
        assert_int_equal(fx_from_text(texts[i], &out, &end), EINVAL_);
        assert_ptr_equal(end, texts[i]);
        assert_int_equal(fx_from_text(texts[i], &out, NULL), EINVAL_);
        assert_int_equal(out, 4711);
    }
}

static void reading_stops_where_the_number_ends(void **state)
{
    static const struct {
        const char *text;
        size_t used;
        fx_t value;
    } partly[] = {
        {"1.5,2", 3, FX_ONE + FX_HALF}, {"1.2.3", 3, 78643}, {"1e", 1, FX_ONE},     {"1e+", 1, FX_ONE},
        {"2e-x", 1, 2 * FX_ONE},        {"0x10", 1, 0},      {"3 ", 1, 3 * FX_ONE}, {"1e1e1", 3, 10 * FX_ONE},
        {"5-", 1, 5 * FX_ONE},          {"1..", 2, FX_ONE},
    };
    (void)state;
    for (size_t i = 0; i < COUNT(partly); i++) {
        fx_t out = 4711;
        const char *end = NULL;
        assert_int_equal(fx_from_text(partly[i].text, &out, &end), 0);
        assert_int_equal(out, partly[i].value);
        assert_ptr_equal(end, partly[i].text + partly[i].used);
    }
}

static void out_of_range_uses_the_text_and_leaves_the_result(void **state)
{
    static const char *const texts[] = {"32768", "-32768.1", "1e999999999", "-123456789012345678901234567890",
                                        "1e99999999999999999999999"};
    (void)state;
    for (size_t i = 0; i < COUNT(texts); i++) {
        fx_t out = 4711;
        const char *end = NULL;
        assert_int_equal(fx_from_text(texts[i], &out, &end), ERANGE_);
        assert_int_equal(out, 4711);
        assert_ptr_equal(end, texts[i] + strlen(texts[i]));
    }
}

static void an_exponent_undoes_a_hundred_thousand_zeros(void **state)
{
    enum { ZEROS = 100000 };
    char *text = malloc(2 * ZEROS);
    fx_t out = 0;
    (void)state;
    assert_non_null(text);
    text[0] = '.';
    memset(text + 1, '0', ZEROS);
    memcpy(text + 1 + ZEROS, "15e100001", sizeof "15e100001");
    assert_int_equal(fx_from_text(text, &out, NULL), 0);
    assert_int_equal(out, FX_ONE + FX_HALF);
    text[0] = '3';
    memcpy(text + 1 + ZEROS, "e-100000", sizeof "e-100000");
    assert_int_equal(fx_from_text(text, &out, NULL), 0);
    assert_int_equal(out, 3 * FX_ONE);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_fraction_and_every_whole_is_written_exactly),
        cmocka_unit_test(known_texts),
        cmocka_unit_test(numbers_are_read_to_the_nearest),
        cmocka_unit_test(a_tie_goes_up_and_a_digit_far_behind_breaks_it),
        cmocka_unit_test(random_texts_agree),
        cmocka_unit_test(what_is_no_number_is_refused_and_leaves_the_result),
        cmocka_unit_test(reading_stops_where_the_number_ends),
        cmocka_unit_test(out_of_range_uses_the_text_and_leaves_the_result),
        cmocka_unit_test(an_exponent_undoes_a_hundred_thousand_zeros),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
