#include "families/ft232h.h"

const struct board board_ft232h_ili9341 = {
    .name = "ft232h-ili9341",
    .title = "FT232H on USB with an ILI9341 240x320 breakout",
    .panel = &panel_ili9341_240x320,
    .rotation = PANEL_R0, /* the controller's own top: a bare module has no other */
    .format = PANEL_RGB565,
    .over_limit = true, /* the datasheet's 10 MHz are 8 frames a second; these modules run at this */
    FT232H_BREAKOUT,
};
