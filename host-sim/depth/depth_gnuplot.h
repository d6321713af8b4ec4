/* depth_gnuplot: a gnuplot script in memory becomes a picture in a file, or in memory. */
#ifndef DEPTH_GNUPLOT_H
#define DEPTH_GNUPLOT_H

#include <stdbool.h>
#include <stddef.h>

/* Runs gnuplot on the script, without the start-up files of the user. The caller frees *picture. 0 or COMPLAINED. */
int depth_gnuplot_run(const char *script, char **picture, size_t *length);

/* Whether gnuplot can be run. */
bool depth_gnuplot_is_here(void);

#endif
