/* See picture_in.h. WebP by libwebp, which decodes a whole picture at a time: up to 1 GiB for the largest that there
 * is. */
#include "picture_in.h"

#include <webp/decode.h>

const char webp_in_reason[] = "is a WebP picture that cannot be read: it is broken, cut off or animated";

bool webp_in_memory(struct picture_in *in, const void *bytes, size_t n)
{
    WebPBitstreamFeatures file;
    if (WebPGetFeatures(bytes, n, &file) != VP8_STATUS_OK) {
        return false;
    }
    const uint32_t width = (uint32_t)file.width, height = (uint32_t)file.height, channels = file.has_alpha ? 4 : 3;
    if (!picture_in_begin(in, width, height, file.has_alpha != 0)) {
        return false;
    }
    int w, h;
    uint8_t *pixels = (file.has_alpha ? WebPDecodeRGBA : WebPDecodeRGB)(bytes, n, &w, &h);
    for (uint32_t y = 0; pixels != NULL && y < height; y++) {
        picture_in_row(in, pixels + (size_t)y * width * channels, width, 0, 1, y);
    }
    WebPFree(pixels);
    return pixels != NULL;
}
