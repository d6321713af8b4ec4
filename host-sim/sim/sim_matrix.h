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
 * Every number is the exact decimal of its Q16.16 (fx_to_text), so that reading it again gives the same bits. A frame
 * with several cameras has a line `camera 1 of 2` before the matrices of each.
 */
#ifndef SIM_MATRIX_H
#define SIM_MATRIX_H

#include "camera.h"

#include <stdbool.h>
#include <stdio.h>

/* 16 numbers, rows first, commas between them. False, and *out stays as it was, if the text is something else. */
struct sim_matrix {
    double m[4][4];
};
bool sim_matrix_read(const char *text, struct sim_matrix *out);

#define SIM_MATRIX_VALUES "16 numbers, rows first, commas between them; each less than 32768"

/* The value of --flatten: a matrix that drops the depth (KAIST 4.7, 4.11; EECE 478, pinhole algebra; HAW, a plane). */
bool sim_matrix_flat(const char *text, struct ph_mat4 *out);

/*
 * Set *view or *p from a matrix that is written down in the convention, and round once. A view is rigid: unit rows at
 * right angles, within 1/10000, whose determinant is 1, for PH_D3D -1 or 1: the camera of PH_D3D is left-handed, and so
 * is its world if the determinant is 1. Then *left_world is set, and our z is the world's -z. A projection is one that
 * camera.h makes, or a positive multiple of it: w grows with the distance, for PH_LMU it falls below 0. PH_ERR_INVAL:
 * it is something else, or an element does not fit.
 */
int sim_matrix_view(const struct sim_matrix *from, enum ph_convention convention, struct ph_xform *view,
                    bool *left_world);
int sim_matrix_projection(const struct sim_matrix *from, enum ph_convention convention, struct ph_projection *p);

/* Prints one matrix and its name. */
void sim_matrix_print_one(FILE *file, const char *name, const struct ph_mat4 *matrix);

/* The matrices as the convention writes them; left_world: the view from a left-handed world, see sim_matrix_view. */
struct sim_matrix_writing {
    enum ph_convention convention;
    bool left_world;
};

/* The view matrix in that writing. */
struct ph_mat4 sim_matrix_of_view(const struct ph_xform *view, struct sim_matrix_writing writing);

/* Prints the matrices. 0, PH_ERR_INVAL for a fisheye, which has no matrix, or PH_ERR_RANGE if an element does not fit
 * Q16.16. After an error nothing was printed. */
int sim_matrix_print(FILE *file, const struct ph_xform *view, const struct ph_projection *projection, uint16_t width,
                     uint16_t height, struct sim_matrix_writing writing);

#endif
