/*
 * depth_separation: from which separation on the renderer shows the nearer of two surfaces at every pixel. The only
 * derivation of what advise, planes, slopes, resolve and budget call enough; all of them print these numbers.
 *
 * One triangle. Let n be the unit normal of its plane, c the plane's distance from the eye, r the ray of a pixel, which
 * goes 1 m along the view, and p the slope of a pixel. The plane lies at z = c / (n r). What is stored is the code of a
 * plane that differs from it by
 *   K px: corners are snapped to 1/256 px. Inside a triangle all that the corners are moved is mixed, so the plane is
 *         moved by at most 1/512 px right and down;
 *   G m:  a corner is rounded when it is turned and at each plane that clips it, of which there are three at most: by
 *         2 2^-16 m along the view and as many units of clip coordinates (depth_across_unit) across it; the matrix adds
 *         1.3 z 2^-28;
 *   E:    what the quotient of a corner and the steps of a plane leave, in codes and in metres: depth_off,
 *         depth_off_small.
 * Two triangles in parallel planes s apart, along the normal, the one behind no farther away than z anywhere. With the
 * rays r1, r2 to which the pixel is moved, n (r1 - r2) is at most 2 K p (|nx| + |ny|), or sqrt(2) 2^-8 p sin(tilt).
 * d1 - d2 = N (n r1 / c1 - n r2 / c2) is at least N (s / z - n (r1 - r2)) / c1. So the codes differ if
 *   s >= sqrt(2) 2^-8 p z sin(tilt) + s_z n r + 2 G,
 * s_z the distance in which d changes by a code and what both triangles are off. n r = cos(tilt) + tan(phi) sin(tilt)
 * for the ray with the angle phi to the view. Over all tilts the right side is S_min of Akeley and Su (2006),
 * sqrt((s_xy + s_z tan phi)^2 + s_z^2), plus 2 G.
 *
 * A plane across octaves is off by a part u of N / z' of its nearest corner (depth_separation.c), so a surface needs
 * u z c / z' = u z n r', r' the ray of that corner. n r' is at most cos(tilt) + tan(phi') sin(tilt), phi' the angle of
 * the farthest place that a corner may have; it is also at most n r times the ratio of the distances that one plane
 * may have. The smaller bound of the two counts.
 *
 * Nothing of this depends on the azimuth or on the shading: a triangle has one depth in every shading (depth.h).
 *
 * Surfaces that face the camera have one w: neither sub-pixels nor gradients count, and what remains is the longest
 * plateau of the codes.
 */
#ifndef DEPTH_SEPARATION_H
#define DEPTH_SEPARATION_H

#include "depth_budget_terms.h"
#include "lab_num.h"

/* How far the value that is cut off to a code may be off the value of the exact plane through the projected corners. */
struct depth_off {
    double codes;  /* of the octave of z */
    double metres; /* along the view */
};

/* A triangle whose corners are at most way_px right or left of a pixel and above or below it, both together. */
struct depth_off depth_off(const struct ph_depth_format *format, const struct depth_lab *lab, double z, double way_px);

/* A small triangle, in the formats that have such (render.h). */
struct depth_off depth_off_small(const struct ph_depth_format *format, const struct depth_lab *lab, double z);

/* What way_px is for triangles whose corners lie at most as far outside of the picture as this is wide and high. */
double depth_way_px(const struct depth_lab *lab);

/* What way_px is for every triangle: corners reach to the end of the guard band. */
double depth_guard_way_px(const struct depth_lab *lab);

/*
 * The separation, along their normal and in metres, from which on of two parallel surfaces the nearer one shows, in
 * every shading, at every pixel that both cover. They may have any azimuth and any tilt from 0 to tilt_deg, 0 .. 90,
 * and lie anywhere between the near plane and z. HUGE_VAL: none fits before z. tilt_deg 0: surfaces that face the
 * camera.
 */
double depth_separation_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z, double tilt_deg,
                          double way_px);

/* The distance up to z at which the most is needed along the view: z, or where an octave of a float ends. */
double depth_coarsest_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z, double way_px);

/* In whole steps of Q16.16, rounded up, as all commands print it; "none" for HUGE_VAL. */
void depth_separation_text(double metres, char text[LAB_TEXT_SIZE]);

/* Steps for a separation in metres; UINT32_MAX for 16384 m and more. */
uint32_t depth_separation_lsbs(double metres);

#endif
