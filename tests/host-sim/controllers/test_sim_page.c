/* sim_page: SSD1306, SSD1309, SH1106 and SH1107 by themselves: bytes sent by hand, as the data sheets describe them,
 * what is then seen, and what is told of bytes that a controller would not take. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "sim_bus.h"

static void commands(struct sim_bus *k, const uint8_t *codes, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        command(k, codes[i]);
    }
}

#define COMMANDS(k, ...) commands((k), (const uint8_t[]){__VA_ARGS__}, sizeof((const uint8_t[]){__VA_ARGS__}))

/* A panel that shows a black picture: pages of zeros, supply and display on, upright. */
static void open_dark(struct sim_bus *k, const struct panel *panel)
{
    *k = sim_bus_with(panel);
    plug(k);
    wait_ms(k, 1);
    COMMANDS(k, 0xA1, 0xC8);
    for (unsigned page = 0; page < 8; page++) {
        COMMANDS(k, (uint8_t)(0xB0 | page), 0x00, 0x10);
        for (unsigned column = 0; column < panel->ram_width; column++) {
            DATA(k, "\0");
        }
    }
    if (panel == &panel_ssd1306_128x64 || panel == &panel_ssd1306_128x32) {
        COMMANDS(k, 0x8D, 0x14);
    }
    command(k, 0xAF);
    none(k);
}

/* A byte has 8 lines, the upper one in bit 0; the next byte is the column to its right. */
static void bit_0_is_the_upper_line(void **state)
{
    static const struct panel *const panels[] = {&panel_ssd1306_128x64, &panel_ssd1309_128x64, &panel_sh1106_128x64};
    (void)state;
    for (int i = 0; i < 3; i++) {
        const unsigned left = i == 2 ? 2 : 0; /* SH1106: columns 2 .. 129 of 132 */
        struct sim_bus k;
        open_dark(&k, panels[i]);
        COMMANDS(&k, 0xB3, (uint8_t)(0x05 + left), 0x12);
        DATA(&k, "\x01\x80");
        for (unsigned y = 0; y < 64; y++) {
            for (unsigned x = 0; x < 128; x++) {
                const bool lit = (x == 0x25 && y == 24) || (x == 0x26 && y == 31);
                assert_int_equal(seen_at(&k, 128, x, y), lit ? 0xFFFFFF : 0);
            }
        }
        none(&k);
        sim_close(k.sim);
    }
}

/* A0h and A1h hold for bytes that come after them, C0h and C8h at once (SSD1306, 10.1.8 and 10.1.14). */
static void mirrors(void **state)
{
    (void)state;
    struct sim_bus k;
    open_dark(&k, &panel_ssd1306_128x64);
    COMMANDS(&k, 0xB0, 0x00, 0x10);
    DATA(&k, "\x02");
    assert_int_equal(seen_at(&k, 128, 0, 1), 0xFFFFFF);
    command(&k, 0xA0);
    assert_int_equal(seen_at(&k, 128, 0, 1), 0xFFFFFF);
    COMMANDS(&k, 0xB0, 0x00, 0x10);
    DATA(&k, "\x04");
    assert_int_equal(seen_at(&k, 128, 127, 2), 0xFFFFFF);
    command(&k, 0xC0);
    assert_int_equal(seen_at(&k, 128, 0, 62), 0xFFFFFF);
    assert_int_equal(seen_at(&k, 128, 127, 61), 0xFFFFFF);
    none(&k);
    sim_close(k.sim);
}

/* Start line, offset, fewer lines, COM lines in another order. Line 24 is lit in column 0. */
static void lines_move(void **state)
{
    (void)state;
    struct sim_bus k;
    open_dark(&k, &panel_ssd1306_128x64);
    COMMANDS(&k, 0xB3, 0x00, 0x10);
    DATA(&k, "\x01");
    command(&k, 0x48); /* line 8 is the first */
    assert_int_equal(seen_at(&k, 128, 0, 16), 0xFFFFFF);
    COMMANDS(&k, 0x40, 0xD3, 0x3F);
    assert_int_equal(seen_at(&k, 128, 0, 25), 0xFFFFFF);
    COMMANDS(&k, 0xD3, 0x00, 0xDA, 0x02); /* COM 39, the 20th of the odd ones, shows what was 19 + 32 */
    assert_int_equal(seen_at(&k, 128, 0, 24), 0);
    COMMANDS(&k, 0xDA, 0x12, 0xA8, 0x0F); /* 16 lines: the lowest of the glass */
    for (unsigned y = 0; y < 48; y++) {
        assert_int_equal(seen_at(&k, 128, 0, y), 0);
    }
    COMMANDS(&k, 0xD3, 0x3F); /* these are COM63, 0 .. 14 with C8h */
    command(&k, 0xA7);
    for (unsigned y = 0; y < 64; y++) {
        assert_int_equal(seen_at(&k, 128, 5, y), y == 0 || y >= 49 ? 0xFFFFFF : 0);
    }
    none(&k);
    sim_close(k.sim);
}

