/*
 * D/C, clock and backlight (at the touch controller, on by default) were checked against Linux' pitft28-resistive
 * overlay. There is no reset line. The buttons are the four lines of the PiTFT Plus; their order is not confirmed. The
 * first series has GPIO18 in place of GPIO17.
 */
#include "families/rpi.h"

const struct board board_rpi_pitft_2in8 = {
    .name = "rpi-pitft-2in8",
    .title = "Raspberry Pi with Adafruit PiTFT 2.8\", 320x240",
    .pinout = "https://learn.adafruit.com/adafruit-pitft-28-inch-resistive-touchscreen-display-raspberry-pi",
    .panel = &panel_ili9341_240x320,
    .rotation = PANEL_R270, /* E8h by Linux' fb_ili9341 at rotate=90; Adafruit's Python: 48h and rotation=90 */
    .format = PANEL_RGB565,
    .spi_hz = 32000000,
    .over_limit = true, /* the datasheet's 10 MHz are 8 frames a second; these modules run at this */
    RPI_HEADER,
    .pins = {RPI_CLOCK_AND_DATA, .data_in = BOARD_LINE("GPIO9"), .select = BOARD_LINE_LOW("GPIO8"),
             .dc = BOARD_LINE("GPIO25")},
    .buttons =
        {
            {HAL_BUTTON_UP, BOARD_LINE_LOW("GPIO17")},
            {HAL_BUTTON_DOWN, BOARD_LINE_LOW("GPIO22")},
            {HAL_BUTTON_LEFT, BOARD_LINE_LOW("GPIO23")},
            {HAL_BUTTON_RIGHT, BOARD_LINE_LOW("GPIO27")},
        },
    .button_count = 4,
};
