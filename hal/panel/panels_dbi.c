/*
 * Panels whose controllers follow MIPI DBI type C option 3 (4-line serial) and the MIPI command set.
 *
 * Section numbers are those of the datasheets ST7789V/VW (Sitronix, v1.0), GC9A01A (GalaxyCore, v1.0),
 * ILI9341 (Ilitek, v1.11), ILI9488 (Ilitek, v1.00), ST7735S (Sitronix, v1.4), ST7796S (Sitronix, v1.2). Voltages and
 * gamma depend on the glass; the values are the ones that makers of modules publish. host-sim/controllers/dbi_table.c
 * says of each command which bits it has and what they do.
 *
 * SWRESET stands first for kits whose reset line is not wired; after it and after SLPOUT 120 ms (ST7789V 9.1.2, 9.1.12;
 * the others likewise). DISPON is not here: it comes after the first frame.
 */
#include "panels.h"

#define MX  0x40
#define MY  0x80
#define MV  0x20
#define BGR 0x08

#define DELAY_MS(n) 0x00, 1, (n)
#define WAKE_UP     0x01, 0, DELAY_MS(150), 0x11, 0, DELAY_MS(120)

#define INIT(table) .init = (table), .init_bytes = sizeof(table)

static const uint8_t dbi_on[] = {
    0x29, 0, /* DISPON */
};

static const uint8_t dbi_off[] = {
    0x28,        0, /* DISPOFF */
    0x10,        0, /* SLPIN */
    DELAY_MS(5),    /* until the next command */
};

/* Commands that all controllers of this file have; differences follow in each struct. */
#define DBI_COMMANDS                                                                                                   \
    .init_hz = 4000000, .reset_low_us = 100, .reset_high_us = 120000, .set_column = 0x2A, .set_row = 0x2B,             \
    .memory_write = 0x2C, .address_bytes = 2, .column_pixels = 1, .window_turns = true, .set_rotation = 0x36,          \
    .rotation_bit_mx = MX, .rotation_bit_my = MY, .rotation_bit_mv = MV, .rotation_bit_bgr = BGR,                      \
    .invert = {0x20, 0x21}, .set_format = 0x3A, .on = dbi_on, .on_bytes = sizeof dbi_on, .off = dbi_off,               \
    .off_bytes = sizeof dbi_off

const struct panel_controller panel_st7789 = {
    .name = "ST7789",
    .write_hz = 62500000, /* 7.4.2 TSCYCW 16 ns */
    DBI_COMMANDS,
    .format_value = {[PANEL_RGB565] = 0x55, [PANEL_RGB666] = 0x66, [PANEL_RGB444] = 0x53}, /* 9.1.32 */
};

static const struct panel_controller gc9a01 = {
    .name = "GC9A01",
    .write_hz = 100000000, /* 7.3.4 tscycw 10 ns */
    DBI_COMMANDS,
    .format_value = {[PANEL_RGB565] = 0x55, [PANEL_RGB666] = 0x66, [PANEL_RGB444] = 0x53}, /* 6.2.20 */
};

static const struct panel_controller ili9341 = {
    .name = "ILI9341",
    .write_hz = 10000000, /* 18.3.4 tscycw 100 ns */
    DBI_COMMANDS,
    .format_value = {[PANEL_RGB565] = 0x55, [PANEL_RGB666] = 0x66}, /* 8.2.33 */
};

static const struct panel_controller ili9488 = {
    .name = "ILI9488",
    .write_hz = 20000000, /* 17.4.3 tscycw 50 ns */
    DBI_COMMANDS,
    .format_value = {[PANEL_RGB666] = 0x66}, /* 5.2.34; 4.7.2.2: serial takes 3 and 18 bits a pixel only */
};

static const struct panel_controller st7735s = {
    .name = "ST7735S",
    .write_hz = 15151515, /* 8.4 TSCYCW 66 ns */
    DBI_COMMANDS,
    .format_value = {[PANEL_RGB565] = 0x05, [PANEL_RGB666] = 0x06, [PANEL_RGB444] = 0x03}, /* 10.1.32 */
};

