/*
 * Pinout: https://pinout.xyz
 * An ST7789 module on seven wires and ground: header pins 23 (clock), 19 (data), 24 (select), 22 (D/C), 13 (reset),
 * 18 (backlight). The clock is one that wires of 10 cm bear. Lines are named as on a Raspberry Pi; kernels of other
 * boards name theirs otherwise, see `gpioinfo`: pinhole-panel takes each line on its command line.
 */
#include "boards.h"

const struct board board_sbc_generic = {
    .name = "sbc-generic",
    .title = "Any board with a 40-pin header and an ST7789 module on wires, 240x240",
    .pinout = "https://pinout.xyz",
    .panel = &panel_st7789_240x240,
    .rotation = PANEL_R0,
    .format = PANEL_RGB565,
    .gpio_labels = RPI_GPIO_LABELS,
    .spi_hz = 20000000,
    .pins =
        {
            .clock = BOARD_LINE("GPIO11"),
            .data = BOARD_LINE("GPIO10"),
            .select = BOARD_LINE_LOW("GPIO8"),
            .dc = BOARD_LINE("GPIO25"),
            .reset = BOARD_LINE("GPIO27"),
            .backlight = BOARD_LINE("GPIO24"),
        },
    .band_height = 60,
    .ram_bytes = 16 * 1024 * 1024,
};
