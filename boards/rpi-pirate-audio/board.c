/*
 * Checked against the maker's examples (https://github.com/pimoroni/pirate-audio). On boards sold before 23 January
 * 2020 key Y is GPIO20.
 */
#include "families/rpi.h"

const struct board board_rpi_pirate_audio = {
    .name = "rpi-pirate-audio",
    .title = "Raspberry Pi with Pimoroni Pirate Audio, 240x240",
    .pinout = "https://pinout.xyz/pinout/pirate_audio_line_out",
    .panel = &panel_st7789_240x240,
    .rotation = PANEL_R0, /* 70h by st7789-python, the picture turned by rotation=90 in the examples */
    .format = PANEL_RGB565,
    .spi_hz = 62500000,
    RPI_HEADER,
    RPI_PIMORONI,
};