static const struct panel_controller st7796 = {
    .name = "ST7796S",
    .write_hz = 15151515, /* 7.4.3 TSCYCW 66 ns */
    DBI_COMMANDS,
    .format_value = {[PANEL_RGB565] = 0x55, [PANEL_RGB666] = 0x66}, /* 9.2.32; 8.4.2.3: serial takes no 12 bits */
};

static const struct panel_controller hx8357d = {
    .name = "HX8357D",
    .write_hz = 15151515, /* a cycle of 66 ns; Adafruit names 16 MHz, and sets more */
    DBI_COMMANDS,
    .format_value = {[PANEL_RGB565] = 0x55, [PANEL_RGB666] = 0x66},
};

/*
 * ILI9486 of the Raspberry Pi's HATs of 3.5": a shift register of 16 bits drives its parallel interface. The bytes are
 * those of Linux' drivers/gpu/drm/tiny/ili9486.c; the clock is that of the makers' overlay, and what the shift register
 * takes, not the controller.
 */
static const struct panel_controller ili9486_words = {
    .name = "ILI9486",
    .write_hz = 16000000,
    DBI_COMMANDS,
    .words = true,
    .format_value = {[PANEL_RGB565] = 0x55},
};

#define FORMATS_ALL   (PANEL_FORMAT_BIT(PANEL_RGB565) | PANEL_FORMAT_BIT(PANEL_RGB666) | PANEL_FORMAT_BIT(PANEL_RGB444))
#define FORMATS_16_18 (PANEL_FORMAT_BIT(PANEL_RGB565) | PANEL_FORMAT_BIT(PANEL_RGB666))

/* ---- ST7789: IPS glass, which shows the memory's complement unless it is inverted --------------- */

/*
 * The glass has six bits of red and blue, a 16-bit pixel five. EPF (RAMCTRL, second byte, bits 5:4) says where the
 * sixth comes from: 00 makes it 0, and white would be 62/63; 01 makes it 1, and black would be 1/63; 10 repeats the
 * MSB, so that black and white stay what they are; 11, the reset value, takes green's lowest bit, which tints red and
 * blue: dark greens become grey.
 */
#define ST7789_COMMON                                                                                                  \
    WAKE_UP,                                   /* 9.1.2 SWRESET, 9.1.12 SLPOUT */                                      \
        0xB0, 2, 0x00, 0xE0,                   /* 9.2.1 RAMCTRL: high byte first, EPF 10 */                            \
        0xB2, 5, 0x0C, 0x0C, 0x00, 0x33, 0x33, /* 9.2.3 PORCTRL: porches of 12 lines */                                \
        0xC0, 1, 0x2C,                         /* 9.2.12 LCMCTRL, default */                                           \
        0xC2, 2, 0x01, 0xFF,                   /* 9.2.14 VDVVRHEN: VDV and VRH as commanded */                         \
        0xC4, 1, 0x20,                         /* 9.2.16 VDVS: 0 V */                                                  \
        0xC6, 1, 0x0F,                         /* 9.2.18 FRCTRL2: 60 Hz */                                             \
        0xD0, 2, 0xA4, 0xA1,                   /* 9.2.23 PWCTRL1: AVDD 6.8 V, AVCL -4.8 V, VDDS 2.3 V */               \
        0x21, 0,                               /* 9.1.16 INVON */                                                      \
        0x13, 0                                /* 9.1.14 NORON */

/* Voltages and gamma depend on the glass. */
/* clang-format off */
static const uint8_t st7789_init_tall[] = {
    ST7789_COMMON,
    0xB7, 1, 0x35, /* 9.2.6 GCTRL */
    0xBB, 1, 0x1F, /* 9.2.9 VCOMS */
    0xC3, 1, 0x12, /* 9.2.15 VRHS */
    0xE0, 14, 0xD0, 0x08, 0x11, 0x08, 0x0C, 0x15, 0x39, 0x33, 0x50, 0x36, 0x13, 0x14, 0x29, 0x2D, /* 9.2 PVGAMCTRL */
    0xE1, 14, 0xD0, 0x08, 0x10, 0x08, 0x06, 0x06, 0x39, 0x44, 0x51, 0x0B, 0x16, 0x14, 0x2F, 0x31, /* 9.2 NVGAMCTRL */
};

