/* See model_texture.h. A picture is scaled to powers of two by the mean of the pixels that a texel covers. */
#include "model_texture.h"

#include "model.h"

#include <string.h>

static uint8_t log2_of_side(uint32_t side)
{
    uint8_t log2 = 0;
    while (log2 < TEXTURE_LOG2_MAX && (1u << log2) < side) {
        log2++;
    }
    return log2;
}

/* The pixels first .. last - 1, at least one, that texel i of 2^log2 covers on a side of n pixels. */
struct span {
    uint32_t first, last;
};

static struct span covered(uint32_t i, uint32_t n, uint8_t log2)
{
    struct span s = {(uint32_t)((uint64_t)i * n >> log2), (uint32_t)((uint64_t)(i + 1) * n >> log2)};
    if (s.last == s.first) {
        s.last++;
    }
    return s;
}

static uint16_t mean_colour(const struct ppm *picture, struct span x, struct span y)
{
    uint64_t sum[3] = {0, 0, 0};
    for (uint32_t j = y.first; j < y.last; j++) {
        for (uint32_t i = x.first; i < x.last; i++) {
            const uint8_t *pixel = picture->rgb + ((size_t)j * picture->width + i) * 3;
            sum[0] += pixel[0];
            sum[1] += pixel[1];
            sum[2] += pixel[2];
        }
    }
    const uint64_t n = (uint64_t)(x.last - x.first) * (y.last - y.first);
    return ph_rgb565((uint8_t)(sum[0] / n), (uint8_t)(sum[1] / n), (uint8_t)(sum[2] / n));
}

static void set_level(uint16_t *texels, const struct ppm *picture, uint8_t log2_width, uint8_t log2_height)
{
    for (uint32_t y = 0; y < 1u << log2_height; y++) {
        for (uint32_t x = 0; x < 1u << log2_width; x++) {
            texels[(y << log2_width) + x] =
                mean_colour(picture, covered(x, picture->width, log2_width), covered(y, picture->height, log2_height));
        }
    }
}

int model_texture_make(struct demo_arena *arena, const struct ppm *picture, struct ph_texture *texture)
{
    const uint8_t log2_width = log2_of_side(picture->width), log2_height = log2_of_side(picture->height);
    const uint8_t levels = log2_width > log2_height ? log2_width : log2_height;
    *texture = (struct ph_texture){
        .log2_width = log2_width, .log2_height = log2_height, .wrap = PH_WRAP_REPEAT, .levels = levels & 15};
    uint16_t *texels = demo_alloc(arena, sizeof *texels * model_texture_texels(texture, levels));
    if (texels == NULL) {
        return PH_ERR_NOMEM;
    }
    texture->texels = texels;
    for (uint8_t k = 0; k <= levels; k++) {
        const uint8_t width = k < log2_width ? log2_width - k : 0, height = k < log2_height ? log2_height - k : 0;
        set_level(texels, picture, width, height);
        texels += (size_t)1 << (width + height);
    }
    return 0;
}

size_t model_texture_texels(const struct ph_texture *texture, uint8_t levels)
{
    size_t sum = 0;
    for (int k = 0; k <= levels; k++) {
        const int width = texture->log2_width - k, height = texture->log2_height - k;
        sum += (size_t)1 << ((width > 0 ? width : 0) + (height > 0 ? height : 0));
    }
    return sum;
}
