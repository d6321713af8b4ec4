/*
 * gif_out: frames as one GIF that repeats for ever, 30 frames a second at most. gif/ writes it with giflib; nogif/
 * refuses.
 *
 * All frames share a palette of at most 255 colours, and a pixel that stays as it was is not sent again. Pictures of at
 * most 255 colours in all are exact. For others the palette is fitted to all frames (Lloyd's algorithm), and an ordered
 * dither, which does not flicker from frame to frame, spreads what they lack.
 */
#ifndef GIF_OUT_H
#define GIF_OUT_H

#include "ppm.h"

#include <stddef.h>

struct gif_out;

/* Frames wait in a file without a name in the folder of `path`, because the palette is known after the last one: memory
 * does not grow with them. 0 or a negative status; *gif is to be freed in any case. */
int gif_out_new(struct gif_out **gif, const char *path);

/* Takes the frame. All have the size of the first. 0, or a negative status (a full disk): the frame is left out, and
 * those before it stay. */
int gif_out_add(struct gif_out *gif, const struct ppm *picture);

/* How many frames it has. */
uint32_t gif_out_count(const struct gif_out *gif);

/* Writes path as file_save() does, every pixel `scale` times as wide and high. 0 or a negative status. */
int gif_out_save(struct gif_out *gif, const char *path, uint32_t scale);

void gif_out_free(struct gif_out *gif);

/* Why no GIF is written ("..."), or NULL. */
extern const char *const gif_out_reason;

#endif
