/* Wired as the RP2040-LCD-1.28: pico-sdk, boards/waveshare_rp2350_lcd_1.28.h. */
#include "families/pico.h"

const struct board board_waveshare_rp2350_lcd_1in28 = {
    .name = "waveshare-rp2350-lcd-1in28",
    .title = "Waveshare RP2350-LCD-1.28, round, 240x240",
    PICO_WAVESHARE_1IN28("https://www.waveshare.com/wiki/RP2350-LCD-1.28"),
    .band_height = 16,
    BUDGET_RP2350,
};
