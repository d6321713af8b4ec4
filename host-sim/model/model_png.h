/* model_png: PNG pictures as RGB888. png/ reads them with libpng; nopng/ refuses them. */
#ifndef MODEL_PNG_H
#define MODEL_PNG_H

#include "ppm.h"

#include <stddef.h>

/* Both return 0, or a negative status if there is no such PNG of at most PPM_SIDE_MAX pixels a side. The caller frees
 * picture->rgb. */
int model_png_file(const char *path, struct ppm *picture);
int model_png_memory(const void *bytes, size_t n, struct ppm *picture);

/* Why a PNG is refused ("is ..."): broken, or libpng was missing. */
extern const char model_png_reason[];

#endif
