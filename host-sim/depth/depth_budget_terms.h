/*
 * depth_budget_terms: what the depth pipeline is predicted to resolve, in metres along the view, from the formulas of
 * depth.h alone. Nothing here runs the renderer; what is measured stands beside it (depth_planes, depth_budget).
 *
 * Each share is a bound of the separation of two surfaces, at distance z, that this part of the pipeline may confuse.
 * tests/host-sim/test_depth_planes.c measures it for many cameras: it is never exceeded, and at most 3 times too large.
 *   input          a vertex stands on a grid of 2^-16 m
 *   matrix         w and the object's place are rounded to 2^-16 m, the matrix's elements to 2^-28
 *   divide         N/w is exact to 2^-30 of itself, and scaled once more
 *   store          the longest plateau of the depth code that z may lie on
 *   interpolation  what the corners' quotients leave, as in divide; gradients of 32 bits are rounded to half a unit, or
 *                  across octaves of a float to half of 2 to 32 units, and stepped over the whole picture; planes of 64
 *                  bits are rounded anew in each run (triangles with sides below 64 px take shorter products: at most 8
 *                  times too large)
 *   sub-pixel      a vertex stands on a grid of 2^-8 px: s_xy = sqrt(2) 2^-8 p z, p the slope of a pixel; and x and y
 *                  on one of 2^-16 m before the divide
 * All of them: S_min = sqrt((s_xy + s_z tan phi)^2 + s_z^2), s_z the sum of those along z, phi the angle of the ray off
 * the axis (after Akeley and Su, Minimum triangle separation for correct z-buffer occlusion, 2006).
 */
#ifndef DEPTH_BUDGET_TERMS_H
#define DEPTH_BUDGET_TERMS_H

#include "depth_lab.h"

enum depth_share {
    DEPTH_SHARE_INPUT,
    DEPTH_SHARE_MATRIX,
    DEPTH_SHARE_DIVIDE,
    DEPTH_SHARE_STORE,
    DEPTH_SHARE_INTERPOLATION,
    DEPTH_SHARE_SUBPIXEL,
    DEPTH_SHARES,
};

extern const char *const depth_share_names[DEPTH_SHARES];

#define DEPTH_SUBPIXEL_BITS   8
#define DEPTH_BUDGET_TILT_DEG 45.0 /* of the plane on which interpolation is measured */

static inline double depth_metres(fx_t v)
{
    return v / 65536.0;
}

static inline double depth_radians(double degrees)
{
    return degrees * (3.14159265358979323846 / 180);
}

/* How planes stand: at_m away on the axis of the camera, tilted by tilt_deg in the direction of azimuth_deg: 0 leans
 * away at the top of the picture, 90 at its right. */
struct planes_lean {
    double at_m, tilt_deg, azimuth_deg;
};

#define PLANES_PARTS 64 /* of a plane's height, by which it can be moved within itself */

/* The rows of lab_formats that were asked for and that the renderer draws, as bits. */
uint32_t depth_drawn_formats(const struct depth_lab *lab);

/* Slope of a pixel: the distance between the rays of two rows at a distance of 1 m. */
double depth_pixel_slope(const struct depth_lab *lab);

/* Half of the extent of the picture along and across an azimuth, as slopes. NAN: the most of all azimuths. */
void depth_planes_extent(const struct depth_lab *lab, double azimuth_deg, double *along, double *across);

/* The depth step at distance z that the format's definition gives. */
double depth_step_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z);

/* The depth step at distance z under a parallel projection. */
double depth_step_parallel_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z);

/* The code at distance z by the definition in depth.h, before it becomes a whole number; a larger code is nearer. */
double depth_code_at(const struct ph_depth_format *format, const struct depth_lab *lab, double z);

/* The distance that has this code; beyond the far plane it may be negative or infinite. */
double depth_distance_of(const struct ph_depth_format *format, const struct depth_lab *lab, double code);

/* A float's bits of exponent. */
int depth_exponent_bits(const struct depth_lab *lab);

/* Where d is 2^-octave: there a float's octave ends, and the next one has codes half as wide. */
double depth_octave_end_m(const struct ph_depth_format *format, const struct depth_lab *lab, int octave);

/* The code for a d = N/w - N/f, in a float format. */
double depth_code_of_float(const struct ph_depth_format *format, const struct depth_lab *lab, double d);

/* How many metres across the view are one unit of a corner's x and y in clip coordinates: 1 or more. */
double depth_across_unit(const struct depth_lab *lab);

/* The share of snapping corners to 2^-bits pixel: sqrt(2) 2^-bits p z. */
double depth_subpixel_m(const struct depth_lab *lab, int bits, double z);

/* The bound of a share at z: what depth_budget_measure measures never exceeds it. */
double depth_share_m(enum depth_share share, const struct ph_depth_format *format, const struct depth_lab *lab,
                     double z);

/* The share of interpolation at z, on a plane through the whole picture with its far edge at lean.at_m. An azimuth of
 * NAN stands for all. */
double depth_interpolation_m(const struct ph_depth_format *format, const struct depth_lab *lab, struct planes_lean lean,
                             double z);

double depth_s_min_m(double s_xy, double s_z, double tan_phi);

#endif
