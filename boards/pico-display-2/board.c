#include "families/pico.h"

const struct board board_pico_display_2 = {
    .name = "pico-display-2",
    .title = "Raspberry Pi Pico with Pimoroni Pico Display Pack 2.0, 320x240",
    PICO_DISPLAY_PACK_2("pico-display-pack-2-0"),
    .band_height = 16,
    BUDGET_RP2040,
};
