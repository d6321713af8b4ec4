/* gouraud: what only Gouraud triangles need. Private to firmware/core. */
#ifndef PH_GOURAUD_H
#define PH_GOURAUD_H

#include "shading.h"

/* PH_SHADE_GOURAUD names it, and nothing else refers to its functions: see shading.h. */
extern const struct ph_gouraud ph_gouraud;

/* See struct ph_gouraud. */
void ph_take_tall(struct ph_triangle *t, const struct ph_renderer *r, const struct ph_vertex *const v[3],
                  const struct ph_sides *sides);

#endif
