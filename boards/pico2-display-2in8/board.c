#include "families/pico.h"

const struct board board_pico2_display_2in8 = {
    .name = "pico2-display-2in8",
    .title = "Raspberry Pi Pico 2 with Pimoroni Pico Display Pack 2.8, 320x240",
    PICO_DISPLAY_PACK_2("pico-display-pack-2-8"),
    .band_height = 16,
    BUDGET_RP2350,
};
