/*
 * What may be sent to a display controller, and what it does to the glass. First by hand, from the data sheets: the
 * lowest bits of an ST7789's colours, registers that change the picture, commands that are wrong. Then every line of
 * the models' tables: a value beside a field's range and a bit that no field has are refused; a field that the table
 * calls shown changes the picture, another one does not.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "demo_stage.h"
#include "panel_picture.h"
#include "sim_bus.h"
#include "sim_table.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint8_t seen[3 * PICTURE_PIXELS], other[3 * PICTURE_PIXELS];
static uint16_t picture[PICTURE_PIXELS];

/* ---- a panel with a picture --------------------------------------------------------------------- */

/* A kit whose panel the driver has initialised. Must not move once it is open. */
struct kit {
    struct sim_bus bus;
    struct panel_driver driver;
    uint8_t scratch[512];
};

static void kit_open(struct kit *kit, const struct panel *panel)
{
    kit->bus = sim_bus_with(panel);
    plug(&kit->bus);
    const bool rgb565 = (panel->formats & PANEL_FORMAT_BIT(PANEL_RGB565)) != 0;
    const bool rgb666 = (panel->formats & PANEL_FORMAT_BIT(PANEL_RGB666)) != 0;
    const uint8_t format = rgb565 ? PANEL_RGB565 : rgb666 ? PANEL_RGB666 : (uint8_t)__builtin_ctz(panel->formats);
    const struct panel_config config = {panel, PANEL_R0, format, 1000000, kit->scratch, sizeof kit->scratch};
    assert_int_equal(panel_open(&kit->driver, &kit->bus.hal, &config), 0);
}

/* A command with its parameters, as the controller wants them. */
static void send(struct kit *kit, uint8_t code, const uint8_t *parameters, size_t n)
{
    const struct hal *hal = &kit->bus.hal;
    const bool as_commands = kit->bus.board.panel->controller->parameters_are_commands;
    if (kit->bus.board.panel->controller->words) {
        for (size_t i = 0; i <= n; i++) {
            const uint8_t word[2] = {0, i == 0 ? code : parameters[i - 1]};
            assert_int_equal(hal->ops->bus_write(hal->context, i == 0 ? HAL_COMMAND : HAL_DATA, word, 2), 0);
        }
        return;
    }
    command(&kit->bus, code);
    if (n > 0) {
        assert_int_equal(hal->ops->bus_write(hal->context, as_commands ? HAL_COMMAND : HAL_DATA, parameters, n), 0);
    }
}

#define SEND(kit, code, ...) send((kit), (code), (const uint8_t[]){__VA_ARGS__}, sizeof((const uint8_t[]){__VA_ARGS__}))

static void draw(struct kit *kit)
{
    picture_fill(picture, kit->driver.width, kit->driver.height, 1);
    assert_int_equal(picture_draw(&kit->driver, picture, 16), 0);
}

static size_t look(struct kit *kit, uint8_t *pixels)
{
    sim_pixels(kit->bus.sim, PANEL_R0, pixels);
    return 3 * (size_t)kit->driver.width * kit->driver.height;
}

/* Red, green and blue of the place x, y, as 0xRRGGBB. */
static uint32_t at(struct kit *kit, uint32_t x, uint32_t y)
{
    return seen_at(&kit->bus, kit->driver.width, x, y);
}

/* ---- ST7789: RAMCTRL's EPF ---------------------------------------------------------------------- */

static uint16_t swapped(unsigned colour)
{
    uint16_t stored;
    const uint8_t bytes[2] = {(uint8_t)(colour >> 8), (uint8_t)colour};
    memcpy(&stored, bytes, sizeof stored);
    return stored;
}

/* The level 0 .. 63 that a value 0 .. 255 is nearest to. */
static unsigned level(uint32_t value)
{
    return (unsigned)((value * 63 + 127) / 255);
}

/* A row for each of the 32 reds, with all 64 greens; blue runs against red. */
static void draw_colours(struct kit *kit)
{
    for (unsigned r = 0; r < 32; r++) {
        for (unsigned g = 0; g < 64; g++) {
            picture[r * kit->driver.width + g] = swapped(r << 11 | g << 5 | (31 - r));
        }
    }
    assert_int_equal(picture_draw(&kit->driver, picture, 16), 0);
}

/* ST7789V v1.3, 9.2.1, and ST7796S v1.2, 9.3.8: R0 and B0 are 0; 1; R5 and B5; G0. */
static unsigned lowest_bit(unsigned epf, unsigned five, unsigned green)
{
    const unsigned bits[] = {0, 1, five / 16, green % 2};
    return bits[epf];
}

static void each_epf_fills_red_and_blue_as_the_data_sheets_draw_it(void **state)
{
    (void)state;
    for (unsigned i = 0; i < 8; i++) {
        const unsigned epf = i % 4;
        struct kit kit;
        kit_open(&kit, i < 4 ? &panel_st7789_240x240 : &panel_st7796s_320x480);
        if (i < 4) {
            SEND(&kit, 0xB0, 0x00, (uint8_t)(0xC0 | epf << 4));
        } else {
            SEND(&kit, 0xB7, (uint8_t)(epf << 6 | 6));
        }
        draw_colours(&kit);
        look(&kit, seen);
        for (unsigned r = 0; r < 32; r++) {
            for (unsigned g = 0; g < 64; g++) {
                const uint8_t *p = seen + 3 * (r * kit.driver.width + g);
                const unsigned b = 31 - r;
                assert_int_equal(level(p[0]), 2 * r + lowest_bit(epf, r, g));
                assert_int_equal(level(p[1]), g);
                assert_int_equal(level(p[2]), 2 * b + lowest_bit(epf, b, g));
            }
        }
        none(&kit.bus);
        sim_close(kit.bus.sim);
    }
}

