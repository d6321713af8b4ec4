/*
 * Pinout: https://learn.adafruit.com/adafruit-mini-pitft-135x240-color-tft-add-on-for-raspberry-pi
 * D/C was checked against Linux' minipitft13 overlay, which has GPIO26 for the backlight, as the maker's 1.3" Bonnet
 * does; GPIO22 and the buttons are those of the 1.14", on the same page, and were not confirmed for this one. No reset
 * line.
 */
#include "boards.h"

const struct board board_rpi_mini_pitft_1in3 = {
    .name = "rpi-mini-pitft-1in3",
    .title = "Raspberry Pi with Adafruit Mini PiTFT 1.3\", 240x240",
    .pinout = "https://learn.adafruit.com/adafruit-mini-pitft-135x240-color-tft-add-on-for-raspberry-pi",
    .panel = &panel_st7789_240x240,
    .rotation = PANEL_R180,
    .format = PANEL_RGB565,
    .gpio_labels = RPI_GPIO_LABELS,
    .spi_hz = 62500000,
    .pins =
        {
            .clock = BOARD_LINE("GPIO11"),
            .data = BOARD_LINE("GPIO10"),
            .select = BOARD_LINE_LOW("GPIO8"),
            .dc = BOARD_LINE("GPIO25"),
            .backlight = BOARD_LINE("GPIO22"),
        },
    .buttons =
        {
            {HAL_BUTTON_UP, BOARD_LINE_LOW("GPIO23")},
            {HAL_BUTTON_DOWN, BOARD_LINE_LOW("GPIO24")},
        },
    .button_count = 2,
    .band_height = 60,
    .ram_bytes = 16 * 1024 * 1024,
};
