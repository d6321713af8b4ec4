/* colours: triangles with a lit colour at each corner. Private to firmware/core. */
#ifndef PH_COLOURS_H
#define PH_COLOURS_H

#include "band.h"

/* Draws the rows of a triangle of PH_KIND_COLOURS that lie in the band. Returns the number of its pixels. */
uint32_t ph_draw_colours(const struct ph_triangle *t, const struct ph_band *band);

#endif
