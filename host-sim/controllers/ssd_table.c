/*
 * See sim_table.h. OLED controllers of Solomon Systech. Everything may be written asleep and awake; what SSD1351's FDh
 * locks says so.
 *
 * SSD0323's voltages, phases, clocks and grey levels are taken as fixed bytes: those that Luminary Micro's DriverLib
 * sends to this glass (osram128x64x4.c, after OSRAM's application note AN018).
 */
#include "sim_rows.h"

/* clang-format off */
/* Commands of the SSD1351: datasheet, table 9-1 and 10.1. */
static const struct sim_command ssd1351[] = {
    {0x15, 2, 2, false, "column address 10.1.1", FIELDS(
        {1, 2, 0xFF, 0x00, 0xFF, SIM_SHOWN,   "first and last column; the model checks them"})},
    {0x75, 2, 2, false, "row address 10.1.2", FIELDS(
        {1, 2, 0xFF, 0x00, 0xFF, SIM_SHOWN,   "first and last row; the model checks them"})},
    {0x5C, SIM_PIXELS, SIM_PIXELS, false, "write RAM 10.1.3", BARE},
    {0xA0, 1, 1, false, "re-map 10.1.5", FIELDS(
        {1, 1, 0x01, 0x00, 0x01, SIM_SHOWN,   "A[0]: address counts rows first"},
        {1, 1, 0x02, 0x00, 0x02, SIM_SHOWN,   "A[1]: columns from the last one"},
        {1, 1, 0x04, 0x00, 0x04, SIM_SHOWN,   "A[2]: colours C B A"},
        {1, 1, 0x10, 0x00, 0x10, SIM_SHOWN,   "A[4]: COM lines from the last one"},
        {1, 1, 0x20, 0x00, 0x20, SIM_SHOWN,   "A[5]: COM lines split, even and odd"},
        {1, 1, 0xC0, 0x00, 0x80, SIM_SHOWN,   "A[7:6]: 65k or 262k colours"})},
    {0xA1, 1, 1, false, "start line 10.1.6", FIELDS(
        {1, 1, 0x7F, 0x00, 0x7F, SIM_SHOWN,   "row at the first line"})},
    {0xA2, 1, 1, true, "offset 10.1.7", FIELDS( /* 60h after reset */
        {1, 1, 0x7F, 0x00, 0x7F, SIM_SHOWN,   "line of the first row"})},
    {0xA4, 0, 0, false, "all off 10.1.8", BARE},
    {0xA5, 0, 0, false, "all on 10.1.8", BARE},
    {0xA6, 0, 0, false, "normal display 10.1.8", BARE},
    {0xA7, 0, 0, false, "inverse display 10.1.8", BARE},
    {0xAB, 1, 1, false, "function selection 10.1.9", FIELDS(
        {1, 1, 0x01, 0x01, 0x01, SIM_FIXED,   "A[0]: internal VDD; off for sleep only"},
        {1, 1, 0xC0, 0x00, 0x00, SIM_FIXED,   "A[7:6]: serial and 8-bit interface"})},
    {0xAE, 0, 0, false, "sleep 10.1.10", BARE},
    {0xAF, 0, 0, false, "display on 10.1.10", BARE},
    {0xB1, 1, 1, true, "phase length 10.1.11", FIELDS(
        {1, 1, 0x0F, 0x02, 0x0F, SIM_TIMING,  "A[3:0]: phase 1, 5 .. 31 clocks"},
        {1, 1, 0xF0, 0x30, 0xF0, SIM_TIMING,  "A[7:4]: phase 2, 3 .. 15 clocks"})},
    {0xB3, 1, 1, true, "clock 10.1.13", FIELDS(
        {1, 1, 0x0F, 0x00, 0x0A, SIM_TIMING,  "A[3:0]: divided by 1 .. 1024"},
        {1, 1, 0xF0, 0x00, 0xF0, SIM_TIMING,  "A[7:4]: frequency"})},
    {0xB4, 3, 3, false, "segment low voltage, table 9-1", FIELDS(
        {1, 1, 0xFF, 0xA0, 0xA0, SIM_FIXED,   "A0h: external VSL, the only valid one"},
        {2, 2, 0xFF, 0xB5, 0xB5, SIM_FIXED,   "B5h"},
        {3, 3, 0xFF, 0x55, 0x55, SIM_FIXED,   "55h"})},
    {0xB5, 1, 1, false, "GPIO 10.1.14", FIELDS(
        {1, 1, 0x0F, 0x00, 0x0F, SIM_UNUSED,  "pins GPIO0 and GPIO1"})},
    {0xB6, 1, 1, false, "second pre-charge 10.1.15", FIELDS(
        {1, 1, 0x0F, 0x01, 0x0F, SIM_TIMING,  "1 .. 15 clocks"})},
    {0xBB, 1, 1, true, "pre-charge voltage 10.1.18", FIELDS(
        {1, 1, 0x1F, 0x00, 0x1F, SIM_VOLTAGE, "0.2 .. 0.6 VCC"})},
    {0xBE, 1, 1, true, "VCOMH 10.1.19", FIELDS(
        {1, 1, 0x07, 0x00, 0x07, SIM_VOLTAGE, "0.72 .. 0.86 VCC"})},
    {0xC1, 3, 3, true, "contrast 10.1.20", FIELDS( /* the model shows a colour whose contrast is 0 as dark */
        {1, 3, 0xFF, 0x00, 0xFF, SIM_SHOWN,   "current of A, B, C"})},
    {0xC7, 1, 1, false, "master contrast 10.1.21", FIELDS(
        {1, 1, 0x0F, 0x00, 0x0F, SIM_VOLTAGE, "1/16 .. 16/16 of the current"})},
    {0xCA, 1, 1, false, "multiplex ratio 10.1.22", FIELDS(
        {1, 1, 0x7F, 0x0F, 0x7F, SIM_SHOWN,   "lines less one, 16 .. 128 lines"})},
    {0xFD, 1, 1, false, "command lock 10.1.23", FIELDS( /* 12h, 16h, B0h, B1h; see lock() in sim_ssd.c */
        {1, 1, 0xFF, 0x12, 0xB1, SIM_SHOWN,   "lock"})},
};

