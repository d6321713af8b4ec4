/*
 * Pinout: https://www.waveshare.com/wiki/Pico-LCD-1.3
 * Buttons: the joystick.
 */
#include "boards.h"

const struct board board_waveshare_pico_lcd_1in3 = {
    .name = "waveshare-pico-lcd-1in3",
    .title = "Raspberry Pi Pico with Waveshare Pico-LCD-1.3, 240x240",
    .pinout = "https://www.waveshare.com/wiki/Pico-LCD-1.3",
    .panel = &panel_st7789_240x240,
    .rotation = PANEL_R90,
    .format = PANEL_RGB565,
    .spi_bus = 1,
    .spi_hz = 62500000,
    .pins =
        {
            .clock = BOARD_PIN(10),
            .data = BOARD_PIN(11),
            .select = BOARD_PIN_LOW(9),
            .dc = BOARD_PIN(8),
            .reset = BOARD_PIN(12),
            .backlight = BOARD_PIN(13),
        },
    .buttons =
        {
            {HAL_BUTTON_UP, BOARD_PIN_LOW(2)},
            {HAL_BUTTON_DOWN, BOARD_PIN_LOW(18)},
            {HAL_BUTTON_LEFT, BOARD_PIN_LOW(16)},
            {HAL_BUTTON_RIGHT, BOARD_PIN_LOW(20)},
            {HAL_BUTTON_SELECT, BOARD_PIN_LOW(3)},
        },
    .button_count = 5,
    .band_height = 16,
    .band_buffers = 6,
    .ram_bytes = 140 * 1024,
};
