#include "families/sim.h"

const struct board board_sim_ssd1306_72x40 = {
    .name = "sim-ssd1306-72x40",
    .title = "no kit: SSD1306, 72x40, one bit a pixel",
    .panel = &panel_ssd1306_72x40,
    .spi_hz = 10000000,
    SIM_ONE_BIT,
};
