#include "families/sim.h"

const struct board board_sim_ili9488 = {
    .name = "sim-ili9488",
    .title = "no kit: ILI9488, 480x320",
    .panel = &panel_ili9488_320x480,
    .rotation = PANEL_R90,
    .format = PANEL_RGB666,
    .spi_hz = 20000000,
    SIM_BOARD,
    SIM_PINS,
};
