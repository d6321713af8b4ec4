/* ph_line_pixels of kernels.h, in C for any CPU. */
#include "kernels.h"
#include "span.h"

void ph_line_pixels(const struct ph_line_run *run, uint16_t *pixels, uint16_t *depth, uint32_t n)
{
    const int32_t slope = run->slope, forward = run->forward, stride = run->stride;
    const uint32_t gd = run->gd;
    const uint16_t colour = (uint16_t)run->colour;
    int32_t along = 0, across = run->across;
    uint32_t d = run->d;
    for (; n > 0; n--, along += forward, across += slope, d += gd) {
        const int32_t at = along + (across >> 16) * stride;
        ph_pixel_flat(&pixels[at], &depth[at], d, colour);
    }
}
