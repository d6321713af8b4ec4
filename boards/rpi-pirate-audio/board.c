/*
 * Pinout: https://pinout.xyz/pinout/pirate_audio_line_out; checked against the maker's examples
 * (https://github.com/pimoroni/pirate-audio). Keys A, B, X, Y are up, down, left, right; Y is GPIO20 on boards sold
 * before 23 January 2020. No reset line.
 */
#include "boards.h"

const struct board board_rpi_pirate_audio = {
    .name = "rpi-pirate-audio",
    .title = "Raspberry Pi with Pimoroni Pirate Audio, 240x240",
    .pinout = "https://pinout.xyz/pinout/pirate_audio_line_out",
    .panel = &panel_st7789_240x240,
    .rotation = PANEL_R0,
    .format = PANEL_RGB565,
    .spi_select = 1,
    .gpio_labels = RPI_GPIO_LABELS,
    .spi_hz = 62500000,
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
