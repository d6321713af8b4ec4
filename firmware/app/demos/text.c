#include "demo_scene.h"
#include "overlay.h"

// NOLINTNEXTLINE(readability-non-const-parameter): the pixels are written through the struct
void demo_text(const struct ph_renderer *r, uint32_t band, uint32_t lines, uint16_t *pixels, int32_t x, int32_t y,
               const char *text)
{
    const struct ph_overlay_band over = {pixels, r->config.width, (int32_t)(band * r->config.band_height),
                                         (int32_t)lines};
    const struct ph_overlay_style style = {ph_rgb565(255, 255, 255), ph_rgb565(0, 0, 0), 1};
    ph_overlay_text(&over, x, y, text, &style);
}
