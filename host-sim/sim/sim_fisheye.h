/*
 * sim_fisheye: where a fisheye has a point in the picture. The renderer's own function places it
 * (core/render/fisheye.h), so that its codes are those of a vertex that is drawn.
 */
#ifndef SIM_FISHEYE_H
#define SIM_FISHEYE_H

#include "geom.h"

#include <stdbool.h>

struct sim_fisheye {
    fx_t x, y;               /* pixel, in steps of 1/256 px; y counts downwards */
    fx_t centre_x, centre_y; /* where the view direction meets the picture */
    fx_t scale;              /* pixels per radian */
};

/* Places a point in camera coordinates. False: the fisheye does not see it, wherever the picture ends: it is nearer
 * than near, beyond far, more than 170 degrees off the view direction, or over 2048 pixels off the centre. */
bool sim_fisheye_place(const struct ph_projection *p, uint16_t width, uint16_t height, struct fx_vec3 camera,
                       struct sim_fisheye *out);

#endif
