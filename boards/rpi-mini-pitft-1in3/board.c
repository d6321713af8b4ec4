/*
 * D/C was checked against Linux' minipitft13 overlay. That overlay has the backlight on GPIO26, as does the
 * maker's 1.3" Bonnet. GPIO22 and the buttons are those of the 1.14", on the same page; they were not confirmed for
 * this one.
 */
#include "families/rpi.h"

const struct board board_rpi_mini_pitft_1in3 = {
    .name = "rpi-mini-pitft-1in3",
    .title = "Raspberry Pi with Adafruit Mini PiTFT 1.3\", 240x240",
    .panel = &panel_st7789_240x240,
    .rotation = PANEL_R0, /* C0h by Adafruit's st7789.py, the picture turned by rotation=180 in the example */
    .format = PANEL_RGB565,
    .spi_hz = 62500000,
    RPI_HEADER,
    RPI_MINI_PITFT,
};
