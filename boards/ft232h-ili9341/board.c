/*
 * Pinout: https://learn.adafruit.com/adafruit-ft232h-breakout/pinouts
 * The breakout's backlight is on by default.
 */
#include "boards.h"

const struct board board_ft232h_ili9341 = {
    .name = "ft232h-ili9341",
    .title = "FT232H on USB with an ILI9341 240x320 breakout",
    .pinout = "https://learn.adafruit.com/adafruit-ft232h-breakout/pinouts",
    .panel = &panel_ili9341_240x320,
    .rotation = PANEL_R0,
    .format = PANEL_RGB565,
    .spi_hz = 30000000,
    .over_limit = true, /* the datasheet's 10 MHz are 8 frames a second; these modules run at this */
    .pins =
        {
            .clock = BOARD_LINE("AD0"),
            .data = BOARD_LINE("AD1"),
            .data_in = BOARD_LINE("AD2"),
            .select = BOARD_LINE_LOW("AD3"),
            .dc = BOARD_LINE("AC0"),
            .reset = BOARD_LINE("AC1"),
        },
    .band_height = 60,
    .ram_bytes = 16 * 1024 * 1024,
};
