/*
 * Pinout: https://pinout.xyz/pinout/display_hat_mini; checked against the maker's driver
 * (https://github.com/pimoroni/displayhatmini-python).
 * Keys A, B, X, Y are up, down, left, right. No reset line.
 */
#include "boards.h"

const struct board board_rpi_display_hat_mini = {
    .name = "rpi-display-hat-mini",
    .title = "Raspberry Pi with Pimoroni Display HAT Mini, 320x240",
    .pinout = "https://pinout.xyz/pinout/display_hat_mini",
    .panel = &panel_st7789_240x320,
    .rotation = PANEL_R270,
    .format = PANEL_RGB565,
    .spi_select = 1,
    .gpio_labels = RPI_GPIO_LABELS,
    .spi_hz = 60000000,
    .pins =
        {
            .clock = BOARD_LINE("GPIO11"),
            .data = BOARD_LINE("GPIO10"),
            .select = BOARD_LINE_LOW("GPIO7"),
            .dc = BOARD_LINE("GPIO9"),
            .backlight = BOARD_LINE("GPIO13"),
        },
    .buttons =
        {
            {HAL_BUTTON_UP, BOARD_LINE_LOW("GPIO5")},
            {HAL_BUTTON_DOWN, BOARD_LINE_LOW("GPIO6")},
            {HAL_BUTTON_LEFT, BOARD_LINE_LOW("GPIO16")},
            {HAL_BUTTON_RIGHT, BOARD_LINE_LOW("GPIO24")},
        },
    .button_count = 4,
    .band_height = 60,
    .ram_bytes = 16 * 1024 * 1024,
};
