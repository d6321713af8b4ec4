/*
 * pico: display packs on a Raspberry Pi Pico, and boards with an RP2040 that are wired like one.
 *
 * Their controllers (ST7789, ST7735S, GC9A01) take a bit at the rising edge of the clock, in SPI mode 0 as in mode 3.
 * In mode 3 the RP2040's SPI unit makes no pause after a word (hal/spi_clock.h), which is 9 % more frames/s.
 */
#ifndef FAMILIES_PICO_H
#define FAMILIES_PICO_H

#include "boards.h"

/* Pimoroni's packs: keys A, B, X, Y are up, down, left, right. The panel's reset follows the Pico's RUN. */
#define PICO_PIMORONI                                                                                                  \
    .spi_unit = BOARD_SPI_RP2040, .spi_bus = 0, .spi_mode = 3,                                                         \
    .pins = {.clock = BOARD_PIN(18),                                                                                   \
             .data = BOARD_PIN(19),                                                                                    \
             .select = BOARD_PIN_LOW(17),                                                                              \
             .dc = BOARD_PIN(16),                                                                                      \
             .backlight = BOARD_PIN(20)},                                                                              \
    .buttons = {{HAL_BUTTON_UP, BOARD_PIN_LOW(12)},                                                                    \
                {HAL_BUTTON_DOWN, BOARD_PIN_LOW(13)},                                                                  \
                {HAL_BUTTON_LEFT, BOARD_PIN_LOW(14)},                                                                  \
                {HAL_BUTTON_RIGHT, BOARD_PIN_LOW(15)}},                                                                \
    .button_count = 4

/* Waveshare's; the number of the backlight's pin differs. */
#define PICO_WAVESHARE(backlight_pin)                                                                                  \
    .spi_unit = BOARD_SPI_RP2040, .spi_bus = 1, .spi_mode = 3,                                                         \
    .pins = {.clock = BOARD_PIN(10),                                                                                   \
             .data = BOARD_PIN(11),                                                                                    \
             .select = BOARD_PIN_LOW(9),                                                                               \
             .dc = BOARD_PIN(8),                                                                                       \
             .reset = BOARD_PIN(12),                                                                                   \
             .backlight = BOARD_PIN(backlight_pin)}

#define PICO_WAVESHARE_JOYSTICK                                                                                        \
    .buttons = {{HAL_BUTTON_UP, BOARD_PIN_LOW(2)},                                                                     \
                {HAL_BUTTON_DOWN, BOARD_PIN_LOW(18)},                                                                  \
                {HAL_BUTTON_LEFT, BOARD_PIN_LOW(16)},                                                                  \
                {HAL_BUTTON_RIGHT, BOARD_PIN_LOW(20)},                                                                 \
                {HAL_BUTTON_SELECT, BOARD_PIN_LOW(3)}},                                                                \
    .button_count = 5

#endif
