/*
 * depth_planes_climb: searches for the two triangles, in two parallel planes, that lie farthest apart and yet show the
 * one behind. Whole planes (depth_planes_count.h) need less: their corners lie where chance puts them. Here the corners
 * are chosen against the renderer.
 *
 * The search looks at one pixel. It tries triangles that cover it: slivers of up to 32 px, whose planes have the fewest
 * bits, and large ones, whose first corner may lie as far outside of the picture as this is wide or high. Corners stand
 * just where snapping moves them most. Of each triangle the plane is read before the code is cut off, which takes no
 * drawing. The triangle that seems the nearest is then moved away, and the one that seems the farthest towards us,
 * while their corners are changed at random, as long as the one behind still has the larger code or the same. In the
 * end both are drawn, and the pixel must show the one behind.
 *
 * The corners of all triangles lie exactly in parallel planes: on a lattice (i, j vy, j vz) of steps of Q16.16.
 */
#ifndef DEPTH_PLANES_CLIMB_H
#define DEPTH_PLANES_CLIMB_H

#include "depth_planes_scene.h"

/*
 * The largest separation, along the normal and in metres, at which the pixel showed the one behind; 0: none was found.
 * No corner lies farther away than lean.at_m, and the planes tilt by lean.tilt_deg or a little less. An azimuth of NAN
 * stands for the one in which the picture reaches farthest. bound_m: what is enough (depth_separation.h). The work is
 * the same for each lean, and so is the result on each run.
 */
double depth_planes_climb_m(struct planes_canvas *canvas, struct planes_lean lean, double bound_m);

#endif