static void modes(void **state)
{
    (void)state;
    struct sim_bus k;
    open_dark(&k, &panel_ssd1306_128x64);
    command(&k, 0xA7);
    assert_int_equal(seen_at(&k, 128, 5, 5), 0xFFFFFF);
    command(&k, 0xA5);
    assert_int_equal(seen_at(&k, 128, 5, 5), 0);
    command(&k, 0xA6);
    assert_int_equal(seen_at(&k, 128, 5, 5), 0xFFFFFF);
    COMMANDS(&k, 0x8D, 0x10); /* no charge pump */
    assert_int_equal(seen_at(&k, 128, 5, 5), 0);
    COMMANDS(&k, 0x8D, 0x14, 0xAE);
    assert_int_equal(seen_at(&k, 128, 5, 5), 0);
    none(&k);
    sim_close(k.sim);
    open_dark(&k, &panel_sh1106_128x64);
    COMMANDS(&k, 0xA5);
    assert_int_equal(seen_at(&k, 128, 5, 5), 0xFFFFFF);
    COMMANDS(&k, 0xAD, 0x8A);
    assert_int_equal(seen_at(&k, 128, 5, 5), 0);
    none(&k);
    sim_close(k.sim);
}

static void what_is_wrong_is_told(void **state)
{
    (void)state;
    static const uint8_t unknown[] = {0x21, 0x22, 0x30, 0x82, 0xB8, 0xC1, 0xFD};
    for (size_t i = 0; i < sizeof unknown; i++) {
        struct sim_bus k;
        open_dark(&k, &panel_ssd1306_128x64);
        command(&k, unknown[i]);
        only(&k, SIM_UNKNOWN_COMMAND, 1);
        sim_close(k.sim);
    }
    struct sim_bus k;
    open_dark(&k, &panel_ssd1306_128x64);
    COMMANDS(&k, 0x0F, 0x17);
    DATA(&k, "\xFF\xFF"); /* column 127, and one more */
    only(&k, SIM_TOO_MANY_PIXELS, 1);
    sim_close(k.sim);

    open_dark(&k, &panel_sh1106_128x64);
    COMMANDS(&k, 0x03, 0x18); /* 131 is the last */
    DATA(&k, "\xFF");
    none(&k);
    COMMANDS(&k, 0x04, 0x18);
    only(&k, SIM_WINDOW_OUTSIDE, 1);
    sim_close(k.sim);

    open_dark(&k, &panel_ssd1306_128x64);
    COMMANDS(&k, 0x00, 0x10, 0x81);
    DATA(&k, "\xFF"); /* a parameter comes with D/C low */
    only(&k, SIM_PARAMETER_COUNT, 1);
    sim_close(k.sim);

    k = sim_bus_with(&panel_ssd1306_128x64);
    plug(&k);
    wait_ms(&k, 1);
    command(&k, 0xAF);
    only(&k, SIM_ON_WITHOUT_FRAME, 1);
    sim_close(k.sim);
}

/* FDh 16h: all but FDh has no effect, nor has its parameter. */
static void an_ssd1309_can_be_locked(void **state)
{
    (void)state;
    struct sim_bus k;
    open_dark(&k, &panel_ssd1309_128x64);
    COMMANDS(&k, 0xFD, 0x16, 0xA7, 0xA8, 0x0F);
    assert_int_equal(seen_at(&k, 128, 5, 5), 0);
    only(&k, SIM_BAD_PARAMETER, 2);
    COMMANDS(&k, 0xFD, 0x12, 0xA7);
    assert_int_equal(seen_at(&k, 128, 5, 5), 0xFFFFFF);
    only(&k, SIM_BAD_PARAMETER, 2);
    sim_close(k.sim);
}

static void glasses_have_their_place(void **state)
{
    (void)state;
    struct sim_bus k;
    open_dark(&k, &panel_ssd1306_128x32); /* COM0 .. 31, in their order */
    COMMANDS(&k, 0xDA, 0x02, 0xA8, 0x1F, 0xB3, 0x00, 0x10);
    DATA(&k, "\x80");
    assert_int_equal(seen_at(&k, 128, 0, 31), 0xFFFFFF);
    none(&k);
    sim_close(k.sim);
}

/* An SH1107 with a black picture, upright as its memory is. */
static void open_dark_sh1107(struct sim_bus *k, const struct panel *panel)
{
    *k = sim_bus_with(panel);
    plug(k);
    wait_ms(k, 1);
    command(k, 0x20);
    for (unsigned page = 0; page < 16; page++) {
        COMMANDS(k, (uint8_t)(0xB0 | page), 0x00, 0x10);
        for (unsigned column = 0; column < 128; column++) {
            DATA(k, "\0");
        }
    }
    command(k, 0xAF);
    none(k);
}

/* Fails unless (x, y) is the only place that is lit. x = NOWHERE: nothing is. */
enum { NOWHERE = 999 };
static void only_lit(struct sim_bus *k, unsigned width, unsigned x, unsigned y)
{
    static uint8_t rgb[3 * 128 * 128];
    sim_pixels(k->sim, PANEL_R0, rgb);
    for (unsigned v = 0; v < 128; v++) {
        for (unsigned u = 0; u < width; u++) {
            assert_int_equal(rgb[3 * (v * width + u)], u == x && v == y ? 255 : 0);
        }
    }
    none(k);
}

