/*
 * signal_stop: SIGINT, SIGTERM and SIGHUP ask a program to end. The program looks here between two steps, when no work
 * is half done. There is one variable for the process because a signal handler can reach nothing else.
 */
#ifndef SIGNAL_STOP_H
#define SIGNAL_STOP_H

#include <signal.h>

/* The signal that came, or 0. */
extern volatile sig_atomic_t signal_stop;

/* From now on the signals only set signal_stop. One that was ignored before (nohup, `&` in a script) stays ignored. */
void signal_stop_catch(void);

#endif
