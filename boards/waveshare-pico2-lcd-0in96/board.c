#include "families/pico.h"

const struct board board_waveshare_pico2_lcd_0in96 = {
    .name = "waveshare-pico2-lcd-0in96",
    .title = "Raspberry Pi Pico 2 with Waveshare Pico-LCD-0.96, 160x80",
    PICO_WAVESHARE_0IN96,
    .band_height = 16,
    BUDGET_RP2350,
};
