/* png_out: a picture as PNG (RGB, 8 bits a channel), without libpng: its deflate stream is stored, not compressed. */
#ifndef PNG_OUT_H
#define PNG_OUT_H

#include "ppm.h"

#include <stddef.h>

/* Returns the file's bytes, which the caller frees, or NULL without memory. Sources: PNG (ISO/IEC 15948), RFC 1950, RFC
 * 1951. */
uint8_t *png_out_bytes(const struct ppm *picture, size_t *length);

#endif
