/* setup_texture: the planes of u/w, v/w and 1/w. Private to firmware/core. */
#ifndef PH_SETUP_TEXTURE_H
#define PH_SETUP_TEXTURE_H

#include "plane.h"

/* Sets t->attribute and t->range_log2, once t->block and t->depth are set. uv: those of each corner; NULL counts as 0.
 */
void ph_setup_texture(const struct ph_renderer *r, const struct ph_plane_base *base, const struct ph_vertex *const v[3],
                      const fx_t *const uv[3], struct ph_triangle *t);

#endif
