/* hal/linux/debounce: edges of a contact that bounces, in milliseconds, and which presses a look sees. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "../../hal/linux/debounce.h"

#define MS     1000000ULL
#define SETTLE (10 * MS)

static struct linux_button button;

static int released(void **state)
{
    (void)state;
    linux_debounce_start(&button, false, 100 * MS);
    return 0;
}

static void edge(bool pressed, uint64_t ms)
{
    linux_debounce_edge(&button, pressed, ms * MS, SETTLE);
}

static bool seen(uint64_t ms)
{
    return linux_debounce_look(&button, ms * MS, SETTLE);
}

static void a_contact_that_rests_is_as_it_began(void **state)
{
    (void)state;
    assert_false(seen(100));
    assert_false(seen(5000));
    linux_debounce_start(&button, true, 0);
    assert_true(seen(0));
    assert_true(seen(5000));
}

static void a_press_counts_at_its_first_edge(void **state)
{
    (void)state;
    edge(true, 110); /* the first moment that does */
    assert_true(seen(110));
}

static void an_edge_within_the_settling_time_of_the_last_change_does_not_count(void **state)
{
    (void)state;
    edge(true, 109);
    assert_false(seen(109));
    edge(true, 200);
    edge(false, 209);
    assert_true(seen(209));
    assert_true(seen(218)); /* it has not rested for 10 ms yet */
}

static void the_level_at_which_it_rests_counts(void **state)
{
    (void)state;
    edge(true, 200);
    edge(false, 203);
    edge(true, 205);
    edge(false, 207);
    assert_true(seen(216));
    assert_false(seen(217) && seen(217)); /* released 10 ms after the last edge */
    assert_false(seen(218));
}

static void the_settling_time_counts_from_each_change(void **state)
{
    (void)state;
    edge(true, 200);
    edge(false, 210);
    assert_true(seen(210)); /* it was pressed */
    assert_false(seen(211));
    edge(true, 219); /* too early after the release */
    assert_false(seen(219));
    edge(true, 220);
    assert_true(seen(220));
}

static void a_press_between_two_looks_is_seen_by_one(void **state)
{
    (void)state;
    edge(true, 200);
    edge(false, 230);
    assert_true(seen(300));
    assert_false(seen(300));
}

static void a_start_forgets_what_was_pressed(void **state)
{
    (void)state;
    edge(true, 200);
    linux_debounce_start(&button, false, 300 * MS);
    assert_false(seen(300));
    assert_false(seen(400));
    linux_debounce_start(&button, true, 500 * MS);
    edge(false, 505); /* a bounce: the time counts from the start */
    assert_true(seen(510));
    assert_true(seen(514));
    assert_false(seen(515) && seen(516));
}

static void without_a_settling_time_every_edge_counts(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 6; i++) {
        linux_debounce_edge(&button, i % 2 == 0, 200 * MS + i, 0);
        assert_int_equal(button.held, i % 2 == 0);
    }
    assert_true(linux_debounce_look(&button, 201 * MS, 0));
    assert_false(linux_debounce_look(&button, 201 * MS, 0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_contact_that_rests_is_as_it_began, released),
        cmocka_unit_test_setup(a_press_counts_at_its_first_edge, released),
        cmocka_unit_test_setup(an_edge_within_the_settling_time_of_the_last_change_does_not_count, released),
        cmocka_unit_test_setup(the_level_at_which_it_rests_counts, released),
        cmocka_unit_test_setup(the_settling_time_counts_from_each_change, released),
        cmocka_unit_test_setup(a_press_between_two_looks_is_seen_by_one, released),
        cmocka_unit_test_setup(a_start_forgets_what_was_pressed, released),
        cmocka_unit_test_setup(without_a_settling_time_every_edge_counts, released),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
