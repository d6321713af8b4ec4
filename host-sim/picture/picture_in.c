/* See picture_in.h. A pixel of the small picture is the mean of those that it covers. */
#include "picture_in.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TEXT_OF(number) #number
#define AS_TEXT(number) TEXT_OF(number)

bool picture_in_size(struct picture_in *in, uint32_t width, uint32_t height)
{
    in->width = width;
    in->height = height;
    if (width > PPM_SIDE_MAX || height > PPM_SIDE_MAX) {
        in->why = "is too large: more than " AS_TEXT(PPM_SIDE_MAX) " pixels a side";
    }
    return in->why == NULL && width > 0 && height > 0;
}

bool picture_in_begin(struct picture_in *in, uint32_t width, uint32_t height, bool has_alpha)
{
    if (!picture_in_size(in, width, height)) {
        return false;
    }
    const uint32_t w = width < in->most ? width : in->most, h = height < in->most ? height : in->most;
    const size_t n = (size_t)w * h;
    if (in->most_pixels > 0 && n > in->most_pixels) {
        in->why = "has too many pixels";
        return false;
    }
    in->picture = (struct ppm){w, h, malloc(n * 3)};
    in->alpha = has_alpha ? malloc(n) : NULL;
    const bool shrinks = w < width || h < height;
    in->sums = shrinks ? calloc(n * 4, sizeof *in->sums) : NULL;
    if (in->picture.rgb == NULL || (has_alpha && in->alpha == NULL) || (shrinks && in->sums == NULL)) {
        in->why = "needs too much memory";
    }
    return in->why == NULL;
}

/* Where channel c of pixel i belongs. */
static uint8_t *place_of(const struct picture_in *in, size_t i, unsigned c)
{
    return c < 3 ? &in->picture.rgb[3 * i + c] : &in->alpha[i];
}

void picture_in_row(struct picture_in *in, const uint8_t *pixels, uint32_t n, uint32_t x, uint32_t step, uint32_t y)
{
    const struct ppm *to = &in->picture;
    const unsigned channels = in->alpha != NULL ? 4 : 3;
    const size_t row = (size_t)((uint64_t)y * to->height / in->height) * to->width;
    for (uint32_t i = 0; i < n && x < in->width; i++, x += step, pixels += channels) {
        const size_t at = row + (uint32_t)((uint64_t)x * to->width / in->width);
        for (unsigned c = 0; c < channels; c++) {
            if (in->sums != NULL) {
                in->sums[4 * at + c] += pixels[c];
            } else {
                *place_of(in, at, c) = pixels[c];
            }
        }
    }
}

/* How many of n pixels come to pixel i of a side that is `to` long. */
static uint32_t share(uint32_t i, uint32_t n, uint32_t to)
{
    return (uint32_t)((((uint64_t)i + 1) * n + to - 1) / to - ((uint64_t)i * n + to - 1) / to);
}

void picture_in_end(struct picture_in *in)
{
    const struct ppm *to = &in->picture;
    for (uint32_t y = 0; in->sums != NULL && y < to->height; y++) {
        for (uint32_t x = 0; x < to->width; x++) {
            const size_t at = (size_t)y * to->width + x;
            const uint32_t count = share(x, in->width, to->width) * share(y, in->height, to->height);
            for (unsigned c = 0; c < (in->alpha != NULL ? 4 : 3); c++) {
                *place_of(in, at, c) = (uint8_t)(in->sums[4 * at + c] / count);
            }
        }
    }
    free(in->sums);
    in->sums = NULL;
}

void picture_in_free(struct picture_in *in)
{
    free(in->picture.rgb);
    free(in->alpha);
    free(in->sums);
    in->picture.rgb = NULL;
    in->alpha = NULL;
    in->sums = NULL;
}

/* The reader of a kind of file, which begins with `magic`, at byte `at`. */
static const struct kind {
    const char *magic;
    size_t magic_n, at;
    bool (*read)(struct picture_in *in, const void *bytes, size_t n);
    const char *reason;
} kinds[] = {{"\x89PNG", 4, 0, png_in_memory, png_in_reason},
             {"\xFF\xD8", 2, 0, jpeg_in_memory, jpeg_in_reason},
             {"WEBP", 4, 8, webp_in_memory, webp_in_reason}};

const char *picture_in_memory(struct picture_in *in, const void *bytes, size_t n)
{
    const struct kind *kind = kinds, *const end = kinds + sizeof kinds / sizeof kinds[0];
    while (kind < end &&
           (n < kind->at + kind->magic_n || memcmp((const char *)bytes + kind->at, kind->magic, kind->magic_n) != 0)) {
        kind++;
    }
    if (kind == end) {
        return "is no PNG, JPEG or WebP picture";
    }
    in->picture.rgb = NULL;
    in->alpha = NULL;
    in->sums = NULL;
    in->why = NULL;
    if (kind->read(in, bytes, n)) {
        picture_in_end(in);
        return NULL;
    }
    picture_in_free(in);
    return in->why != NULL ? in->why : kind->reason;
}

const char *picture_in_file(struct picture_in *in, const char *path)
{
    FILE *file = fopen(path, "rb");
    const long size = file != NULL && fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    uint8_t *bytes = size >= 0 && size < 1L << 30 ? malloc((size_t)size + 1) : NULL;
    const bool is_read =
        bytes != NULL && fseek(file, 0, SEEK_SET) == 0 && fread(bytes, 1, (size_t)size, file) == (size_t)size;
    const char *why = is_read ? picture_in_memory(in, bytes, (size_t)size) : "cannot be opened";
    if (file != NULL) {
        fclose(file);
    }
    free(bytes);
    return why;
}