static const uint8_t st7789_init_square[] = {
    ST7789_COMMON,
    0xB7, 1, 0x14, /* 9.2.6 GCTRL */
    0xBB, 1, 0x37, /* 9.2.9 VCOMS */
    0xC3, 1, 0x12, /* 9.2.15 VRHS */
    0xE0, 14, 0xD0, 0x04, 0x0D, 0x11, 0x13, 0x2B, 0x3F, 0x54, 0x4C, 0x18, 0x0D, 0x0B, 0x1F, 0x23, /* 9.2 PVGAMCTRL */
    0xE1, 14, 0xD0, 0x04, 0x0C, 0x11, 0x13, 0x2C, 0x3F, 0x44, 0x51, 0x2F, 0x1F, 0x1F, 0x20, 0x23, /* 9.2 NVGAMCTRL */
};

static const uint8_t st7789_init_narrow[] = {
    ST7789_COMMON,
    0xB7, 1, 0x75, /* 9.2.6 GCTRL */
    0xBB, 1, 0x3D, /* 9.2.9 VCOMS */
    0xC3, 1, 0x00, /* 9.2.15 VRHS */
    0xE0, 14, 0x70, 0x04, 0x08, 0x09, 0x09, 0x05, 0x2A, 0x33, 0x41, 0x07, 0x13, 0x13, 0x29, 0x2F, /* 9.2 PVGAMCTRL */
    0xE1, 14, 0x70, 0x03, 0x09, 0x0A, 0x09, 0x06, 0x2B, 0x34, 0x41, 0x07, 0x12, 0x14, 0x28, 0x2E, /* 9.2 NVGAMCTRL */
};
/* clang-format on */

#define ST7789(n, w, h, left, top, table)                                                                              \
    {                                                                                                                  \
        .name = (n), .controller = &panel_st7789, .width = (w), .height = (h), .ram_width = 240, .ram_height = 320,    \
        .x0 = (left), .y0 = (top), .formats = FORMATS_ALL, INIT(table)                                                 \
    }

const struct panel panel_st7789_240x240 = ST7789("st7789-240x240", 240, 240, 0, 0, st7789_init_square);
const struct panel panel_st7789_135x240 = ST7789("st7789-135x240", 135, 240, 52, 40, st7789_init_narrow);
const struct panel panel_st7789_240x320 = ST7789("st7789-240x320", 240, 320, 0, 0, st7789_init_tall);
const struct panel panel_st7789_170x320 = ST7789("st7789-170x320", 170, 320, 35, 0, st7789_init_tall);
const struct panel panel_st7789_172x320 = ST7789("st7789-172x320", 172, 320, 34, 0, st7789_init_tall);
const struct panel panel_st7789_240x280 = ST7789("st7789-240x280", 240, 280, 0, 20, st7789_init_tall);

/* ---- GC9A01 ------------------------------------------------------------------------------------- */

