/* model_texture: pictures as textures for the renderer. */
#ifndef MODEL_TEXTURE_H
#define MODEL_TEXTURE_H

#include "demo.h"
#include "ppm.h"

#define TEXTURE_LOG2_MAX 10

/* Resamples the picture, by the mean of the pixels under each texel, to the next power of two of each side, at most
 * 1024. The texture repeats. 0, or PH_ERR_NOMEM when the arena is full. */
int model_texture_make(struct demo_arena *arena, const struct ppm *picture, struct ph_texture *texture);

#endif
