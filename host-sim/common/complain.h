/*
 * complain: messages of the host programs. A message is one line on stderr, "program: what, where, what to do". Control
 * characters (from file names, say) become '?', so that it stays one line.
 *
 * Functions of the host programs return 0 when done, or a negative errno value as status.h and hal.h name them; a
 * positive number is a count. Only main() turns it into an exit status, by complain_exit().
 */
#ifndef COMPLAIN_H
#define COMPLAIN_H

#include "status.h"

#define COMPLAINED (-125) /* ECANCELED: it failed, and a line has said why */

/* Prints the line; returns COMPLAINED. */
int complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Prints the line about a wrong command line; returns PH_ERR_INVAL. */
int complain_usage(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Prints the line when the program goes on. */
void complain_note(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Returns the exit status: 0 done, 1 failed, 2 for PH_ERR_INVAL. It is also 1, with a line, if stdout cannot be
 * written. */
int complain_exit(int status);

/* Call this first: it sets the name that starts each line (the text must stay). From then on a write to a file that may
 * not grow further (SIGXFSZ) fails and does not end the program. With --version as the only word it prints name and
 * version, and ends the program. */
void complain_begin(const char *program, int argc, char *const argv[]);

/* Replaces control characters of text by '?'. */
void complain_clean(char *text);

#endif