/* clang-format off */
static const uint8_t gc9a01_init[] = {
    WAKE_UP,                                                              /* 6.2 SWRESET, SLPOUT */
    0xFE, 0, 0xEF, 0,                                                     /* 6.5 inter register enable 1, 2 */
    0xEB, 1, 0x14,                                                        /* maker's value, not in the datasheet */
    0x84, 1, 0x40, 0x85, 1, 0xFF, 0x86, 1, 0xFF, 0x87, 1, 0xFF,           /* likewise */
    0x88, 1, 0x0A, 0x89, 1, 0x21, 0x8A, 1, 0x00, 0x8B, 1, 0x80,           /* likewise */
    0x8C, 1, 0x01, 0x8D, 1, 0x01, 0x8E, 1, 0xFF, 0x8F, 1, 0xFF,           /* likewise */
    0xB6, 2, 0x00, 0x00,                                                  /* 6.3 display function: GS and SS 0 */
    0x90, 4, 0x08, 0x08, 0x08, 0x08, 0xBD, 1, 0x06, 0xBC, 1, 0x00,        /* maker's values */
    0xFF, 3, 0x60, 0x01, 0x04,                                            /* likewise */
    0xC3, 1, 0x13, 0xC4, 1, 0x13, 0xC9, 1, 0x22,                          /* 6.4 VREG1a, VREG1b, VREG2a */
    0xBE, 1, 0x11, 0xE1, 2, 0x10, 0x0E, 0xDF, 3, 0x21, 0x0C, 0x02,        /* maker's values */
    0xF0, 6, 0x45, 0x09, 0x08, 0x08, 0x26, 0x2A,                          /* 6.4 gamma 1 */
    0xF1, 6, 0x43, 0x70, 0x72, 0x36, 0x37, 0x6F,                          /* 6.4 gamma 2 */
    0xF2, 6, 0x45, 0x09, 0x08, 0x08, 0x26, 0x2A,                          /* 6.4 gamma 3 */
    0xF3, 6, 0x43, 0x70, 0x72, 0x36, 0x37, 0x6F,                          /* 6.4 gamma 4 */
    0xED, 2, 0x1B, 0x0B, 0xAE, 1, 0x77, 0xCD, 1, 0x63,                    /* maker's values */
    0x70, 9, 0x07, 0x07, 0x04, 0x0E, 0x0F, 0x09, 0x07, 0x08, 0x03,        /* likewise */
    0xE8, 1, 0x34,                                                        /* 6.3 frame rate: dot inversion */
    0x62, 12, 0x18, 0x0D, 0x71, 0xED, 0x70, 0x70, 0x18, 0x0F, 0x71, 0xEF, 0x70, 0x70, /* maker's values */
    0x63, 12, 0x18, 0x11, 0x71, 0xF1, 0x70, 0x70, 0x18, 0x13, 0x71, 0xF3, 0x70, 0x70, /* likewise */
    0x64, 7, 0x28, 0x29, 0xF1, 0x01, 0xF1, 0x00, 0x07,                    /* likewise */
    0x66, 10, 0x3C, 0x00, 0xCD, 0x67, 0x45, 0x45, 0x10, 0x00, 0x00, 0x00, /* likewise */
    0x67, 10, 0x00, 0x3C, 0x00, 0x00, 0x00, 0x01, 0x54, 0x10, 0x32, 0x98, /* likewise */
    0x74, 7, 0x10, 0x85, 0x80, 0x00, 0x00, 0x4E, 0x00, 0x98, 2, 0x3E, 0x07, /* likewise */
    0x21, 0,                                                              /* 6.2 INVON: IPS glass */
};
/* clang-format on */

const struct panel panel_gc9a01_240x240 = {
    .name = "gc9a01-240x240",
    .controller = &gc9a01,
    .width = 240,
    .height = 240,
    .ram_width = 240,
    .ram_height = 240,
    .rotation_base = MX | BGR, /* columns run from right to left on this glass */
    .formats = FORMATS_ALL,
    .round = true,
    INIT(gc9a01_init),
};

/* ---- ILI9341 ------------------------------------------------------------------------------------ */

/* clang-format off */
static const uint8_t ili9341_init[] = {
    WAKE_UP,                               /* 8.2.2 SWRESET, 8.2.12 SLPOUT */
    0xCF, 3, 0x00, 0xC1, 0x30,             /* 8.4.2 power control B */
    0xED, 4, 0x64, 0x03, 0x12, 0x81,       /* 8.4.6 power-on sequence */
    0xE8, 3, 0x85, 0x00, 0x78,             /* 8.4.3 driver timing A */
    0xCB, 5, 0x39, 0x2C, 0x00, 0x34, 0x02, /* 8.4.1 power control A */
    0xF7, 1, 0x20,                         /* 8.4.8 pump ratio: DDVDH = 2 VCI */
    0xEA, 2, 0x00, 0x00,                   /* 8.4.5 driver timing B */
    0xC0, 1, 0x23,                         /* 8.3.16 PWCTRL1: GVDD 4.6 V */
    0xC1, 1, 0x10,                         /* 8.3.17 PWCTRL2 */
    0xC5, 2, 0x3E, 0x28,                   /* 8.3.18 VMCTRL1: VCOMH 4.25 V, VCOML -1.5 V */
    0xC7, 1, 0x86,                         /* 8.3.19 VMCTRL2 */
    0xB1, 2, 0x00, 0x18,                   /* 8.3.2 FRMCTR1: 79 Hz */
    0xB6, 3, 0x08, 0x82, 0x27,             /* 8.3.7 DISCTRL: normally white, GS and SS 0, 320 lines */
    0xF2, 1, 0x02,                         /* 8.4.7 3 gamma off; bit 1 must be 1 */
    0x26, 1, 0x01,                         /* 8.2.17 GAMSET: curve 1 */
    0xE0, 15, 0x0F, 0x31, 0x2B, 0x0C, 0x0E, 0x08, 0x4E, 0xF1, 0x37, 0x07, 0x10, 0x03, 0x0E, 0x09, 0x00, /* 8.3.24 */
    0xE1, 15, 0x00, 0x0E, 0x14, 0x03, 0x11, 0x07, 0x31, 0xC1, 0x48, 0x08, 0x0F, 0x0C, 0x31, 0x36, 0x0F, /* 8.3.25 */
    0x20, 0,                               /* 8.2.15 INVOFF: TN glass */
};
/* clang-format on */

