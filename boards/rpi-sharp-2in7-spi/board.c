/*
 * Adafruit's breakout 4694 on wires: VIN at 5 V, GND, CLK, DI, CS, DISP, and EMD at GND. CS is SCS, which is high while
 * the panel listens: it is the line of D/C here, see hal/panel/panel_line.h. The chip select that spidev moves (GPIO8)
 * stays open.
 */
#include "families/rpi.h"

const struct board board_rpi_sharp_2in7_spi = {
    .name = "rpi-sharp-2in7-spi",
    .title = "Raspberry Pi with Adafruit's 2.7\" memory LCD, 400x240, one bit a pixel",
    .pinout = "https://learn.adafruit.com/adafruit-sharp-memory-display-breakout",
    .panel = &panel_ls027b7dh01_400x240,
    .rotation = PANEL_R0,
    .format = PANEL_MONO_DITHER,
    .spi_hz = 2000000,
    .pins = {RPI_CLOCK_AND_DATA, .dc = BOARD_LINE("GPIO25"), .backlight = BOARD_LINE("GPIO24")},
    RPI_HEADER,
};
