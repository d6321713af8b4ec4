/*
 * depth_chain: the depth code of one vertex by the renderer's own steps, without a picture, and the exact value by the
 * formats' definition (depth.h), in double.
 */
#ifndef DEPTH_CHAIN_H
#define DEPTH_CHAIN_H

#include "depth.h"

/* The code of a vertex of a perspective at distance w, near plane .. far plane. test_depth.c: it is what is drawn. */
uint32_t depth_chain(const struct ph_lens *lens, const struct ph_depth_format *format, fx_t w);

/* The exact value for distance w, counted in 1/65536; its floor is the code. */
double depth_exact(const struct ph_lens *lens, const struct ph_depth_format *format, double w);

/* How many codes the rounding after the reciprocal may add or take away. */
double depth_tolerance(const struct ph_depth_format *format);

/* Whether a code is that floor, within the tolerance and 2^-29 of the distance (the reciprocal's rounding), 5 2^-30 in
 * floats with 5 or 6 bits of exponent. */
bool depth_is_right(const struct ph_lens *lens, const struct ph_depth_format *format, fx_t w, uint32_t code);

#endif
