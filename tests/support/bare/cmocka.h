/*
 * cmocka.h for machines without cmocka: what the tests here use of it, so that `make check` needs nothing but a C
 * compiler. The Makefile takes this folder only where cmocka is missing. Names and meaning are cmocka's; the output is
 * TAP, as with CMOCKA_MESSAGE_OUTPUT=TAP. A test that fails ends by longjmp.
 */
#ifndef BARE_CMOCKA_H
#define BARE_CMOCKA_H

#include <setjmp.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct CMUnitTest {
    const char *name;
    void (*test)(void **state);
    int (*setup)(void **state);
    int (*teardown)(void **state);
};

enum { BARE_PASSED, BARE_FAILED, BARE_SKIPPED };

static jmp_buf bare_end;        /* of the test that runs */
static const char *bare_filter; /* a test that is left out */

__attribute__((noreturn, unused)) static void bare_fail(const char *file, int line, const char *what)
{
    printf("# %s:%d: %s\n", file, line, what);
    longjmp(bare_end, BARE_FAILED);
}

__attribute__((unused)) static void bare_compare(const char *file, int line, const char *what, uintmax_t a, uintmax_t b,
                                                 int equal)
{
    if ((a == b) != equal) {
        printf("# %#jx, %#jx\n", a, b);
        bare_fail(file, line, what);
    }
}

__attribute__((unused)) static void bare_bytes(const char *file, int line, const char *what, const void *a,
                                               const void *b, size_t n, int equal)
{
    if ((memcmp(a, b, n) == 0) != equal) {
        bare_fail(file, line, what);
    }
}

__attribute__((unused)) static void bare_text(const char *file, int line, const char *a, const char *b, int equal)
{
    if ((strcmp(a, b) == 0) != equal) {
        printf("# \"%s\", \"%s\"\n", a, b);
        bare_fail(file, line, equal ? "the texts differ" : "the texts are the same");
    }
}

#define BARE_AT __FILE__, __LINE__

#define assert_true(c)                   ((c) ? (void)0 : bare_fail(BARE_AT, #c))
#define assert_false(c)                  ((c) ? bare_fail(BARE_AT, "not: " #c) : (void)0)
#define assert_non_null(p)               assert_true((p) != NULL)
#define assert_null(p)                   assert_true((p) == NULL)
#define assert_int_equal(a, b)           bare_compare(BARE_AT, #a " == " #b, (uintmax_t)(a), (uintmax_t)(b), 1)
#define assert_int_not_equal(a, b)       bare_compare(BARE_AT, #a " != " #b, (uintmax_t)(a), (uintmax_t)(b), 0)
#define assert_ptr_equal(a, b)           bare_compare(BARE_AT, #a " == " #b, (uintptr_t)(a), (uintptr_t)(b), 1)
#define assert_ptr_not_equal(a, b)       bare_compare(BARE_AT, #a " != " #b, (uintptr_t)(a), (uintptr_t)(b), 0)
#define assert_in_range(v, a, b)         assert_true((uintmax_t)(v) >= (uintmax_t)(a) && (uintmax_t)(v) <= (uintmax_t)(b))
#define assert_memory_equal(a, b, n)     bare_bytes(BARE_AT, #a " and " #b " differ", a, b, n, 1)
#define assert_memory_not_equal(a, b, n) bare_bytes(BARE_AT, #a " and " #b " are the same", a, b, n, 0)
#define assert_string_equal(a, b)        bare_text(BARE_AT, a, b, 1)
#define assert_string_not_equal(a, b)    bare_text(BARE_AT, a, b, 0)
#define fail()                           bare_fail(BARE_AT, "fail")
#define fail_msg(...)                    (printf("# " __VA_ARGS__), printf("\n"), bare_fail(BARE_AT, "fail"))
#define skip()                           longjmp(bare_end, BARE_SKIPPED)
#define print_message(...)               printf(__VA_ARGS__)
#define print_error(...)                 fprintf(stderr, __VA_ARGS__)

#define cmocka_set_skip_filter(name) (bare_filter = (name))
#define cmocka_unit_test(f)                                                                                            \
    {                                                                                                                  \
#f, f, NULL, NULL                                                                                              \
    }
#define cmocka_unit_test_setup(f, s)                                                                                   \
    {                                                                                                                  \
#f, f, s, NULL                                                                                                 \
    }
#define cmocka_unit_test_teardown(f, t)                                                                                \
    {                                                                                                                  \
#f, f, NULL, t                                                                                                 \
    }
#define cmocka_unit_test_setup_teardown(f, s, t)                                                                       \
    {                                                                                                                  \
#f, f, s, t                                                                                                    \
    }
#define cmocka_run_group_tests(tests, setup, teardown)                                                                 \
    bare_run((tests), sizeof(tests) / sizeof(tests)[0], (setup), (teardown))

/* How a test ended. Its teardown runs whether it failed or not. */
static int bare_one(const struct CMUnitTest *test, void **state)
{
    volatile int end = setjmp(bare_end);
    if (end == BARE_PASSED) {
        if (test->setup != NULL && test->setup(state) != 0) {
            printf("# its setup failed\n");
            return BARE_FAILED;
        }
        test->test(state);
    }
    if (test->teardown != NULL && test->teardown(state) != 0) {
        printf("# its teardown failed\n");
        end = BARE_FAILED;
    }
    return end;
}

__attribute__((unused)) static int bare_run(const struct CMUnitTest *tests, size_t n, int (*setup)(void **state),
                                            int (*teardown)(void **state))
{
    void *shared = NULL;
    const int broken = setup != NULL && setup(&shared) != 0;
    int failed = 0;
    printf("1..%zu\n", n);
    for (size_t i = 0; i < n; i++) {
        void *state = shared;
        const int left_out = bare_filter != NULL && strcmp(bare_filter, tests[i].name) == 0;
        const int end = left_out ? BARE_SKIPPED : broken ? BARE_FAILED : bare_one(&tests[i], &state);
        printf("%sok %zu - %s%s\n", end == BARE_FAILED ? "not " : "", i + 1, tests[i].name,
               end == BARE_SKIPPED ? " # SKIP" : "");
        fflush(stdout);
        failed += end == BARE_FAILED;
    }
    failed += teardown != NULL && teardown(&shared) != 0;
    return failed;
}

#endif
