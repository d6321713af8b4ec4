/*
 * D/C, clock and the missing reset line are those of Adafruit's pitft35-resistive overlay, which sets 20 MHz (their
 * installer; 16 MHz before). The backlight is at the touch controller, on by default.
 */
#include "families/rpi.h"

const struct board board_rpi_pitft_3in5 = {
    .name = "rpi-pitft-3in5",
    .title = "Raspberry Pi with Adafruit PiTFT 3.5\", 480x320",
    .pinout = "https://learn.adafruit.com/adafruit-pitft-3-dot-5-touch-screen-for-raspberry-pi",
    .panel = &panel_hx8357d_320x480,
    .rotation = PANEL_R90, /* A0h by Adafruit's adafruit_hx8357.py */
    .format = PANEL_RGB565,
    .spi_hz = 20000000,
    .over_limit = true,
    RPI_HEADER,
    .pins = {RPI_CLOCK_AND_DATA, .data_in = BOARD_LINE("GPIO9"), .select = BOARD_LINE_LOW("GPIO8"),
             .dc = BOARD_LINE("GPIO25")},
};
