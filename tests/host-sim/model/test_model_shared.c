/* model_shared: notes are kept once and never cut, lists grow before they are full, and endings of names. */
#include "model_shared.h"

#include <malloc.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static struct model_shared shared;

static int fresh(void **state)
{
    (void)state;
    memset(&shared, 0, sizeof shared);
    return 0;
}

static void a_failure_is_a_line_that_fits(void **state)
{
    (void)state;
    assert_false(model_shared_failed(&shared, "has %d of %s", 3, "four"));
    assert_string_equal(shared.error, "has 3 of four");
    assert_false(model_shared_failed(&shared, "%0300d", 7));
    assert_int_equal(strlen(shared.error), sizeof shared.error - 1);
    assert_int_equal(shared.error[254], '0');
}

static void a_note_is_kept_once(void **state)
{
    (void)state;
    model_shared_note(&shared, "lines are %s", "left out");
    assert_string_equal(shared.note, "lines are left out");
    model_shared_note(&shared, "points");
    model_shared_note(&shared, "lines are left out");
    model_shared_note(&shared, "points");
    assert_string_equal(shared.note, "lines are left out; points");
    model_shared_note(&shared, "more points");
    assert_string_equal(shared.note, "lines are left out; points; more points");
    shared.note[1] = 0;
    model_shared_note(&shared, "points");
    assert_string_equal(shared.note, "l; points");
}

/* 512 bytes hold 500 letters, "; ", a text of nine letters and the zero, and not one letter more. */
static void a_note_that_has_no_room_is_left_out_whole(void **state)
{
    (void)state;
    model_shared_note(&shared, "%0500d", 0);
    assert_int_equal(strlen(shared.note), 500);
    model_shared_note(&shared, "tentheight");
    assert_int_equal(strlen(shared.note), 500);
    model_shared_note(&shared, "ninenight");
    assert_string_equal(shared.note + 500, "; ninenight");
    model_shared_note(&shared, "x");
    assert_int_equal(strlen(shared.note), 511);
}

static void endings_are_compared_without_regard_to_capitals(void **state)
{
    static const struct {
        const char *name, *ending;
        bool ends;
    } cases[] = {{"a/box.obj", ".obj", true}, {"a/box.OBJ", ".obj", true},  {"box.obj.gz", ".obj", false},
                 {".obj", ".obj", true},      {"obj", ".obj", false},       {"", ".obj", false},
                 {"box.objx", ".obj", false}, {"a.obj/box", ".obj", false}, {"box.xobj", ".obj", false}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        shared.folder.model = cases[i].name;
        assert_int_equal(model_shared_ends(&shared, cases[i].ending), cases[i].ends);
    }
}

/* An element has 64 bytes, more than what malloc adds to round up. */
static void a_list_doubles_before_it_is_full(void **state)
{
    struct line {
        unsigned char at[64];
    } *list = NULL;
    size_t room = 0;
    (void)state;
    for (unsigned n = 0; n < 200; n++) {
        list = model_shared_grow(list, n, sizeof *list);
        assert_non_null(list);
        assert_in_range(malloc_usable_size(list) / sizeof *list, n + 1, n < 16 ? 16 : 2 * n);
        assert_true(room < n + 1 || room == malloc_usable_size(list) / sizeof *list);
        room = malloc_usable_size(list) / sizeof *list;
        memset(&list[n], (int)n, sizeof *list);
        for (unsigned i = 0; i <= n; i++) {
            assert_int_equal(list[i].at[4], i);
        }
    }
    free(list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_failure_is_a_line_that_fits, fresh),
        cmocka_unit_test_setup(a_note_is_kept_once, fresh),
        cmocka_unit_test_setup(a_note_that_has_no_room_is_left_out_whole, fresh),
        cmocka_unit_test_setup(endings_are_compared_without_regard_to_capitals, fresh),
        cmocka_unit_test(a_list_doubles_before_it_is_full),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
