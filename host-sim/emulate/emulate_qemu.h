/* emulate_qemu: QEMU, halted or running, over its monitor, the log UART and its trace. */
#ifndef EMULATE_QEMU_H
#define EMULATE_QEMU_H

#include <stdbool.h>
#include <stdio.h>
#include <sys/types.h>

struct qemu {
    pid_t pid;
    int monitor, uart, trace, said; /* sockets to QMP and UART; pipes from the trace (or -1) and from stderr */
    char line[512];                 /* of the UART, so far */
    size_t length;
    FILE *log; /* what the image logs goes here, too; or NULL */

    int (*take)(void *context, const char *line); /* takes the trace's lines, while others wait, too; NULL: no trace */
    void *context;
    int taken; /* its last status; one that is not 0 ends the run */
    char trace_line[256];
    size_t trace_length;
};

/* Starts the machine, halted; serial line number `uart` is the log. */
int emulate_qemu_start(struct qemu *q, const char *machine, const char *image, unsigned uart, bool traced);

/* Sends a QMP command with arguments (a format of JSON, or NULL) and waits for its answer. */
int emulate_qemu_command(struct qemu *q, const char *name, const char *arguments, ...)
    __attribute__((format(printf, 3, 4)));

/* Returns whether a signal asks this program to end, and says so. */
bool emulate_qemu_interrupted(void);

/* Sends characters to the UART. */
int emulate_qemu_send(const struct qemu *q, const char *text);

/* Takes a byte that the image logged; true when a line is complete: q->line. */
bool emulate_qemu_logged(struct qemu *q, char byte);

/* Waits for the next line of the log on the UART. A line "fault..." or "stopped..." is a failure. */
int emulate_qemu_line(struct qemu *q);
int emulate_qemu_check_line(const struct qemu *q);

/* Waits for some of the trace and passes it on. False: the trace has ended, or take refused a line. */
bool emulate_qemu_trace(struct qemu *q);

/* Ends QEMU. COMPLAINED if it wrote to stderr anything that it does not write in every run. */
int emulate_qemu_stop(struct qemu *q);

#endif
