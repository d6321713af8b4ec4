/* See emulate_qemu.h. QMP: https://www.qemu.org/docs/master/interop/qmp-spec.html */
#define _XOPEN_SOURCE 700

#include "emulate_qemu.h"

#include "complain.h"
#include "signal_stop.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define CPU_SECONDS 1800  /* a QEMU without its parent does not run for ever */
#define WAIT_MS     30000 /* for a line or an answer */
#define LAST_MS     200

bool emulate_qemu_interrupted(void)
{
    if (signal_stop != 0) {
        complain("interrupted");
    }
    return signal_stop != 0;
}

struct ends {
    int monitor[2], uart[2], trace[2], said[2]; /* ours, QEMU's */
};

static bool open_ends(struct ends *e)
{
    const bool all = socketpair(AF_UNIX, SOCK_STREAM, 0, e->monitor) == 0 &&
                     socketpair(AF_UNIX, SOCK_STREAM, 0, e->uart) == 0 && pipe(e->trace) == 0 && pipe(e->said) == 0;
    for (int i = 0; all && i < 4; i++) { /* a second QEMU must not keep this one's ends open */
        const int ours[] = {e->monitor[0], e->uart[0], e->trace[0], e->said[0]};
        fcntl(ours[i], F_SETFD, FD_CLOEXEC);
    }
    return all;
}

/* The words of a command line. */
struct words {
    const char *list[48];
    size_t count;
};

static void add(struct words *w, const char *option, const char *value)
{
    w->list[w->count++] = option;
    w->list[w->count++] = value;
}

static void add_machine(struct words *w, const char *machine, const char *image)
{
    w->list[w->count++] = "qemu-system-arm";
    add(w, "-M", machine);
    add(w, "-kernel", image);
    w->list[w->count++] = "-S";
    add(w, "-display", "none");
    add(w, "-monitor", "none");
    add(w, "-nic", "none");
    add(w, "-icount", "shift=5,sleep=off");
    add(w, "-semihosting-config", "enable=on,target=native");
    add(w, "-d", "guest_errors");
}

/* Starts QEMU, in the child process. */
static void execute(const struct ends *e, const char *machine, const char *image, unsigned uart, bool traced)
{
    char monitor[48], serial[48], log[32];
    struct words w = {.count = 0};
    const struct rlimit limit = {CPU_SECONDS, CPU_SECONDS};
    snprintf(monitor, sizeof monitor, "socket,id=monitor,fd=%d", e->monitor[1]);
    snprintf(serial, sizeof serial, "socket,id=uart,fd=%d", e->uart[1]);
    snprintf(log, sizeof log, "/dev/fd/%d", e->trace[1]);
    add_machine(&w, machine, image);
    add(&w, "-chardev", monitor);
    add(&w, "-mon", "chardev=monitor,mode=control");
    add(&w, "-chardev", serial);
    for (unsigned i = 0; i < uart && i < 4; i++) {
        add(&w, "-serial", "null");
    }
    add(&w, "-serial", "chardev:uart");
    if (traced) {
        add(&w, "-trace", "memory_region_ops_*");
        add(&w, "-trace", "nvic_acknowledge_irq");
        add(&w, "-D", log);
    }
    setrlimit(RLIMIT_CPU, &limit);
    dup2(e->said[1], STDERR_FILENO);
    dup2(e->said[1], STDOUT_FILENO);
    execvp(w.list[0], (char *const *)(uintptr_t)w.list);
    dprintf(STDERR_FILENO, "qemu-system-arm does not start: %s; apt-get install qemu-system-arm\n", strerror(errno));
    _exit(127);
}

int emulate_qemu_start(struct qemu *q, const char *machine, const char *image, unsigned uart, bool traced)
{
    struct ends e;
    *q = (struct qemu){.pid = -1, .monitor = -1, .uart = -1, .trace = -1, .said = -1};
    if (!open_ends(&e)) {
        return complain("no sockets for QEMU: %s", strerror(errno));
    }
    q->pid = fork();
    if (q->pid == 0) {
        execute(&e, machine, image, uart, traced);
    }
    close(e.monitor[1]);
    close(e.uart[1]);
    close(e.trace[1]);
    close(e.said[1]);
    q->monitor = e.monitor[0];
    q->uart = e.uart[0];
    q->trace = e.trace[0];
    q->said = e.said[0];
    signal_stop_catch(); /* a signal ends the waiting, so that QEMU is stopped and half-written files are removed */
    signal(SIGPIPE, SIG_IGN);
    if (q->pid < 0) {
        return complain("fork: %s", strerror(errno));
    }
    /* Since QEMU 10 the word guest_errors no longer covers accesses to nowhere; an older one ignores invalid_mem. */
    const int status = emulate_qemu_command(q, "qmp_capabilities", NULL);
    return status != 0
               ? status
               : emulate_qemu_command(q, "human-monitor-command", "\"command-line\": \"log guest_errors,invalid_mem\"");
}

bool emulate_qemu_trace(struct qemu *q)
{
    char bytes[65536];
    const ssize_t n = read(q->trace, bytes, sizeof bytes);
    for (ssize_t i = 0; i < n && q->taken == 0; i++) {
        if (bytes[i] != '\n') {
            q->trace_line[q->trace_length] = bytes[i];
            q->trace_length += q->trace_length < sizeof q->trace_line - 1;
            continue;
        }
        q->trace_line[q->trace_length] = '\0';
        q->trace_length = 0;
        q->taken = q->take(q->context, q->trace_line);
    }
    return n > 0 && q->taken == 0;
}

static int64_t now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000 + t.tv_nsec / 1000000;
}

