/* A stand-in of ESP-IDF's esp_lcd: ends are exclusive. */
#pragma once
#include "stand_in.h"

typedef void *esp_lcd_panel_handle_t;

static inline int esp_lcd_panel_draw_bitmap(esp_lcd_panel_handle_t panel, int x0, int y0, int x1, int y1,
                                            const void *pixels)
{
    (void)panel;
    return stand_in_take((uint32_t)x0, (uint32_t)y0, (uint32_t)(x1 - x0), (uint32_t)(y1 - y0), pixels, false);
}
