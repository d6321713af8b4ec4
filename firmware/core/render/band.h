/* band: the rows of the picture that are drawn at a time. Private to firmware/core. */
#ifndef PH_BAND_H
#define PH_BAND_H

#include "edge.h"
#include "kernels.h"

struct ph_coarse; /* coarse.h */

/* Rows y0 .. y1 - 1 of the picture, and the memory that they are drawn into. */
struct ph_band {
    uint16_t *pixels; /* of row y0 */
    void *depth;      /* of row y0: uint32_t if depth24, else uint16_t */
    bool depth24;     /* depth codes have 24 bits */
    uint16_t stride;  /* pixels from row to row */
    int32_t y0, y1, width;
    struct ph_coarse *coarse; /* of these rows; NULL: none is kept */
};

/* Draws what of a triangle lies in the band. Returns the pixels tested. */
uint32_t ph_draw_triangle(const struct ph_triangle *t, const struct ph_band *band);

/* Draws pixel (x, y) of the band, which is one of a flat triangle or a line of any depth format. */
void ph_draw_pixel(const struct ph_triangle *t, int32_t x, int32_t y, const struct ph_band *band);

/* The same for a triangle that ends in the band. */
static inline uint32_t ph_draw_fresh(const struct ph_triangle *t, const struct ph_band *band)
{
    if (t->kind != PH_KIND_SMALL || t->y_top < band->y0) {
        return ph_draw_triangle(t, band);
    }
    const uint32_t stride = band->stride, first = (uint32_t)(t->y_top - band->y0) * stride;
    return ph_small_gouraud(&t->small, (uint16_t *)band->depth + first, band->pixels + first, 2 * stride);
}

/* The same for one that was carried on to this band, where a small one stands at the first row. */
static inline uint32_t ph_draw_end(const struct ph_triangle *t, const struct ph_band *band)
{
    return t->kind == PH_KIND_SMALL ? ph_small_gouraud(&t->small, band->depth, band->pixels, 2 * (uint32_t)band->stride)
                                    : ph_draw_triangle(t, band);
}

/* Before the band that begins at row y1 a triangle is stepped down to it; y_bottom is below y1. */
void ph_step_below(struct ph_triangle *t, int32_t y1);

/* Both for a triangle that goes on below the band, without a copy of a small one. No other core may look at it. */
uint32_t ph_draw_above(struct ph_triangle *t, const struct ph_band *band);

/* A depth buffer from pixel n on. */
static inline void *ph_depth_from(void *depth, uint32_t n, bool depth24)
{
    return depth24 ? (void *)((uint32_t *)depth + n) : (void *)((uint16_t *)depth + n);
}

/* Leaves the first rows of a band, and returns the others. */
static inline struct ph_band ph_cut_lower(struct ph_band *band, int32_t rows)
{
    struct ph_band lower = *band;
    band->y1 = lower.y0 = band->y0 + rows;
    const uint32_t above = (uint32_t)rows * band->stride;
    lower.pixels += above;
    lower.depth = ph_depth_from(band->depth, above, band->depth24);
    return lower;
}

/* The rows of the upper (0) or lower (1) half of a triangle that lie in the band. False if there are none; then only y
 * and y_end are set. */
static inline bool ph_rows_of_half(const struct ph_triangle *t, const struct ph_band *band, int half,
                                   struct ph_half_rows *in)
{
    const int32_t from = half == 0 ? t->y_top : t->y_mid, to = half == 0 ? t->y_mid : t->y_bottom;
    const int32_t y = from > band->y0 ? from : band->y0, y_end = to < band->y1 ? to : band->y1;
    in->y = y;
    in->y_end = y_end;
    if (y >= y_end) {
        return false;
    }
    const struct ph_edge long_edge = ph_edge_below(t->long_edge, y - t->y_top);
    const struct ph_edge other = ph_edge_below(half == 0 ? t->upper : t->lower, y - from);
    in->left = t->long_left != 0 ? long_edge : other;
    in->right = t->long_left != 0 ? other : long_edge;
    return true;
}

/* The same, once for all that call it. */
bool ph_rows_of_half_apart(const struct ph_triangle *t, const struct ph_band *band, int half, struct ph_half_rows *in);

#endif
