/* See signal_stop.h. */
#define _XOPEN_SOURCE 700 /* sigaction */

#include "signal_stop.h"

#include <stddef.h>

volatile sig_atomic_t signal_stop;

static void note_signal(int number)
{
    signal_stop = number;
}

void signal_stop_catch(void)
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    struct sigaction action = {.sa_handler = note_signal}, before;
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        if (sigaction(numbers[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN) {
            sigaction(numbers[i], &action, NULL);
        }
    }
}
