/* raster: triangles and lines that are set up are drawn into a band. Private to firmware/core. */
#ifndef PH_RASTER_H
#define PH_RASTER_H

#include "band.h"
#include "kernels.h"

/* Draws the part of a triangle that lies in the band. Returns the pixels tested. */
uint32_t ph_draw_triangle(const struct ph_triangle *t, const struct ph_band *band);

/* Draws a small triangle without a knee that lies in the band. */
static inline uint32_t ph_draw_whole(const struct ph_triangle *t, const struct ph_band *band,
                                     ph_gouraud_kernel *draw_gouraud)
{
    const uint32_t stride = band->stride, start = (uint32_t)(t->y_top - band->y0) * stride;
    return draw_gouraud(&t->as.small.rows, (uint16_t *)band->depth + start, band->pixels + start, 2 * stride);
}

/* Draws a triangle that ends in the band: ph_draw_triangle does so too, but a small one is found sooner here. */
static inline uint32_t ph_draw_fresh(const struct ph_triangle *t, const struct ph_band *band)
{
    if (t->kind != PH_KIND_SMALL || t->y_top < band->y0) {
        return ph_draw_triangle(t, band);
    }
    return ph_draw_whole(t, band, ph_small_gouraud);
}

/* Draws a triangle that ends in the band and was carried on to it: a small one stands at the first row. */
static inline uint32_t ph_draw_end(const struct ph_triangle *t, const struct ph_band *band)
{
    return t->kind == PH_KIND_SMALL
               ? ph_small_gouraud(&t->as.small.rows, band->depth, band->pixels, 2 * (uint32_t)band->stride)
               : ph_draw_triangle(t, band);
}

/* Steps a triangle down to row y1, where the next band begins; y_bottom is below y1. */
void ph_step_below(struct ph_triangle *t, int32_t y1);

/* Draws a triangle that goes on below the band, and steps it down to the next one in place. Only one core may use the
 * triangle meanwhile. */
uint32_t ph_draw_above(struct ph_triangle *t, const struct ph_band *band);

#endif
