/*
 * What an image is built for: see image.h, hal/port.h and demo.h. firmware.mk compiles this file with -D:
 *   BOARD_HERE   the board's symbol          MEMORY_BYTES  its scene_bytes (firmware/tools/board_facts.c reads it)
 *   DEMO_HERE    the first demo's symbol     TILES_BYTES   memory for signatures of tiles, or 0
 *   AHEAD_BYTES  memory for the next frame's scene, or 0
 *   IMAGE_BUILD  image_build                  CLIP_FPS      frames in a second of clips, or DEMO_CLIPS_BY_CLOCK
 *   DITHERED_RAMPS  ramps for dithered light, or 0
 *   SCENE_AT     where a binary scene may lie in flash, of at most SCENE_BYTES; 0: nowhere
 */
#include "demo.h"
#include "image.h"
#include "memory_plan.h"
#include "port.h"

#ifdef BOARD_HERE /* make lint reads this file without a board */

extern const struct board BOARD_HERE;
extern const struct demo DEMO_HERE;

const struct board *const board_here = &BOARD_HERE;
const struct demo *const demo_here = &DEMO_HERE;

const char *const image_build = IMAGE_BUILD;

uint64_t image_memory[MEMORY_BYTES / sizeof(uint64_t)];
const size_t image_memory_bytes = sizeof image_memory;

uint32_t image_tiles[TILES_BYTES > 0 ? TILES_BYTES / sizeof(uint32_t) : 1];
const size_t image_tiles_bytes = TILES_BYTES;

static uint64_t ahead[AHEAD_BYTES > 0 ? AHEAD_BYTES / sizeof(uint64_t) : 1];
void *const image_ahead = AHEAD_BYTES > 0 ? ahead : NULL;
const size_t image_ahead_bytes = AHEAD_BYTES;
const void *const image_scene = (const void *)(uintptr_t)(SCENE_AT);
const size_t image_scene_bytes = SCENE_BYTES;
const uint16_t image_clip_fps = CLIP_FPS;

/* Without ramps neither they nor ph_dither are linked. */
#if DITHERED_RAMPS > 0
static struct ph_dithered_ramp ramps[DITHERED_RAMPS];
static struct ph_dither dither = {.ramps = ramps, .ramp_max = DITHERED_RAMPS};
struct ph_dither *const image_dither = &dither;
int (*const image_set_dither)(struct ph_renderer *r, struct ph_dither *dither) = ph_dither;
#else
struct ph_dither *const image_dither = NULL;
int (*const image_set_dither)(struct ph_renderer *r, struct ph_dither *dither) = NULL;
#endif

#endif
