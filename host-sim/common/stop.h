/*
 * stop: SIGINT, SIGTERM and SIGHUP ask a program to end; it looks here between two steps, when nothing is half-written.
 * One for the whole process: a signal handler can reach nothing else.
 */
#ifndef STOP_H
#define STOP_H

#include <signal.h>

/* The signal that came; 0: none so far. */
extern volatile sig_atomic_t stop_signal;

/* From now on the signals only set stop_signal. */
void stop_catch(void);

#endif
