/* texture_knee: whether a small textured triangle whose depth has a knee is drawn as one. Here it is not, which saves code:
 * its rows are split (raster_rows.c). See texture_small.h. */
#ifndef PH_TEXTURE_KNEE_H
#define PH_TEXTURE_KNEE_H

#include "texture_small.h"

#define PH_TEXTURE_KNEE 0

/* Never called. */
static inline uint32_t ph_texture_knee(struct ph_texel_run *r, uint32_t knee)
{
    (void)knee;
    return r->rows;
}

#endif
