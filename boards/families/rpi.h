/* rpi: displays on the 40-pin header of a Raspberry Pi. They hang on SPI0 (GPIO11, GPIO10). */
#ifndef FAMILIES_RPI_H
#define FAMILIES_RPI_H

#include "boards.h"

/* What boards on a Raspberry Pi's header have in common, but for their pins. */
#define RPI_HEADER .gpio_labels = RPI_GPIO_LABELS, .band_height = 60, .scene_bytes = 16 * 1024 * 1024

#define RPI_CLOCK_AND_DATA .clock = BOARD_LINE("GPIO11"), .data = BOARD_LINE("GPIO10")

/* Waveshare's HATs. */
#define RPI_WAVESHARE_PINS                                                                                             \
    .pins = {RPI_CLOCK_AND_DATA, .select = BOARD_LINE_LOW("GPIO8"), .dc = BOARD_LINE("GPIO25"),                        \
             .reset = BOARD_LINE("GPIO27"), .backlight = BOARD_LINE("GPIO24")}

#define RPI_WAVESHARE_JOYSTICK                                                                                         \
    .buttons = {{HAL_BUTTON_UP, BOARD_LINE_LOW("GPIO6")},                                                              \
                {HAL_BUTTON_DOWN, BOARD_LINE_LOW("GPIO19")},                                                           \
                {HAL_BUTTON_LEFT, BOARD_LINE_LOW("GPIO5")},                                                            \
                {HAL_BUTTON_RIGHT, BOARD_LINE_LOW("GPIO26")},                                                          \
                {HAL_BUTTON_SELECT, BOARD_LINE_LOW("GPIO13")}},                                                        \
    .button_count = 5

/* Pimoroni's HATs: keys A, B, X, Y are up, down, left, right. D/C is the line of MISO. There is no reset line. */
#define RPI_PIMORONI                                                                                                   \
    .spi_select = 1,                                                                                                   \
    .pins = {RPI_CLOCK_AND_DATA, .select = BOARD_LINE_LOW("GPIO7"), .dc = BOARD_LINE("GPIO9"),                         \
             .backlight = BOARD_LINE("GPIO13")},                                                                       \
    .buttons = {{HAL_BUTTON_UP, BOARD_LINE_LOW("GPIO5")},                                                              \
                {HAL_BUTTON_DOWN, BOARD_LINE_LOW("GPIO6")},                                                            \
                {HAL_BUTTON_LEFT, BOARD_LINE_LOW("GPIO16")},                                                           \
                {HAL_BUTTON_RIGHT, BOARD_LINE_LOW("GPIO24")}},                                                         \
    .button_count = 4

/* Adafruit's Mini PiTFTs, which share a page. There is no reset line. */
#define RPI_MINI_PITFT                                                                                                 \
    .pinout = "https://learn.adafruit.com/adafruit-mini-pitft-135x240-color-tft-add-on-for-raspberry-pi",              \
    .pins = {RPI_CLOCK_AND_DATA, .select = BOARD_LINE_LOW("GPIO8"), .dc = BOARD_LINE("GPIO25"),                        \
             .backlight = BOARD_LINE("GPIO22")},                                                                       \
    .buttons = {{HAL_BUTTON_UP, BOARD_LINE_LOW("GPIO23")}, {HAL_BUTTON_DOWN, BOARD_LINE_LOW("GPIO24")}},               \
    .button_count = 2

#endif