/* What the driver sends: every 16-bit colour is seen as its bits repeated, black, white and all greys included. */
static void colours_are_seen_as_they_were_sent(void **state)
{
    (void)state;
    struct kit kit;
    kit_open(&kit, &panel_st7789_240x240);
    draw_colours(&kit);
    for (unsigned grey = 0; grey < 32; grey++) {
        picture[grey] = swapped(grey << 11 | (grey << 1 | grey >> 4) << 5 | grey);
    }
    picture_expect(picture, 240, 240, PANEL_RGB565, false, other);
    assert_int_equal(picture_draw(&kit.driver, picture, 16), 0);
    assert_int_equal(look(&kit, seen), 3 * 240 * 240);
    assert_memory_equal(seen, other, 3 * 240 * 240);
    assert_int_equal(at(&kit, 0, 0), 0x000000);
    assert_int_equal(at(&kit, 31, 0), 0xFFFFFF);
    none(&kit.bus);
    sim_close(kit.bus.sim);
}

/* The six-bit levels of both keep their order and their place. */
static void every_level_of_the_glass_has_one_value(void **state)
{
    (void)state;
    uint8_t value[64] = {0};
    for (unsigned epf = 0; epf < 2; epf++) {
        struct kit kit;
        kit_open(&kit, &panel_st7789_240x240);
        SEND(&kit, 0xB0, 0x00, (uint8_t)(0xC0 | epf << 4));
        draw_colours(&kit);
        look(&kit, seen);
        for (unsigned r = 0; r < 32; r++) {
            value[2 * r + epf] = seen[3 * r * 240];
        }
        sim_close(kit.bus.sim);
    }
    for (unsigned i = 0; i < 64; i++) {
        assert_true(abs((int)value[i] * 63 - (int)i * 255) < 2 * 63);
        assert_true(i == 0 || value[i] > value[i - 1]);
    }
    assert_int_equal(value[0], 0);
    assert_int_equal(value[63], 255);
}

/* The share of the lit pixels of a demo's frame that F0h shows in another colour, in percent. */
static unsigned tinted(const char *name)
{
    struct demo_stage stage = demo_stage_open(demo_find(name), 240, 240);
    demo_stage_frame(&stage, 0);
    struct kit kit;
    kit_open(&kit, &panel_st7789_240x240);
    SEND(&kit, 0xB0, 0x00, 0xF0);
    memcpy(picture, stage.rig.pixels, sizeof(uint16_t) * 240 * 240);
    assert_int_equal(picture_draw(&kit.driver, picture, 16), 0);
    look(&kit, seen);
    picture_expect(picture, 240, 240, PANEL_RGB565, false, other);
    unsigned lit = 0, off = 0, counted = 0;
    for (int i = 0; i < 240 * 240; i++) {
        const unsigned colour = pixel(&stage, i % 240, i / 240), host = swapped(colour);
        lit += host != 0;
        counted += (host >> 5 & 1) != (host >> 15 & 1) || (host >> 5 & 1) != (host >> 4 & 1);
        off += memcmp(seen + 3 * i, other + 3 * i, 3) != 0;
        for (int c = 0; c < 3; c++) { /* by one level of the glass */
            assert_true(abs((int)seen[3 * i + c] - (int)other[3 * i + c]) <= 4);
        }
    }
    assert_int_equal(off, counted);
    none(&kit.bus);
    sim_close(kit.bus.sim);
    demo_stage_close(&stage);
    return (100 * off + lit / 2) / lit;
}

static void f0_tints_a_part_of_turntable_and_nearly_all_of_ground(void **state)
{
    (void)state;
    const unsigned turntable = tinted("turntable"), ground = tinted("ground");
    print_message("F0h tints %u %% of turntable's lit pixels, %u %% of ground's\n", turntable, ground);
    assert_in_range(turntable, 15, 50);
    assert_in_range(ground, 90, 100);
}

/* ---- registers that change the picture ---------------------------------------------------------- */

/* The picture after the command has come, and the same frame once more: seen, with the one before it in `other`. */
static void redraw_after(struct kit *kit, const struct panel *panel, uint8_t code, const uint8_t *parameters, size_t n)
{
    kit_open(kit, panel);
    draw(kit);
    look(kit, other);
    send(kit, code, parameters, n);
    draw(kit);
    look(kit, seen);
}

#define REDRAW(kit, panel, code, ...)                                                                                  \
    redraw_after((kit), (panel), (code), (const uint8_t[]){__VA_ARGS__}, sizeof((const uint8_t[]){__VA_ARGS__}))

/* Whether what is seen at (x, y) is what was at (width - 1 - x, y), at (x, height - 1 - y). */
static void expect_mirrored(struct kit *kit, bool columns, bool rows)
{
    const uint32_t width = kit->driver.width, height = kit->driver.height;
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            const uint32_t was = (rows ? height - 1 - y : y) * width + (columns ? width - 1 - x : x);
            assert_memory_equal(seen + 3 * (y * width + x), other + 3 * was, 3);
        }
    }
    none(&kit->bus);
    sim_close(kit->bus.sim);
}

