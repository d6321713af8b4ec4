/* For the simulator. */
#include "boards.h"

const struct board board_sim_ili9488 = {
    .name = "sim-ili9488",
    .title = "no kit: ILI9488, 480x320",
    .pinout = "none",
    .panel = &panel_ili9488_320x480,
    .rotation = PANEL_R90,
    .format = PANEL_RGB666,
    .spi_hz = 20000000,
    .pins =
        {
            .reset = BOARD_PIN(0),
            .backlight = BOARD_PIN(1),
        },
    .band_height = 60,
    .ram_bytes = 16 * 1024 * 1024,
};
