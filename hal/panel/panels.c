/* See panel.h. */
#include "panels.h"

const struct panel *const panel_list[] = {
    &panel_st7789_240x240,  &panel_st7789_135x240,  &panel_st7789_240x320,  &panel_st7789_170x320,
    &panel_st7789_240x280,  &panel_gc9a01_240x240,  &panel_ili9341_240x320, &panel_ili9488_320x480,
    &panel_st7735s_128x128, &panel_st7735s_128x160, &panel_st7735s_80x160,  &panel_ssd1351_128x128,
    &panel_ssd0323_128x64,
};

const uint32_t panel_count = sizeof panel_list / sizeof panel_list[0];
