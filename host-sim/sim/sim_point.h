/*
 * sim_point: a vertex at every stage of the pipeline, in the convention's way to write it. A line of sim_fraction.h a
 * number, whose name is the stage and coordinate: object, world, view, clip (x, y, z, w), ndc, pixel. The exact value
 * is worked out in whole numbers from the fields of the camera as Pinhole holds them (geom.h); the codes come out of
 * its own matrices (camera.h), one after the other. Then a line for each depth format: `depth.fixed16 CODE SHARE`, the
 * code in the depth buffer and its share of the largest one.
 *
 * A fisheye is no matrix. After `view` it has: distance (from the eye, as its near and far plane are spheres),
 * angle.degrees and angle.radians (off the view direction), angle.scale (pixels per radian), radius (angle times scale,
 * pixels from the centre), pixel. Their codes are those of the renderer, which has places in steps of 1/256 px.
 */
#ifndef SIM_POINT_H
#define SIM_POINT_H

#include "sim_fraction.h"
#include "sim_matrix.h"

/* Prints the lines. object: where the object stands in the world. 0, or PH_ERR_RANGE: a number does not fit, or a
 * fisheye does not see the point (sim_fisheye.h). After an error nothing was printed. */
int sim_point_print(FILE *file, struct fx_vec3 point, const struct ph_xform *object, const struct ph_xform *view,
                    const struct ph_projection *projection, uint16_t width, uint16_t height,
                    struct sim_matrix_writing writing);

/* How far the point lies along the view, exactly. */
struct sim_fraction sim_point_away(struct fx_vec3 point, const struct ph_xform *object, const struct ph_xform *view);

/* Prints the point times a matrix of --flatten, which takes camera coordinates of the convention: `flatten` (x, y, z,
 * w); and after the divide by w `divided` (x, y, z), which has no lines where w is 0: the image is infinitely far. */
void sim_point_flatten(FILE *file, struct fx_vec3 point, const struct ph_xform *object, const struct ph_xform *view,
                       const struct ph_mat4 *flat, struct sim_matrix_writing writing);

#endif
