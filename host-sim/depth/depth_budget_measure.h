/*
 * depth_budget_measure: the real error of each part of the depth pipeline. It runs that part of the renderer and
 * compares with double precision. depth_budget_terms.h has the parts and their predictions.
 *
 *   input          how far w moves for the next vertex position
 *   matrix         w of the same distance for many objects and cameras, turned and moved: its spread about the exact w
 *   divide         N/w for many w from z on: its spread about the exact quotient
 *   interpolation  one tilted plane, rolled: the spread of the codes of its triangles' planes, before they are cut off,
 *                  about the exact plane through the corners as they were snapped, in metres
 *   sub-pixel      the snapped position of many vertices at z: its spread about the exact one
 *
 * `pinhole-depth resolve` measures `store`, and `pinhole-depth planes` all parts together.
 */
#ifndef DEPTH_BUDGET_MEASURE_H
#define DEPTH_BUDGET_MEASURE_H

#include "depth_budget_terms.h"
#include "depth_planes_scene.h"

/* The measured error of each part, in metres; NAN without memory. The canvas is open in the format that is measured. */
double depth_budget_input_m(struct planes_canvas *canvas, double z);
double depth_budget_matrix_m(struct planes_canvas *canvas, double z);
double depth_budget_divide_m(struct planes_canvas *canvas, double z);
double depth_budget_interpolation_m(struct planes_canvas *canvas, double z);
double depth_budget_subpixel_m(struct planes_canvas *canvas, double z);

#endif