/* ST7789V v1.3, 9.2.10: each bit turns one of MADCTL's, or the inversion, or GS over. 2Ch is the value at reset. */
static void lcmctrl_turns_over_what_it_names(void **state)
{
    (void)state;
    struct kit kit;
    REDRAW(&kit, &panel_st7789_240x320, 0xC0, 0x2C);
    expect_mirrored(&kit, false, false);
    REDRAW(&kit, &panel_st7789_240x320, 0xC0, 0x2C ^ 0x08);
    expect_mirrored(&kit, true, false);
    REDRAW(&kit, &panel_st7789_240x320, 0xC0, 0x2C ^ 0x40);
    expect_mirrored(&kit, false, true);
    REDRAW(&kit, &panel_st7789_240x320, 0xC0, 0x2C ^ 0x01);
    expect_mirrored(&kit, false, true);
    REDRAW(&kit, &panel_st7789_240x320, 0xC0, 0x2C ^ 0x04); /* XMH: another interface's */
    expect_mirrored(&kit, false, false);

    REDRAW(&kit, &panel_st7789_240x320, 0xC0, 0x2C ^ 0x20);
    for (int i = 0; i < 240 * 320; i++) {
        assert_int_equal(seen[3 * i], other[3 * i + 2]);
        assert_int_equal(seen[3 * i + 1], other[3 * i + 1]);
    }
    sim_close(kit.bus.sim);
    REDRAW(&kit, &panel_st7789_240x320, 0xC0, 0x2C ^ 0x10);
    for (int i = 0; i < 3 * 240 * 320; i++) {
        assert_int_equal(seen[i], 255 - other[i]);
    }
    sim_close(kit.bus.sim);

    /* XMV: the second pixel of a window is the one below the first. The picture begins with black, white, red. */
    REDRAW(&kit, &panel_st7789_240x240, 0xC0, 0x2C ^ 0x02);
    assert_int_equal(at(&kit, 0, 1), 0xFFFFFF);
    assert_int_equal(at(&kit, 0, 2), 0xFF0000);
    sim_close(kit.bus.sim);
}

/* 9.2.28: NL counts lines by eight; GS begins with the last of them. */
static void gatectrl_says_how_many_lines_are_driven_and_from_where(void **state)
{
    (void)state;
    struct kit kit;
    REDRAW(&kit, &panel_st7789_240x320, 0xE4, 0x27, 0x00, 0x11);
    expect_mirrored(&kit, false, true);
    REDRAW(&kit, &panel_st7789_240x320, 0xE4, 0x01, 0x00, 0x10);
    assert_memory_equal(seen, other, 3 * 240 * 16);
    for (int i = 3 * 240 * 16; i < 3 * 240 * 320; i++) {
        assert_int_equal(seen[i], 0);
    }
    none(&kit.bus);
    sim_close(kit.bus.sim);

    /* The glass of 240 x 240 has the first lines: from the last one on it shows rows 319 .. 80 of the memory. */
    kit_open(&kit, &panel_st7789_240x240);
    draw(&kit);
    window(&kit.bus, "\0\x05\0\x05", "\x01\x3F\x01\x3F");
    command(&kit.bus, 0x2C);
    DATA(&kit.bus, "\xF8\x00");
    SEND(&kit, 0xE4, 0x27, 0x00, 0x11);
    assert_int_equal(at(&kit, 5, 0), 0xFF0000);
    sim_close(kit.bus.sim);
}

/* 8.3.7 of ILI9341: REV for the other kind of liquid crystal; NL, GS, SS. */
static void display_function_control_is_followed(void **state)
{
    (void)state;
    struct kit kit;
    REDRAW(&kit, &panel_ili9341_240x320, 0xB6, 0x08, 0x02, 0x27);
    for (int i = 0; i < 3 * 240 * 320; i++) {
        assert_int_equal(seen[i], 255 - other[i]);
    }
    sim_close(kit.bus.sim);
    REDRAW(&kit, &panel_ili9341_240x320, 0xB6, 0x08, 0xC2, 0x27);
    expect_mirrored(&kit, false, true);
    REDRAW(&kit, &panel_ili9341_240x320, 0xB6, 0x08, 0xA2, 0x27);
    expect_mirrored(&kit, true, false);
    REDRAW(&kit, &panel_ili9488_320x480, 0xB6, 0x02, 0x62, 0x3B);
    expect_mirrored(&kit, true, true);
    REDRAW(&kit, &panel_ili9488_320x480, 0xB6, 0x02, 0x02, 0x3A);
    assert_int_equal(at(&kit, 7, 472), 0);
    assert_memory_equal(seen, other, 3 * 320 * 472);
    sim_close(kit.bus.sim);
    REDRAW(&kit, &panel_st7796s_320x480, 0xB6, 0x80, 0x62, 0x3B);
    expect_mirrored(&kit, true, true);
    REDRAW(&kit, &panel_st7796s_320x480, 0xB6, 0x80, 0x02, 0x3A);
    assert_int_equal(at(&kit, 7, 472), 0);
    assert_memory_equal(seen, other, 3 * 320 * 472);
    sim_close(kit.bus.sim);
    REDRAW(&kit, &panel_gc9a01_240x240, 0xB6, 0x00, 0x60);
    expect_mirrored(&kit, true, true);
}

/* SSD1351 rev. 1.5, 10.1.20: ISEG = contrast / 256 * IREF, so a colour with 0 has no current. Table 9-1: A2h is 60h
 * after reset. */
