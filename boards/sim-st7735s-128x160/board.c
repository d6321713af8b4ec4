#include "families/sim.h"

const struct board board_sim_st7735s_128x160 = {
    .name = "sim-st7735s-128x160",
    .title = "no kit: ST7735S, 128x160",
    .panel = &panel_st7735s_128x160,
    .rotation = PANEL_R0,
    .format = PANEL_RGB565,
    .spi_hz = 15000000,
    SIM_BOARD,
    SIM_PINS,
};
