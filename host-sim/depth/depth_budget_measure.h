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

/* The code that a triangle of the frame, by its number, has at a pixel before it is cut off; p: its corners. NAN: it
 * does not cover the pixel's centre. The frame need not be drawn. */
double depth_budget_code(const struct planes_canvas *canvas, uint32_t number, const struct fx_vec3 p[3], int32_t x,
                         int32_t y);

#endif