static void contrast_0_is_dark_and_the_offset_is_not_0_after_reset(void **state)
{
    (void)state;
    struct kit kit;
    REDRAW(&kit, &panel_ssd1351_128x128, 0xC1, 0x00, 0x80, 0xC8);
    for (int i = 0; i < 128 * 128; i++) {
        assert_int_equal(seen[3 * i], 0);
        assert_memory_equal(seen + 3 * i + 1, other + 3 * i + 1, 2);
    }
    sim_close(kit.bus.sim);
    REDRAW(&kit, &panel_ssd1351_128x128, 0xA2, 0x60);
    assert_memory_equal(seen + 3 * 128 * 32, other, 3 * 128 * 96);
    sim_close(kit.bus.sim);
    REDRAW(&kit, &panel_ssd0323_128x64, 0x81, 0x00);
    assert_int_equal(at(&kit, 1, 0), 0);
    sim_close(kit.bus.sim);
    REDRAW(&kit, &panel_ssd0323_128x64, 0x81, 0x01);
    expect_mirrored(&kit, false, false);
}

/* ---- what is wrong ------------------------------------------------------------------------------ */

#define WRONG(panel, ...)                                                                                              \
    {                                                                                                                  \
        &(panel), (const uint8_t[]){__VA_ARGS__}, sizeof((const uint8_t[]){__VA_ARGS__})                               \
    }

