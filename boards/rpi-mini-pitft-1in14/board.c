/*
 * Pinout: https://learn.adafruit.com/adafruit-mini-pitft-135x240-color-tft-add-on-for-raspberry-pi
 * Checked against the maker's example (Adafruit_CircuitPython_RGB_Display, rgb_display_minipitfttest.py). No reset
 * line.
 */
#include "boards.h"

const struct board board_rpi_mini_pitft_1in14 = {
    .name = "rpi-mini-pitft-1in14",
    .title = "Raspberry Pi with Adafruit Mini PiTFT 1.14\", 240x135",
    .pinout = "https://learn.adafruit.com/adafruit-mini-pitft-135x240-color-tft-add-on-for-raspberry-pi",
    .panel = &panel_st7789_135x240,
    .rotation = PANEL_R270,
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