/* Its columns are COM lines: C8h mirrors columns at once, A1h mirrors rows for bytes that come after it. */
static void columns_of_an_sh1107_are_com_lines(void **state)
{
    (void)state;
    struct sim_bus k;
    open_dark_sh1107(&k, &panel_sh1107_128x128);
    COMMANDS(&k, 0xBF, 0x05, 0x12);
    DATA(&k, "\x02"); /* column 25h, row 121 */
    only_lit(&k, 128, 0x25, 121);
    command(&k, 0xC8);
    only_lit(&k, 128, 127 - 0x25, 121);
    COMMANDS(&k, 0xC0, 0xA1);
    only_lit(&k, 128, 0x25, 121);
    COMMANDS(&k, 0xB0, 0x05, 0x12);
    DATA(&k, "\x40"); /* row 6 is row 121 now */
    only_lit(&k, 128, 0x25, 121);
    DATA(&k, "\x01");
    assert_int_equal(seen_at(&k, 128, 0x26, 127), 0xFFFFFF);
    sim_close(k.sim);
}

/* Start line, offset and multiplex ratio count columns. */
static void columns_of_an_sh1107_move(void **state)
{
    (void)state;
    struct sim_bus k;
    open_dark_sh1107(&k, &panel_sh1107_128x128);
    COMMANDS(&k, 0xB0, 0x05, 0x12);
    DATA(&k, "\x01");
    COMMANDS(&k, 0xDC, 0x07);
    only_lit(&k, 128, 0x25 - 7, 0);
    COMMANDS(&k, 0xDC, 0x00, 0xD3, 0x10); /* the data sheet: COM16 moves to COM0 */
    only_lit(&k, 128, 0x25 - 16, 0);
    COMMANDS(&k, 0xD3, 0x00, 0xA8, 0x24);
    only_lit(&k, 128, NOWHERE, 0);
    COMMANDS(&k, 0xA8, 0x25);
    only_lit(&k, 128, 0x25, 0);
    command(&k, 0xC8);
    only_lit(&k, 128, 0, 0); /* from the last of 26 lines */
    sim_close(k.sim);
}

/* The glass of 64 columns is bonded to COM32 .. 95. Of 64 lines, an offset of 60h moves C0h's there and one of 20h
 * C8h's. */
static void a_glass_of_64_columns_is_in_the_middle(void **state)
{
    (void)state;
    struct sim_bus k;
    open_dark_sh1107(&k, &panel_sh1107_64x128);
    COMMANDS(&k, 0xB0, 0x01, 0x10);
    DATA(&k, "\x01"); /* column 1 */
    only_lit(&k, 64, NOWHERE, 0);
    COMMANDS(&k, 0xA8, 0x3F, 0xD3, 0x60);
    only_lit(&k, 64, 1, 0);
    command(&k, 0xC8);
    command(&k, 0xA7);
    only_lit(&k, 64, NOWHERE, 0); /* no line of the glass is driven, not even inverse */
    COMMANDS(&k, 0xA6, 0xD3, 0x20);
    only_lit(&k, 64, 62, 0);
    COMMANDS(&k, 0xC0, 0xA8, 0x7F, 0xD3, 0x00, 0xB0, 0x01, 0x12);
    DATA(&k, "\x80"); /* column 33 */
    only_lit(&k, 64, 1, 7);
    command(&k, 0xC8); /* columns 95 .. 32 */
    only_lit(&k, 64, 62, 7);
    sim_close(k.sim);
}

static void an_sh1107_takes_no_command_of_others(void **state)
{
    (void)state;
    static const uint8_t unknown[] = {0x21, 0x22, 0x2E, 0x30, 0x40, 0x7F, 0x8D, 0xC1, 0xDA, 0xFD};
    struct sim_bus k;
    for (size_t i = 0; i < sizeof unknown; i++) {
        open_dark_sh1107(&k, &panel_sh1107_128x128);
        command(&k, unknown[i]);
        only(&k, SIM_UNKNOWN_COMMAND, 1);
        sim_close(k.sim);
    }
    open_dark_sh1107(&k, &panel_sh1107_128x128);
    COMMANDS(&k, 0x0F, 0x17); /* 127 is the last */
    DATA(&k, "\xFF");
    none(&k);
    COMMANDS(&k, 0x00, 0x18);
    only(&k, SIM_WINDOW_OUTSIDE, 1);
    sim_close(k.sim);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bit_0_is_the_upper_line),
        cmocka_unit_test(mirrors),
        cmocka_unit_test(lines_move),
        cmocka_unit_test(modes),
        cmocka_unit_test(what_is_wrong_is_told),
        cmocka_unit_test(an_ssd1309_can_be_locked),
        cmocka_unit_test(glasses_have_their_place),
        cmocka_unit_test(columns_of_an_sh1107_are_com_lines),
        cmocka_unit_test(columns_of_an_sh1107_move),
        cmocka_unit_test(a_glass_of_64_columns_is_in_the_middle),
        cmocka_unit_test(an_sh1107_takes_no_command_of_others),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
