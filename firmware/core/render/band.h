/* band: the rows of the picture that are drawn at a time. Private to firmware/core. */
#ifndef PH_BAND_H
#define PH_BAND_H

#include "depth_ways.h"
#include "edge.h"

struct ph_coarse;    /* coarse.h */
struct ph_colouring; /* colours.h */

/* Rows y0 .. y1 - 1 of the picture, and the memory that they are drawn into. */
struct ph_band {
    uint16_t *pixels; /* of row y0 */
    void *depth;      /* of row y0: uint32_t if depth24, else uint16_t */
    bool depth24;     /* depth codes have 24 bits */
    uint16_t stride;  /* pixels from row to row */
    int32_t y0, y1, width;
    struct ph_coarse *coarse;             /* of these rows; NULL: none is kept */
    const struct ph_depth_ways *ways;     /* of the frame's format */
    const struct ph_colouring *colouring; /* of the config; or NULL */
};

/* The address of pixel n of a depth buffer, whose codes have 16 or 24 bits. */
static inline void *ph_depth_from(void *depth, uint32_t n, bool depth24)
{
    return depth24 ? (void *)((uint32_t *)depth + n) : (void *)((uint16_t *)depth + n);
}

/* Cuts a band in two: it keeps its first rows, and the rows below them are returned. */
static inline struct ph_band ph_cut_lower(struct ph_band *band, int32_t rows)
{
    struct ph_band lower = *band;
    band->y1 = lower.y0 = band->y0 + rows;
    const uint32_t above = (uint32_t)rows * band->stride;
    lower.pixels += above;
    lower.depth = ph_depth_from(band->depth, above, band->depth24);
    return lower;
}

/* The rows of the upper (0) or lower (1) half of a large triangle that lie in the band. False if there are none; then
 * only y and y_end are set. */
static inline bool ph_rows_of_half(const struct ph_triangle *t, const struct ph_band *band, int half,
                                   struct ph_half_rows *in)
{
    const struct ph_large *const l = &t->as.large;
    const int32_t from = half == 0 ? t->y_top : l->y_mid, to = half == 0 ? l->y_mid : t->y_bottom;
    const int32_t y = from > band->y0 ? from : band->y0, y_end = to < band->y1 ? to : band->y1;
    in->y = y;
    in->y_end = y_end;
    if (y >= y_end) {
        return false;
    }
    const struct ph_edge long_edge = ph_edge_below(l->long_edge, y - t->y_top);
    const struct ph_edge other = ph_edge_below(half == 0 ? l->upper : l->lower, y - from);
    in->left = l->long_left != 0 ? long_edge : other;
    in->right = l->long_left != 0 ? other : long_edge;
    return true;
}

/* ph_rows_of_half as a function that is not inlined, for callers that run rarely. */
bool ph_rows_of_half_apart(const struct ph_triangle *t, const struct ph_band *band, int half, struct ph_half_rows *in);

#endif
