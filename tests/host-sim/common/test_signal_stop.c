/* signal_stop: the three signals are noted, others are not caught, and one that was ignored stays so. */
#define _XOPEN_SOURCE 700 /* sigaction */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "signal_stop.h"

static void before_a_signal_it_is_0(void **state)
{
    (void)state;
    assert_int_equal(signal_stop, 0);
    signal_stop_catch();
    assert_int_equal(signal_stop, 0);
}

static void each_signal_is_noted_by_its_number(void **state)
{
    (void)state;
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        signal(numbers[i], SIG_DFL);
        signal_stop_catch();
        signal_stop = 0;
        raise(numbers[i]);
        assert_int_equal(signal_stop, numbers[i]);
        raise(numbers[i]); /* a second one ends nothing, either */
        assert_int_equal(signal_stop, numbers[i]);
    }
}

static void an_ignored_signal_stays_ignored(void **state)
{
    (void)state;
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        signal(numbers[i], SIG_IGN);
        signal_stop_catch();
        signal_stop = 0;
        raise(numbers[i]);
        assert_int_equal(signal_stop, 0);
        raise(numbers[(i + 1) % 3]);
        assert_int_equal(signal_stop, numbers[(i + 1) % 3]);
        signal(numbers[i], SIG_DFL);
        signal_stop_catch();
    }
}

static void other_signals_are_left_alone(void **state)
{
    (void)state;
    static const int numbers[] = {SIGPIPE, SIGALRM, SIGUSR1, SIGQUIT};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        struct sigaction found;
        assert_int_equal(sigaction(numbers[i], NULL, &found), 0);
        assert_true(found.sa_handler == SIG_DFL);
    }
    struct sigaction found;
    assert_int_equal(sigaction(SIGTERM, NULL, &found), 0);
    assert_int_equal(found.sa_flags & SA_RESTART, 0); /* a call that waits ends */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(before_a_signal_it_is_0),
        cmocka_unit_test(each_signal_is_noted_by_its_number),
        cmocka_unit_test(an_ignored_signal_stays_ignored),
        cmocka_unit_test(other_signals_are_left_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
