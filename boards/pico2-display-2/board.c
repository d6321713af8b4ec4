#include "families/pico.h"

const struct board board_pico2_display_2 = {
    .name = "pico2-display-2",
    .title = "Raspberry Pi Pico 2 with Pimoroni Pico Display Pack 2.0, 320x240",
    PICO_DISPLAY_PACK_2("pico-display-pack-2-0"),
    .band_height = 16,
    BUDGET_RP2350,
};
