/* sim: panels without a kit, for the simulator. A pin's number means nothing there. */
#ifndef FAMILIES_SIM_H
#define FAMILIES_SIM_H

#include "boards.h"

#define SIM_BOARD .pinout = "none", .band_height = 60, .scene_bytes = 16 * 1024 * 1024

#define SIM_PINS .pins = {.reset = BOARD_PIN(0), .backlight = BOARD_PIN(1)}

#endif
