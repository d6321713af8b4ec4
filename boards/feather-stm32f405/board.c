/* D9 is PB8, D10 is PB9. The panel is reset with the Feather; its backlight is always on. */
#include "boards.h"

const struct board board_feather_stm32f405 = {
    .name = "feather-stm32f405",
    .title = "Adafruit Feather STM32F405 with TFT FeatherWing 2.4\", 320x240",
    .pinout = "https://learn.adafruit.com/adafruit-2-4-tft-touch-screen-featherwing/pinouts",
    .panel = &panel_ili9341_240x320,
    .rotation = PANEL_R90, /* 38h by Adafruit's adafruit_ili9341.py; bit 10h is the refresh order */
    .format = PANEL_RGB565,
    .spi_unit = BOARD_SPI_STM32F4,
    .spi_bus = 2,
    .spi_hz = 21000000,
    .over_limit = true, /* the datasheet's 10 MHz are 8 frames a second; these modules run at this */
    .pins =
        {
            .clock = BOARD_PIN(BOARD_PORT('B', 13)),
            .data = BOARD_PIN(BOARD_PORT('B', 15)),
            .data_in = BOARD_PIN(BOARD_PORT('B', 14)),
            .select = BOARD_PIN_LOW(BOARD_PORT('B', 8)),
            .dc = BOARD_PIN(BOARD_PORT('B', 9)),
        },
    .band_height = 16,
    BUDGET_STM32F405,
};
