/*
 * Pinout: https://www.waveshare.com/wiki/1.3inch_LCD_HAT
 * Buttons: the joystick.
 */
#include "boards.h"

const struct board board_rpi_waveshare_1in3 = {
    .name = "rpi-waveshare-1in3",
    .title = "Raspberry Pi with Waveshare 1.3inch LCD HAT, 240x240",
    .pinout = "https://www.waveshare.com/wiki/1.3inch_LCD_HAT",
    .panel = &panel_st7789_240x240,
    .rotation = PANEL_R90,
    .format = PANEL_RGB565,
    .gpio_labels = RPI_GPIO_LABELS,
    .spi_hz = 40000000,
    .pins =
        {
            .clock = BOARD_LINE("GPIO11"),
            .data = BOARD_LINE("GPIO10"),
            .select = BOARD_LINE_LOW("GPIO8"),
            .dc = BOARD_LINE("GPIO25"),
            .reset = BOARD_LINE("GPIO27"),
            .backlight = BOARD_LINE("GPIO24"),
        },
    .buttons =
        {
            {HAL_BUTTON_UP, BOARD_LINE_LOW("GPIO6")},
            {HAL_BUTTON_DOWN, BOARD_LINE_LOW("GPIO19")},
            {HAL_BUTTON_LEFT, BOARD_LINE_LOW("GPIO5")},
            {HAL_BUTTON_RIGHT, BOARD_LINE_LOW("GPIO26")},
            {HAL_BUTTON_SELECT, BOARD_LINE_LOW("GPIO13")},
        },
    .button_count = 5,
    .band_height = 60,
    .ram_bytes = 16 * 1024 * 1024,
};
