#include "families/rpi.h"

const struct board board_rpi_waveshare_1in3 = {
    .name = "rpi-waveshare-1in3",
    .title = "Raspberry Pi with Waveshare 1.3inch LCD HAT, 240x240",
    .pinout = "https://www.waveshare.com/wiki/1.3inch_LCD_HAT",
    .panel = &panel_st7789_240x240,
    .rotation = PANEL_R90, /* 70h by Waveshare's ST7789.py; bit 10h is the refresh order */
    .format = PANEL_RGB565,
    .spi_hz = 40000000,
    RPI_HEADER,
    RPI_WAVESHARE_PINS,
    RPI_WAVESHARE_JOYSTICK,
};
