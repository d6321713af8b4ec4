/*
 * signal_stop: SIGINT, SIGTERM and SIGHUP ask a program to end; it looks here between two steps, when nothing is
 * half-written. One for the whole process: a signal handler can reach nothing else.
 */
#ifndef SIGNAL_STOP_H
#define SIGNAL_STOP_H

#include <signal.h>

/* The signal that came; 0: none so far. */
extern volatile sig_atomic_t signal_stop;

/* From now on the signals only set signal_stop. */
void signal_stop_catch(void);

#endif
