/*
 * Panels with OLED controllers of one bit a pixel, whose memory consists of pages: SSD1306 (Solomon Systech, rev. 1.1),
 * SSD1309 (Solomon Systech, rev. 1.1), SH1106 (Sino Wealth, V2.3) and SH1107 (Sino Wealth, V2.1). All are addressed
 * page by page, which is the only way of the SH1106. Modules of the first three are upright with columns and lines from
 * the last one (A1h, C8h).
 *
 * The memory of an SH1107 lies across: its columns belong to COM lines and the rows of its pages to segments. So C0h
 * and C8h mirror columns, A0h and A1h mirror rows, and multiplex ratio, offset and start line count columns.
 */
#include "panels.h"

static const uint8_t page_on[] = {0xAF, 0};
static const uint8_t page_off[] = {0xAE, 0};

#define PAGE_COMMANDS                                                                                                  \
    .init_hz = 1000000, .reset_low_us = 100, .reset_high_us = 10000, .column_pixels = 1, .set_page = 0xB0,             \
    .invert = {0xA6, 0xA7}, .parameters_are_commands = true, .on = page_on, .on_bytes = sizeof page_on,                \
    .off = page_off, .off_bytes = sizeof page_off

#define COLUMNS_ARE_SEGMENTS .set_rotation = 0xA0, .rotation_bit_mx = 0x01, .set_scan = 0xC0, .rotation_bit_my = 0x08
#define COLUMNS_ARE_LINES    .set_rotation = 0xC0, .rotation_bit_mx = 0x08, .set_scan = 0xA0, .rotation_bit_my = 0x01

static const struct panel_controller ssd1306 = {
    .name = "SSD1306",
    .write_hz = 10000000, /* 13, table 13-4: tcycle 100 ns */
    PAGE_COMMANDS,
    COLUMNS_ARE_SEGMENTS,
};

static const struct panel_controller ssd1309 = {
    .name = "SSD1309",
    .write_hz = 10000000, /* AC characteristics, 4-wire serial: tcycle 100 ns */
    PAGE_COMMANDS,
    COLUMNS_ARE_SEGMENTS,
};

static const struct panel_controller sh1106 = {
    .name = "SH1106",
    .write_hz = 4000000, /* AC characteristics, serial, VDD1 2.4 .. 3.5 V: tSCYC 250 ns */
    PAGE_COMMANDS,
    COLUMNS_ARE_SEGMENTS,
};

static const struct panel_controller sh1107 = {
    .name = "SH1107",
    .write_hz = 4000000, /* AC characteristics, serial, VDD 2.4 .. 3.5 V: tSCYC 250 ns */
    PAGE_COMMANDS,
    COLUMNS_ARE_LINES,
};

/* What all glasses share; sections of the SSD1306's datasheet. */
#define PAGE_COMMON(lines, pins)                                                                                       \
    0xAE, 0,                /* 10.1.12 sleep */                                                                        \
        0xD5, 1, 0x80,      /* 10.1.16 clock, as after reset */                                                        \
        0xA8, 1, (lines)-1, /* 10.1.11 multiplex ratio */                                                              \
        0xD3, 1, 0x00,      /* 10.1.15 offset */                                                                       \
        0x40, 0,            /* 10.1.6 start line */                                                                    \
        0xDA, 1, (pins),    /* 10.1.18 COM pins: 12h alternating, 02h in order */                                      \
        0xA4, 0, 0xA6, 0    /* 10.1.9, 10.1.10 memory is shown, not inverted */

#define SSD1306_COMMON(lines, pins)                                                                                    \
    PAGE_COMMON(lines, pins), 0x20, 1, 0x02, /* 10.1.3 addressing by pages */                                          \
        0x8D, 1, 0x14,                       /* application note: charge pump on */                                    \
        0xD9, 1, 0xF1,                       /* 10.1.17 pre-charge: 15 and 1 clocks */                                 \
        0xDB, 1, 0x20,                       /* 10.1.19 VCOMH 0.77 VCC */                                              \
        0x2E, 0                              /* 10.2.3 scrolling off */

