/* It has no buttons. */
#include "families/pico.h"

const struct board board_waveshare_rp2040_lcd_1in28 = {
    .name = "waveshare-rp2040-lcd-1in28",
    .title = "Waveshare RP2040-LCD-1.28, round, 240x240",
    .pinout = "https://www.waveshare.com/wiki/RP2040-LCD-1.28",
    .panel = &panel_gc9a01_240x240,
    .rotation = PANEL_R0, /* 08h after B6h 20h (columns reversed) by Waveshare's LCD_1in28.c */
    .format = PANEL_RGB565,
    .spi_hz = 62500000,
    PICO_WAVESHARE(25),
    .band_height = 16,
    .band_buffers = 6,
    .ram_bytes = 118 * 1024,
};