/* Waits for something to read. QEMU goes on only while its trace is taken. */
static bool readable(struct qemu *q, int fd, int wait_ms)
{
    struct pollfd p[] = {{.fd = fd, .events = POLLIN}, {.fd = q->take != NULL ? q->trace : -1, .events = POLLIN}};
    const int64_t until = now_ms() + wait_ms;
    for (int64_t left = wait_ms; left >= 0 && signal_stop == 0 && poll(p, 2, (int)left) > 0; left = until - now_ms()) {
        if ((p[1].revents & POLLIN) != 0 && !emulate_qemu_trace(q)) {
            return false;
        }
        if (p[0].revents != 0 || (p[1].revents & POLLIN) == 0) {
            return (p[0].revents & POLLIN) != 0;
        }
    }
    return false;
}

/* Whether a line comes in every run: the machines have a network chip without a network, and timers that stand
 * still. */
static bool usual(const char *line)
{
    return strstr(line, "has no peer") != NULL || strcmp(line, "Timer with period zero, disabling") == 0;
}

static int complaints_of(FILE *said)
{
    char line[512];
    int status = 0;
    while (fgets(line, sizeof line, said) != NULL) {
        line[strcspn(line, "\r\n")] = '\0';
        if (status == 0 && line[0] != '\0' && !usual(line)) {
            status = complain("QEMU says: %s", line);
        }
    }
    return status;
}

/* Ends QEMU if it still runs. COMPLAINED when it had something to say. */
static int end(struct qemu *q)
{
    if (q->pid > 0) {
        kill(q->pid, SIGKILL);
        waitpid(q->pid, NULL, 0);
        q->pid = -1;
    }
    FILE *said = q->said >= 0 ? fdopen(q->said, "r") : NULL;
    if (said == NULL) {
        return 0;
    }
    q->said = -1;
    const int status = signal_stop != 0 ? COMPLAINED : complaints_of(said); /* QEMU tells of the signal, too */
    fclose(said);
    return status;
}

/* Complains that QEMU ended or does not answer. If the image logged a reason, that is told. */
static int last_words(struct qemu *q, const char *what, const char *name)
{
    char byte;
    if (q->taken != 0 || emulate_qemu_interrupted()) {
        return COMPLAINED;
    }
    while (readable(q, q->uart, LAST_MS) && read(q->uart, &byte, 1) == 1) {
        if (emulate_qemu_logged(q, byte) && emulate_qemu_check_line(q) != 0) {
            return COMPLAINED;
        }
    }
    return end(q) != 0 ? COMPLAINED : complain("QEMU does not %s %s", what, name);
}

/* Waits for the answer; events may come before it. */
static int await_answer(struct qemu *q, const char *name)
{
    char line[4096];
    size_t n = 0;
    while (readable(q, q->monitor, WAIT_MS) && read(q->monitor, line + n, 1) == 1) {
        if (line[n] != '\n') {
            n += n < sizeof line - 1;
            continue;
        }
        line[n] = '\0';
        n = 0;
        if (strncmp(line, "{\"return\"", 9) == 0) {
            return 0;
        }
        if (strncmp(line, "{\"error\"", 8) == 0) {
            return complain("QEMU refuses %s: %.200s", name, line);
        }
    }
    return last_words(q, "answer", name);
}

int emulate_qemu_command(struct qemu *q, const char *name, const char *arguments, ...)
{
    char text[1024], values[768] = "";
    va_list list;
    va_start(list, arguments);
    if (arguments != NULL) {
        vsnprintf(values, sizeof values, arguments, list);
    }
    va_end(list);
    const int n = snprintf(text, sizeof text, "{\"execute\": \"%s\", \"arguments\": {%s}}\n", name, values);
    if (n < 0 || n >= (int)sizeof text || write(q->monitor, text, (size_t)n) != n) {
        return last_words(q, "take", name);
    }
    return await_answer(q, name);
}

int emulate_qemu_send(const struct qemu *q, const char *text)
{
    const ssize_t n = (ssize_t)strlen(text);
    return write(q->uart, text, (size_t)n) == n ? 0 : complain("QEMU does not take what the UART gets");
}

bool emulate_qemu_logged(struct qemu *q, char byte)
{
    if (byte == '\r') {
        return false;
    }
    if (byte != '\n') {
        q->line[q->length] = byte;
        q->length += q->length < sizeof q->line - 1;
        return false;
    }
    q->line[q->length] = '\0';
    q->length = 0;
    if (q->log != NULL) {
        fprintf(q->log, "%s\n", q->line);
    }
    return true;
}

int emulate_qemu_check_line(const struct qemu *q)
{
    const bool bad = strncmp(q->line, "fault", 5) == 0 || strncmp(q->line, "stopped", 7) == 0;
    return bad ? complain("the image says: %s", q->line) : 0;
}

int emulate_qemu_line(struct qemu *q)
{
    char byte;
    while (readable(q, q->uart, WAIT_MS) && read(q->uart, &byte, 1) == 1) {
        if (emulate_qemu_logged(q, byte)) {
            return emulate_qemu_check_line(q);
        }
    }
    if (q->taken != 0 || emulate_qemu_interrupted() || end(q) != 0) {
        return COMPLAINED;
    }
    return complain("the image logs nothing more");
}

int emulate_qemu_stop(struct qemu *q)
{
    int status = end(q);
    while (status == 0 && q->take != NULL && emulate_qemu_trace(q)) {
    }
    status = status != 0 ? status : q->taken;
    const int others[] = {q->monitor, q->uart, q->trace};
    for (int i = 0; i < 3; i++) {
        if (others[i] >= 0) {
            close(others[i]);
        }
    }
    return status;
}
