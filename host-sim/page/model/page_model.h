/*
 * page_model: pinhole-asset as a WebAssembly module, which page_worker.mjs calls: the readers of model files, the
 * simplifier and the writers of scenes, as in the program. Each instance of the module reads one model.
 *
 * Files come from the page, by calls of WASI. In this folder stand what the page does in its own way: model_open.c
 * reads without a child process, because the worker is one; model_folder.c finds files among those that the user gave;
 * progress.c tells the worker; stb_in.c reads pictures with stb_image; refuse.c refuses what the page does not read.
 * Messages go to stderr.
 */
#ifndef PAGE_MODEL_H
#define PAGE_MODEL_H

#include <stddef.h>
#include <stdint.h>

#define PAGE_EXPORT __attribute__((visibility("default"))) /* page.mk compiles with all else hidden */

/* Returns memory for the path of the model's file, PAGE_MODEL_PATH bytes with the 0. */
#define PAGE_MODEL_PATH 1024
PAGE_EXPORT char *page_model_path(void);

/* Reads the file of that path. up: 'y', 'z', or 0 for what the format says. filter: 0 .. 3 for nearest, bilinear,
 * mipmap and what the file says. background: 0xRRGGBB, or -1 for the usual. light: 0 for two lamps, 1 .. 5 for the
 * words of MODEL_LIGHTS. 0 or a message. */
PAGE_EXPORT int page_model_open(int up, unsigned filter, int two_sided, int32_t background, unsigned light);

/* Makes a scene of it, with clip number `clip` alone where the model has more than one (-1: with all), of at most so
 * many triangles. 0 triangles: as many as the board has room for; UINT32_MAX: all. texture_log2: of the longest side of
 * a texture. turntable: also where the file has a camera. Returns the bytes of the binary scene, 0 after a message. */
PAGE_EXPORT uint32_t page_model_make(uint32_t board, uint32_t triangles, unsigned texture_log2, int turntable,
                                     int clip);

/* Returns those bytes; they stay until the next scene is made. */
PAGE_EXPORT const uint8_t *page_model_scene(void);

/* Prints on stdout what the scene is, and what it needs of flash and of each board's memory, as an object of JSON. */
PAGE_EXPORT void page_model_report(void);

/* Prints the scene as C on stdout. */
PAGE_EXPORT void page_model_c(void);

#endif