static const uint8_t ssd1306_init_64[] = {SSD1306_COMMON(64, 0x12), 0x81, 1, 0xCF}; /* 10.1.7 contrast */
static const uint8_t ssd1306_init_32[] = {SSD1306_COMMON(32, 0x02), 0x81, 1, 0x8F};
static const uint8_t ssd1306_init_40[] = {SSD1306_COMMON(40, 0x12), 0x81, 1, 0xCF, 0xAD, 1, 0x30}; /* SSD1306B: IREF */

/* 10.1.22 unlock; by pages; contrast; pre-charge: 5 and 2 clocks; VCOMH 0.78 VCC; scrolling off */
static const uint8_t ssd1309_init[] = {
    0xFD, 1, 0x12, PAGE_COMMON(64, 0x12), 0x20, 1, 0x02, 0x81, 1, 0x6F, 0xD9, 1, 0x25, 0xDB, 1, 0x34, 0x2E, 0};

/* DC-DC converter on, 8 V; contrast, as after reset; dis-charge 15, pre-charge 1 clocks; VCOM deselect 0.77 VREF */
static const uint8_t sh1106_init[] = {
    PAGE_COMMON(64, 0x12), 0xAD, 1, 0x8B, 0x32, 0, 0x81, 1, 0x80, 0xD9, 1, 0x1F, 0xDB, 1, 0x40};

/*
 * Numbers are those of the data sheet's list of commands. The glass of 64 columns is bonded to COM32 .. 95. Makers scan
 * 64 lines and move them there (A8h 3Fh, D3h 60h), which fits C0h alone: with C8h it takes 20h. Here all 128 are
 * scanned, as other drivers do, so that one sequence fits both; a dot is then lit half as long. Supply, contrast,
 * pre-charge and VCOM are those of Waveshare's Pico-OLED-1.3.py.
 */
static const uint8_t sh1107_init[] = {
    0xAE, 0,       /* 11: sleep */
    0xD5, 1, 0x50, /* 14: clock, as after reset */
    0xA8, 1, 0x7F, /* 6: multiplex ratio */
    0xD3, 1, 0x00, /* 9: offset */
    0xDC, 1, 0x00, /* 17: start line */
    0x20, 0,       /* 3: addressing by pages */
    0xA4, 0,       /* 7: memory is shown */
    0xA6, 0,       /* 8: not inverted */
    0xAD, 1, 0x8A, /* 10: DC-DC converter off, the module has its own */
    0x81, 1, 0x6F, /* 4: contrast */
    0xD9, 1, 0x22, /* 15: dis-charge and pre-charge 2 clocks, as after reset */
    0xDB, 1, 0x35, /* 16: VCOM deselect 0.77 VREF, as after reset */
};

#define PAGE_PANEL(n, of, w, h, columns, left, base, table)                                                            \
    {                                                                                                                  \
        .name = (n), .controller = (of), .width = (w), .height = (h), .ram_width = (columns), .ram_height = (h),       \
        .x0 = (left), .rotation_base = (base),                                                                         \
        .formats = PANEL_FORMAT_BIT(PANEL_MONO_DITHER) | PANEL_FORMAT_BIT(PANEL_MONO_THRESHOLD), .init = (table),      \
        .init_bytes = sizeof(table)                                                                                    \
    }

const struct panel panel_ssd1306_128x64 =
    PAGE_PANEL("ssd1306-128x64", &ssd1306, 128, 64, 128, 0, 0x09, ssd1306_init_64);
const struct panel panel_ssd1306_128x32 =
    PAGE_PANEL("ssd1306-128x32", &ssd1306, 128, 32, 128, 0, 0x09, ssd1306_init_32);
const struct panel panel_ssd1306_72x40 = PAGE_PANEL("ssd1306-72x40", &ssd1306, 72, 40, 128, 28, 0x09, ssd1306_init_40);
const struct panel panel_ssd1309_128x64 = PAGE_PANEL("ssd1309-128x64", &ssd1309, 128, 64, 128, 0, 0x09, ssd1309_init);
const struct panel panel_sh1106_128x64 = PAGE_PANEL("sh1106-128x64", &sh1106, 128, 64, 132, 2, 0x09, sh1106_init);
const struct panel panel_sh1107_64x128 = PAGE_PANEL("sh1107-64x128", &sh1107, 64, 128, 128, 32, 0x00, sh1107_init);
const struct panel panel_sh1107_128x128 = PAGE_PANEL("sh1107-128x128", &sh1107, 128, 128, 128, 0, 0x00, sh1107_init);
