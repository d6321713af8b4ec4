/* progress: lines where stderr is a file, which the timer's signal writes, and a bar on a terminal. */
#define _XOPEN_SOURCE 700 /* setenv, getitimer, posix_openpt, dup2 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "progress.h"
#include "stderr_capture.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

static void off_means_nothing(void **state)
{
    (void)state;
    struct itimerval timer;
    setenv("PINHOLE_PROGRESS", "off", 1);
    progress_show("work", 1, 4);
    assert_int_equal(getitimer(ITIMER_REAL, &timer), 0);
    assert_int_equal(timer.it_value.tv_sec + timer.it_value.tv_usec, 0);
    setenv("PINHOLE_PROGRESS", "on", 1);
}

/* The signal itself is raised, so that the test need not wait for it. */
static void a_line_comes_with_the_timer(void **state)
{
    (void)state;
    struct stderr_capture capture;
    struct itimerval timer;
    stderr_capture_begin(&capture);
    progress_begin("program");
    progress_show("work", 3, 16);
    errno = 4711;
    raise(SIGALRM);
    const int after = errno;
    progress_show("work", 1ull << 40, 1ull << 41);
    raise(SIGALRM);
    raise(SIGALRM);
    progress_clear(); /* there is no bar */
    progress_show("work", 16, 16);
    raise(SIGALRM);
    stderr_capture_end(&capture);
    assert_int_equal(after, 4711);
    assert_string_equal(capture.text, "program: work: 3 of 16\nprogram: work: 1099511627776 of 2199023255552\n"
                                      "program: work: 1099511627776 of 2199023255552\n");
    assert_int_equal(getitimer(ITIMER_REAL, &timer), 0);
    assert_int_equal(timer.it_interval.tv_sec, 5);
    assert_true(timer.it_value.tv_sec < 2);
    const struct itimerval none = {{0, 0}, {0, 0}};
    setitimer(ITIMER_REAL, &none, NULL);
    progress_show("work", 1, 2); /* the timer is set once */
    assert_int_equal(getitimer(ITIMER_REAL, &timer), 0);
    assert_int_equal(timer.it_interval.tv_sec, 0);
    progress_show("work", 2, 2);
}

/* Where nobody reads, the line is dropped, and what was interrupted keeps its errno. */
static void a_stream_that_is_closed_is_no_matter(void **state)
{
    (void)state;
    struct stderr_capture capture;
    stderr_capture_begin(&capture);
    const int before = dup(STDERR_FILENO);
    close(STDERR_FILENO);
    progress_show("work", 1, 2);
    errno = 4711;
    raise(SIGALRM);
    const int after = errno;
    dup2(before, STDERR_FILENO);
    close(before);
    raise(SIGALRM);
    stderr_capture_end(&capture);
    assert_int_equal(after, 4711);
    assert_string_equal(capture.text, "");
}

static void a_long_line_is_cut(void **state)
{
    (void)state;
    struct stderr_capture capture;
    char what[200];
    memset(what, 'w', sizeof what - 1);
    what[sizeof what - 1] = '\0';
    stderr_capture_begin(&capture);
    progress_show(what, 0, 1);
    raise(SIGALRM);
    progress_show(what, 1, 1);
    stderr_capture_end(&capture);
    assert_int_equal(strlen(capture.text), 95);
}

/* What progress says on a terminal between the two marks of `run`. */
static void on_terminal(void (*run)(void), char *text, size_t size)
{
    const int master = posix_openpt(O_RDWR | O_NOCTTY), before = dup(STDERR_FILENO);
    assert_true(master >= 0 && before >= 0 && grantpt(master) == 0 && unlockpt(master) == 0);
    const int slave = open(ptsname(master), O_RDWR | O_NOCTTY);
    assert_true(slave >= 0);
    dup2(slave, STDERR_FILENO);
    run();
    fputc('.', stderr); /* so that there is something to read */
    dup2(before, STDERR_FILENO);
    size_t n = 0;
    while (n + 1 < size && (n == 0 || text[n - 1] != '.')) {
        const ssize_t more = read(master, text + n, size - 1 - n);
        assert_true(more > 0);
        n += (size_t)more;
    }
    text[n] = '\0';
    close(slave);
    close(before);
    close(master);
}

static void a_quarter_and_a_bit(void)
{
    progress_show("work", 10, 40);
    progress_show("work", 100, 399); /* 10 of 40 characters: nothing new */
    progress_show("work", 11, 40);
}

static void to_the_end(void)
{
    progress_show("work", 40, 40);
    progress_show("work", 0, 0);
    progress_clear();
    progress_show("work", 99, 100);
    progress_clear();
    progress_show("work", 99, 100); /* the bar is new, though as long as the last one */
    progress_clear();
}

#define BLANK "                                        "
#define WIPE  "\r" BLANK "                                       \r"

static void a_bar_grows_on_a_terminal_and_goes_away(void **state)
{
    (void)state;
    char text[1000];
    on_terminal(a_quarter_and_a_bit, text, sizeof text);
    assert_string_equal(text, "\rwork                 [##########                              ]  25 %"
                              "\rwork                 [###########                             ]  27 %.");
    on_terminal(to_the_end, text, sizeof text);
    assert_string_equal(text, WIPE "\rwork                 [####################################### ]  97 %" WIPE
                                   "\rwork                 [####################################### ]  97 %" WIPE ".");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(off_means_nothing),
        cmocka_unit_test(a_line_comes_with_the_timer),
        cmocka_unit_test(a_stream_that_is_closed_is_no_matter),
        cmocka_unit_test(a_long_line_is_cut),
        cmocka_unit_test(a_bar_grows_on_a_terminal_and_goes_away),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
