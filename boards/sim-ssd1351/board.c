#include "families/sim.h"

const struct board board_sim_ssd1351 = {
    .name = "sim-ssd1351",
    .title = "no kit: SSD1351, 128x128",
    .panel = &panel_ssd1351_128x128,
    .rotation = PANEL_R0,
    .format = PANEL_RGB565,
    .spi_hz = 20000000,
    SIM_BOARD,
    .pins = {.reset = BOARD_PIN(0)},
};