/* A command that a maker's data sheet forbids, or whose effect the models do not follow. */
static const struct wrong {
    const struct panel *panel;
    const uint8_t *bytes; /* command, parameters */
    size_t n;
} wrong[] = {
    WRONG(panel_st7789_240x240, 0x36, 0x01),                      /* MADCTL D0 */
    WRONG(panel_st7789_240x240, 0x3A, 0xD5),                      /* COLMOD D7 */
    WRONG(panel_st7789_240x240, 0x3A, 0x5D),                      /* COLMOD D3 */
    WRONG(panel_st7789_240x240, 0x3A, 0x05),                      /* RGB interface's format 000 */
    WRONG(panel_st7789_240x240, 0x3A, 0x57),                      /* 16M truncated */
    WRONG(panel_st7789_240x240, 0x26, 0x02),                      /* GAMSET: another curve */
    WRONG(panel_st7789_240x240, 0xB0, 0x10, 0xE0),                /* RM: memory by the RGB interface */
    WRONG(panel_st7789_240x240, 0xB0, 0x01, 0xE0),                /* DM: display by the RGB interface */
    WRONG(panel_st7789_240x240, 0xB0, 0x04, 0xE0),                /* first byte, D2 */
    WRONG(panel_st7789_240x240, 0xB0, 0x00, 0x20),                /* second byte without its 11 */
    WRONG(panel_st7789_240x240, 0xB2, 0x00, 0x0C, 0, 0x33, 0x33), /* BPA: at least 1 */
    WRONG(panel_st7789_240x240, 0xB2, 0x0C, 0x0C, 2, 0x33, 0x33), /* third byte, D1 */
    WRONG(panel_st7789_240x240, 0xB7, 0x3D),                      /* GCTRL D3 */
    WRONG(panel_st7789_240x240, 0xBB, 0x5F),                      /* VCOMS D6 */
    WRONG(panel_st7789_240x240, 0xC0, 0xAC),                      /* LCMCTRL D7 */
    WRONG(panel_st7789_240x240, 0xC2, 0x01, 0xFE),                /* VDVVRHEN: FFh */
    WRONG(panel_st7789_240x240, 0xC3, 0x28),                      /* VRHS: 28h .. 3Fh are reserved */
    WRONG(panel_st7789_240x240, 0xC6, 0x2F),                      /* NLA: neither dot nor column inversion */
    WRONG(panel_st7789_240x240, 0xD0, 0xA0, 0xA1),                /* PWCTRL1: A4h */
    WRONG(panel_st7789_240x240, 0xD0, 0xA4, 0xE1),                /* AVDD 11 is reserved */
    WRONG(panel_st7789_240x240, 0xE4, 0x28, 0x00, 0x10),          /* NL: 320 lines at most */
    WRONG(panel_st7789_240x240, 0xE4, 0x27, 0x01, 0x10),          /* SCN */
    WRONG(panel_st7789_240x240, 0xE4, 0x27, 0x00, 0x14),          /* SM */
    WRONG(panel_gc9a01_240x240, 0xB6, 0x00, 0x80),                /* REV */
    WRONG(panel_gc9a01_240x240, 0xEB, 0x15),                      /* maker's 14h */
    WRONG(panel_gc9a01_240x240, 0x74, 0x10, 0x85, 0x80, 0x00, 0x00, 0x4E, 0x01),
    WRONG(panel_gc9a01_240x240, 0xF0, 0x45, 0x09, 0x08, 0x08, 0x26, 0x2B),
    WRONG(panel_ili9341_240x320, 0x36, 0x4A),                         /* MADCTL D1 */
    WRONG(panel_ili9341_240x320, 0x26, 0x02),                         /* GAMSET: reserved */
    WRONG(panel_ili9341_240x320, 0x3A, 0x53),                         /* DBI 011 is reserved */
    WRONG(panel_ili9341_240x320, 0xB1, 0x00, 0x0F),                   /* RTNA below 10h */
    WRONG(panel_ili9341_240x320, 0xB1, 0x04, 0x18),                   /* first byte, D2 */
    WRONG(panel_ili9341_240x320, 0xB6, 0x04, 0x82, 0x27),             /* PTG 01 is prohibited */
    WRONG(panel_ili9341_240x320, 0xB6, 0x08, 0x92, 0x27),             /* SM */
    WRONG(panel_ili9341_240x320, 0xB6, 0x08, 0x82, 0x28),             /* NL */
    WRONG(panel_ili9341_240x320, 0xC0, 0x02),                         /* VRH: 0 .. 2 are prohibited */
    WRONG(panel_ili9341_240x320, 0xC1, 0x14),                         /* BT: 4 .. 7 are not there */
    WRONG(panel_ili9341_240x320, 0xCB, 0x39, 0x2C, 0x00, 0x36, 0x02), /* REG_VD 110 is reserved */
    WRONG(panel_ili9341_240x320, 0xCF, 0x00, 0x41, 0x30),             /* second byte without its D7 */
    WRONG(panel_ili9341_240x320, 0xE8, 0x85, 0x00, 0x7B),             /* PC 11 is reserved */
    WRONG(panel_ili9341_240x320, 0xF2, 0x00),                         /* bit 1 must be 1 */
    WRONG(panel_ili9341_240x320, 0xF7, 0x10),                         /* ratio 01 is reserved */
    WRONG(panel_ili9488_320x480, 0x3A, 0x55),                         /* 16 bits a pixel over SPI */
    WRONG(panel_ili9488_320x480, 0xE9, 0x01),                         /* 24 bits a pixel */
    WRONG(panel_ili9488_320x480, 0xB6, 0x22, 0x02, 0x3B),             /* the RGB interface */
    WRONG(panel_ili9488_320x480, 0xB6, 0x02, 0x02, 0x3C),             /* NL: 480 lines at most */
    WRONG(panel_ili9488_320x480, 0xF7, 0xA9, 0x51, 0x2C, 0x02),
    WRONG(panel_st7796s_320x480, 0x3A, 0x53),                   /* 12 bits a pixel */
    WRONG(panel_st7796s_320x480, 0xB4, 0x03),                   /* DINV 11 is reserved */
    WRONG(panel_st7796s_320x480, 0xB5, 0x02, 0x01, 0x00, 0x04), /* VBP: at least 2 */
    WRONG(panel_st7796s_320x480, 0xB5, 0x02, 0x02, 0x01, 0x04), /* third byte */
    WRONG(panel_st7796s_320x480, 0xB6, 0xA0, 0x02, 0x3B),       /* RM: memory by the RGB interface */
    WRONG(panel_st7796s_320x480, 0xB6, 0x84, 0x02, 0x3B),       /* PTG 01 is prohibited */
    WRONG(panel_st7796s_320x480, 0xB6, 0x80, 0x02, 0x3C),       /* NL: 480 lines at most */
    WRONG(panel_st7796s_320x480, 0xB7, 0x8E),                   /* deep standby */
    WRONG(panel_st7796s_320x480, 0xB7, 0x82),                   /* GON 0: gates at VGH */
    WRONG(panel_st7796s_320x480, 0xC1, 0x28),                   /* VRH: 28h .. 3Fh are reserved */
    WRONG(panel_st7796s_320x480, 0xC2, 0x03),                   /* SOP 0: no operation */
    WRONG(panel_st7796s_320x480, 0xE8, 0x40, 0x8A, 0x00, 0x00, 0x39, 0x19, 0xA5, 0x33),
    WRONG(panel_st7796s_320x480, 0xF0, 0x97),             /* neither C3h, 96h, 3Ch nor 69h */
    WRONG(panel_ili9486_320x480, 0x3A, 0x56),             /* 18 bits a pixel: no word of 16 */
    WRONG(panel_ili9486_320x480, 0xC2, 0x33),             /* Linux' 44h */
    WRONG(panel_hx8357d_320x480, 0x3A, 0x53),             /* 12 bits a pixel */
    WRONG(panel_hx8357d_320x480, 0xB9, 0xFF, 0x83, 0x58), /* another key */
    WRONG(panel_hx8357d_320x480, 0xCC, 0x01),             /* SETPANEL: another scan than Adafruit's */
    WRONG(panel_st7735s_128x160, 0x36, 0x0A),             /* MADCTL D1 */
    WRONG(panel_st7735s_128x160, 0xB1, 0x01, 0x00, 0x2D), /* FPA: more than 0 */
    WRONG(panel_st7735s_128x160, 0xB4, 0x0F),             /* INVCTR D3 */
    WRONG(panel_st7735s_128x160, 0xC0, 0xA2, 0x02, 0xC4), /* MODE 11 */
    WRONG(panel_st7735s_128x160, 0xC0, 0xA2, 0x02, 0x80), /* D2 must be 1 */
    WRONG(panel_st7735s_128x160, 0xC1, 0xC7),             /* VGHBT 11 */
    WRONG(panel_st7735s_128x160, 0xC2, 0x0E, 0x00),       /* APA 110 is reserved */
    WRONG(panel_ssd1351_128x128, 0xA0, 0x7C),             /* A[3] */
    WRONG(panel_ssd1351_128x128, 0xA0, 0xF4),             /* 16-bit interface's format */
    WRONG(panel_ssd1351_128x128, 0xA1, 0x80),             /* start line 128 */
    WRONG(panel_ssd1351_128x128, 0xAB, 0x00),             /* VDD off while awake */
    WRONG(panel_ssd1351_128x128, 0xAB, 0x41),             /* 16-bit interface */
    WRONG(panel_ssd1351_128x128, 0xB1, 0x31),             /* phase 1: 0 and 1 are invalid */
    WRONG(panel_ssd1351_128x128, 0xB1, 0x22),             /* phase 2: 0 .. 2 are invalid */
    WRONG(panel_ssd1351_128x128, 0xB3, 0xFB),             /* divider: 11 .. 15 are invalid */
    WRONG(panel_ssd1351_128x128, 0xB4, 0xA1, 0xB5, 0x55), /* A[1:0]: 01 is invalid */
    WRONG(panel_ssd1351_128x128, 0xB6, 0x00),             /* 0 is invalid */
    WRONG(panel_ssd1351_128x128, 0xBE, 0x08),             /* A[3] */
    WRONG(panel_ssd1351_128x128, 0xCA, 0x0E),             /* 15 lines */
    WRONG(panel_ssd1351_128x128, 0xFD, 0x13),             /* neither 12h, 16h, B0h nor B1h */
    WRONG(panel_ssd0323_128x64, 0xA0, 0x5A),              /* A[3] */
    WRONG(panel_ssd0323_128x64, 0xA1, 0x50),              /* start line 80 */
    WRONG(panel_ssd0323_128x64, 0xA8, 0x0E),              /* 15 lines */
    WRONG(panel_ssd1306_128x64, 0x20, 0x00),              /* horizontal addressing is not followed */
    WRONG(panel_ssd1306_128x64, 0x20, 0x03),              /* invalid */
    WRONG(panel_ssd1306_128x64, 0x8D, 0x04),              /* A[4] must be 1 */
    WRONG(panel_ssd1306_128x64, 0x8D, 0x95),              /* A[7] and A[0] */
    WRONG(panel_ssd1306_128x64, 0xA8, 0x0E),              /* 15 lines */
    WRONG(panel_ssd1306_128x64, 0xD3, 0x40),              /* offset 64 */
    WRONG(panel_ssd1306_128x64, 0xD9, 0xF0),              /* phase 1: 0 is invalid */
    WRONG(panel_ssd1306_128x64, 0xDA, 0x10),              /* A[1] must be 1 */
    WRONG(panel_ssd1306_128x64, 0xDA, 0x32),              /* A[5]: sides exchanged */
    WRONG(panel_ssd1306_128x64, 0xDB, 0x40),              /* not in the table of VCOMH */
    WRONG(panel_ssd1309_128x64, 0xFD, 0x13),              /* A[0] */
    WRONG(panel_ssd1309_128x64, 0xD9, 0x0F),              /* phase 2: 0 is invalid */
    WRONG(panel_sh1106_128x64, 0xAD, 0x0B),               /* 8Ah or 8Bh */
    WRONG(panel_sh1106_128x64, 0xDA, 0x00),               /* D1 must be 1 */
    WRONG(panel_sh1107_128x128, 0xAD, 0x8B),              /* the converter inside */
    WRONG(panel_sh1107_128x128, 0xAD, 0x0A),              /* D7 must be 1 */
    WRONG(panel_sh1107_128x128, 0xA8, 0xFF),              /* D7 */
    WRONG(panel_sh1107_64x128, 0xDC, 0x80),               /* column 128 */
    WRONG(panel_ssd0323_128x64, 0xB8, 0x01, 0x11, 0x22, 0x32, 0x43, 0x54, 0x65, 0x75),
};

