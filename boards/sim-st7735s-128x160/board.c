/* For the simulator. */
#include "boards.h"

const struct board board_sim_st7735s_128x160 = {
    .name = "sim-st7735s-128x160",
    .title = "no kit: ST7735S, 128x160",
    .pinout = "none",
    .panel = &panel_st7735s_128x160,
    .rotation = PANEL_R0,
    .format = PANEL_RGB565,
    .spi_hz = 15000000,
    .pins =
        {
            .reset = BOARD_PIN(0),
            .backlight = BOARD_PIN(1),
        },
    .band_height = 60,
    .ram_bytes = 16 * 1024 * 1024,
};
