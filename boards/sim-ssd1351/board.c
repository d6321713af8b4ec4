/* For the simulator. */
#include "boards.h"

const struct board board_sim_ssd1351 = {
    .name = "sim-ssd1351",
    .title = "no kit: SSD1351, 128x128",
    .pinout = "none",
    .panel = &panel_ssd1351_128x128,
    .rotation = PANEL_R0,
    .format = PANEL_RGB565,
    .spi_hz = 20000000,
    .pins =
        {
            .reset = BOARD_PIN(0),
        },
    .band_height = 60,
    .ram_bytes = 16 * 1024 * 1024,
};
