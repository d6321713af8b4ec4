#include "families/sim.h"

const struct board board_sim_ssd1309_128x64 = {
    .name = "sim-ssd1309-128x64",
    .title = "no kit: SSD1309, 128x64, one bit a pixel",
    .panel = &panel_ssd1309_128x64,
    .spi_hz = 10000000,
    SIM_ONE_BIT,
};
