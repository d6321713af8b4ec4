/*
 * depth_plot_curves: the plots of the source documents, depth over distance, as gnuplot scripts and as CSV. They are
 * called as struct depth_plot_kind says.
 */
#ifndef DEPTH_PLOT_CURVES_H
#define DEPTH_PLOT_CURVES_H

#include "depth_lab.h"

/* z_ndc over z. */
int depth_plot_ndc(const struct depth_lab *lab, FILE *script);
int depth_plot_ndc_rows(const struct depth_lab *lab);

/* g(z). */
int depth_plot_g(const struct depth_lab *lab, FILE *script);
int depth_plot_g_rows(const struct depth_lab *lab);

#endif
