/*
 * Pinout: https://learn.adafruit.com/adafruit-pitft-28-inch-resistive-touchscreen-display-raspberry-pi
 * D/C, clock and backlight (at the touch controller, on by default) were checked against Linux' pitft28-resistive
 * overlay. No reset line. Buttons: the four lines of the PiTFT Plus; that they come in this order is not confirmed. The
 * first series has GPIO18 in place of GPIO17.
 */
#include "boards.h"

const struct board board_rpi_pitft_2in8 = {
    .name = "rpi-pitft-2in8",
    .title = "Raspberry Pi with Adafruit PiTFT 2.8\", 320x240",
    .pinout = "https://learn.adafruit.com/adafruit-pitft-28-inch-resistive-touchscreen-display-raspberry-pi",
    .panel = &panel_ili9341_240x320,
    .rotation = PANEL_R90,
    .format = PANEL_RGB565,
    .gpio_labels = RPI_GPIO_LABELS,
    .spi_hz = 32000000,
    .over_limit = true, /* the datasheet's 10 MHz are 8 frames a second; these modules run at this */
    .pins =
        {
            .clock = BOARD_LINE("GPIO11"),
            .data = BOARD_LINE("GPIO10"),
            .data_in = BOARD_LINE("GPIO9"),
            .select = BOARD_LINE_LOW("GPIO8"),
            .dc = BOARD_LINE("GPIO25"),
        },
    .buttons =
        {
            {HAL_BUTTON_UP, BOARD_LINE_LOW("GPIO17")},
            {HAL_BUTTON_DOWN, BOARD_LINE_LOW("GPIO22")},
            {HAL_BUTTON_LEFT, BOARD_LINE_LOW("GPIO23")},
            {HAL_BUTTON_RIGHT, BOARD_LINE_LOW("GPIO27")},
        },
    .button_count = 4,
    .band_height = 60,
    .ram_bytes = 16 * 1024 * 1024,
};
