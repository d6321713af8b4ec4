/* texels: u and v over a small textured triangle. Private to firmware/core; the method is in texels.c. */
#ifndef PH_TEXELS_H
#define PH_TEXELS_H

#include "setting.h"
#include "triangle.h"

/* Sets u, v and the kind of a triangle that ph_setup_small has set up without a ramp. False: it must be drawn in
 * tiles. uv: those of each corner; NULL counts as 0. */
bool ph_setup_texels(struct ph_triangle *t, const struct ph_setting *s, const struct ph_vertex *const v[3],
                     const fx_t *const uv[3]);

#endif
