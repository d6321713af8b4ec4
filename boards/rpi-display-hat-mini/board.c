/* Checked against the maker's driver (https://github.com/pimoroni/displayhatmini-python). */
#include "families/rpi.h"

const struct board board_rpi_display_hat_mini = {
    .name = "rpi-display-hat-mini",
    .title = "Raspberry Pi with Pimoroni Display HAT Mini, 320x240",
    .pinout = "https://pinout.xyz/pinout/display_hat_mini",
    .panel = &panel_st7789_240x320,
    .rotation = PANEL_R270, /* 70h by st7789-python, the picture turned by rotation=180 in displayhatmini */
    .format = PANEL_RGB565,
    .spi_hz = 60000000,
    RPI_HEADER,
    RPI_PIMORONI,
};
