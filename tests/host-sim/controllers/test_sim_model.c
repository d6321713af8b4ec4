/* sim_model: the text and counts of complaints, and when a frame is complete, on a glass that the test makes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "sim_model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint32_t missing_x, missing_y;

static bool all_but_one(const struct sim *sim, uint32_t x, uint32_t y)
{
    assert_true(x < sim->glass.width && y < sim->glass.height);
    return x != missing_x || y != missing_y;
}

static const struct sim_model model = {.controller = "ABC123", .written = all_but_one};

static struct sim *fresh(void)
{
    struct sim *const sim = calloc(1, sizeof *sim);
    assert_non_null(sim);
    sim->glass = (struct sim_glass){.model = &model, .width = 4, .height = 3};
    return sim;
}

static void a_complaint_says_who_and_when(void **state)
{
    (void)state;
    struct sim *const sim = fresh();
    sim->time_ns = 12045678901;
    sim_complain(sim, SIM_BAD_PARAMETER, "%02Xh is %s", 0x3a, "wrong");
    assert_string_equal(sim->complaints[0], "ABC123, 12045.678 ms: 3Ah is wrong");
    sim->time_ns = 999;
    sim_complain(sim, SIM_DC_MOVED, "x");
    assert_string_equal(sim->complaints[1], "ABC123, 0.000 ms: x");
    sim->time_ns = 7005000;
    sim_complain(sim, SIM_DC_MOVED, "y");
    assert_string_equal(sim->complaints[2], "ABC123, 7.005 ms: y");
    assert_int_equal(sim->complaint_count, 3);
    for (int kind = 0; kind < SIM_COMPLAINT_KINDS; kind++) {
        assert_int_equal(sim->complaint_count_of[kind], kind == SIM_DC_MOVED ? 2 : kind == SIM_BAD_PARAMETER);
    }
    free(sim);
}

static void more_than_32_are_only_counted(void **state)
{
    (void)state;
    struct sim *const sim = fresh();
    for (unsigned i = 0; i < 40; i++) {
        sim_complain(sim, SIM_SHORT_RESET, "number %u", i);
    }
    assert_int_equal(sim->complaint_count, 40);
    assert_int_equal(sim->complaint_count_of[SIM_SHORT_RESET], 40);
    assert_string_equal(sim->complaints[0], "ABC123, 0.000 ms: number 0");
    assert_string_equal(sim->complaints[31], "ABC123, 0.000 ms: number 31");
    assert_string_equal(sim->note, "");
    free(sim);
}

static void a_long_complaint_is_cut(void **state)
{
    (void)state;
    struct sim *const sim = fresh();
    char text[300];
    memset(text, 'w', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    sim_complain(sim, SIM_SHORT_RESET, "%s", text);
    assert_int_equal(strlen(sim->complaints[0]), 159);
    assert_int_equal(sim->complaints[0][158], 'w');
    assert_int_equal(sim->complaints[1][0], 0);
    free(sim);
}

static void a_frame_is_complete_when_no_pixel_is_missing(void **state)
{
    (void)state;
    struct sim *const sim = fresh();
    for (missing_y = 0; missing_y < 4; missing_y++) {
        for (missing_x = 0; missing_x < 5; missing_x++) {
            assert_int_equal(sim_frame_complete(sim), missing_x == 4 || missing_y == 3);
        }
    }
    free(sim);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_complaint_says_who_and_when),
        cmocka_unit_test(more_than_32_are_only_counted),
        cmocka_unit_test(a_long_complaint_is_cut),
        cmocka_unit_test(a_frame_is_complete_when_no_pixel_is_missing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
