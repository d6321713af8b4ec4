/*
 * Pins: pico-sdk, boards/waveshare_rp2350_lcd_0.96.h. No buttons. The rotation is that of the Pico-LCD-0.96; nobody has
 * confirmed it here.
 */
#include "families/pico.h"

const struct board board_waveshare_rp2350_lcd_0in96 = {
    .name = "waveshare-rp2350-lcd-0in96",
    .title = "Waveshare RP2350-LCD-0.96, 160x80",
    .pinout = "https://www.waveshare.com/wiki/RP2350-LCD-0.96",
    PICO_WAVESHARE(25),
    PICO_GLASS_0IN96,
    .band_height = 16,
    BUDGET_RP2350,
};
