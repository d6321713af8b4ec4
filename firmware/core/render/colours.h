/* colours: triangles with a lit colour at each corner. Private to firmware/core. */
#ifndef PH_COLOURS_H
#define PH_COLOURS_H

#include "band.h"
#include "sides.h"

/* After ph_set_planes: a triangle of PH_DRAW_COLOURS gets its colours. flat: that of its first corner. */
void ph_set_colours(struct ph_triangle *t, const struct ph_vertex *const v[3], const struct ph_sides *sides, bool flat);

/* Draws the rows of a triangle of PH_KIND_COLOURS that lie in the band. Returns the number of its pixels. */
uint32_t ph_draw_colours(const struct ph_triangle *t, const struct ph_band *band);

#endif
