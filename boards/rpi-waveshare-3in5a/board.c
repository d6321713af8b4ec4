/*
 * D/C, reset, chip select and 16 MHz are those of the waveshare35a overlay; tft35a of other makers is wired alike. The
 * backlight is always on. The touch controller has the other chip select and MISO.
 */
#include "families/rpi.h"

const struct board board_rpi_waveshare_3in5a = {
    .name = "rpi-waveshare-3in5a",
    .title = "Raspberry Pi with Waveshare 3.5inch RPi LCD (A), 480x320",
    .pinout = "https://www.waveshare.com/wiki/3.5inch_RPi_LCD_(A)",
    .panel = &panel_ili9486_320x480,
    .rotation = PANEL_R270, /* E8h by Linux' ili9486.c at rotation 0 */
    .format = PANEL_RGB565,
    .spi_hz = 16000000,
    RPI_HEADER,
    .pins = {RPI_CLOCK_AND_DATA, .select = BOARD_LINE_LOW("GPIO8"), .dc = BOARD_LINE("GPIO24"),
             .reset = BOARD_LINE("GPIO25")},
};
