/* colours_small: small triangles with a lit colour at each corner. Private to firmware/core. */
#ifndef PH_COLOURS_SMALL_H
#define PH_COLOURS_SMALL_H

#include "setting.h"
#include "triangle.h"

/* Sets the colours of a triangle that ph_setup_small has set up without a ramp. False: it crosses octaves, or is so
 * thin or so steep that a channel would be off by more than a quarter of a step: then it needs planes of 32 bits. uv:
 * none. */
bool ph_set_small_colours(struct ph_triangle *t, const struct ph_setting *s, const struct ph_vertex *const v[3],
                          const fx_t *const uv[3]);

#endif
