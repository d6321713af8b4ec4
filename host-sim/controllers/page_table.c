/*
 * See sim_table.h. OLED controllers with one bit a pixel, whose memory consists of pages. Commands that carry a number
 * in their own lowest bits (the page, the column's halves, the start line) stand here by the first of them; sim_page.c
 * knows how many follow. Everything may be written asleep and awake.
 */
#include "sim_rows.h"

/* What all four have; SSD1306 section 9, table 9-1. */
/* clang-format off */
#define COMMON                                                                                                         \
    {0x00, 0, 0, false, "column, low four bits", BARE},                                                                \
    {0x10, 0, 0, false, "column, high four bits", BARE},                                                               \
    {0x81, 1, 1, false, "contrast", FIELDS({1, 1, 0xFF, 0x00, 0xFF, SIM_VOLTAGE, "1 .. 256 steps of current"})},       \
    {0xA0, 0, 0, false, "segment re-map: columns from the first one", BARE},                                           \
    {0xA1, 0, 0, false, "segment re-map: columns from the last one", BARE},                                            \
    {0xA4, 0, 0, false, "memory is shown", BARE},                                                                      \
    {0xA5, 0, 0, false, "all on", BARE},                                                                               \
    {0xA6, 0, 0, false, "normal display", BARE},                                                                       \
    {0xA7, 0, 0, false, "inverse display", BARE},                                                                      \
    {0xAE, 0, 0, false, "sleep", BARE},                                                                                \
    {0xAF, 0, 0, false, "display on", BARE},                                                                           \
    {0xB0, 0, 0, false, "page", BARE},                                                                                 \
    {0xC0, 0, 0, false, "COM lines from the first one", BARE},                                                         \
    {0xC8, 0, 0, false, "COM lines from the last one", BARE},                                                          \
    {0xD5, 1, 1, false, "clock", FIELDS({1, 1, 0xFF, 0x00, 0xFF, SIM_TIMING, "A[3:0] divider, A[7:4] frequency"})},    \
    {0xD9, 1, 1, false, "pre-charge", FIELDS(                                                                          \
        {1, 1, 0x0F, 0x01, 0x0F, SIM_TIMING, "A[3:0]: phase 1; 0 is invalid"},                                         \
        {1, 1, 0xF0, 0x10, 0xF0, SIM_TIMING, "A[7:4]: phase 2; 0 is invalid"})},                                       \
    {0xE3, 0, 0, false, "no operation", BARE}

/* Controllers of 64 COM lines */
#define LINES_64                                                                                                       \
    {0x40, 0, 0, false, "start line", BARE},                                                                           \
    {0xA8, 1, 1, false, "multiplex ratio", FIELDS({1, 1, 0x3F, 0x0F, 0x3F, SIM_SHOWN, "lines less one, 16 .. 64"})},   \
    {0xD3, 1, 1, false, "display offset", FIELDS({1, 1, 0x3F, 0x00, 0x3F, SIM_SHOWN, "line of COM0"})}

/* SSD1306 and SSD1309 */
#define SOLOMON                                                                                                        \
    {0x20, 1, 1, false, "addressing mode", FIELDS({1, 1, 0x03, 0x02, 0x02, SIM_FIXED, "by pages; no other is followed"})}, \
    {0x2E, 0, 0, false, "scrolling off", BARE},                                                                        \
    {0xDA, 1, 1, false, "COM pins", FIELDS(                                                                            \
        {1, 1, 0x10, 0x00, 0x10, SIM_SHOWN, "A[4]: alternating sides"},                                                \
        {1, 1, 0x22, 0x02, 0x02, SIM_FIXED, "A[5]: sides not exchanged; A[1] is 1"})}

static const struct sim_command ssd1306[] = {
    COMMON,
    LINES_64,
    SOLOMON,
    {0x8D, 1, 1, false, "charge pump, application note", FIELDS(
        {1, 1, 0x04, 0x00, 0x04, SIM_SHOWN, "A[2]: on; the glass has no other supply"},
        {1, 1, 0x10, 0x10, 0x10, SIM_FIXED, "A[4] is 1"})},
    {0xAD, 1, 1, false, "reference current, SSD1306B", BYTES(0x30)}, /* from inside, 30 uA */
    {0xDB, 1, 1, false, "VCOMH", FIELDS({1, 1, 0x70, 0x00, 0x30, SIM_VOLTAGE, "0.65 .. 0.83 VCC"})},
};

