/* model_png: PNG pictures as RGB888. png/ does it with libpng, nopng/ has none; the Makefile picks. */
#ifndef MODEL_PNG_H
#define MODEL_PNG_H

#include "ppm.h"

#include <stddef.h>

/* Both return 0, or a negative errno value where there is no such PNG of at most PPM_SIDE_MAX pixels a side.
 * free(picture->rgb). */
int model_png_file(const char *path, struct ppm *picture);
int model_png_memory(const void *bytes, size_t n, struct ppm *picture);

/* Why a PNG is refused ("is ..."): broken, or libpng was missing. */
extern const char model_png_reason[];

#endif
