#include "families/pico.h"

const struct board board_pico2_display = {
    .name = "pico2-display",
    .title = "Raspberry Pi Pico 2 with Pimoroni Pico Display Pack, 1.14\", 240x135",
    PICO_DISPLAY_PACK,
    .band_height = 16,
    BUDGET_RP2350,
};
