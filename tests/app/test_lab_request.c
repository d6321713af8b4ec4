/* lab_request: which lines are requests, what they ask the tables for, which the test plays, and what is put around
 * them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "lab_request.h"

#include <string.h>

static struct lab asked;
static int pairs_status, resolve_status;
static char answer[256];
static char memory[8];

/* In place of lab.c. */
int lab_pairs(const struct lab *lab)
{
    asked = *lab;
    lab->put(lab->context, "pairs\n");
    return pairs_status;
}

int lab_resolve(const struct lab *lab)
{
    assert_true(lab->near_z == asked.near_z && lab->formats == asked.formats);
    lab->put(lab->context, "resolve\n");
    return resolve_status;
}

static void put(void *context, const char *text)
{
    assert_ptr_equal(context, answer);
    strncat(answer, text, sizeof answer - strlen(answer) - 1);
}

static int request(const char *line)
{
    answer[0] = '\0';
    return lab_request(line, memory, sizeof memory, put, answer);
}

static uint32_t rows_of(const char *name)
{
    uint32_t rows = 0;
    for (uint32_t i = 0; i < lab_format_count; i++) {
        rows |= (uint32_t)(strcmp(lab_formats[i].name, name) == 0) << i;
    }
    return rows;
}

static void a_request_is_repeated_and_answered(void **state)
{
    (void)state;
    assert_int_equal(request("0.1 1000 float16"), 0);
    assert_string_equal(answer, "> 0.1 1000 float16\npairs\nresolve\ndone\n");
    assert_true(asked.near_z == 6554 && asked.far_z == FX_INT(1000) && asked.formats == rows_of("float16"));
    assert_true(asked.count == 500 && asked.memory == memory && asked.memory_bytes == sizeof memory);
    assert_int_equal(asked.spacing, LAB_LINEAR_SPACED);
    assert_int_equal(request("  1   2  log"), 0);
    assert_string_equal(answer, "> 1 2 log\npairs\nresolve\ndone\n");
    assert_int_equal(asked.formats, rows_of("log"));
    assert_int_equal(request("1 2 all"), 0);
    assert_int_equal(asked.formats, lab_format_count < 32 ? ((uint32_t)1 << lab_format_count) - 1 : UINT32_MAX);
}

static void other_lines_are_no_requests(void **state)
{
    static const char *const lines[] = {
        "",         "1",        "1 2",     "1 2 ",     "1 2 float", "1 2 float167", "1 2 float16 ", "1 2 FLOAT16",
        "2 1 log",  "1 1 log",  "0 1 log", "-1 1 log", "a 1 log",   "1 b log",      "1,2 log",      "1 2,log",
        "1x 2 log", ".5.75 log"};
    (void)state;
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        assert_int_equal(request(lines[i]), PH_ERR_INVAL);
        assert_string_equal(answer, "");
    }
}

static void what_fails_ends_so(void **state)
{
    (void)state;
    pairs_status = PH_ERR_NOMEM;
    assert_int_equal(request("1 2 log"), PH_ERR_NOMEM);
    assert_string_equal(answer, "> 1 2 log\npairs\nfailed\n");
    pairs_status = 0;
    resolve_status = PH_ERR_NOMEM;
    assert_int_equal(request("1 2 log"), PH_ERR_NOMEM);
    assert_string_equal(answer, "> 1 2 log\npairs\nresolve\nfailed\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_request_is_repeated_and_answered),
        cmocka_unit_test(other_lines_are_no_requests),
        cmocka_unit_test(what_fails_ends_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
