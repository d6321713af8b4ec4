/* sim: panels without a kit, for the simulator. A pin's number means nothing there. */
#ifndef FAMILIES_SIM_H
#define FAMILIES_SIM_H

#include "boards.h"

#define SIM_ANY   .pinout = "none", .scene_bytes = 16 * 1024 * 1024
#define SIM_BOARD SIM_ANY, .band_height = 60

/* One bit a pixel: OLEDs, some of which have only 32 lines. */
#define SIM_ONE_BIT                                                                                                    \
    SIM_ANY, .rotation = PANEL_R0, .format = PANEL_MONO_DITHER, .band_height = 32, .pins = {.reset = BOARD_PIN(0)}

#define SIM_PINS .pins = {.reset = BOARD_PIN(0), .backlight = BOARD_PIN(1)}

#endif
