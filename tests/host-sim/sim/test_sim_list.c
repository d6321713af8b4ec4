/* sim_list: the names of a demo's views. test_sim_cli has what --list prints. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "sim_list.h"

#include <string.h>

static const char *const two[] = {"head", "outside", NULL};
static const struct demo with_views = {.views = two};
static const struct demo without_views = {.views = NULL};

static void each_view_has_a_space_before_it(void **state)
{
    char text[40];
    (void)state;
    sim_list_views(&with_views, text, sizeof text);
    assert_string_equal(text, " head outside");
}

static void a_demo_without_views_gives_nothing(void **state)
{
    char text[8] = "before";
    (void)state;
    sim_list_views(&without_views, text, sizeof text);
    assert_string_equal(text, "");
}

static void what_has_no_room_is_cut_off(void **state)
{
    for (size_t room = 1; room <= 14; room++) {
        char text[20];
        memset(text, '#', sizeof text);
        sim_list_views(&with_views, text, room);
        assert_int_equal(strlen(text), room - 1);
        assert_memory_equal(text, " head outside", room - 1);
        assert_int_equal(text[room], '#');
    }
    (void)state;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_view_has_a_space_before_it),
        cmocka_unit_test(a_demo_without_views_gives_nothing),
        cmocka_unit_test(what_has_no_room_is_cut_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
