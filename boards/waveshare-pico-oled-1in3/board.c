/*
 * The module as it is sold: its resistors select SPI. A0h and C0h by Waveshare's Pico-OLED-1.3.py, which writes the
 * picture's first line to the last column; PANEL_R90 writes it to the first one, with C8h. KEY0 and KEY1 are up and
 * down.
 */
#include "families/pico.h"

const struct board board_waveshare_pico_oled_1in3 = {
    .name = "waveshare-pico-oled-1in3",
    .title = "Raspberry Pi Pico with Waveshare Pico-OLED-1.3, 128x64, one bit a pixel",
    .pinout = "https://www.waveshare.com/wiki/Pico-OLED-1.3",
    .panel = &panel_sh1107_64x128,
    .rotation = PANEL_R90,
    .format = PANEL_MONO_DITHER,
    PICO_WAVESHARE_SPI,
    .spi_hz = 4000000,
    .pins = {PICO_WAVESHARE_WIRES},
    .buttons = {{HAL_BUTTON_UP, BOARD_PIN_LOW(15)}, {HAL_BUTTON_DOWN, BOARD_PIN_LOW(17)}},
    .button_count = 2,
    .band_height = 16,
    BUDGET_RP2040,
};
