/*
 * sim_frustum: what a projection sees, in lines of sim_fraction.h. Angles are degrees and have `-` for their fraction.
 *
 *   fov.x, fov.y     fields of view, 2 atan(1 / scale); a parallel projection has none
 *   aspect           width / height
 *   size.x, size.y   width and height of the view volume at a distance (HAW: w_n and h_n at the near plane)
 *   fill.fov         the vertical field of view that a height at this distance fills (LMU: dollyZoomFOV, where it is 2)
 *   fill.distance    the distance at which this height fills the projection's own field of view (LMU: dollyZoomDist)
 */
#ifndef SIM_FRUSTUM_H
#define SIM_FRUSTUM_H

#include "geom.h"

#include <stdio.h>

/* Prints the lines; those of `fill` for a perspective and a height > 0 only. The distance is more than 0. Exact values
 * are worked out from the projection's fields, codes are those of camera.h. 0, or PH_ERR_INVAL for a fisheye. */
int sim_frustum_print(FILE *file, const struct ph_projection *p, fx_t distance, fx_t height);

#endif
