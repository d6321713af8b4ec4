/* caught: what a program says on stderr meanwhile, for tests of complain.h's lines. */
#ifndef CAUGHT_H
#define CAUGHT_H

#include <stdio.h>

struct caught {
    int before; /* descriptor */
    FILE *file;
    char text[2048]; /* after caught_end: what was said, cut to what fits */
};

/* Between these no assertion: cmocka speaks on stderr, too. */
void caught_begin(struct caught *c);
void caught_end(struct caught *c);

unsigned caught_lines(const struct caught *c);

#endif
