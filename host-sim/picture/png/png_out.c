/* See png_out.h. PNG by libpng, in memory. */
#include "png_out.h"

#include <png.h>
#include <stdlib.h>

uint8_t *png_out_bytes(const struct ppm *picture, size_t *length)
{
    png_image image = {
        .version = PNG_IMAGE_VERSION, .width = picture->width, .height = picture->height, .format = PNG_FORMAT_RGB};
    png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(image); /* asking for the size would compress it twice */
    uint8_t *memory = malloc(bytes);
    if (memory != NULL && !png_image_write_to_memory(&image, memory, &bytes, 0, picture->rgb, 0, NULL)) {
        free(memory);
        memory = NULL;
    }
    png_image_free(&image);
    *length = bytes;
    return memory;
}
