#include "families/pico.h"

const struct board board_waveshare_pico_lcd_1in3 = {
    .name = "waveshare-pico-lcd-1in3",
    .title = "Raspberry Pi Pico with Waveshare Pico-LCD-1.3, 240x240",
    .pinout = "https://www.waveshare.com/wiki/Pico-LCD-1.3",
    .panel = &panel_st7789_240x240,
    .rotation = PANEL_R90, /* 70h by Waveshare's LCD_1in3.c, HORIZONTAL; bit 10h is the refresh order */
    .format = PANEL_RGB565,
    .spi_hz = 62500000,
    PICO_WAVESHARE(13),
    PICO_WAVESHARE_JOYSTICK,
    .band_height = 16,
    .band_buffers = 6,
    .ram_bytes = 118 * 1024,
};
