/* The parts of the lab: errors of the contract, the adjacent-pair test of float32. */
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
        cmocka_unit_test(wrong_input_is_refused_before_a_word_is_said),
        cmocka_unit_test(int24_keeps_the_order_of_its_float32),
        cmocka_unit_test(the_self_test_is_in_order_where_depth_is_reversed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
