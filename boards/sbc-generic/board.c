/*
 * An ST7789 module on seven wires and ground: header pins 23 (clock), 19 (data), 24 (select), 22 (D/C), 13 (reset),
 * 18 (backlight). Wires of 10 cm bear this clock. Lines are named as on a Raspberry Pi. Kernels of other boards have
 * other names, which `gpioinfo` lists: pinhole-panel takes each line on its command line.
 */
#include "families/rpi.h"

const struct board board_sbc_generic = {
    .name = "sbc-generic",
    .title = "Any board with a 40-pin header and an ST7789 module on wires, 240x240",
    .pinout = "https://pinout.xyz",
    .panel = &panel_st7789_240x240,
    .rotation = PANEL_R0, /* the controller's own top: a bare module has no other */
    .format = PANEL_RGB565,
    .spi_hz = 20000000,
    RPI_HEADER,
    RPI_WAVESHARE_PINS,
};
