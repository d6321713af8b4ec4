/*
 * progress: how far long work is, on stderr. On a terminal it is a bar. Elsewhere (a log, a CI) it is lines like
 * `pinhole-depth: resolve: 3 of 16`, the first after 2 s and then one every 5 s, so that short work says nothing. A
 * timer (SIGALRM) writes them: they come also while one step takes long. System calls go on after it. With
 * PINHOLE_PROGRESS=off in the environment nothing is shown.
 */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdint.h>

#define PROGRESS_FIRST_S 2
#define PROGRESS_EVERY_S 5

/* complain_begin() says by this which program writes; the text must stay. */
void progress_begin(const char *program);

/* Shows how much of the work is done; done >= total: it is over, and the bar goes away. */
void progress_show(const char *what, uint64_t done, uint64_t total);

/* Takes the bar away, so that a message has the line for itself. */
void progress_clear(void);

#endif