const struct panel panel_ili9341_240x320 = {
    .name = "ili9341-240x320",
    .controller = &ili9341,
    .width = 240,
    .height = 320,
    .ram_width = 240,
    .ram_height = 320,
    .rotation_base = MX | BGR,
    .formats = FORMATS_16_18,
    INIT(ili9341_init),
};

/* ---- ILI9488 ------------------------------------------------------------------------------------ */

/* clang-format off */
static const uint8_t ili9488_init[] = {
    WAKE_UP,                         /* 5.2.2 SWRESET, 5.2.12 SLPOUT */
    0xE0, 15, 0x00, 0x03, 0x09, 0x08, 0x16, 0x0A, 0x3F, 0x78, 0x4C, 0x09, 0x0A, 0x08, 0x16, 0x1A, 0x0F, /* 5.3 gamma */
    0xE1, 15, 0x00, 0x16, 0x19, 0x03, 0x0F, 0x05, 0x32, 0x45, 0x46, 0x04, 0x0E, 0x0D, 0x35, 0x37, 0x0F, /* 5.3 gamma */
    0xC0, 2, 0x17, 0x15,             /* 5.3 power control 1: VREG1 5 V, VREG2 -4.875 V */
    0xC1, 1, 0x41,                   /* 5.3 power control 2 */
    0xC5, 3, 0x00, 0x12, 0x80,       /* 5.3 VCOM control */
    0xB0, 1, 0x00,                   /* 5.3 interface mode */
    0xB1, 1, 0xA0,                   /* 5.3 frame rate 60 Hz */
    0xB4, 1, 0x02,                   /* 5.3 2-dot inversion */
    0xB6, 3, 0x02, 0x02, 0x3B,       /* 5.3 display function: GS and SS 0, 480 lines */
    0xE9, 1, 0x00,                   /* 5.3 set image: 24-bit off */
    0xF7, 4, 0xA9, 0x51, 0x2C, 0x82, /* 5.3 adjust control 3 */
    0x20, 0,                         /* 5.2.16 INVOFF: TN glass */
};
/* clang-format on */

const struct panel panel_ili9488_320x480 = {
    .name = "ili9488-320x480",
    .controller = &ili9488,
    .width = 320,
    .height = 480,
    .ram_width = 320,
    .ram_height = 480,
    .rotation_base = MX | BGR,
    .formats = PANEL_FORMAT_BIT(PANEL_RGB666),
    INIT(ili9488_init),
};

/* ---- ST7796S ------------------------------------------------------------------------------------ */

