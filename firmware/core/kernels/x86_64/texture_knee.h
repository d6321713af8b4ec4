/* texture_knee: a small textured triangle whose depth has a knee is drawn as one, x86-64; see texture_small.h. This
 * takes half of what split rows take, and gives the same pixels. */
#ifndef PH_TEXTURE_KNEE_H
#define PH_TEXTURE_KNEE_H

#include "texture_small.h"

#define PH_TEXTURE_KNEE 1

/* ph_texture_small for codes with a knee, which is above 0: see ph_knee_code. */
uint32_t ph_texture_knee(struct ph_texel_run *r, uint32_t knee);

#endif
