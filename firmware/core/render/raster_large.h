/* raster_large: triangles that are not small. Private to firmware/core. */
#ifndef PH_RASTER_LARGE_H
#define PH_RASTER_LARGE_H

#include "band.h"

/* Draws the part that lies in the band of a triangle that is neither small nor exact. Returns the pixels tested. */
uint32_t ph_draw_large(const struct ph_triangle *t, const struct ph_band *band);

#endif