static const struct sim_command ssd1309[] = {
    COMMON,
    LINES_64,
    SOLOMON,
    {0xDB, 1, 1, false, "VCOMH", FIELDS({1, 1, 0x3C, 0x00, 0x3C, SIM_VOLTAGE, "0.64 .. 0.84 VCC"})},
    {0xFD, 1, 1, false, "command lock", FIELDS( /* 12h unlocks, 16h locks all but this command */
        {1, 1, 0x04, 0x00, 0x04, SIM_SHOWN, "A[2]: locked"},
        {1, 1, 0x12, 0x12, 0x12, SIM_FIXED, "A[4] and A[1] are 1"})},
};

/* SH1106 V2.3, "commands": 132 columns, pages only. */
static const struct sim_command sh1106[] = {
    COMMON,
    LINES_64,
    {0x30, 0, 0, false, "pump voltage", BARE}, /* 30h .. 33h: 6.4, 7.4, 8, 9 V */
    {0xAD, 1, 1, false, "DC-DC converter", FIELDS(
        {1, 1, 0x01, 0x00, 0x01, SIM_SHOWN, "D0: on; the glass has no other supply"},
        {1, 1, 0xFE, 0x8A, 0x8A, SIM_FIXED, "D[7:1]"})},
    {0xDA, 1, 1, false, "COM pads", FIELDS(
        {1, 1, 0x10, 0x00, 0x10, SIM_SHOWN, "D4: alternating sides"},
        {1, 1, 0x02, 0x02, 0x02, SIM_FIXED, "D1 is 1"})},
    {0xDB, 1, 1, false, "VCOM deselect", FIELDS({1, 1, 0xFF, 0x00, 0xFF, SIM_VOLTAGE, "0.43 .. 1 VREF"})},
};

/* SH1107 V2.1, "commands": 128 columns, which are COM lines. It has neither 40h .. 7Fh nor DAh, and forbids what it does
 * not list. 21h, addressing down the pages, is not followed. */
static const struct sim_command sh1107[] = {
    COMMON,
    {0x20, 0, 0, false, "addressing by pages", BARE},
    {0xA8, 1, 1, false, "multiplex ratio", FIELDS({1, 1, 0x7F, 0x00, 0x7F, SIM_SHOWN, "lines less one, 1 .. 128"})},
    {0xAD, 1, 1, false, "DC-DC converter", FIELDS(
        {1, 1, 0x01, 0x00, 0x00, SIM_FIXED, "D: off; the modules here have a converter of their own"},
        {1, 1, 0x0E, 0x00, 0x0E, SIM_TIMING, "F[2:0]: its frequency"},
        {1, 1, 0xF0, 0x80, 0x80, SIM_FIXED, "D[7:4]"})},
    {0xD3, 1, 1, false, "display offset", FIELDS({1, 1, 0x7F, 0x00, 0x7F, SIM_SHOWN, "line of COM0"})},
    {0xDB, 1, 1, false, "VCOM deselect", FIELDS({1, 1, 0xFF, 0x00, 0xFF, SIM_VOLTAGE, "0.43 .. 1 VREF"})},
    {0xDC, 1, 1, false, "start line", FIELDS({1, 1, 0x7F, 0x00, 0x7F, SIM_SHOWN, "column of the first line"})},
};
/* clang-format on */

const struct sim_table sim_table_ssd1306 = {"SSD1306, Solomon Systech, rev. 1.1", LIST(ssd1306), 0, 0};
const struct sim_table sim_table_ssd1309 = {"SSD1309, Solomon Systech, rev. 1.1", LIST(ssd1309), 0, 0};
const struct sim_table sim_table_sh1106 = {"SH1106, Sino Wealth, V2.3", LIST(sh1106), 0, 0};
const struct sim_table sim_table_sh1107 = {"SH1107, Sino Wealth, V2.1", LIST(sh1107), 0, 0};
