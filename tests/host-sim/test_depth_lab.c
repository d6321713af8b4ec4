/* The parts of the lab: numbers and their text, errors of the contract, the adjacent-pair test of float32. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "depth_ieee.h"
#include "lab_num.h"
#include "lab_search.h"

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

static void say_nothing(void *context, const char *text)
{
    (void)text;
    ++*(int *)context;
}

static void wrong_input_is_refused_before_a_word_is_said(void **state)
{
    (void)state;
    static uint64_t memory[4096];
    int said = 0;
    const fx_t outside = FX_INT(200);
    struct lab lab = {.near_z = FX_ONE,
                      .far_z = FX_INT(100),
                      .formats = 1,
                      .count = 10,
                      .memory = memory,
                      .memory_bytes = sizeof memory,
                      .put = say_nothing,
                      .context = &said};
    struct lab wrong = lab;
    wrong.near_z = 0;
    assert_int_equal(lab_pairs(&wrong), PH_ERR_INVAL);
    wrong.near_z = lab.far_z;
    assert_int_equal(lab_resolve(&wrong), PH_ERR_INVAL);
    wrong = lab;
    wrong.count = 0;
    assert_int_equal(lab_pairs(&wrong), PH_ERR_INVAL);
    wrong.count = LAB_COUNT_MAX;
    assert_int_equal(lab_pairs(&wrong), PH_ERR_NOMEM);
    wrong = lab;
    wrong.at = &outside;
    wrong.at_count = 1;
    assert_int_equal(lab_resolve(&wrong), PH_ERR_INVAL);
    wrong = lab;
    wrong.memory_bytes = lab_bytes(&lab) - 1;
    assert_int_equal(lab_pairs(&wrong), PH_ERR_NOMEM);
    assert_int_equal(said, 0);
    assert_int_equal(lab_pairs(&lab), 0);
    assert_true(said > 0);
}

/* An int24 rounds what a float32 holds, and in 1/2 .. 1 a float32 has just as many steps: the counts are the same. */
static void int24_keeps_the_order_of_its_float32(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < DEPTH_IEEE_FORMATS / 2; i++) {
        struct depth_ieee_count real, whole;
        assert_int_equal(depth_ieee_pairs(i, .1, 10000, LAB_LINEAR_SPACED, 10000, &real), 0);
        assert_int_equal(depth_ieee_pairs(i + DEPTH_IEEE_FORMATS / 2, .1, 10000, LAB_LINEAR_SPACED, 10000, &whole), 0);
        if (strstr(depth_ieee_name(i), "reversed") == NULL) {
            assert_int_equal(whole.equal, real.equal);
            assert_int_equal(whole.swap, real.swap);
        }
    }
}

/* Widest wrong order of the float32 test: against every pair. */
static void the_self_test_is_in_order_where_depth_is_reversed(void **state)
{
    (void)state;
    struct depth_ieee_count found;
    for (uint32_t i = 0; i < DEPTH_IEEE_FORMATS; i++) {
        const bool reversed = strstr(depth_ieee_name(i), "reversed") != NULL,
                   whole = strstr(depth_ieee_name(i), "int24") != NULL;
        assert_int_equal(depth_ieee_pairs(i, .1, 10000, LAB_LINEAR_SPACED, 10000, &found), 0);
        assert_int_equal(found.equal == 0 && found.swap == 0, reversed && !whole);
        assert_int_equal(found.max_wrong == 0, reversed && !whole);
        assert_true(found.max_wrong < 200);
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
        cmocka_unit_test(wrong_input_is_refused_before_a_word_is_said),
        cmocka_unit_test(int24_keeps_the_order_of_its_float32),
        cmocka_unit_test(the_self_test_is_in_order_where_depth_is_reversed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
