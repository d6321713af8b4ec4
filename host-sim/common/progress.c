/* See progress.h. The main program prepares a line, and a timer's signal handler writes it. */
#define _XOPEN_SOURCE 700 /* isatty, setitimer, sigaction */

#include "progress.h"

#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

/* A signal handler gets no argument, so its state is here. It writes lines[current]; set_line fills the other one
 * first. */
static char lines[2][96];
static volatile sig_atomic_t current, lengths[2];

static const char *program_name = "pinhole";

void progress_begin(const char *program)
{
    program_name = program;
}

static void write_line(int number)
{
    (void)number;
    const int line = current, before = errno;
    if (lengths[line] > 0 && write(STDERR_FILENO, lines[line], (size_t)lengths[line]) < 0) {
        lengths[line] = 0; /* nobody reads it */
    }
    errno = before;
}

static void start_timer(void)
{
    static const struct itimerval times = {.it_value = {PROGRESS_FIRST_S, 0}, .it_interval = {PROGRESS_EVERY_S, 0}};
    static bool is_started;
    struct sigaction action = {.sa_handler = write_line, .sa_flags = SA_RESTART};
    if (!is_started) {
        is_started = true;
        sigemptyset(&action.sa_mask);
        sigaction(SIGALRM, &action, NULL);
        setitimer(ITIMER_REAL, &times, NULL);
    }
}

static void set_line(const char *what, uint64_t done, uint64_t total)
{
    const int next = 1 - current;
    char *const line = lines[next];
    lengths[next] = 0;
    if (done < total) {
        snprintf(line, sizeof lines[0], "%s: %s: %llu of %llu\n", program_name, what, (unsigned long long)done,
                 (unsigned long long)total);
        lengths[next] = (sig_atomic_t)strlen(line);
    }
    current = next;
    start_timer();
}

static bool has_bar;
static int bar_filled; /* characters */

void progress_clear(void)
{
    if (has_bar) {
        fprintf(stderr, "\r%79s\r", "");
        fflush(stderr);
    }
    has_bar = false;
}

void progress_show(const char *what, uint64_t done, uint64_t total)
{
    static const char bar[] = "########################################";
    const int filled = (int)(done * 40 / (total > 0 ? total : 1));
    const char *const wish = getenv("PINHOLE_PROGRESS");
    if (wish != NULL && strcmp(wish, "off") == 0) {
        return;
    }
    if (!isatty(STDERR_FILENO)) {
        set_line(what, done, total);
    } else if (done >= total) {
        progress_clear();
    } else if (!has_bar || filled != bar_filled) {
        fprintf(stderr, "\r%-20s [%-40.*s] %3d %%", what, filled, bar, filled * 5 / 2);
        fflush(stderr);
        has_bar = true;
        bar_filled = filled;
    }
}
