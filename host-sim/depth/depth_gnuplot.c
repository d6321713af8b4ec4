/* See depth_gnuplot.h. */
#define _XOPEN_SOURCE 700

#include "depth_gnuplot.h"

#include "complain.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#define NOT_FOUND 127 /* exit status of a child that found no gnuplot */

/* Becomes gnuplot, and never returns. -d: the ~/.gnuplot of the user does not change the picture. */
static void become_gnuplot(int in, int out, int errors)
{
    char name[] = "gnuplot", no_defaults[] = "-d", from_stdin[] = "-";
    char *const arguments[] = {name, no_defaults, from_stdin, NULL};
    if (dup2(in, STDIN_FILENO) >= 0 && dup2(out, STDOUT_FILENO) >= 0 && dup2(errors, STDERR_FILENO) >= 0) {
        execvp(name, arguments);
    }
    _exit(errno == ENOENT || errno == EACCES ? NOT_FOUND : 1);
}

/* Writes the whole text into the pipe. If the reader has gone its exit status tells, so that is no error here. */
static void feed(int pipe_end, const char *text)
{
    size_t left = strlen(text);
    while (left > 0) {
        const ssize_t n = write(pipe_end, text, left);
        if (n < 0 && errno != EINTR) {
            return;
        }
        text += n > 0 ? n : 0;
        left -= n > 0 ? (size_t)n : 0;
    }
}

static int wait_for(pid_t child)
{
    int status;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) {
            return 1;
        }
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

/* Returns the exit status of gnuplot, or a negative errno value when it could not be started. */
static int run_child(const char *script, FILE *out, FILE *errors)
{
    int ends[2];
    if (pipe(ends) != 0) {
        return -errno;
    }
    const pid_t child = fork();
    const int refused = child < 0 ? -errno : 0;
    if (child == 0) {
        close(ends[1]);
        become_gnuplot(ends[0], fileno(out), fileno(errors));
    }
    close(ends[0]);
    if (child > 0) {
        struct sigaction ignore, before;
        memset(&ignore, 0, sizeof ignore);
        ignore.sa_handler = SIG_IGN;
        sigaction(SIGPIPE, &ignore, &before);
        feed(ends[1], script);
        sigaction(SIGPIPE, &before, NULL);
    }
    close(ends[1]);
    return child < 0 ? refused : wait_for(child);
}

/* Returns the whole file with a zero behind it, to be freed; NULL without memory. */
static char *contents(FILE *file, size_t *length)
{
    const long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    char *const bytes = size < 0 ? NULL : malloc((size_t)size + 1);
    if (bytes != NULL) {
        rewind(file);
        *length = fread(bytes, 1, (size_t)size, file);
        bytes[*length] = '\0';
    }
    return bytes;
}

/* Tells the first line of what gnuplot complained about. */
static int blame(FILE *errors)
{
    size_t length;
    char *const text = contents(errors, &length);
    char *line = text != NULL ? text + strspn(text, " \t\n^") : NULL;
    if (line != NULL) {
        line[strcspn(line, "\n")] = '\0';
    }
    const int status = complain("gnuplot: %s", line != NULL && *line != '\0' ? line : "wrote no picture");
    free(text);
    return status;
}

static int judge(int status, FILE *out, FILE *errors, char **picture, size_t *length)
{
    if (status < 0) {
        return complain("gnuplot: cannot be started: %s", strerror(-status));
    }
    if (status == NOT_FOUND) {
        return complain("gnuplot is missing, and it draws the plots: apt-get install gnuplot-nox");
    }
    *picture = contents(out, length);
    if (status == 0 && *picture != NULL && *length > 0) {
        return 0;
    }
    free(*picture);
    *picture = NULL;
    return blame(errors);
}

int depth_gnuplot_run(const char *script, char **picture, size_t *length)
{
    FILE *const out = tmpfile(), *const errors = tmpfile();
    int status = COMPLAINED;
    *picture = NULL;
    if (out == NULL || errors == NULL) {
        complain("gnuplot: no temporary file: %s", strerror(errno));
    } else {
        status = judge(run_child(script, out, errors), out, errors, picture, length);
    }
    if (out != NULL) {
        fclose(out);
    }
    if (errors != NULL) {
        fclose(errors);
    }
    return status;
}

bool depth_gnuplot_is_here(void)
{
    FILE *const out = tmpfile();
    const int status = out != NULL ? run_child("", out, out) : -errno;
    if (out != NULL) {
        fclose(out);
    }
    return status >= 0 && status != NOT_FOUND;
}
