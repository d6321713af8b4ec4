/* raster_walk: triangles that are walked row by row, and single pixels. Private to firmware/core. */
#ifndef PH_RASTER_WALK_H
#define PH_RASTER_WALK_H

#include "band.h"

/* Draws the part of a triangle that lies in the band; it has one colour or is a Gouraud one. Returns the pixels
 * tested. */
uint32_t ph_walk(const struct ph_triangle *t, const struct ph_band *band);

/* Draws pixel (x, y) of a flat triangle whose depth is not exact; the pixel lies in the band. */
void ph_draw_pixel(const struct ph_triangle *t, int32_t x, int32_t y, const struct ph_band *band);

#endif
