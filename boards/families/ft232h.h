/* ft232h: a display module behind an FT232H breakout. The module's backlight is on by default. */
#ifndef FAMILIES_FT232H_H
#define FAMILIES_FT232H_H

#include "boards.h"

#define FT232H_BREAKOUT                                                                                                \
    .pinout = "https://learn.adafruit.com/adafruit-ft232h-breakout/pinouts", .spi_hz = 30000000,                       \
    .pins = {.clock = BOARD_LINE("AD0"),                                                                               \
             .data = BOARD_LINE("AD1"),                                                                                \
             .data_in = BOARD_LINE("AD2"),                                                                             \
             .select = BOARD_LINE_LOW("AD3"),                                                                          \
             .dc = BOARD_LINE("AC0"),                                                                                  \
             .reset = BOARD_LINE("AC1")},                                                                              \
    .band_height = 60, .scene_bytes = 16 * 1024 * 1024

#endif
