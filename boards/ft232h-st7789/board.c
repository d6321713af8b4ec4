#include "families/ft232h.h"

const struct board board_ft232h_st7789 = {
    .name = "ft232h-st7789",
    .title = "FT232H on USB with an ST7789 240x240 breakout",
    .panel = &panel_st7789_240x240,
    .rotation = PANEL_R0, /* the controller's own top: a bare module has no other */
    .format = PANEL_RGB565,
    FT232H_BREAKOUT,
};
