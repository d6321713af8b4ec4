/*
 * A module with seven pins (GND, VCC, D0, D1, RES, DC, CS) and four wires of SPI. A1h and C8h are those of Adafruit's
 * adafruit_ssd1306.py. Modules whose resistors are set for I2C: pico-oled-0in96-i2c.
 */
#include "boards.h"

const struct board board_pico_oled_0in96_spi = {
    .name = "pico-oled-0in96-spi",
    .title = "Raspberry Pi Pico with a 0.96\" OLED on SPI wires, 128x64, one bit a pixel",
    .pinout = "https://learn.adafruit.com/monochrome-oled-breakouts",
    .panel = &panel_ssd1306_128x64,
    .rotation = PANEL_R0,
    .format = PANEL_MONO_DITHER,
    .spi_unit = BOARD_SPI_RP2,
    .spi_mode = 3, /* no pause after a word, see families/pico.h; bits are taken at the rising edge in 0 and 3 */
    .spi_hz = 10000000,
    .pins = {.clock = BOARD_PIN(18),
             .data = BOARD_PIN(19),
             .select = BOARD_PIN_LOW(17),
             .dc = BOARD_PIN(16),
             .reset = BOARD_PIN(20)},
    .band_height = 16,
    BUDGET_RP2040,
};
