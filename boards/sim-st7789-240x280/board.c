#include "families/sim.h"

const struct board board_sim_st7789_240x280 = {
    .name = "sim-st7789-240x280",
    .title = "no kit: ST7789, 240x280",
    .panel = &panel_st7789_240x280,
    .rotation = PANEL_R0,
    .format = PANEL_RGB565,
    .spi_hz = 62500000,
    SIM_BOARD,
    SIM_PINS,
};
