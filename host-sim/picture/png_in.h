/* png_in: PNG pictures as RGB888. png/ reads them with libpng; nopng/ refuses them. */
#ifndef PNG_IN_H
#define PNG_IN_H

#include "ppm.h"

#include <stddef.h>

/* Both return 0, or a negative status if there is no such PNG of at most PPM_SIDE_MAX pixels a side. The caller frees
 * picture->rgb. */
int png_in_file(const char *path, struct ppm *picture);
int png_in_memory(const void *bytes, size_t n, struct ppm *picture);

/* Why a PNG is refused ("is ..."): broken, or libpng was missing. */
extern const char png_in_reason[];

#endif
