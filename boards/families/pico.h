/*
 * pico: display packs on a Raspberry Pi Pico or Pico 2, and boards with an RP2040 or RP2350 that are wired like one.
 *
 * Their controllers (ST7789, ST7735S, GC9A01, SH1107) take a bit at the rising edge of the clock, in SPI mode 0 as in
 * mode 3. In mode 3 these chips' SPI unit makes no pause after a word (hal/chips/spi_clock.h), which is 9 % more
 * frames/s.
 */
#ifndef FAMILIES_PICO_H
#define FAMILIES_PICO_H

#include "boards.h"

/* Pimoroni's packs: keys A, B, X, Y are up, down, left, right. The panel's reset follows the Pico's RUN. */
#define PICO_PIMORONI                                                                                                  \
    .spi_unit = BOARD_SPI_RP2, .spi_bus = 0, .spi_mode = 3,                                                            \
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

/* Waveshare's; the number of the backlight's pin differs, and OLEDs have none. */
#define PICO_WAVESHARE_SPI .spi_unit = BOARD_SPI_RP2, .spi_bus = 1, .spi_mode = 3
#define PICO_WAVESHARE_WIRES                                                                                           \
    .clock = BOARD_PIN(10), .data = BOARD_PIN(11), .select = BOARD_PIN_LOW(9), .dc = BOARD_PIN(8),                     \
    .reset = BOARD_PIN(12)
#define PICO_WAVESHARE(backlight_pin)                                                                                  \
    PICO_WAVESHARE_SPI, .pins = {PICO_WAVESHARE_WIRES, .backlight = BOARD_PIN(backlight_pin)}

#define PICO_WAVESHARE_JOYSTICK                                                                                        \
    .buttons = {{HAL_BUTTON_UP, BOARD_PIN_LOW(2)},                                                                     \
                {HAL_BUTTON_DOWN, BOARD_PIN_LOW(18)},                                                                  \
                {HAL_BUTTON_LEFT, BOARD_PIN_LOW(16)},                                                                  \
                {HAL_BUTTON_RIGHT, BOARD_PIN_LOW(20)},                                                                 \
                {HAL_BUTTON_SELECT, BOARD_PIN_LOW(3)}},                                                                \
    .button_count = 5

/*
 * A pack or a panel with all that does not depend on the chip. The rotation bytes are the makers'; their bit 10h is the
 * refresh order.
 */

/* 70h by pimoroni-pico's st7789.cpp at ROTATE_0. */
#define PICO_DISPLAY_PACK                                                                                              \
    .pinout = "https://shop.pimoroni.com/products/pico-display-pack", .panel = &panel_st7789_135x240,                  \
    .rotation = PANEL_R90, .format = PANEL_RGB565, .spi_hz = 62500000, .band_buffers = 5, PICO_PIMORONI

/* 2.0 and 2.8, whose glass alone differs in size. */
#define PICO_DISPLAY_PACK_2(page)                                                                                      \
    .pinout = "https://shop.pimoroni.com/products/" page, .panel = &panel_st7789_240x320, .rotation = PANEL_R90,       \
    .format = PANEL_RGB565, .spi_hz = 62500000, .band_buffers = 3, PICO_PIMORONI

/* 70h by Waveshare's LCD_1in3.c, HORIZONTAL. */
#define PICO_WAVESHARE_1IN3                                                                                            \
    .pinout = "https://www.waveshare.com/wiki/Pico-LCD-1.3", .panel = &panel_st7789_240x240, .rotation = PANEL_R90,    \
    .format = PANEL_RGB565, .spi_hz = 62500000, .band_buffers = 5, PICO_WAVESHARE(13), PICO_WAVESHARE_JOYSTICK

/* A8h by Waveshare's Pico-LCD-0.96.py. */
#define PICO_GLASS_0IN96                                                                                               \
    .panel = &panel_st7735s_80x160, .rotation = PANEL_R270, .format = PANEL_RGB565, .spi_hz = 10000000,                \
    .band_buffers = 5

#define PICO_WAVESHARE_0IN96                                                                                           \
    .pinout = "https://www.waveshare.com/wiki/Pico-LCD-0.96", PICO_GLASS_0IN96, PICO_WAVESHARE(13),                    \
    PICO_WAVESHARE_JOYSTICK

/* NOLINTBEGIN(bugprone-macro-parentheses): `page` is an initializer */
/* 08h after B6h 20h (columns reversed) by Waveshare's LCD_1in28.c. No buttons. */
#define PICO_WAVESHARE_1IN28(page)                                                                                     \
    .pinout = page, .panel = &panel_gc9a01_240x240, .rotation = PANEL_R0, .format = PANEL_RGB565, .spi_hz = 62500000,  \
    .band_buffers = 5, PICO_WAVESHARE(25)
/* NOLINTEND(bugprone-macro-parentheses) */

#endif
