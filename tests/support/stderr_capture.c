/* See stderr_capture.h. */
#define _XOPEN_SOURCE 700 /* dup2, pread */
#include "stderr_capture.h"

#include <stdlib.h>
#include <unistd.h>

void stderr_capture_begin(struct stderr_capture *c)
{
    c->file = tmpfile();
    c->before = dup(STDERR_FILENO);
    if (c->file == NULL || c->before < 0) {
        abort();
    }
    dup2(fileno(c->file), STDERR_FILENO);
}

void stderr_capture_end(struct stderr_capture *c)
{
    dup2(c->before, STDERR_FILENO);
    const ssize_t n = pread(fileno(c->file), c->text, sizeof c->text - 1, 0);
    c->text[n < 0 ? 0 : n] = '\0';
    close(c->before);
    fclose(c->file);
}

unsigned stderr_capture_lines(const struct stderr_capture *c)
{
    unsigned lines = 0;
    for (const char *text = c->text; *text != '\0'; text++) {
        lines += *text == '\n';
    }
    return lines;
}
