/* depth_plot: the kinds of depth_plot_kinds as pictures. */
#ifndef DEPTH_PLOT_H
#define DEPTH_PLOT_H

#include "depth_plot_kinds.h"

/* Finds a kind of plot by its name. NULL: there is none. */
const struct depth_plot_kind *depth_plot_find(const char *name);

/* The picture as bytes to be freed; png: else SVG. 0, or a status when one line has said why. */
int depth_plot_picture(const struct depth_lab *lab, const struct depth_plot_kind *kind, bool png, char **picture,
                       size_t *length);

#endif
