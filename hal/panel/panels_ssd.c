/*
 * Panels with OLED controllers of Solomon Systech: SSD1351 (datasheet rev. 1.5) and SSD0323 (rev. 1.3). Neither has a
 * software reset: their kits wire the reset line.
 */
#include "panels.h"

/* SSD1351 and SSD0323: AFh turns the display on, AEh puts it to sleep. */
static const uint8_t ssd_on[] = {0xAF, 0};
static const uint8_t ssd_off[] = {0xAE, 0};

static const struct panel_controller ssd1351 = {
    .name = "SSD1351",
    .init_hz = 4000000,
    .write_hz = 20000000,   /* 13, table 13-4: tcycle 50 ns */
    .reset_low_us = 100,    /* 8.9: 2 us */
    .reset_high_us = 10000, /* 8.9: 2 us; modules with a slow supply need more */
    .set_column = 0x15,     /* 10.1.1 */
    .set_row = 0x75,        /* 10.1.2 */
    .memory_write = 0x5C,   /* 10.1.3 */
    .address_bytes = 1,
    .column_pixels = 1,
    .set_rotation = 0xA0, /* 10.1.5 */
    .rotation_bit_mx = 0x02,
    .rotation_bit_my = 0x10,
    .rotation_bit_mv = 0x01,
    .rotation_bit_bgr = 0x04,
    .invert = {0xA6, 0xA7}, /* 10.1.8 */
    .on = ssd_on,
    .on_bytes = sizeof ssd_on,
    .off = ssd_off,
    .off_bytes = sizeof ssd_off,
};

static const uint8_t ssd1351_init[] = {
    0xFD, 1, 0x12,             /* 10.1.23 unlock */
    0xFD, 1, 0xB1,             /* 10.1.23 unlock A2h, B1h, B3h, BBh, BEh, C1h */
    0xAE, 0,                   /* 10.1.10 sleep */
    0xB3, 1, 0xF1,             /* 10.1.13 clock: fastest, divided by 2 */
    0xCA, 1, 0x7F,             /* 10.1.22 128 lines */
    0xA1, 1, 0x00,             /* 10.1.6 start line */
    0xA2, 1, 0x00,             /* 10.1.7 offset */
    0xB5, 1, 0x00,             /* 10.1.14 GPIO off */
    0xAB, 1, 0x01,             /* 10.1.9 internal VDD regulator */
    0xB1, 1, 0x32,             /* 10.1.11 phases: 5 and 3 clocks */
    0xB4, 3, 0xA0, 0xB5, 0x55, /* 9, table 9-1: external VSL */
    0xBB, 1, 0x17,             /* 10.1.18 precharge 0.5 VCC */
    0xBE, 1, 0x05,             /* 10.1.19 VCOMH 0.82 VCC */
    0xC1, 3, 0xC8, 0x80, 0xC8, /* 10.1.20 contrast of the three colours */
    0xC7, 1, 0x0F,             /* 10.1.21 master contrast */
    0xB6, 1, 0x01,             /* 10.1.15 second precharge */
    0xA6, 0,                   /* 10.1.8 not inverted */
};

const struct panel panel_ssd1351_128x128 = {
    .name = "ssd1351-128x128",
    .controller = &ssd1351,
    .width = 128,
    .height = 128,
    .ram_width = 128,
    .ram_height = 128,
    .rotation_base =
        0x74, /* 10.1.5: 65k colours, COM split, COM from the last, colours C-B-A: upright on the modules */
    .formats = PANEL_FORMAT_BIT(PANEL_RGB565),
    .init = ssd1351_init,
    .init_bytes = sizeof ssd1351_init,
};

static const struct panel_controller ssd0323 = {
    .name = "SSD0323",
    .init_hz = 1000000,
    .write_hz = 4000000,    /* AC characteristics, 4-wire serial: tcycle 250 ns */
    .reset_low_us = 100,    /* power-on sequence: 3 us */
    .reset_high_us = 10000, /* power-on sequence: 3 us */
    .set_column = 0x15,     /* command table: pairs of pixels, 0 .. 63 */
    .set_row = 0x75,        /* 0 .. 79 */
    .memory_write = 0,      /* data needs no command before it */
    .address_bytes = 1,
    .column_pixels = 2,
    .parameters_are_commands = true,
    .set_rotation = 0xA0, /* A[0] column, A[1] nibble, A[2] vertical increment, A[4] COM */
    .rotation_bit_mx = 0x01,
    .rotation_bit_mx_pair = 0x02,
    .rotation_bit_my = 0x10,
    .rotation_bit_mv = 0x04,
    .invert = {0xA4, 0xA7},
    .on = ssd_on,
    .on_bytes = sizeof ssd_on,
    .off = ssd_off,
    .off_bytes = sizeof ssd_off,
};

/* Command table of the datasheet, values for the 128x64 glass of the Stellaris kits. */
static const uint8_t ssd0323_init[] = {
    0xAE, 0,                                                 /* sleep */
    0x81, 1, 0x32,                                           /* contrast current */
    0x85, 0,                                                 /* half of the current range */
    0xA1, 1, 0x00,                                           /* start line */
    0xA2, 1, 0x4C,                                           /* offset: how this glass is wired */
    0xA4, 0,                                                 /* normal display */
    0xA8, 1, 0x3F,                                           /* 64 lines */
    0xB1, 1, 0x22,                                           /* phase lengths */
    0xB2, 1, 0x46,                                           /* row period */
    0xB3, 1, 0xF1,                                           /* clock */
    0xBF, 1, 0x0D,                                           /* VSL */
    0xBE, 1, 0x02,                                           /* VCOMH */
    0xBC, 1, 0x10,                                           /* precharge */
    0xB8, 8, 0x01, 0x11, 0x22, 0x32, 0x43, 0x54, 0x65, 0x76, /* grey levels */
    0xAD, 1, 0x03,                                           /* DC-DC on */
};

const struct panel panel_ssd0323_128x64 = {
    .name = "ssd0323-128x64",
    .controller = &ssd0323,
    .width = 128,
    .height = 64,
    .ram_width = 128,
    .ram_height = 64,      /* only lines that are scanned; they are mirrored among themselves */
    .rotation_base = 0x52, /* COM split, COM from the last, left pixel in the high nibble: upright */
    .formats = PANEL_FORMAT_BIT(PANEL_GREY4),
    .init = ssd0323_init,
    .init_bytes = sizeof ssd0323_init,
};
