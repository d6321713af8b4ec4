/*
 * This is the kit with the 128x64 panel, before revision C. Revision C has a 128x96 panel with another controller
 * (RITEK P14201), which this does not drive. The SD card shares the bus, so PD0 must be high. The panel is reset with
 * the CPU. QEMU's panel cannot be turned.
 */
#include "boards.h"

const struct board board_lm3s6965evb = {
    .name = "lm3s6965evb",
    .title = "Stellaris EK-LM3S6965 before revision C (and QEMU's), 128x64, 16 greys",
    .pinout = "https://www.ti.com/tool/EK-LM3S6965",
    .panel = &panel_ssd0323_128x64,
    .rotation = PANEL_R0, /* A0h 52h by Luminary's osram128x64x4.c */
    .format = PANEL_GREY4,
    .spi_unit = BOARD_SPI_LM3S6965,
    .spi_hz = 3500000,
    .pins =
        {
            .clock = BOARD_PIN(BOARD_PORT('A', 2)),
            .data = BOARD_PIN(BOARD_PORT('A', 5)),
            .select = BOARD_PIN_LOW(BOARD_PORT('A', 3)),
            .dc = BOARD_PIN(BOARD_PORT('C', 7)),
        },
    .buttons =
        {
            {HAL_BUTTON_UP, BOARD_PIN_LOW(BOARD_PORT('E', 0))},
            {HAL_BUTTON_DOWN, BOARD_PIN_LOW(BOARD_PORT('E', 1))},
            {HAL_BUTTON_LEFT, BOARD_PIN_LOW(BOARD_PORT('E', 2))},
            {HAL_BUTTON_RIGHT, BOARD_PIN_LOW(BOARD_PORT('E', 3))},
            {HAL_BUTTON_SELECT, BOARD_PIN_LOW(BOARD_PORT('F', 1))},
        },
    .button_count = 5,
    .band_height = 8,
    BUDGET_LM3S6965,
};
