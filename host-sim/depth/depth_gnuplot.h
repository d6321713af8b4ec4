/* depth_gnuplot: a gnuplot script in memory becomes a picture in a file, or in memory. */
#ifndef DEPTH_GNUPLOT_H
#define DEPTH_GNUPLOT_H

#include <stdbool.h>
#include <stddef.h>

/*
 * Runs gnuplot on the script, without its user's start-up files. *picture: what it wrote, to be freed.
 * 0, or COMPLAINED and one line: gnuplot is missing, or what it complained about.
 */
int depth_gnuplot_run(const char *script, char **picture, size_t *length);

/* Whether gnuplot can be run. */
bool depth_gnuplot_is_here(void);

#endif
