/*
 * exhaustive: runs checks over all 2^32 raw inputs of a function, on all processors at once.
 *
 * Usage of a program: exhaustive_X [--help] [NAME...]     all checks, or those named; with SHARE=K/N in the environment
 * every N-th.
 */
#ifndef EXHAUSTIVE_H
#define EXHAUSTIVE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The raw inputs of one call of a check; both ends are included. A range has 2^22 inputs and begins at a multiple. */
struct range {
    uint32_t first, last;
};

struct check {
    const char *name;
    bool (*run)(struct range, uint32_t *wrong); /* false: *wrong is the first input with a wrong result */
};

/* Runs the checks that the command line names and prints TAP; returns the exit status. */
int exhaustive_main(int argc, char **argv, const struct check *checks, size_t count);

#endif
