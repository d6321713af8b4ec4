/* complain: one line a message, whatever is in it, and the exit status. */
#define _XOPEN_SOURCE 700 /* dup2, SIGXFSZ */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "stderr_capture.h"
#include "status.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static void control_characters_become_question_marks(void **state)
{
    (void)state;
    char text[] = "a\n\x1f \x7f~\x80\xff\t\x01";
    complain_clean(text);
    assert_string_equal(text, "a?? ?~\x80\xff??");
}

static void a_message_is_a_line_and_a_status(void **state)
{
    (void)state;
    struct stderr_capture capture;
    stderr_capture_begin(&capture);
    const int failed = complain("%s: %d", "a\nb", 7), wrong = complain_usage("usage %c", 'x');
    complain_note("goes on");
    stderr_capture_end(&capture);
    assert_int_equal(failed, -125);
    assert_int_equal(wrong, -22);
    assert_string_equal(capture.text, "pinhole: a?b: 7\npinhole: usage x\npinhole: goes on\n");
}

static void a_long_message_is_cut(void **state)
{
    (void)state;
    struct stderr_capture capture;
    char text[2000];
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    stderr_capture_begin(&capture);
    complain_note("%s", text);
    stderr_capture_end(&capture);
    assert_int_equal(strlen(capture.text), strlen("pinhole: ") + 1023 + 1);
    assert_int_equal(stderr_capture_lines(&capture), 1);
}

static void the_status_becomes_that_of_the_program(void **state)
{
    (void)state;
    assert_int_equal(complain_exit(0), 0);
    assert_int_equal(complain_exit(PH_ERR_INVAL), 2);
    assert_int_equal(complain_exit(COMPLAINED), 1);
    assert_int_equal(complain_exit(PH_ERR_NOMEM), 1);
    assert_int_equal(complain_exit(3), 1);
}

/* What a child of this process says on both streams, and its exit status. */
struct said {
    char text[300];
    int status;
};

static struct said of_child(void (*run)(void))
{
    struct said said = {.status = -1};
    FILE *const file = tmpfile();
    assert_non_null(file);
    fflush(stdout);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        dup2(fileno(file), STDOUT_FILENO);
        dup2(fileno(file), STDERR_FILENO);
        run();
        _exit(99);
    }
    assert_int_equal(waitpid(child, &said.status, 0), child);
    const ssize_t n = pread(fileno(file), said.text, sizeof said.text - 1, 0);
    said.text[n < 0 ? 0 : n] = '\0';
    fclose(file);
    said.status = WIFEXITED(said.status) ? WEXITSTATUS(said.status) : -1;
    return said;
}

static char program[] = "name", version[] = "--version", other[] = "--versions";

static void ask_version(void)
{
    char *words[] = {program, version, NULL};
    complain_begin("pinhole-x", 2, words);
}

static void ask_something_else(void)
{
    char *words[] = {program, other, NULL};
    complain_begin("pinhole-x", 2, words);
    complain_note("here");
    raise(SIGXFSZ);
    fflush(stdout);
    _exit(7);
}

static void ask_version_and_more(void)
{
    char *words[] = {program, version, other, NULL};
    complain_begin("pinhole-x", 3, words);
    complain_begin("pinhole-y", 1, words);
    _exit(8);
}

static void version_is_printed_where_it_is_the_only_word(void **state)
{
    (void)state;
    struct said said = of_child(ask_version);
    assert_string_equal(said.text, "pinhole-x " PH_VERSION "\n");
    assert_int_equal(said.status, 0);
    said = of_child(ask_something_else);
    assert_string_equal(said.text, "pinhole-x: here\n");
    assert_int_equal(said.status, 7);
    said = of_child(ask_version_and_more);
    assert_string_equal(said.text, "");
    assert_int_equal(said.status, 8);
}

static void fill_stdout(void)
{
    if (freopen("/dev/full", "w", stdout) == NULL) {
        _exit(98);
    }
    printf("lost");
    _exit(complain_exit(0));
}

static void fill_stdout_early(void)
{
    if (freopen("/dev/full", "w", stdout) == NULL) {
        _exit(98);
    }
    printf("lost");
    fflush(stdout);
    _exit(complain_exit(0));
}

static void a_stdout_that_is_full_is_told(void **state)
{
    (void)state;
    struct said said = of_child(fill_stdout);
    assert_string_equal(said.text, "pinhole: stdout cannot be written: No space left on device\n");
    assert_int_equal(said.status, 1);
    said = of_child(fill_stdout_early);
    assert_non_null(strstr(said.text, "pinhole: stdout cannot be written: "));
    assert_int_equal(said.status, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(control_characters_become_question_marks),
        cmocka_unit_test(a_message_is_a_line_and_a_status),
        cmocka_unit_test(a_long_message_is_cut),
        cmocka_unit_test(the_status_becomes_that_of_the_program),
        cmocka_unit_test(version_is_printed_where_it_is_the_only_word),
        cmocka_unit_test(a_stdout_that_is_full_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
