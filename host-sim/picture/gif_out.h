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

/* Returns NULL without memory. */
struct gif_out *gif_out_new(void);

/* Keeps a copy of the frame until gif_out_save(). All have the size of the first. 0 or PH_ERR_NOMEM: no memory, or all
 * frames together take over GIF_OUT_BYTES. */
#define GIF_OUT_BYTES ((size_t)1 << 30)
int gif_out_add(struct gif_out *gif, const struct ppm *picture);

/* Writes path as file_save() does, every pixel `scale` times as wide and high. 0 or a negative status. */
int gif_out_save(struct gif_out *gif, const char *path, uint32_t scale);

void gif_out_free(struct gif_out *gif);

/* Why no GIF is written ("..."), or NULL. */
extern const char *const gif_out_reason;

#endif
