/* Checked against the maker's example (Adafruit_CircuitPython_RGB_Display, rgb_display_minipitfttest.py). */
#include "families/rpi.h"

const struct board board_rpi_mini_pitft_1in14 = {
    .name = "rpi-mini-pitft-1in14",
    .title = "Raspberry Pi with Adafruit Mini PiTFT 1.14\", 240x135",
    .panel = &panel_st7789_135x240,
    .rotation = PANEL_R90, /* C0h by Adafruit's st7789.py, the picture turned by rotation=90 in the example */
    .format = PANEL_RGB565,
    .spi_hz = 62500000,
    RPI_HEADER,
    RPI_MINI_PITFT,
};
