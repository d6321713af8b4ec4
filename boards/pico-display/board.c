#include "families/pico.h"

const struct board board_pico_display = {
    .name = "pico-display",
    .title = "Raspberry Pi Pico with Pimoroni Pico Display Pack, 1.14\", 240x135",
    PICO_DISPLAY_PACK,
    .band_height = 16,
    BUDGET_RP2040,
};
