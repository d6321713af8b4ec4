#include "families/sim.h"

const struct board board_sim_st7789_172x320 = {
    .name = "sim-st7789-172x320",
    .title = "no kit: ST7789, 320x172",
    .panel = &panel_st7789_172x320,
    .rotation = PANEL_R90,
    .format = PANEL_RGB565,
    .spi_hz = 62500000,
    SIM_BOARD,
    SIM_PINS,
};
