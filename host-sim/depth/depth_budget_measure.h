/*
 * depth_budget_measure: what each part of the depth pipeline really costs, by running that part of the renderer and
 * comparing with double precision. The predictions, and what the parts are, stand in depth_budget_terms.h.
 *
 *   input          how far w moves for the next vertex position
 *   matrix         the same distance from many objects and cameras, turned and moved: spread of w about the exact one
 *   divide         spread of N/w about the exact quotient, for many w from z on
 *   interpolation  one tilted plane, rolled so that no two pixels are equally far: the largest distance between two
 *                  pixels of it whose codes are in the wrong order (given the corners as they were snapped)
 *   sub-pixel      many vertices at z: spread of the snapped position about the exact one
 * `store` is what `pinhole-depth resolve` measures, all of them together what `pinhole-depth planes` does.
 */
#ifndef DEPTH_BUDGET_MEASURE_H
#define DEPTH_BUDGET_MEASURE_H

#include "depth_budget_terms.h"
#include "depth_planes_scene.h"

/* In metres; NAN without memory. canvas: open, in the format that is measured. */
double depth_budget_input_m(struct planes_canvas *canvas, double z);
double depth_budget_matrix_m(struct planes_canvas *canvas, double z);
double depth_budget_divide_m(struct planes_canvas *canvas, double z);
double depth_budget_interpolation_m(struct planes_canvas *canvas, double z);
double depth_budget_subpixel_m(struct planes_canvas *canvas, double z);

#endif
