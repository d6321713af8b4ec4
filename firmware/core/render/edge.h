/*
 * edge: the order of a triangle's corners, and the rows and columns of its edges. Set-up of large and of small
 * triangles share it. Private to firmware/core.
 *
 * Watertight: an edge is always walked from its upper to its lower corner, and all its arithmetic depends on these two
 * alone. So the triangles on both of its sides get the same column in every row.
 */
#ifndef PH_EDGE_H
#define PH_EDGE_H

#include "sides.h"
#include "triangle.h"

static inline int32_t ph_min(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static inline int32_t ph_max(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

/* Whether three coordinates keep a pixel away from both borders of a picture of that size. */
static inline bool ph_is_between(int32_t a, int32_t b, int32_t c, int32_t size)
{
    return ph_min(ph_min(a, b), c) >= 256 && ph_max(ph_max(a, b), c) <= (size - 1) * 256;
}

/* First row whose centre is at or below y (1/256 px). */
static inline int32_t ph_first_row(int32_t y)
{
    return (y + 127) >> 8;
}

/* The corners from top to bottom, and the first row of each. The long edge runs from top to low, on one side. */
struct ph_outline {
    const struct ph_vertex *top, *mid, *low;
    int32_t row_top, row_mid, row_low;
    bool long_left;
};

/* The corners run counter-clockwise. Of two with one first row either may be the upper: their edge has no row. */
static inline struct ph_outline ph_outline(const struct ph_vertex *const v[3])
{
    const struct ph_vertex *top = v[0], *left = v[1], *right = v[2];
    int32_t row_top = ph_first_row(top->y), row_left = ph_first_row(left->y), row_right = ph_first_row(right->y);
    while (row_left < row_top || row_right < row_top) { /* the corners turn, at most twice */
        const struct ph_vertex *const corner = top;
        const int32_t row = row_top;
        top = left, row_top = row_left;
        left = right, row_left = row_right;
        right = corner, row_right = row;
    }
    if (row_left > row_right) {
        return (struct ph_outline){top, right, left, row_top, row_right, row_left, true};
    }
    return (struct ph_outline){top, left, right, row_top, row_left, row_right, false};
}

/* An edge at row y0, from its x at row `row`, the first row of its upper corner; y0 is not above that. */
static inline struct ph_edge ph_edge_at_row(int32_t x, int32_t dx, int32_t row, int32_t y0)
{
    return (struct ph_edge){(int32_t)((uint32_t)x + (uint32_t)(y0 - row) * (uint32_t)dx + 32767u), dx};
}

/* The columns of a row from one edge to another, cut to the picture: from .. to - 1. */
static inline uint32_t ph_from_column(uint32_t left)
{
    return (uint32_t)ph_max((int32_t)left >> 16, 0);
}

static inline uint32_t ph_to_column(uint32_t right, uint32_t width)
{
    return (uint32_t)ph_min((int32_t)right >> 16, (int32_t)width);
}

/* An edge so many rows further down. */
static inline struct ph_edge ph_edge_below(struct ph_edge edge, int32_t rows)
{
    return (struct ph_edge){(int32_t)((uint32_t)edge.x + (uint32_t)rows * (uint32_t)edge.dx), edge.dx};
}

static inline void ph_edge_step(struct ph_edge *edge, int32_t rows)
{
    *edge = ph_edge_below(*edge, rows);
}

/* Sets the columns between two edges, which step a row down. False if there are none. */
static inline bool ph_next_row(struct ph_edge *left, struct ph_edge *right, int32_t width, int32_t *from, int32_t *to)
{
    *from = (int32_t)ph_from_column((uint32_t)left->x);
    *to = (int32_t)ph_to_column((uint32_t)right->x, (uint32_t)width);
    ph_edge_step(left, 1);
    ph_edge_step(right, 1);
    return *from < *to;
}

/* The edge at row y0 that begins at a and goes on by dx, dy, each below 64 px (PH_SIDE_SHORT); `row` is the first row
 * of a. It has a row. In 32 bits; at its far end it is 2^-9 px off at most. */
static inline struct ph_edge ph_short_edge(const struct ph_vertex *a, int32_t dx, int32_t dy, int32_t row, int32_t y0)
{
    const int32_t down = row * 256 + 128 - a->y; /* from a to the centre of its first row, 0 .. 255 */
    const int top = fx_clz32((uint32_t)dy) ^ 31; /* the highest bit that is set */
    /* 2^(16 + top) dx / dy, never above it: a centre on the edge is on its right (top-left rule) */
    /* NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): 0 < dy < 2^14 */
    const int32_t slope = dx * ((int32_t)fx_rcp16((uint32_t)dy << (15 - top)) + (dx < 0));
    return ph_edge_at_row(a->x * 256 + ((slope >> 8) * down >> top), slope >> top, row, y0);
}

/* Whether x is the longer axis of a line: see line.h. */
static inline bool ph_line_is_x_major(const struct ph_vertex *a, const struct ph_vertex *b)
{
    return fx_magnitude(b->x - a->x) >= fx_magnitude(b->y - a->y);
}

/* The row or column of a coordinate across the longer axis, 1/256 px. A border belongs to the pixel above or left. */
static inline int32_t ph_line_pixel(int32_t across)
{
    return (across - 1) >> 8;
}

/* Where a pixel is two samples wide a line is two lines of samples: line 0 or 1 of them, from its ends. */
static inline void ph_line_of_samples(struct ph_vertex *a, struct ph_vertex *b, int line)
{
    const int32_t aside = line * 256 - 128;
    int32_t *const of_a = ph_line_is_x_major(a, b) ? &a->y : &a->x, *const of_b = of_a == &a->y ? &b->y : &b->x;
    *of_a += aside;
    *of_b += aside;
}

/* v or -1 - v, whichever is not negative. It has as many bits as v needs beside its sign. */
static inline uint32_t ph_without_sign(int32_t v)
{
    return (uint32_t)(v ^ v >> 31);
}

#endif
