/* image: what firmware/app/images/board_here.c gives to the main() of a firmware image; hal/port.h has board_here. */
#ifndef IMAGE_H
#define IMAGE_H

#include "render.h"

#include <stddef.h>
#include <stdint.h>

/* How the image was built, in the words of make: "demos for pico-display, CORES=1 CHANGES=1". */
extern const char *const image_build;

/* Static memory for the runner: the board's scene_bytes. */
extern uint64_t image_memory[];
extern const size_t image_memory_bytes;

/* Static memory for the signatures of tiles (panel_tiles.h). 0 bytes where frames are sent whole (make's CHANGES=0). */
extern uint32_t image_tiles[];
extern const size_t image_tiles_bytes;

/* Frames in a second of clips; DEMO_CLIPS_BY_CLOCK: they run by the kit's clock (make's CLIP_FPS=N says otherwise). */
extern const uint16_t image_clip_fps;

/* Dithered light, which runner_config takes (make's DITHER=N). NULL: light has bands. */
extern struct ph_dither *const image_dither;
extern int (*const image_set_dither)(struct ph_renderer *r, struct ph_dither *dither);

/* Static memory for the scene of the next frame (see runner_config.h). NULL and 0 bytes with one core. */
extern void *const image_ahead;
extern const size_t image_ahead_bytes;
/* Where in flash a binary scene (scene_file.h) may lie, and its largest size. 0 bytes: the image looks for none. */
extern const void *const image_scene;
extern const size_t image_scene_bytes;

#endif
