/*
 * edge: rows and columns of a triangle's edges. Private to firmware/core.
 *
 * Watertight: an edge is always walked from its upper to its lower vertex, and all its arithmetic depends on these two
 * alone, so the triangles on both sides get the same column in every row.
 */
#ifndef PH_EDGE_H
#define PH_EDGE_H

#include "pipeline.h"

/* First row whose centre is at or below y (1/256 px). */
static inline int32_t ph_first_row(int32_t y)
{
    return (y + 127) >> 8;
}

/*
 * Edges from a down to b: x at row y0, which is not above the first row of a, and slope. Not for an edge without a row.
 */
static inline struct ph_edge ph_edge_at_row(int32_t x, int32_t dx, int32_t row, int32_t y0)
{
    return (struct ph_edge){(int32_t)((uint32_t)x + (uint32_t)(y0 - row) * (uint32_t)dx + 32767u), dx};
}

/* One below 64 px each way (PH_SIDE_SHORT), in 32 bits, to 2^-9 px at its far end. */
static inline struct ph_edge ph_short_edge(const struct ph_vertex *a, int32_t dx, int32_t dy, int32_t row, int32_t y0)
{
    const int32_t down = row * 256 + 128 - a->y; /* from a to the centre of its first row, 0 .. 255 */
    const int shift = fx_clz32((uint32_t)dy);
    /* 2^(47 - shift) dx / dy, never above it: a centre that lies on the edge is on its right, as by the top-left rule
     */
    const int32_t scaled = dx * ((int32_t)fx_rcp16((uint32_t)dy << (shift - 16)) + (dx < 0));
    return ph_edge_at_row(a->x * 256 + ((scaled >> 8) * down >> (31 - shift)), scaled >> (31 - shift), row, y0);
}

#endif