/* clang-format off */
static const uint8_t st7796_init[] = {
    WAKE_UP,                                                  /* 9.2.2 SWRESET, 9.2.13 SLPOUT */
    0xF0, 1, 0xC3, 0xF0, 1, 0x96,                             /* 9.3.23 CSCON: command 2, parts I and II */
    0xB4, 1, 0x01,                                            /* 9.3.5 DIC: 1-dot inversion */
    0xB6, 3, 0x80, 0x02, 0x3B,                                /* 9.3.7 DFC: GS and SS 0, 480 lines */
    0xB7, 1, 0x86,                                            /* 9.3.8 EM: EPF 10, as of an ST7789; 00 after reset */
    0xE8, 8, 0x40, 0x8A, 0x00, 0x00, 0x29, 0x19, 0xA5, 0x33,  /* 9.3.22 DOCA: gates from 26 to 38 clocks, G_EQ */
    0xC1, 1, 0x06,                                            /* 9.3.10 PWR2: GVDD 3.85 V + VCOM */
    0xC2, 1, 0x07,                                            /* 9.3.11 PWR3: source low, gamma high */
    0xC5, 1, 0x18,                                            /* 9.3.12 VCMPCTL: VCOM 0.9 V */
    0xE0, 14, 0xF0, 0x09, 0x0B, 0x06, 0x04, 0x15, 0x2F, 0x54, 0x42, 0x3C, 0x17, 0x14, 0x18, 0x1B, /* 9.3.18 PGC */
    0xE1, 14, 0xE0, 0x09, 0x0B, 0x06, 0x04, 0x03, 0x2B, 0x43, 0x42, 0x3B, 0x16, 0x14, 0x17, 0x1B, /* 9.3.19 NGC */
    0x20, 0,                                                  /* 9.2.16 INVOFF: TN glass */
};
/* clang-format on */

const struct panel panel_st7796s_320x480 = {
    .name = "st7796s-320x480",
    .controller = &st7796,
    .width = 320,
    .height = 480,
    .ram_width = 320,
    .ram_height = 480,
    .rotation_base = MX | BGR,
    .formats = FORMATS_16_18,
    INIT(st7796_init),
};

/* ---- ILI9486 behind a shift register ------------------------------------------------------------ */

/* clang-format off */
static const uint8_t ili9486_init[] = {
    WAKE_UP,                         /* SWRESET, SLPOUT */
    0xB0, 1, 0x00,                   /* interface mode */
    0xC2, 1, 0x44,                   /* power control 3 */
    0xC5, 4, 0x00, 0x00, 0x00, 0x00, /* VCOM control */
    0xE0, 15, 0x0F, 0x1F, 0x1C, 0x0C, 0x0F, 0x08, 0x48, 0x98, 0x37, 0x0A, 0x13, 0x04, 0x11, 0x0D, 0x00, /* gamma */
    0xE1, 15, 0x0F, 0x32, 0x2E, 0x0B, 0x0D, 0x05, 0x47, 0x75, 0x37, 0x06, 0x10, 0x03, 0x24, 0x20, 0x00, /* gamma */
    0x20, 0,                         /* INVOFF: TN glass */
};
/* clang-format on */

const struct panel panel_ili9486_320x480 = {
    .name = "ili9486-320x480",
    .controller = &ili9486_words,
    .width = 320,
    .height = 480,
    .ram_width = 320,
    .ram_height = 480,
    .rotation_base = MX | BGR,
    .formats = PANEL_FORMAT_BIT(PANEL_RGB565),
    INIT(ili9486_init),
};

/* ---- HX8357D ------------------------------------------------------------------------------------ */

/* Its own registers are those of Adafruit's Adafruit_CircuitPython_HX8357; see dbi_table.c. */
/* clang-format off */
static const uint8_t hx8357d_init[] = {
    WAKE_UP,                                              /* SWRESET, SLPOUT */
    0xB9, 3, 0xFF, 0x83, 0x57,                            /* SETEXTC: the commands from B0h on */
    DELAY_MS(150),                                        /* as Linux' fb_hx8357d.c waits */
    0xB3, 4, 0x00, 0x00, 0x06, 0x06,                      /* SETRGB: no data line back */
    0xB6, 1, 0x25,                                        /* SETCOM: -1.52 V */
    0xB0, 1, 0x68,                                        /* SETOSC: 70 Hz */
    0xCC, 1, 0x05,                                        /* SETPANEL: BGR, lines from the last one */
    0xB1, 6, 0x00, 0x15, 0x1C, 0x1C, 0x83, 0xAA,          /* SETPWR1 */
    0xC0, 6, 0x50, 0x50, 0x01, 0x3C, 0x1E, 0x08,          /* SETSTBA */
    0xB4, 7, 0x02, 0x40, 0x00, 0x2A, 0x2A, 0x0D, 0x78,    /* SETCYC */
    0xE0, 34, 0x02, 0x0A, 0x11, 0x1D, 0x23, 0x35, 0x41, 0x4B, 0x4B, 0x42, 0x3A, 0x27, 0x1B, 0x08, 0x09, 0x03, 0x02,
              0x0A, 0x11, 0x1D, 0x23, 0x35, 0x41, 0x4B, 0x4B, 0x42, 0x3A, 0x27, 0x1B, 0x08, 0x09, 0x03, 0x00, 0x01,
                                                          /* SETGAMMA */
    0x20, 0,                                              /* INVOFF */
};
/* clang-format on */

