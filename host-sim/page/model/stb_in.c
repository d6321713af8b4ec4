/* See picture_in.h. PNG and JPEG by stb_image, which needs memory for the whole picture. A PNG has the pixels that
 * libpng gives. In a JPEG a channel may be off by a few steps of 256 from libjpeg's, which interpolates colours in
 * another way. A checksum of a PNG is not looked at. */
#include "picture_in.h"

#include <stdlib.h>

#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_FAILURE_STRINGS
#define STBI_MAX_DIMENSIONS PPM_SIDE_MAX
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

const char png_in_reason[] = "is a PNG that cannot be read: it is broken or cut off";
const char jpeg_in_reason[] = "is a JPEG that cannot be read: it is broken or cut off";

/* 16 bits as the nearest of 8, as libpng does it. */
static void halve(uint8_t *to, const uint16_t *from, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        to[i] = (uint8_t)(((uint32_t)from[i] * 255 + 32895) >> 16);
    }
}

/* Four bytes a pixel. NULL: it cannot be read. */
static uint8_t *load(const void *bytes, int n, int *width, int *height, int *channels)
{
    if (!stbi_is_16_bit_from_memory(bytes, n)) {
        return stbi_load_from_memory(bytes, n, width, height, channels, 4);
    }
    uint16_t *const wide = stbi_load_16_from_memory(bytes, n, width, height, channels, 4);
    if (wide != NULL) {
        halve((uint8_t *)wide, wide,
              (size_t)*width * (size_t)*height * 4); /* forwards: it reads ahead of what it writes */
    }
    return (uint8_t *)wide;
}

static bool read(struct picture_in *in, const void *bytes, size_t n)
{
    int width = 0, height = 0, channels = 0;
    if (n > INT32_MAX || !stbi_info_from_memory(bytes, (int)n, &width, &height, &channels) ||
        !picture_in_size(in, (uint32_t)width, (uint32_t)height)) {
        return false;
    }
    uint8_t *const pixels = load(bytes, (int)n, &width, &height, &channels);
    const bool has_alpha = channels == 2 || channels == 4;
    const bool is_begun = pixels != NULL && picture_in_begin(in, (uint32_t)width, (uint32_t)height, has_alpha);
    for (int y = 0; y < height && is_begun; y++) {
        uint8_t *const row = pixels + (size_t)y * (size_t)width * 4;
        for (size_t x = 0; x < (size_t)width && !has_alpha; x++) {
            for (size_t c = 0; c < 3; c++) {
                row[3 * x + c] = row[4 * x + c];
            }
        }
        picture_in_row(in, row, (uint32_t)width, 0, 1, (uint32_t)y);
    }
    stbi_image_free(pixels);
    return is_begun;
}

bool png_in_memory(struct picture_in *in, const void *bytes, size_t n)
{
    return read(in, bytes, n);
}

bool jpeg_in_memory(struct picture_in *in, const void *bytes, size_t n)
{
    return read(in, bytes, n);
}
