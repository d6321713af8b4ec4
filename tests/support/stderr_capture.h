/* stderr_capture: what a program says on stderr meanwhile, for tests of complain.h's lines. */
#ifndef STDERR_CAPTURE_H
#define STDERR_CAPTURE_H

#include <stdio.h>

struct stderr_capture {
    int before; /* descriptor */
    FILE *file;
    char text[2048]; /* after stderr_capture_end: what was said, cut to what fits */
};

/* Begins and ends a capture of stderr. Between the two no assertion may be: cmocka speaks on stderr, too. */
void stderr_capture_begin(struct stderr_capture *c);
void stderr_capture_end(struct stderr_capture *c);

unsigned stderr_capture_lines(const struct stderr_capture *c);

#endif
