/* ref_plane: the plane z = 0 of a model, placed in front of the camera, and the point of it that a pixel shows. */
#ifndef REF_PLANE_H
#define REF_PLANE_H

#include "geom.h"

#include <stdbool.h>

/* Model to view, as the renderer gets it, and the same numbers in double. */
struct ref_plane {
    struct ph_xform xform;
    double r[3][3], t[3];
};

/* A square perspective camera; field of view 60 degrees from top to bottom. */
struct ref_lens {
    int width, height;
    double near_z, far_z;
};

/* Facing the camera but for a turn of up to `turn` radians, `distance` away and up to `side` off the axis. */
void ref_plane_place(struct ref_plane *p, double distance, double side, double turn);

/*
 * The model coordinates (u, v) that the ray through a picture point (in pixels) meets, at distance *z along the view;
 * false where it does not meet the front of the plane between near and far plane.
 */
bool ref_plane_at(const struct ref_plane *p, const struct ref_lens *lens, double sx, double sy, double *u, double *v,
                  double *z);

/* The lens as the renderer's projection. */
void ref_lens_projection(const struct ref_lens *lens, struct ph_projection *out);

#endif
