/*
 * depth_chain: the depth code of one vertex, through the renderer's own steps but without a picture, and what it must
 * be by the formats' definition (depth.h), computed in double.
 */
#ifndef DEPTH_CHAIN_H
#define DEPTH_CHAIN_H

#include "depth.h"

/* The code of a perspective's vertex at distance w, near plane .. far plane. That this is what is drawn: test_depth.c.
 */
uint32_t depth_chain(const struct ph_lens *lens, enum ph_depth_format format, fx_t w);

/* The exact value of which the code of distance w (counted in 1/65536) is the floor. */
double depth_exact(const struct ph_lens *lens, enum ph_depth_format format, double w);

/* How far the code may be from it by rounding after the reciprocal, in codes. */
double depth_tolerance(enum ph_depth_format format);

/* Whether a code is that floor, give or take the tolerance and 2^-29 of the distance: the reciprocal's rounding. */
bool depth_is_right(const struct ph_lens *lens, enum ph_depth_format format, fx_t w, uint32_t code);

#endif