/* One complaint, which names the command; and the register stays what it was. */
static void wrong_commands_are_refused_and_have_no_effect(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        struct kit kit;
        char code[8];
        redraw_after(&kit, wrong[i].panel, wrong[i].bytes[0], wrong[i].bytes + 1, wrong[i].n - 1);
        snprintf(code, sizeof code, "%02Xh", wrong[i].bytes[0]);
        if (sim_complaint_count_of(kit.bus.sim, SIM_BAD_PARAMETER) != 1) {
            fail_msg("%s %s: no complaint", wrong[i].panel->name, code);
        }
        only(&kit.bus, SIM_BAD_PARAMETER, 1);
        if (strstr(sim_complaint(kit.bus.sim, 0), code) == NULL) {
            fail_msg("%s does not name %s", sim_complaint(kit.bus.sim, 0), code);
        }
        assert_memory_equal(seen, other, 3 * (size_t)kit.driver.width * kit.driver.height);
        sim_close(kit.bus.sim);
    }
}

/* 9.2.1 shows EPF with 16 bits a pixel only. */
static void twelve_bits_a_pixel_want_the_epf_that_is_known(void **state)
{
    static const uint8_t epf[] = {0xC0, 0xD0, 0xE0, 0xF0};
    (void)state;
    for (size_t i = 0; i < sizeof epf; i++) {
        struct kit kit;
        kit_open(&kit, &panel_st7789_240x240);
        SEND(&kit, 0xB0, 0x00, epf[i]);
        SEND(&kit, 0x3A, 0x53);
        command(&kit.bus, 0x2C);
        DATA(&kit.bus, "\x12\x34\x56");
        only(&kit.bus, SIM_BAD_PARAMETER, epf[i] != 0xE0);
        sim_close(kit.bus.sim);
    }
}

/* GC9A01A, 6.5: FEh and EFh one after the other; a reset closes again what they have opened. */
static void gc9a01_wants_its_registers_unlocked(void **state)
{
    (void)state;
    struct kit kit;
    kit_open(&kit, &panel_gc9a01_240x240);
    wake_dbi(&kit.bus);
    SEND(&kit, 0xEB, 0x14);
    only(&kit.bus, SIM_BAD_PARAMETER, 1);
    command(&kit.bus, 0xEF);
    SEND(&kit, 0xEB, 0x14);
    only(&kit.bus, SIM_BAD_PARAMETER, 2);
    command(&kit.bus, 0xFE);
    command(&kit.bus, 0x00);
    command(&kit.bus, 0xEF);
    SEND(&kit, 0xEB, 0x14);
    only(&kit.bus, SIM_BAD_PARAMETER, 3);
    command(&kit.bus, 0xFE);
    command(&kit.bus, 0xEF);
    command(&kit.bus, 0x00);
    SEND(&kit, 0xEB, 0x14);
    only(&kit.bus, SIM_BAD_PARAMETER, 3);
    sim_close(kit.bus.sim);
}

