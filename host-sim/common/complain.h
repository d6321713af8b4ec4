/*
 * complain: what the host programs say when something is wrong. Exactly one line on stderr, "program: what, where,
 * what to do"; control characters (from file names, say) become '?', so that it stays one line.
 *
 * Functions of the host programs return 0 when done, or a negative errno value as status.h and hal.h name them; a
 * positive number is a count. Only main() makes an exit status of it, by complain_exit().
 */
#ifndef COMPLAIN_H
#define COMPLAIN_H

#include "status.h"

#define COMPLAINED (-125) /* ECANCELED: it failed, and a line has said why */

/* Prints the line; returns COMPLAINED. */
int complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same where the command line is wrong; returns PH_ERR_INVAL. */
int complain_usage(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same where the program goes on. */
void complain_note(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The exit status: 0 done, 1 failed (also when stdout could not be written; a line says so), 2 for PH_ERR_INVAL. */
int complain_exit(int status);

/*
 * Before anything else: the name that starts each line (text that stays). From then on a file that may grow no further
 * (SIGXFSZ) is an error of the write, not the end of the program.
 */
void complain_as(const char *program);

/* Replaces control characters of text by '?'. */
void complain_clean(char *text);

#endif
