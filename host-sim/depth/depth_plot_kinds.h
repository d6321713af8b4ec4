/*
 * depth_plot_kinds: the plots of pinhole-depth as gnuplot scripts, their data in them. Colours are told apart by people
 * who see red and green alike (after Okabe and Ito), and each curve has its own marks or dashes.
 */
#ifndef DEPTH_PLOT_KINDS_H
#define DEPTH_PLOT_KINDS_H

#include "depth_lab.h"

struct depth_plot_kind {
    const char *name, *title;
    int width, height;                                       /* pixels */
    int (*write)(const struct depth_lab *lab, FILE *script); /* 0, or a status when one line has said why */
    int (*rows)(const struct depth_lab *lab); /* writes CSV to lab->rows likewise; NULL: a command of its own does */
};

extern const struct depth_plot_kind depth_plot_kinds[];
extern const uint32_t depth_plot_kind_count;

#endif