const struct panel panel_hx8357d_320x480 = {
    .name = "hx8357d-320x480",
    .controller = &hx8357d,
    .width = 320,
    .height = 480,
    .ram_width = 320,
    .ram_height = 480,
    .rotation_base = MX | MY,
    .formats = FORMATS_16_18,
    INIT(hx8357d_init),
};

/* ---- ST7735S: 132 x 162 memory, or 132 x 132 (pins GM2..0, 7 "pin description") ----------------- */

#define ST7735S_COMMON                                                                                                 \
    WAKE_UP,                       /* 10.1.2 SWRESET, 10.1.11 SLPOUT */                                                \
        0xB1, 3, 0x01, 0x2C, 0x2D, /* 10.2.1 FRMCTR1, 10.2.2 and 10.2.3 likewise idle and partial */                   \
        0xB2, 3, 0x01, 0x2C, 0x2D, 0xB3, 6, 0x01, 0x2C, 0x2D, 0x01, 0x2C, 0x2D, 0xB4, 1,                               \
        0x07,                                     /* 10.2.4 INVCTR: column inversion */                                \
        0xC0, 3, 0xA2, 0x02, 0x84,                /* 10.2.6 PWCTR1: AVDD 5 V, GVDD 4.6 V */                            \
        0xC1, 1, 0xC5,                            /* 10.2.7 PWCTR2: VGH 3 AVDD - 0.5 V, VGL -10 V */                   \
        0xC2, 2, 0x0A, 0x00,                      /* 10.2.8 PWCTR3 */                                                  \
        0xC3, 2, 0x8A, 0x2A, 0xC4, 2, 0x8A, 0xEE, /* 10.2.9 PWCTR4, 10.2.10 PWCTR5 */                                  \
        0xC5, 1, 0x0E,                            /* 10.2.11 VMCTR1: VCOM -0.775 V */                                  \
        0xE0, 16, 0x02, 0x1C, 0x07, 0x12, 0x37, 0x32, 0x29, 0x2D, 0x29, 0x25, 0x2B, 0x39, 0x00, 0x01, 0x03, 0x10,      \
        0xE1, 16, 0x03, 0x1D, 0x07, 0x06, 0x2E, 0x2C, 0x29, 0x2D, 0x2E, 0x2E, 0x37, 0x3F, 0x00, 0x00, 0x02, 0x10,      \
        0x13, 0 /* 10.2.17, 10.2.18 gamma; 10.1.13 NORON */

static const uint8_t st7735s_tn_init[] = {
    ST7735S_COMMON, 0x20, 0, /* 10.1.14 INVOFF */
};

static const uint8_t st7735s_ips_init[] = {
    ST7735S_COMMON, 0x21, 0, /* 10.1.15 INVON */
};

#define ST7735S(n, w, h, ram_h, left, top, table)                                                                      \
    {                                                                                                                  \
        .name = (n), .controller = &st7735s, .width = (w), .height = (h), .ram_width = 132, .ram_height = (ram_h),     \
        .x0 = (left), .y0 = (top), .rotation_base = BGR, .formats = FORMATS_ALL, INIT(table)                           \
    }

const struct panel panel_st7735s_128x128 = ST7735S("st7735s-128x128", 128, 128, 132, 2, 1, st7735s_tn_init);
const struct panel panel_st7735s_128x160 = ST7735S("st7735s-128x160", 128, 160, 162, 2, 1, st7735s_tn_init);
const struct panel panel_st7735s_80x160 = ST7735S("st7735s-80x160", 80, 160, 162, 26, 1, st7735s_ips_init);
