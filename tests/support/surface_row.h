/* surface_row: what a test of surfaces measures against double precision, for the table of tests/README.md
 * (tests/core/surfaces.sh). */
#ifndef SURFACE_ROW_H
#define SURFACE_ROW_H

#include <stdbool.h>
#include <stdio.h>

/* Prints a row, and returns whether the error keeps to its bar. unit: what the error is, and in what. */
static inline bool surface_row(const char *surface, const char *unit, double error, double bar)
{
    printf("surface: %s | %s | %.3f | %.3f\n", surface, unit, error, bar);
    return error <= bar;
}

#endif
