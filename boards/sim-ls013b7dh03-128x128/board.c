#include "families/sim.h"

const struct board board_sim_ls013b7dh03_128x128 = {
    .name = "sim-ls013b7dh03-128x128",
    .title = "no kit: LS013B7DH03, a memory LCD, 128x128, one bit a pixel",
    .panel = &panel_ls013b7dh03_128x128,
    .format = PANEL_MONO_DITHER,
    .spi_hz = 1100000,
    .band_height = 32,
    SIM_ANY,
    SIM_PINS,
};
