/*
 * Pinout: https://shop.pimoroni.com/products/pico-display-pack-2-0
 * Keys A, B, X, Y are up, down, left, right. The panel's reset follows the Pico's RUN.
 */
#include "boards.h"

const struct board board_pico_display_2 = {
    .name = "pico-display-2",
    .title = "Raspberry Pi Pico with Pimoroni Pico Display Pack 2.0, 320x240",
    .pinout = "https://shop.pimoroni.com/products/pico-display-pack-2-0",
    .panel = &panel_st7789_240x320,
    .rotation = PANEL_R90,
    .format = PANEL_RGB565,
    .spi_hz = 62500000,
    .pins =
        {
            .clock = BOARD_PIN(18),
            .data = BOARD_PIN(19),
            .select = BOARD_PIN_LOW(17),
            .dc = BOARD_PIN(16),
            .backlight = BOARD_PIN(20),
        },
    .buttons =
        {
            {HAL_BUTTON_UP, BOARD_PIN_LOW(12)},
            {HAL_BUTTON_DOWN, BOARD_PIN_LOW(13)},
            {HAL_BUTTON_LEFT, BOARD_PIN_LOW(14)},
            {HAL_BUTTON_RIGHT, BOARD_PIN_LOW(15)},
        },
    .button_count = 4,
    .band_height = 16,
    .band_buffers = 5,
    .ram_bytes = 140 * 1024,
};
