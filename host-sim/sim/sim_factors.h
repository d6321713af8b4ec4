/*
 * sim_factors: the matrices that a view and a projection are products of, in the convention's way to write them. An
 * element is a line of sim_fraction.h, whose name is the factor's with row and column, counted from 0. An element that
 * has no line is that of the unit matrix.
 *
 *   view = R T                       T moves the eye to the origin, R rotates (KAIST 4.6; LMU; 4600: O T)
 *   camera                           the view's inverse: the camera as a node (HAW: camera.matrix; LMU: R^-1 = R^T)
 *   projection = scale shift         parallel: shift moves the middle of the view volume to the origin, or the plane
 *                                    whose depth is 0, where depths begin or end at 0 (LMU: T_ortho)
 *   projection = scale shift persp   perspective: persp makes a box of the frustum (LMU: T_persp->ortho). Elements 2.2
 *                                    and 2.3 are called `w1` and `w2`. Near and far are as the convention writes them
 *
 * The exact values are worked out from the fields of the camera as Pinhole holds them. scale shift persp is exactly the
 * projection that they say. T and camera take R's transpose for its inverse: R T is the view within 2^-27 of the eye's
 * distance, because R is rounded to Q2.30. Codes of R, T and camera are those of Pinhole's matrices; the others are the
 * nearest ones, which saturate.
 */
#ifndef SIM_FACTORS_H
#define SIM_FACTORS_H

#include "sim_matrix.h"

/* Prints the factors; those of the projection only where it has a matrix. */
void sim_factors_print(FILE *file, const struct ph_xform *view, const struct ph_projection *projection,
                       struct sim_matrix_writing writing);

#endif
