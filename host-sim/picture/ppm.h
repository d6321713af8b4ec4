/* ppm: binary PPM pictures (P6, 8 bits a channel), as netpbm, ImageMagick and ffmpeg read and write them. */
#ifndef PPM_H
#define PPM_H

#include <stdint.h>
#include <stdio.h>

struct ppm {
    uint32_t width, height;
    uint8_t *rgb; /* rows from the top, 3 bytes a pixel */
};

/* Appends one picture and flushes. 0 or a negative errno value. */
int ppm_write(FILE *file, const struct ppm *picture);

/* Writes path as file_save() does. 0 or a negative errno value. */
int ppm_save(const char *path, const struct ppm *picture);

#define PPM_SIDE_MAX 16384

/* Reads the first picture of the file, of most_pixels at most; free picture->rgb afterwards. 0 or a negative errno
 * value (PH_ERR_INVAL: not a PPM; PH_ERR_NOMEM: too large, and its size is in picture). */
int ppm_load(const char *path, uint32_t most_pixels, struct ppm *picture);

#endif