/* ST7796S v1.2, 9.3.23: C3h and 96h open a part of command table 2 each, 3Ch and 69h close it. */
static void st7796_wants_both_parts_of_table_2_unlocked(void **state)
{
    static const struct {
        uint8_t key;
        bool open;
    } keys[] = {{0x3C, false}, {0x69, false}, {0x96, false}, {0xC3, true}, {0x69, false},
                {0x96, true},  {0x3C, false}, {0x96, false}, {0xC3, true}};
    (void)state;
    struct kit kit;
    kit_open(&kit, &panel_st7796s_320x480); /* opens both */
    uint32_t refused = 0;
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        SEND(&kit, 0xF0, keys[i].key);
        SEND(&kit, 0xB4, 0x01);
        refused += !keys[i].open;
        only(&kit.bus, SIM_BAD_PARAMETER, refused);
    }
    sim_close(kit.bus.sim);
}

/* Adafruit_HX8357.cpp: SETEXTC before everything else, and SETPANEL 05h: red and blue, first and last line change
 * places. */
static void hx8357d_is_opened_and_turned_by_its_own_commands(void **state)
{
    (void)state;
    struct kit kit;
    kit_open(&kit, &panel_hx8357d_320x480);
    wake_dbi(&kit.bus);
    SEND(&kit, 0xCC, 0x05);
    only(&kit.bus, SIM_BAD_PARAMETER, 1);
    SEND(&kit, 0x36, 0xC0);
    draw(&kit);
    look(&kit, other);
    SEND(&kit, 0xB9, 0xFF, 0x83, 0x57);
    SEND(&kit, 0xCC, 0x05);
    look(&kit, seen);
    only(&kit.bus, SIM_BAD_PARAMETER, 1);
    for (uint32_t i = 0; i < 320 * 480; i++) {
        const uint8_t *const now = seen + 3 * i, *const was = other + 3 * ((479 - i / 320) * 320 + i % 320);
        assert_true(now[0] == was[2] && now[1] == was[1] && now[2] == was[0]);
    }
    sim_close(kit.bus.sim);
}

/* ST7735S v1.1, 10.1.2, 10.1.11, 10.1.12: 120 ms to the next command, where the others want 5. */
static void st7735s_wants_longer_waits(void **state)
{
    (void)state;
    static const uint8_t codes[] = {0x01, 0x11, 0x10};
    for (size_t i = 0; i < sizeof codes; i++) {
        struct kit kit;
        kit_open(&kit, &panel_st7735s_128x160);
        wait_ms(&kit.bus, 120);
        command(&kit.bus, codes[i]);
        wait_ms(&kit.bus, 119);
        command(&kit.bus, 0x00);
        only(&kit.bus, SIM_EARLY_COMMAND, 1);
        wait_ms(&kit.bus, 1);
        command(&kit.bus, 0x00);
        only(&kit.bus, SIM_EARLY_COMMAND, 1);
        sim_close(kit.bus.sim);
    }
}

/* ST7789V 9.1.2, ILI9341 8.2.2: no SWRESET during the sleep-out sequence. */
static void swreset_does_not_come_while_the_panel_wakes(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_ili9341_240x320);
    plug(&k);
    wait_ms(&k, 120);
    command(&k, 0x11);
    wait_ms(&k, 100);
    command(&k, 0x01);
    only(&k, SIM_EARLY_COMMAND, 1);
    sim_close(k.sim);
}

/* ---- every line of the tables ------------------------------------------------------------------- */

static const struct {
    const struct panel *panel;
    const struct sim_table *table;
} tables[] = {
    {&panel_st7789_240x240, &sim_table_st7789},   {&panel_gc9a01_240x240, &sim_table_gc9a01},
    {&panel_ili9341_240x320, &sim_table_ili9341}, {&panel_ili9488_320x480, &sim_table_ili9488},
    {&panel_st7796s_320x480, &sim_table_st7796},  {&panel_hx8357d_320x480, &sim_table_hx8357d},
    {&panel_st7735s_128x160, &sim_table_st7735s}, {&panel_ssd1351_128x128, &sim_table_ssd1351},
    {&panel_ssd0323_128x64, &sim_table_ssd0323},  {&panel_ssd1306_128x64, &sim_table_ssd1306},
    {&panel_ssd1309_128x64, &sim_table_ssd1309},  {&panel_sh1106_128x64, &sim_table_sh1106},
    {&panel_ili9486_320x480, &sim_table_ili9486}, {&panel_sh1107_64x128, &sim_table_sh1107},
};

/* Parameters that the table allows: the lowest value of each field, or the only ones. */
static void allowed(const struct sim_command *command, uint8_t *parameters)
{
    for (unsigned i = 0; i < command->most; i++) {
        parameters[i] = command->exact != NULL ? command->exact[i] : 0;
        for (unsigned f = 0; f < command->field_count; f++) {
            const struct sim_field *field = &command->fields[f];
            parameters[i] |= i + 1 >= field->first && i + 1 <= field->last ? field->least : 0;
        }
    }
}

/* The command, then a frame; how often the model has found a parameter wrong. */
static uint32_t frame_after(const struct panel *panel, const struct sim_command *c, const uint8_t *parameters,
                            uint8_t *pixels)
{
    static struct kit kit;
    kit_open(&kit, panel);
    send(&kit, c->code, parameters, c->most);
    draw(&kit);
    look(&kit, pixels);
    const uint32_t complaints = sim_complaint_count_of(kit.bus.sim, SIM_BAD_PARAMETER);
    sim_close(kit.bus.sim);
    return complaints;
}

