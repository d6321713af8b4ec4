/*
 * sim_wrong: matrices that are no view, or no lens, of the convention: what is wrong with them in words, and what they
 * draw. Rows and columns count from 0.
 */
#ifndef SIM_WRONG_H
#define SIM_WRONG_H

#include "sim_matrix.h"

#define SIM_WRONG_TEXT 320

/* Says what is wrong with a matrix that sim_matrix_view refuses, without a line break. */
void sim_wrong_view(const struct sim_matrix *m, enum ph_convention convention, char text[SIM_WRONG_TEXT]);

/* Says what is wrong with a matrix that sim_matrix_projection refuses, or whose near plane is not before the eye. */
void sim_wrong_lens(const struct sim_matrix *m, enum ph_convention convention, char text[SIM_WRONG_TEXT]);

/*
 * The camera that draws what two matrices of the convention draw one after the other, whatever they are: x and y are
 * theirs; the near and the far plane are where their depth leaves its range. Where their depth is no function of w, the
 * planes are at 0.1 and 1000 times the view's unit. *view need not be rigid.
 * Returns 0; 1 if nothing is visible, because w or the depth is nowhere in its range; or PH_ERR_RANGE if it does not
 * fit fixed point.
 */
int sim_wrong_camera(const struct sim_matrix *view_matrix, const struct sim_matrix *lens_matrix,
                     enum ph_convention convention, struct ph_xform *view, struct ph_projection *projection);

#endif
