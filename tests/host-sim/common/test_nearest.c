/* nearest: distances counted by hand; a name is suggested up to a third of its letters away, and no further. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "nearest.h"

#include <string.h>

struct names {
    const char *const *all;
    size_t count;
};

static const char *name_at(const void *from, size_t i)
{
    const struct names *names = from;
    return i < names->count ? names->all[i] : NULL;
}

static void expect(const char *wrong, const char *const *all, size_t count, const char *meant)
{
    const struct names names = {all, count};
    assert_string_equal(nearest_text(wrong, name_at, &names), meant);
}

static void expect_one(const char *wrong, const char *right, const char *meant)
{
    expect(wrong, &right, 1, meant);
}

static void a_letter_may_be_changed_added_or_lost(void **state)
{
    (void)state;
    expect_one("cup", "cap", "did you mean cap? ");
    expect_one("cp", "cap", "did you mean cap? ");
    expect_one("ap", "cap", "did you mean cap? ");
    expect_one("ca", "cap", "did you mean cap? ");
    expect_one("cap", "ca", "did you mean ca? ");
    expect_one("caap", "cap", "did you mean cap? ");
    expect_one("cap", "cap", "did you mean cap? ");
}

static void a_third_of_the_longer_name_may_differ(void **state)
{
    (void)state;
    expect_one("cux", "cap", "");                                     /* 2 of 3 */
    expect_one("kitten", "sittin", "did you mean sittin? ");          /* 2 of 6 */
    expect_one("kitten", "sitting", "");                              /* 3 of 7: the textbooks' example */
    expect_one("abcdefghi", "xbcdxfghx", "did you mean xbcdxfghx? "); /* 3 of 9 */
    expect_one("abcdefghi", "xbcdxfgx", "");                          /* 4 of 9 */
    expect_one("abcdef", "cdef", "did you mean cdef? ");              /* 2 of 6, the wrong one is longer */
    expect_one("cdef", "abcdef", "did you mean abcdef? ");
    expect_one("", "a", "");
    expect_one("ab", "ba", ""); /* two letters change places: 2 of 2 */
    expect_one("saturday", "sunday", "");
    expect_one("saturdayabc", "sundayabc", "did you mean sundayabc? "); /* 3 of 11 */
}

static void the_nearest_is_suggested_and_of_equals_the_first(void **state)
{
    (void)state;
    static const char *const names[] = {"turntaxxe", "turntabxe", "turntablx", "cube"};
    expect("turntable", names, 4, "did you mean turntabxe? ");
    expect("turntablx", names, 4, "did you mean turntablx? ");
    expect("cubs", names, 4, "did you mean cube? ");
    expect("cubs", names, 3, "");
    expect("torus", names, 4, "");
}

/* Names of 64 letters and more are not compared, neither as the wrong one nor as one of the list. */
static void long_names_are_left_alone(void **state)
{
    (void)state;
    char right[66], wrong[66];
    for (size_t n = 62; n < 66; n++) {
        memset(right, 'a', n);
        memset(wrong, 'a', n);
        wrong[0] = 'b';
        right[n] = wrong[n] = '\0';
        const char *const name = right;
        const struct names names = {&name, 1};
        assert_int_equal(strlen(nearest_text(wrong, name_at, &names)), n < 64 ? strlen("did you mean ? ") + n : 0);
    }
    memset(wrong, 'a', 64);
    wrong[64] = right[63] = '\0';
    expect_one(wrong, right, "");
    static const char *const both[] = {"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaab",
                                       "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"};
    assert_int_equal(strlen(both[0]), 65);
    assert_int_equal(strlen(both[1]), 63);
    expect("aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa", both, 2,
           "did you mean aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa? ");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_letter_may_be_changed_added_or_lost),
        cmocka_unit_test(a_third_of_the_longer_name_may_differ),
        cmocka_unit_test(the_nearest_is_suggested_and_of_equals_the_first),
        cmocka_unit_test(long_names_are_left_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
