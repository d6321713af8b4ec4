/* See sim_show.h. */
#include "sim_show.h"

/* The linker's name for the function itself, where sim_show_draw_band stands for it. */
// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
uint32_t __real_demo_draw_band(const struct demo *demo, struct demo_context *context, struct ph_renderer *r,
                               uint32_t band, uint16_t *pixels);
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

static bool depth_shown;

void sim_show_depth(bool shown)
{
    depth_shown = shown;
}

uint32_t sim_show_draw_band(const struct demo *demo, struct demo_context *context, struct ph_renderer *r, uint32_t band,
                            uint16_t *pixels)
{
    if (!depth_shown) {
        return __real_demo_draw_band(demo, context, r, band, pixels);
    }
    const uint32_t lines = ph_draw_band(r, band, pixels), largest = ((uint32_t)1 << r->stats.depth_format->bits) - 1;
    const bool wide = ph_depth_bytes(r->config.depth_format) == sizeof(uint32_t);
    for (uint32_t i = 0; i < lines * r->config.width; i++) {
        const uint32_t code = wide ? ((const uint32_t *)r->config.depth)[i] : ((const uint16_t *)r->config.depth)[i];
        const uint8_t grey = (uint8_t)((code * (uint64_t)255 + largest / 2) / largest);
        pixels[i] = ph_rgb565(grey, grey, grey);
    }
    return lines;
}
