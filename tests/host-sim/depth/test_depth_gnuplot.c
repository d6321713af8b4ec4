/* depth_gnuplot: pictures and complaints of a gnuplot that the test plays: a shell script of that name, alone in PATH.
 */
#define _XOPEN_SOURCE 700 /* setenv */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "depth_gnuplot.h"
#include "files.h"
#include "stderr_capture.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>

static char *picture;
static size_t length;
static struct stderr_capture said;

/* Makes gnuplot do these commands; NULL: there is none. */
static void play(const char *commands)
{
    char text[500];
    remove(file_path("gnuplot"));
    if (commands != NULL) {
        snprintf(text, sizeof text, "#!/bin/sh\nPATH=/usr/bin:/bin\n%s\n", commands);
        chmod(file_text("gnuplot", text), 0755);
    }
    setenv("PATH", file_path("."), 1);
}

static int run(const char *script)
{
    picture = (char *)&said;
    stderr_capture_begin(&said);
    const int status = depth_gnuplot_run(script, &picture, &length);
    stderr_capture_end(&said);
    return status;
}

static void the_script_goes_in_and_the_picture_comes_out(void **state)
{
    (void)state;
    play("cat; echo \"$# $1 $2\"");
    assert_int_equal(run("plot x\nplot y\n"), 0);
    assert_int_equal(length, 14 + 7);
    assert_string_equal(picture, "plot x\nplot y\n2 -d -\n"); /* no defaults, from standard input */
    free(picture);
    play("cat >/dev/null; printf 'a\\000b'"); /* any bytes */
    assert_int_equal(run(""), 0);
    assert_int_equal(length, 3);
    assert_memory_equal(picture, "a\0b", 4);
    free(picture);
    assert_int_equal(said.text[0], 0);
}

/* The script is longer than what a pipe holds, and gnuplot may be gone before it has read it. */
static void a_long_script_is_fed_whole_or_not_at_all(void **state)
{
    enum { LONG = 300000 };
    char *const script = malloc(LONG + 1);
    (void)state;
    assert_non_null(script);
    memset(script, 'x', LONG), script[LONG] = '\0';
    play("wc -c");
    assert_int_equal(run(script), 0);
    assert_int_equal(strtol(picture, NULL, 10), LONG);
    free(picture);
    play("exec 0<&-; echo gone");
    assert_int_equal(run(script), 0);
    assert_string_equal(picture, "gone\n");
    free(picture);
    free(script);
    struct sigaction now;
    sigaction(SIGPIPE, NULL, &now);
    assert_true(now.sa_handler == SIG_DFL);
}

static void the_first_line_of_a_complaint_is_told(void **state)
{
    static const struct {
        const char *commands, *line;
    } cases[] = {{"cat >/dev/null; echo '  ^ line 3: bad' >&2; echo more >&2; exit 1", "gnuplot: line 3: bad\n"},
                 {"cat >/dev/null; echo half; echo bad >&2; exit 2", "gnuplot: bad\n"},
                 {"cat >/dev/null; echo warning >&2", "gnuplot: warning\n"},
                 {"cat >/dev/null", "gnuplot: wrote no picture\n"},
                 {"cat >/dev/null; kill -9 $$", "gnuplot: wrote no picture\n"},
                 {"cat >/dev/null; echo half; kill -9 $$", "gnuplot: wrote no picture\n"},
                 {NULL, "gnuplot is missing, and it draws the plots: apt-get install gnuplot-nox\n"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        play(cases[i].commands);
        assert_int_equal(run("plot x\n"), COMPLAINED);
        assert_null(picture);
        assert_non_null(strstr(said.text, cases[i].line));
        assert_int_equal(stderr_capture_lines(&said), 1);
    }
}

static void it_is_here_if_it_can_be_started(void **state)
{
    (void)state;
    play("exit 3");
    assert_true(depth_gnuplot_is_here());
    play("exit 0");
    assert_true(depth_gnuplot_is_here());
    chmod(file_path("gnuplot"), 0);
    assert_false(depth_gnuplot_is_here());
    play(NULL);
    assert_false(depth_gnuplot_is_here());
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1); /* no child is left */
    assert_int_equal(errno, ECHILD);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_script_goes_in_and_the_picture_comes_out),
        cmocka_unit_test(a_long_script_is_fed_whole_or_not_at_all),
        cmocka_unit_test(the_first_line_of_a_complaint_is_told),
        cmocka_unit_test(it_is_here_if_it_can_be_started),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
