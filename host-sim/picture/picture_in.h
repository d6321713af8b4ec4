/*
 * picture_in: PNG, JPEG and WebP pictures as RGB888, read row by row and shrunk as they are read: a picture of 16,000 x
 * 16,000 pixels takes the memory of the small one that is wanted. Embedded colour profiles are left out.
 *
 * png/ reads PNG with libpng, jpeg/ JPEG with libjpeg, webp/ WebP with libwebp, which needs memory for the whole
 * picture; nopng/, nojpeg/ and nowebp/ refuse them.
 */
#ifndef PICTURE_IN_H
#define PICTURE_IN_H

#include "ppm.h"

#include <stdbool.h>
#include <stddef.h>

struct picture_in {
    uint32_t most;          /* sides that are longer become this long: pixel i of n goes to i * most / n, and each is
                               the mean, rounded down, of what comes to it */
    uint32_t most_pixels;   /* of the picture, after that; 0: no limit */
    uint32_t width, height; /* of the file, 1 .. PPM_SIDE_MAX */
    struct ppm picture;     /* picture_in_free() frees it and what follows */
    uint8_t *alpha;         /* of each pixel of the picture; NULL if the file has none */
    uint32_t *sums;         /* while it is shrunk: of each channel of the picture; else NULL */
    const char *why;        /* it is too large, or NULL */
};

/* Read a picture from a file or from memory. Return NULL, or why there is no picture ("is ..."). The caller sets
 * in->most. */
const char *picture_in_file(struct picture_in *in, const char *path);
const char *picture_in_memory(struct picture_in *in, const void *bytes, size_t n);

void picture_in_free(struct picture_in *in);

/* For the readers: whether a picture of this size is read. */
bool picture_in_size(struct picture_in *in, uint32_t width, uint32_t height);

/* For the readers: the size is known; n pixels of row y arrive, from x on in these steps; all have arrived. Each pixel
 * arrives once, as 3 bytes, or as 4 with alpha. false: too large, or no memory. */
bool picture_in_begin(struct picture_in *in, uint32_t width, uint32_t height, bool has_alpha);
void picture_in_row(struct picture_in *in, const uint8_t *pixels, uint32_t n, uint32_t x, uint32_t step, uint32_t y);
void picture_in_end(struct picture_in *in);

/* The readers. true, or false: in->why, or the reader's own reason. */
bool png_in_memory(struct picture_in *in, const void *bytes, size_t n);
bool jpeg_in_memory(struct picture_in *in, const void *bytes, size_t n);
bool webp_in_memory(struct picture_in *in, const void *bytes, size_t n);
extern const char png_in_reason[], jpeg_in_reason[], webp_in_reason[];

#endif
