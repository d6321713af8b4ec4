/*
 * complain: what the host programs say when something is wrong. Exactly one line on stderr, "program: what, where,
 * what to do"; control characters (from file names, say) become '?', so that it stays one line.
 */
#ifndef COMPLAIN_H
#define COMPLAIN_H

enum exit_status { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_USAGE = 2 };

/* Prints the line and returns status, for `return complain(EXIT_USAGE, ...)`. */
int complain(int status, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Sees to it that what was printed has arrived on stdout: 0, or EXIT_FAILED and one line. */
int complain_stdout(void);

/*
 * Before anything else: the name that starts each line (text that stays). From then on a file that may grow no further
 * (SIGXFSZ) is an error of the write, not the end of the program.
 */
void complain_as(const char *program);

/* Replaces control characters of text by '?'. */
void complain_clean(char *text);

#endif
