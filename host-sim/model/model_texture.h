/* model_texture: pictures as textures for the renderer. */
#ifndef MODEL_TEXTURE_H
#define MODEL_TEXTURE_H

#include "demo.h"
#include "ppm.h"

#define TEXTURE_LOG2_MAX 10

/* Resamples the picture, by the mean of the pixels under each texel, to the next power of two of each side, at most
 * 1024. Its levels, down to one texel, are means of the same picture: a box filter on the values as they are stored,
 * which is in gamma space. The texture repeats, and is drawn by the nearest texel. 0, or PH_ERR_NOMEM when the arena is
 * full. */
int model_texture_make(struct demo_arena *arena, const struct ppm *picture, struct ph_texture *texture);

/* Texels of the first level and so many more. */
size_t model_texture_texels(const struct ph_texture *texture, uint8_t levels);

#endif
