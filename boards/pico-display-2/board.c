#include "families/pico.h"

const struct board board_pico_display_2 = {
    .name = "pico-display-2",
    .title = "Raspberry Pi Pico with Pimoroni Pico Display Pack 2.0, 320x240",
    .pinout = "https://shop.pimoroni.com/products/pico-display-pack-2-0",
    .panel = &panel_st7789_240x320,
    .rotation = PANEL_R90, /* 70h by pimoroni-pico's st7789.cpp at ROTATE_0; bit 10h is the refresh order */
    .format = PANEL_RGB565,
    .spi_hz = 62500000,
    PICO_PIMORONI,
    .band_height = 16,
    .band_buffers = 5,
    .ram_bytes = 118 * 1024,
};