/* Commands of the SSD0323: datasheet, command table. */
static const struct sim_command ssd0323[] = {
    {0x15, 2, 2, false, "column address", FIELDS(
        {1, 2, 0xFF, 0x00, 0xFF, SIM_SHOWN,   "first and last pair of columns; the model checks them"})},
    {0x75, 2, 2, false, "row address", FIELDS(
        {1, 2, 0xFF, 0x00, 0xFF, SIM_SHOWN,   "first and last row; the model checks them"})},
    {0x81, 1, 1, false, "contrast", FIELDS( /* the model shows contrast 0 as dark */
        {1, 1, 0x7F, 0x00, 0x7F, SIM_SHOWN,   "current"})},
    {0x84, 0, 0, false, "quarter of the current", BARE},
    {0x85, 0, 0, false, "half of the current", BARE},
    {0x86, 0, 0, false, "full current", BARE},
    {0xA0, 1, 1, false, "re-map", FIELDS(
        {1, 1, 0x01, 0x00, 0x01, SIM_SHOWN,   "A[0]: columns from the last one"},
        {1, 1, 0x02, 0x00, 0x02, SIM_SHOWN,   "A[1]: left pixel in the high nibble"},
        {1, 1, 0x04, 0x00, 0x04, SIM_SHOWN,   "A[2]: address counts rows first"},
        {1, 1, 0x10, 0x00, 0x10, SIM_SHOWN,   "A[4]: COM lines from the last one"},
        {1, 1, 0x40, 0x00, 0x40, SIM_SHOWN,   "A[6]: COM lines split, even and odd"})},
    {0xA1, 1, 1, false, "start line", FIELDS(
        {1, 1, 0x7F, 0x00, 0x4F, SIM_SHOWN,   "row at the first line"})},
    {0xA2, 1, 1, false, "offset", FIELDS(
        {1, 1, 0x7F, 0x00, 0x4F, SIM_SHOWN,   "line of the first row"})},
    {0xA4, 0, 0, false, "normal display", BARE},
    {0xA5, 0, 0, false, "all on", BARE},
    {0xA6, 0, 0, false, "all off", BARE},
    {0xA7, 0, 0, false, "inverse display", BARE},
    {0xA8, 1, 1, false, "multiplex ratio", FIELDS(
        {1, 1, 0x7F, 0x0F, 0x4F, SIM_SHOWN,   "lines less one, 16 .. 80 lines"})},
    {0xAD, 1, 1, false, "master configuration", BYTES(0x03)}, /* DC-DC converter on */
    {0xAE, 0, 0, false, "sleep", BARE},
    {0xAF, 0, 0, false, "display on", BARE},
    {0xB1, 1, 1, false, "phase lengths", BYTES(0x22)},
    {0xB2, 1, 1, false, "row period", BYTES(0x46)},
    {0xB3, 1, 1, false, "clock", BYTES(0xF1)},
    {0xB8, 8, 8, false, "grey levels", BYTES(0x01, 0x11, 0x22, 0x32, 0x43, 0x54, 0x65, 0x76)},
    {0xBC, 1, 1, false, "pre-charge voltage", BYTES(0x10)},
    {0xBE, 1, 1, false, "VCOMH", BYTES(0x02)},
    {0xBF, 1, 1, false, "segment low voltage", BYTES(0x0D)},
    {0xE3, 0, 0, false, "no operation", BARE},
};
/* clang-format on */

const struct sim_table sim_table_ssd1351 = {"SSD1351, Solomon Systech, rev. 1.5", LIST(ssd1351), 0, 0};
const struct sim_table sim_table_ssd0323 = {"SSD0323, Solomon Systech, rev. 1.3", LIST(ssd0323), 0, 0};
