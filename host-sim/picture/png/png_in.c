#include "png_in.h"

#include "status.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

const char png_in_reason[] = "is a PNG that cannot be read: broken or too large";

/* Drops alpha: the renderer has no transparency. */
static int finish(png_image *image, struct ppm *picture)
{
    int result = PH_ERR_INVAL;
    image->format = PNG_FORMAT_RGBA;
    uint8_t *rgba = NULL;
    if (image->width <= PPM_SIDE_MAX && image->height <= PPM_SIDE_MAX) {
        rgba = malloc(PNG_IMAGE_SIZE(*image));
    }
    if (rgba != NULL && png_image_finish_read(image, NULL, rgba, 0, NULL)) {
        const size_t pixels = (size_t)image->width * image->height;
        for (size_t i = 0; i < pixels; i++) {
            memmove(rgba + i * 3, rgba + i * 4, 3);
        }
        *picture = (struct ppm){image->width, image->height, rgba};
        rgba = NULL;
        result = 0;
    }
    free(rgba);
    png_image_free(image);
    return result;
}

int png_in_file(const char *path, struct ppm *picture)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    return png_image_begin_read_from_file(&image, path) ? finish(&image, picture) : PH_ERR_INVAL;
}

int png_in_memory(const void *bytes, size_t n, struct ppm *picture)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    return png_image_begin_read_from_memory(&image, bytes, n) ? finish(&image, picture) : PH_ERR_INVAL;
}
