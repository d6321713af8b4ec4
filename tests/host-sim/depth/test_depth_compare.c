/* depth_compare: logs of a kit against answers that the test plays: what is the same, the line that differs, and
 * requests that cannot be answered. */
#define _XOPEN_SOURCE 700 /* open_memstream */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "depth_lab.h"
#include "files.h"
#include "lab_request.h"
#include "stderr_capture.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* In place of lab_request.c: "N F FORMAT" is answered with its mark and two lines more, in three pieces. */
int lab_request(const char *line, void *memory, size_t memory_bytes, lab_put *put, void *context)
{
    assert_true(memory != NULL && memory_bytes >= 1 << 16);
    memset(memory, 0, memory_bytes);
    if (strstr(line, "large") != NULL) {
        return PH_ERR_NOMEM;
    }
    if (strstr(line, "wrong") != NULL) {
        return PH_ERR_INVAL;
    }
    put(context, LAB_REQUEST_MARK);
    put(context, line);
    put(context, "\n1,2,3\ndone\n");
    return 0;
}

static char *csv;
static struct stderr_capture said;

static int compare(const char *path)
{
    const struct depth_lab lab = {.kind = path};
    free(csv);
    stderr_capture_begin(&said);
    const int status = depth_lab_capture(&lab, depth_compare, &csv);
    stderr_capture_end(&said);
    return status;
}

#define HEAD   "near,far,format,lines,verdict\n"
#define ANSWER "> 0.1 1000 float16\n1,2,3\ndone\n"

static void answers_that_are_the_same_have_a_row_each(void **state)
{
    static const struct {
        const char *log, *rows;
    } cases[] = {
        {ANSWER, HEAD "0.1,1000,float16,3,same\n"},
        {"boot\n\n" ANSWER "> 1 2 log\n1,2,3\ndone\nend", HEAD "0.1,1000,float16,3,same\n1,2,log,3,same\n"},
        {"> 0.1 1000 float16\r\n1,2,3\r\ndone\r\n", HEAD "0.1,1000,float16,3,same\n"},
        {"\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r\r" ANSWER, HEAD "0.1,1000,float16,3,same\n"},
        {"a > 1 2 wrong\n>1\n" ANSWER ANSWER, HEAD "0.1,1000,float16,3,same\n0.1,1000,float16,3,same\n"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(compare(file_text("log", cases[i].log)), 0);
        assert_string_equal(csv, cases[i].rows);
        assert_int_equal(said.text[0], 0);
    }
}

static void what_differs_or_is_missing_is_told(void **state)
{
    static const struct {
        const char *log, *line;
    } cases[] = {
        {"> 1 2 log\n1,2,4\ndone\n", "compare: line 2 of the answer differs: `1,2,4` there, `1,2,3` here\n"},
        {"> 1 2 log\n1,2,3\ndon\n", "compare: line 3 of the answer differs: `don` there, `done` here\n"},
        {"> 1 2 log\n1,2,3\ndone", "line 3 of the answer differs: `done` there, `done` here\n"},
        {"> 1 2 log\n1,2,3\n", "line 3 of the answer differs: `` there, `done` here\n"},
        {"> 1 2 log\n1,2,31\ndone\n", "line 2 of the answer differs: `1,2,31` there, `1,2,3` here\n"},
        {ANSWER "> 1 2 log\n\n", "line 2 of the answer differs: `` there, `1,2,3` here\n"},
        {"> 1 2 wrong\n", "compare: no such request: 1 2 wrong\n"},
        {"> 1 2 large\n", "compare: 1 2 large cannot be measured here\n"},
        {"", "compare: the log has no answer; one begins with `> 0.1 1000 float16`\n"},
        {"boot\n>\n", "compare: the log has no answer"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(compare(file_text("log", cases[i].log)), COMPLAINED);
        assert_non_null(strstr(said.text, cases[i].line));
        assert_int_equal(stderr_capture_lines(&said), 1);
    }
}

static void a_log_is_read_whole_from_a_file_or_from_standard_input(void **state)
{
    static char large[20100];
    (void)state;
    memset(large, '-', 20000);
    memcpy(large + 20000, "\n" ANSWER, sizeof ANSWER + 1);
    file_text("large", large);
    assert_int_equal(compare(file_path("large")), 0);
    assert_string_equal(csv, HEAD "0.1,1000,float16,3,same\n");
    const int before = dup(STDIN_FILENO);
    assert_non_null(freopen(file_path("large"), "r", stdin));
    assert_int_equal(compare("-"), 0);
    assert_string_equal(csv, HEAD "0.1,1000,float16,3,same\n");
    dup2(before, STDIN_FILENO);
    close(before);
    assert_int_equal(compare(file_path("none")), COMPLAINED);
    assert_non_null(strstr(said.text, "none: cannot be read: No such file"));
    assert_int_equal(compare(file_path(".")), COMPLAINED);
    assert_non_null(strstr(said.text, "/.: cannot be read"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers_that_are_the_same_have_a_row_each),
        cmocka_unit_test(what_differs_or_is_missing_is_told),
        cmocka_unit_test(a_log_is_read_whole_from_a_file_or_from_standard_input),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
