/* texture: textured triangles in tiles. Private to firmware/core; the method is in texture.c. */
#ifndef PH_TEXTURE_H
#define PH_TEXTURE_H

#include "band.h"

/* Draws the rows of a textured triangle that lie in the band. Returns the number of its pixels. */
uint32_t ph_draw_textured(const struct ph_triangle *t, const struct ph_band *band);

#endif