/* The driver sends these with each frame, or they change what its bytes mean: they have tests of their own. */
static bool is_tested_elsewhere(uint8_t code)
{
    return code == 0x15 || code == 0x75 || code == 0x3A || code == 0xFD;
}

static bool is_lock(const struct sim_table *table, uint8_t code)
{
    return table == &sim_table_st7796 && code == 0xF0;
}

static void try_field(const struct panel *panel, const struct sim_command *c, const struct sim_field *f,
                      unsigned number)
{
    uint8_t parameters[SIM_PARAMETERS_MAX];
    allowed(c, parameters);
    const size_t bytes = 3 * (size_t)panel->width * panel->height;
    assert_int_equal(frame_after(panel, c, parameters, other), 0);
    parameters[number - 1] = (uint8_t)((parameters[number - 1] & ~f->bits) | f->most);
    assert_int_equal(frame_after(panel, c, parameters, seen), 0);
    const bool differs = memcmp(seen, other, bytes) != 0;
    if (differs != (f->effect == SIM_SHOWN && f->least != f->most)) {
        fail_msg("%s, %02Xh %s, %s: the picture %s", panel->name, c->code, c->name, f->name,
                 differs ? "changes" : "does not change");
    }
}

static void shown_fields_change_the_picture_and_others_do_not(void **state)
{
    (void)state;
    unsigned tried = 0;
    for (size_t t = 0; t < sizeof tables / sizeof tables[0]; t++) {
        for (size_t i = 0; i < tables[t].table->count; i++) {
            const struct sim_command *c = &tables[t].table->commands[i];
            for (unsigned f = 0;
                 f < c->field_count && !is_tested_elsewhere(c->code) && !is_lock(tables[t].table, c->code); f++) {
                try_field(tables[t].panel, c, &c->fields[f], c->fields[f].first);
                tried++;
            }
        }
    }
    assert_true(tried > 150);
}

/* A byte that is wrong by one bit, or beside its field's range: for every parameter of every command. */
static unsigned try_bytes(const struct panel *panel, const struct sim_command *c, struct kit *kit)
{
    unsigned refused = 0;
    for (unsigned number = 1; number <= c->most; number++) {
        uint8_t named = c->exact != NULL ? 0 : 255;
        for (unsigned value = 0; value < 256; value++) {
            uint8_t parameters[SIM_PARAMETERS_MAX];
            allowed(c, parameters);
            bool right = c->exact != NULL ? value == c->exact[number - 1] : true;
            for (unsigned f = 0; f < c->field_count; f++) {
                const struct sim_field *field = &c->fields[f];
                if (number >= field->first && number <= field->last) {
                    named &= (uint8_t)~field->bits;
                    right = right && (value & field->bits) >= field->least && (value & field->bits) <= field->most;
                }
            }
            right = right && (c->exact != NULL || (value & named) == 0);
            const uint32_t before = sim_complaint_count_of(kit->bus.sim, SIM_BAD_PARAMETER);
            parameters[number - 1] = (uint8_t)value;
            send(kit, c->code, parameters, c->most);
            if ((sim_complaint_count_of(kit->bus.sim, SIM_BAD_PARAMETER) == before) != right) {
                fail_msg("%s, %02Xh %s, parameter %u: %02Xh is %s", panel->name, c->code, c->name, number, value,
                         right ? "refused" : "accepted");
            }
            refused += !right;
        }
    }
    return refused;
}

static void no_other_byte_is_accepted(void **state)
{
    (void)state;
    unsigned refused = 0;
    for (size_t t = 0; t < sizeof tables / sizeof tables[0]; t++) {
        static struct kit kit;
        kit_open(&kit, tables[t].panel);
        for (size_t i = 0; i < tables[t].table->count; i++) {
            const struct sim_command *c = &tables[t].table->commands[i];
            if (c->most > 0 && c->most != SIM_PIXELS && !is_tested_elsewhere(c->code) &&
                !is_lock(tables[t].table, c->code)) {
                refused += try_bytes(tables[t].panel, c, &kit);
            }
        }
        sim_close(kit.bus.sim);
    }
    assert_true(refused > 20000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_epf_fills_red_and_blue_as_the_data_sheets_draw_it),
        cmocka_unit_test(colours_are_seen_as_they_were_sent),
        cmocka_unit_test(every_level_of_the_glass_has_one_value),
        cmocka_unit_test(f0_tints_a_part_of_turntable_and_nearly_all_of_ground),
        cmocka_unit_test(lcmctrl_turns_over_what_it_names),
        cmocka_unit_test(gatectrl_says_how_many_lines_are_driven_and_from_where),
        cmocka_unit_test(display_function_control_is_followed),
        cmocka_unit_test(contrast_0_is_dark_and_the_offset_is_not_0_after_reset),
        cmocka_unit_test(wrong_commands_are_refused_and_have_no_effect),
        cmocka_unit_test(twelve_bits_a_pixel_want_the_epf_that_is_known),
        cmocka_unit_test(gc9a01_wants_its_registers_unlocked),
        cmocka_unit_test(st7796_wants_both_parts_of_table_2_unlocked),
        cmocka_unit_test(hx8357d_is_opened_and_turned_by_its_own_commands),
        cmocka_unit_test(st7735s_wants_longer_waits),
        cmocka_unit_test(swreset_does_not_come_while_the_panel_wakes),
        cmocka_unit_test(shown_fields_change_the_picture_and_others_do_not),
        cmocka_unit_test(no_other_byte_is_accepted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
