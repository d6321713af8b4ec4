/* Pinhole on a panel of ESP-IDF's esp_lcd, by ph_show. `panel` is yours: esp_lcd_new_panel_st7789() or another one,
 * started. */
#include "triangle.h"

#include <esp_lcd_panel_ops.h>

/* esp_lcd sends in the background from the buffer that it is given: wait here for its on_color_trans_done. */
extern void wait_until_sent(void);

static int flush(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    const int status = esp_lcd_panel_draw_bitmap(context, (int)x, (int)y, (int)(x + width), (int)(y + height), pixels);
    wait_until_sent();
    return status;
}

void pinhole_task(esp_lcd_panel_handle_t panel)
{
    static struct ph_renderer renderer;
    if (triangle_init(&renderer, PH_PIXELS_WIRE) != 0) {
        return;
    }
    for (uint32_t frame = 0; triangle_draw(&renderer, frame) == 0; frame++) {
        if (ph_show(&renderer, flush, panel) != 0) {
            return;
        }
    }
}
