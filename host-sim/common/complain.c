/* See complain.h. A message clears the progress bar first, and then stands on a line of its own. */
#define _XOPEN_SOURCE 700 /* SIGXFSZ */

#include "complain.h"
#include "progress.h"
#include "status.h"

#include <errno.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *program_name = "pinhole";

void complain_clean(char *text)
{
    for (; *text != '\0'; text++) {
        if ((unsigned char)*text < 0x20 || *text == 0x7f) {
            *text = '?';
        }
    }
}

__attribute__((format(printf, 1, 0))) static void print_line(const char *format, va_list arguments)
{
    char line[1024];
    vsnprintf(line, sizeof line, format, arguments);
    complain_clean(line);
    progress_clear();
    fprintf(stderr, "%s: %s\n", program_name, line);
}

int complain(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_line(format, arguments);
    va_end(arguments);
    return COMPLAINED;
}

int complain_usage(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_line(format, arguments);
    va_end(arguments);
    return PH_ERR_INVAL;
}

void complain_note(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_line(format, arguments);
    va_end(arguments);
}

int complain_exit(int status)
{
    if (status == 0 && (fflush(stdout) != 0 || ferror(stdout))) {
        status = complain("stdout cannot be written: %s", strerror(errno));
    }
    return status == 0 ? 0 : status == PH_ERR_INVAL ? 2 : 1;
}

void complain_begin(const char *program, int argc, char *const argv[])
{
    program_name = program;
    progress_begin(program);
    signal(SIGXFSZ, SIG_IGN);
    if (argc == 2 && strcmp(argv[1], "--version") == 0) {
        printf("%s %s\n", program, PH_VERSION);
        exit(complain_exit(0));
    }
}
