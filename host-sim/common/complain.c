#define _XOPEN_SOURCE 700 /* SIGXFSZ */

#include "complain.h"

#include <errno.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const char *program_name = "pinhole";

void complain_as(const char *program)
{
    program_name = program;
    signal(SIGXFSZ, SIG_IGN);
}

void complain_clean(char *text)
{
    for (; *text != '\0'; text++) {
        if ((unsigned char)*text < 0x20 || *text == 0x7f) {
            *text = '?';
        }
    }
}

int complain(int status, const char *format, ...)
{
    char line[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    complain_clean(line);
    fprintf(stderr, "%s: %s\n", program_name, line);
    return status;
}

int complain_stdout(void)
{
    if (fflush(stdout) == 0 && !ferror(stdout)) {
        return 0;
    }
    return complain(EXIT_FAILED, "stdout cannot be written: %s", strerror(errno));
}
