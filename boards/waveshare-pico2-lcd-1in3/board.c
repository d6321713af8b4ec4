#include "families/pico.h"

const struct board board_waveshare_pico2_lcd_1in3 = {
    .name = "waveshare-pico2-lcd-1in3",
    .title = "Raspberry Pi Pico 2 with Waveshare Pico-LCD-1.3, 240x240",
    PICO_WAVESHARE_1IN3,
    .band_height = 16,
    BUDGET_RP2350,
};
