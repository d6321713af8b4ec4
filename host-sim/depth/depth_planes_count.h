/* depth_planes_count: how often the renderer shows the wrong one of two planes, and from which separation on never. */
#ifndef DEPTH_PLANES_COUNT_H
#define DEPTH_PLANES_COUNT_H

#include "depth_planes_scene.h"

enum planes_verdict { PLANES_UNCOUNTED, PLANES_RIGHT, PLANES_WRONG };

struct planes_count {
    uint32_t samples; /* pixels that both planes cover */
    uint32_t wrong;   /* of these: showed the plane that is exactly behind */
};

/* Draws each plane alone, then both. verdicts has one byte a pixel (enum planes_verdict). */
struct planes_count depth_planes_count(struct planes_canvas *canvas, const struct planes_pair *pair, uint8_t *verdicts);

/*
 * The prediction at distance z for planes of this tilt, on the ray with slope y / z: a depth step along the ray, seen
 * along the normal of the planes, plus a sub-pixel step up: s_z (cos(tilt) - slope sin(tilt)) + 2^-8 p z |sin(tilt)|.
 */
double depth_planes_predicted_m(const struct depth_lab *lab, const struct ph_depth_format *format, double z,
                                double slope, double tilt_deg);

/* One row of the sweep. The predictions are for the row of the picture that needs most. */
struct planes_sweep {
    double s_min_m;    /* predicted: S_min, whatever the tilt */
    double at_tilt_m;  /* predicted at this tilt */
    double bound_m;    /* of depth_separation.h: no larger separation is ever wrong, whatever the azimuth */
    double measured_m; /* smallest separation from which on no pixel was found wrong; HUGE_VAL: none */
    double found_m;    /* that, or what depth_planes_climb.h found to be wrong, whichever is larger */
};

/*
 * Finds the smallest separation of planes that lean so and whose farthest point is at lean.at_m. It goes from well
 * above S_min down in steps of 2^(1/16). Each separation is tried in 24 places that differ by parts of a pixel and of a
 * depth step; half of them are as wide as the picture, the others small (24 px) or tiny (6 px) in its middle, or small
 * at the edge where rays meet the planes most steeply. If lean.azimuth_deg is NAN each place has an azimuth of its own.
 * Triangles in such planes are then chosen against the renderer (depth_planes_climb.h), unless the canvas has a draw.
 */
struct planes_sweep depth_planes_sweep(struct planes_canvas *canvas, const struct ph_depth_format *format,
                                       struct planes_lean lean);

#endif
