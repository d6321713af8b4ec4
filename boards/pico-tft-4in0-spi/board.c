/*
 * A red module of 4.0" (MSP4020, with touch MSP4021) on wires; those of 3.5" (MSP3525, MSP3526) are wired alike. Its
 * pins are VCC, GND, CS, RESET, DC/RS, SDI, SCK, LED. 28h is TFT_eSPI's for its rotation 1.
 */
#include "boards.h"

const struct board board_pico_tft_4in0_spi = {
    .name = "pico-tft-4in0-spi",
    .title = "Raspberry Pi Pico with a 4.0\" ST7796 module on SPI wires, 480x320",
    .pinout = "https://www.lcdwiki.com/4.0inch_SPI_Module_ST7796",
    .panel = &panel_st7796s_320x480,
    .rotation = PANEL_R90,
    .format = PANEL_RGB565,
    .spi_unit = BOARD_SPI_RP2,
    .spi_mode = 3, /* no pause after a word, see families/pico.h; bits are taken at the rising edge in 0 and 3 */
    .spi_hz = 31250000,
    .over_limit = true, /* the datasheet's 15 MHz are 6 frames a second; TFT_eSPI sets 27 to 40 MHz for these modules */
    .pins = {.clock = BOARD_PIN(18),
             .data = BOARD_PIN(19),
             .select = BOARD_PIN_LOW(17),
             .dc = BOARD_PIN(16),
             .reset = BOARD_PIN(20),
             .backlight = BOARD_PIN(21)},
    .band_buffers = 3,
    .band_height = 8,
    BUDGET_RP2040,
};
