/*
 * gif_out: frames as one GIF that repeats for ever, 30 frames a second at most. gif/ writes it with giflib; nogif/
 * refuses.
 *
 * Each frame has a palette of at most 255 colours, and a pixel that stays as it was is not sent again. A frame that
 * sends at most 255 colours is exact. For others the palette is fitted to what is sent (Lloyd's algorithm), and an
 * ordered dither spreads what it lacks.
 */
#ifndef GIF_OUT_H
#define GIF_OUT_H

#include "ppm.h"

#include <stddef.h>

struct gif_out;

#define GIF_OUT_BYTES_MOST 20000000 /* of a file, however many frames come: what web pages and chats take */

/* Packed frames wait in a file without a name in the folder of `path`: memory does not grow with them. Every pixel
 * becomes `scale` times as wide and high. 0 or a negative status; *gif is to be freed in any case. */
int gif_out_new(struct gif_out **gif, const char *path, uint32_t scale);

/* Takes the frame. All have the size of the first. 0, or a negative status (a full disk): the frame is left out, those
 * before it stay, and none may follow. */
int gif_out_add(struct gif_out *gif, const struct ppm *picture);

/* How many frames it took. */
uint32_t gif_out_count(const struct gif_out *gif);

/* Of so many frames one was kept at last, for as long as all of them last: 1, or more where the file would have become
 * too large. */
uint32_t gif_out_every(const struct gif_out *gif);

/* Writes path as file_save() does. 0 or a negative status. */
int gif_out_save(const struct gif_out *gif, const char *path);

void gif_out_free(struct gif_out *gif);

/* Why no GIF is written ("..."), or NULL. */
extern const char *const gif_out_reason;

#endif
