#include "families/sim.h"

const struct board board_sim_ssd1306_128x32 = {
    .name = "sim-ssd1306-128x32",
    .title = "no kit: SSD1306, 128x32, one bit a pixel",
    .panel = &panel_ssd1306_128x32,
    .spi_hz = 10000000,
    SIM_ONE_BIT,
};
