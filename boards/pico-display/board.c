#include "families/pico.h"

const struct board board_pico_display = {
    .name = "pico-display",
    .title = "Raspberry Pi Pico with Pimoroni Pico Display Pack, 1.14\", 240x135",
    .pinout = "https://shop.pimoroni.com/products/pico-display-pack",
    .panel = &panel_st7789_135x240,
    .rotation = PANEL_R90, /* 70h by pimoroni-pico's st7789.cpp at ROTATE_0; bit 10h is the refresh order */
    .format = PANEL_RGB565,
    .spi_hz = 62500000,
    PICO_PIMORONI,
    .band_height = 16,
    .band_buffers = 6,
    .ram_bytes = 118 * 1024,
};
