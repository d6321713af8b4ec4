/*
 * depth_ieee: the adjacent-pair test of depth in float32 (N. Reed, "Visualizing Depth Precision", 2015): a self-test
 * of the method against published counts, and what a GPU has. d = (z scale + bias) / z, each operation rounded to
 * float32; scale and bias are rounded to it once; the GL cases are mapped from [-1, 1] to [0, 1] by d / 2 + 1/2,
 * the reversed ones compared the other way round; the int24 ones are floor(d (2^24 - 1) + 1/2).
 */
#ifndef DEPTH_IEEE_H
#define DEPTH_IEEE_H

#include "depth_lab.h"

#define DEPTH_IEEE_FORMATS 12

const char *depth_ieee_name(uint32_t format); /* "ieee32-standard" */

struct depth_ieee_count {
    uint32_t equal, swap;
    double max_wrong; /* largest distance that is ordered wrongly */
};

/*
 * Reed's experiment in full: the distances are vertices in a random direction each, inside a lens of 16:9, that a view
 * (turned about x and y, and moved) has placed in the world in double precision. From there on all is float32: vertex,
 * matrix, and the products of both. composed: one matrix of view and projection; else the view first. Linear spacing.
 * Fills equal and swap alone.
 */
void depth_ieee_view_pairs(uint32_t format, double near_z, double far_z, uint32_t count, bool composed,
                           struct depth_ieee_count *out);

/* Counts the pairs of a format. 0 or PH_ERR_NOMEM. near and far are in metres. */
int depth_ieee_pairs(uint32_t format, double near_z, double far_z, uint8_t spacing, uint32_t count,
                     struct depth_ieee_count *out);

#endif
