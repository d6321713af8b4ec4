#include "families/sim.h"

const struct board board_sim_sh1107_128x128 = {
    .name = "sim-sh1107-128x128",
    .title = "no kit: SH1107, 128x128, one bit a pixel",
    .panel = &panel_sh1107_128x128,
    .spi_hz = 4000000,
    SIM_ONE_BIT,
};
