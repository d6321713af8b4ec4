/*
 * sim_matrix: the matrices of a camera as text, in the convention's way to write them (camera.h):
 *
 *   view              a line with the matrix's name, then its four rows, numbers with single spaces between them
 *   1 0 0 0           world to camera coordinates
 *   ...
 *   projection        camera to clip coordinates
 *   ...
 *   viewport          normalised device coordinates to pixels; its third row leaves the depth alone
 *   ...
 *
 * Every number is the exact decimal of its Q16.16 (fx_to_text), so that reading it again gives the same bits.
 */
#ifndef SIM_MATRIX_H
#define SIM_MATRIX_H

#include "camera.h"

#include <stdio.h>

/* 0, PH_ERR_INVAL for a fisheye, which has no matrix, or PH_ERR_RANGE if an element does not fit Q16.16. After an error
 * nothing was printed. */
int sim_matrix_print(FILE *file, const struct ph_xform *view, const struct ph_projection *projection, uint16_t width,
                     uint16_t height, enum ph_convention convention);

#endif
