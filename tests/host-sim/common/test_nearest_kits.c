/* nearest_kits: the lists name every demo and every board once, in their order, and end. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "board.h"
#include "demo.h"
#include "nearest.h"

static void every_demo_is_named_and_then_the_list_ends(void **state)
{
    (void)state;
    for (size_t i = 0; i < demo_count; i++) {
        assert_string_equal(nearest_demo(NULL, i), demo_list[i]->name);
    }
    assert_null(nearest_demo(NULL, demo_count));
    assert_null(nearest_demo(NULL, demo_count + 1));
}

static void every_board_is_named_and_then_the_list_ends(void **state)
{
    (void)state;
    for (size_t i = 0; i < board_count; i++) {
        assert_string_equal(nearest_board(NULL, i), board_list[i]->name);
    }
    assert_null(nearest_board(NULL, board_count));
    assert_null(nearest_board(NULL, board_count + 1));
}

static void a_mistyped_kit_or_demo_is_found(void **state)
{
    (void)state;
    assert_string_equal(nearest_text("turntabel", nearest_demo, NULL), "did you mean turntable? ");
    assert_string_equal(nearest_text("pico-dispaly", nearest_board, NULL), "did you mean pico-display? ");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_demo_is_named_and_then_the_list_ends),
        cmocka_unit_test(every_board_is_named_and_then_the_list_ends),
        cmocka_unit_test(a_mistyped_kit_or_demo_is_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
