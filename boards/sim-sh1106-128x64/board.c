#include "families/sim.h"

const struct board board_sim_sh1106_128x64 = {
    .name = "sim-sh1106-128x64",
    .title = "no kit: SH1106, 128x64, one bit a pixel",
    .panel = &panel_sh1106_128x64,
    .spi_hz = 4000000,
    SIM_ONE_BIT,
};
