/*
 * The stick is up, down, left, right and select; keys A and B (GPIO5, GPIO6) are not used. There is no reset line. A1h
 * and C8h are those of Adafruit's adafruit_ssd1306.py, whose example does not turn the picture.
 */
#include "families/rpi.h"

const struct board board_rpi_oled_bonnet = {
    .name = "rpi-oled-bonnet",
    .title = "Raspberry Pi with Adafruit 128x64 OLED Bonnet (I2C), one bit a pixel",
    .pinout = "https://learn.adafruit.com/adafruit-128x64-oled-bonnet-for-raspberry-pi/pinouts",
    .panel = &panel_ssd1306_128x64,
    .rotation = PANEL_R0,
    .format = PANEL_MONO_DITHER,
    .spi_bus = 1,
    .i2c_address = 0x3C,
    .spi_hz = 400000,
    .pins = {.clock = BOARD_LINE("GPIO3"), .data = BOARD_LINE("GPIO2")},
    .buttons = {{HAL_BUTTON_UP, BOARD_LINE_LOW("GPIO17")},
                {HAL_BUTTON_DOWN, BOARD_LINE_LOW("GPIO22")},
                {HAL_BUTTON_LEFT, BOARD_LINE_LOW("GPIO27")},
                {HAL_BUTTON_RIGHT, BOARD_LINE_LOW("GPIO23")},
                {HAL_BUTTON_SELECT, BOARD_LINE_LOW("GPIO4")}},
    .button_count = 5,
    RPI_HEADER,
};
