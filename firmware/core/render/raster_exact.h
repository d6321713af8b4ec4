/* raster_exact: triangles whose depth takes 64 bits. Private to firmware/core. */
#ifndef PH_RASTER_EXACT_H
#define PH_RASTER_EXACT_H

#include "band.h"

/* Draws the part of a triangle with an exact plane of depth (exact.h) that lies in the band. Returns the pixels
 * tested. */
uint32_t ph_draw_exact(const struct ph_triangle *t, const struct ph_band *band);

#endif
