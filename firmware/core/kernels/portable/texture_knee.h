/* texture_knee: whether a small textured triangle whose depth has a knee is drawn as one. Here it is not, which saves
 * code: its rows are split (raster_rows.c). See texture_small.h. */
#ifndef PH_TEXTURE_KNEE_H
#define PH_TEXTURE_KNEE_H

#include "texture_small_portable.h"

#define PH_TEXTURE_KNEE 0

/* ph_texture_small for codes with a knee, which is above 0: see ph_knee_code. Other CPUs' functions are compared with
 * this one. */
static inline uint32_t ph_texture_knee(struct ph_texel_run *r, uint32_t knee)
{
    return ph_texture_small_rows(r, knee);
}

#endif
