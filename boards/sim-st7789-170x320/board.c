/* For the simulator. */
#include "boards.h"

const struct board board_sim_st7789_170x320 = {
    .name = "sim-st7789-170x320",
    .title = "no kit: ST7789, 320x170",
    .pinout = "none",
    .panel = &panel_st7789_170x320,
    .rotation = PANEL_R90,
    .format = PANEL_RGB565,
    .spi_hz = 62500000,
    .pins =
        {
            .reset = BOARD_PIN(0),
            .backlight = BOARD_PIN(1),
        },
    .band_height = 60,
    .ram_bytes = 16 * 1024 * 1024,
};
