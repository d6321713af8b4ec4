/* lab_num: text against printf and strtod, products and quotients by each other, the logarithm against libm. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "lab_num.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void six_digits_are_those_of_printf(void **state)
{
    (void)state;
    uint64_t random = 7;
    for (int i = 0; i < 200000; i++) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        const uint64_t m = random >> 24; /* 40 bits: a double holds it */
        const int e = (int)(random % 70) - 60;
        char text[LAB_TEXT_SIZE];
        lab_num_text(lab_num_scaled(m, e), text);
        const double exact = ldexp((double)m, e), said = strtod(text, NULL);
        if (fabs(said - exact) > exact * 5.0000001e-6) {
            fail_msg("%.12g is said as %s", exact, text);
        }
    }
}

static void text_is_plain(void **state)
{
    (void)state;
    static const struct {
        uint64_t m;
        int e;
        const char *text;
    } cases[] = {{0, 0, "0"},
                 {1, 0, "1"},
                 {10, 0, "10"},
                 {181, 0, "181"},
                 {1, -1, "0.5"},
                 {3, -5, "0.09375"},
                 {1000000, 0, "1000000"},
                 {1, -16, "1.52588e-05"},
                 {1, -13, "0.00012207"},
                 {999999999, 0, "1e+09"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[LAB_TEXT_SIZE];
        lab_num_text(lab_num_scaled(cases[i].m, cases[i].e), text);
        assert_string_equal(text, cases[i].text);
    }
}

/* CSV tells every length from its neighbours, on the far side of 10 m, too. */
static void a_length_is_told_from_the_next(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < 32; k++) {
        for (uint32_t v = ((uint32_t)1 << k) - (k > 0); v - ((uint32_t)1 << k) + 1 < 1000; v++) {
            char text[LAB_TEXT_SIZE];
            lab_length_text(v, text);
            assert_int_equal(lround(strtod(text, NULL) * 65536), v);
        }
    }
    char text[LAB_TEXT_SIZE];
    lab_length_text(INT32_MAX, text);
    assert_string_equal(text, "32767.99998");
}

/* Read back it is the same number, and no decimal with one digit less is. */
static void the_decimal_of_a_distance_is_the_shortest(void **state)
{
    (void)state;
    for (uint32_t v = 0; v < 3 * 65536; v++) {
        char text[LAB_TEXT_SIZE];
        fx_t back;
        lab_fx_text((fx_t)v, text);
        assert_int_equal(fx_from_text(text, &back, NULL), 0);
        assert_int_equal(back, v);
        const char *point = strchr(text, '.');
        if (point != NULL) {
            char shorter[LAB_TEXT_SIZE];
            snprintf(shorter, sizeof shorter, "%.*f", (int)strlen(point + 1) - 1, v / 65536.0);
            assert_int_equal(fx_from_text(shorter, &back, NULL), 0);
            assert_int_not_equal(back, v);
        }
    }
    char text[LAB_TEXT_SIZE];
    lab_fx_text(6554, text);
    assert_string_equal(text, "0.1");
    lab_fx_text(FX_MAX, text);
    assert_string_equal(text, "32767.99998");
}

static void quotients_and_products_are_good_to_62_bits(void **state)
{
    (void)state;
    for (uint64_t a = 1; a < 2000; a += 7) {
        for (uint64_t b = 1; b < 2000; b += 11) {
            const struct lab_num q = lab_num_mul(lab_num_div(lab_num_of(a), lab_num_of(b)), lab_num_of(b));
            const double back = ldexp((double)q.m, q.e);
            assert_true(fabs(back - (double)a) <= (double)a * 1e-15);
        }
    }
}

static void the_logarithm_is_that_of_libm(void **state)
{
    (void)state;
    for (uint32_t v = 1; v < UINT32_MAX / 3 * 2; v += v / 1000 + 1) {
        assert_true(fabs(ldexp((double)lab_log2_q56(v), -56) - log2(v)) < 1e-14);
    }
    assert_true(lab_log2_q56(8) == (uint64_t)3 << 56);
}

/* Digits of 16 bits, multiplied as on paper. */
static void a_high_product_is_that_of_128_bits(void **state)
{
    uint64_t a = 0x0123456789ABCDEF, b = 0xFEDCBA9876543210;
    (void)state;
    for (int run = 0; run < 10000; run++) {
        uint64_t carry = 0, high = 0;
        a = a * 6364136223846793005u + 1442695040888963407u;
        b = b * 2862933555777941757u + 3037000493u;
        for (int digit = 0; digit < 8; digit++) {
            uint64_t sum = carry;
            for (int i = digit < 4 ? 0 : digit - 3; i <= digit && i < 4; i++) {
                sum += (a >> 16 * i & 0xFFFF) * (b >> 16 * (digit - i) & 0xFFFF);
            }
            high |= digit < 4 ? 0 : (sum & 0xFFFF) << 16 * (digit - 4);
            carry = sum >> 16;
        }
        assert_true(lab_mulhi_u64(a, b) == high);
    }
    assert_true(lab_mulhi_u64(UINT64_MAX, UINT64_MAX) == UINT64_MAX - 1);
}

static void whole_numbers_are_plain(void **state)
{
    static const uint32_t numbers[] = {0, 9, 10, 99, 100, 999999999, 1000000000, UINT32_MAX};
    (void)state;
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        char text[LAB_TEXT_SIZE], expected[LAB_TEXT_SIZE];
        lab_u32_text(numbers[i], text);
        snprintf(expected, sizeof expected, "%u", (unsigned)numbers[i]);
        assert_string_equal(text, expected);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(six_digits_are_those_of_printf),
        cmocka_unit_test(text_is_plain),
        cmocka_unit_test(a_length_is_told_from_the_next),
        cmocka_unit_test(the_decimal_of_a_distance_is_the_shortest),
        cmocka_unit_test(quotients_and_products_are_good_to_62_bits),
        cmocka_unit_test(the_logarithm_is_that_of_libm),
        cmocka_unit_test(a_high_product_is_that_of_128_bits),
        cmocka_unit_test(whole_numbers_are_plain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
