#include "families/pico.h"

const struct board board_waveshare_pico_lcd_0in96 = {
    .name = "waveshare-pico-lcd-0in96",
    .title = "Raspberry Pi Pico with Waveshare Pico-LCD-0.96, 160x80",
    .pinout = "https://www.waveshare.com/wiki/Pico-LCD-0.96",
    .panel = &panel_st7735s_80x160,
    .rotation = PANEL_R270, /* A8h by Waveshare's Pico-LCD-0.96.py */
    .format = PANEL_RGB565,
    .spi_hz = 10000000,
    PICO_WAVESHARE(13),
    PICO_WAVESHARE_JOYSTICK,
    .band_height = 16,
    .band_buffers = 5,
    .ram_bytes = 118 * 1024,
};
