/*
 * Adafruit's breakout 4694 with seven wires: VIN at 5 V (VBUS), GND, CLK, DI, CS, DISP, and EMD at GND, so that VCOM
 * is toggled by the messages; EIN stays open. CS is SCS, which is high while the panel listens: it is D/C here, see
 * hal/panel/panel_line.h.
 */
#include "boards.h"

const struct board board_pico_sharp_2in7_spi = {
    .name = "pico-sharp-2in7-spi",
    .title = "Raspberry Pi Pico with Adafruit's 2.7\" memory LCD, 400x240, one bit a pixel",
    .pinout = "https://learn.adafruit.com/adafruit-sharp-memory-display-breakout",
    .panel = &panel_ls027b7dh01_400x240,
    .rotation = PANEL_R0,
    .format = PANEL_MONO_DITHER,
    .spi_unit = BOARD_SPI_RP2,
    .spi_mode = 0,
    .spi_hz = 2000000,
    .pins = {.clock = BOARD_PIN(18), .data = BOARD_PIN(19), .dc = BOARD_PIN(17), .backlight = BOARD_PIN(20)},
    .band_height = 8,
    BUDGET_RP2040,
};
