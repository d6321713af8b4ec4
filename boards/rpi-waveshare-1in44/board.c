#include "families/rpi.h"

const struct board board_rpi_waveshare_1in44 = {
    .name = "rpi-waveshare-1in44",
    .title = "Raspberry Pi with Waveshare 1.44inch LCD HAT, 128x128",
    .pinout = "https://www.waveshare.com/wiki/1.44inch_LCD_HAT",
    .panel = &panel_st7735s_128x128,
    .rotation = PANEL_R90, /* 68h by Waveshare's LCD_1in44.py, U2D_R2L */
    .format = PANEL_RGB565,
    .spi_hz = 9000000,
    RPI_HEADER,
    RPI_WAVESHARE_PINS,
    RPI_WAVESHARE_JOYSTICK,
};
