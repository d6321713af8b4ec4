/* png_out: a picture as PNG (RGB, 8 bits a channel). png/ compresses it with libpng; nopng/ stores it as it is. */
#ifndef PNG_OUT_H
#define PNG_OUT_H

#include "ppm.h"

#include <stddef.h>

/* Returns the file's bytes, which the caller frees, or NULL without memory. */
uint8_t *png_out_bytes(const struct ppm *picture, size_t *length);

#endif
