/* The controller models by themselves: bytes sent by hand, as the datasheets describe them, and what is then seen. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "sim_bus.h"

/*
 * ST7789 240x240 on its IPS glass: red stored at column 2, row 1 is seen there only once inverted; swapped with blue by
 * MADCTL BGR.
 */
static void inversion_and_colour_order_are_seen(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    show_dbi(&k, 240 * 320, 0x0000);
    window(&k, "\0\x02\0\x02", "\0\x01\0\x01");
    command(&k, 0x2C);
    DATA(&k, "\xF8\x00");
    assert_int_equal(seen_at(&k, 240, 2, 1), 0x00FFFF);
    assert_int_equal(seen_at(&k, 240, 3, 1), 0xFFFFFF);
    command(&k, 0x21);
    assert_int_equal(seen_at(&k, 240, 2, 1), 0xFF0000);
    assert_int_equal(seen_at(&k, 240, 3, 1), 0x000000);
    command(&k, 0x36);
    DATA(&k, "\x08");
    assert_int_equal(seen_at(&k, 240, 2, 1), 0x0000FF);
    command(&k, 0x20);
    assert_int_equal(seen_at(&k, 240, 2, 1), 0xFFFF00);
    none(&k);
    sim_close(k.sim);
}

/* Two pixels at the start of the window, for all values of MY MX MV: where do they come to lie in 240 x 320? */
static void memory_access_control_mirrors_and_swaps(void **state)
{
    (void)state;
    static const struct {
        char madctl;
        uint16_t x[2], y[2];
    } cases[] = {
        {'\x00', {2, 3}, {5, 5}},         {'\x40', {237, 236}, {5, 5}},     {'\x80', {2, 3}, {314, 314}},
        {'\xC0', {237, 236}, {314, 314}}, {'\x20', {5, 5}, {2, 3}},         {'\x60', {234, 234}, {2, 3}},
        {'\xA0', {5, 5}, {317, 316}},     {'\xE0', {234, 234}, {317, 316}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct sim_bus k = sim_bus_with(&panel_st7789_240x320);
        plug(&k);
        wake_dbi(&k);
        command(&k, 0x21);
        show_dbi(&k, 240 * 320, 0x0000);
        command(&k, 0x36);
        data(&k, &cases[i].madctl, 1);
        window(&k, "\0\x02\0\x03", "\0\x05\0\x05");
        command(&k, 0x2C);
        DATA(&k, "\xF8\x00\x07\xE0");
        assert_int_equal(seen_at(&k, 240, cases[i].x[0], cases[i].y[0]), 0xFF0000);
        assert_int_equal(seen_at(&k, 240, cases[i].x[1], cases[i].y[1]), 0x00FF00);
        none(&k);
        sim_close(k.sim);
    }
}

/* 135 x 240 of the memory are seen, from column 52 and row 40 on. */
static void the_glass_shows_a_part_of_the_memory(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_135x240);
    plug(&k);
    wake_dbi(&k);
    command(&k, 0x21);
    show_dbi(&k, 240 * 320, 0x0000);
    window(&k, "\0\x33\0\x34", "\0\x28\0\x28"); /* columns 51 and 52 of row 40 */
    command(&k, 0x2C);
    DATA(&k, "\xFF\xFF\xF8\x00");
    assert_int_equal(seen_at(&k, 135, 0, 0), 0xFF0000);
    window(&k, "\0\xBA\0\xBB", "\x01\x17\x01\x17"); /* columns 186 and 187 of row 279 */
    command(&k, 0x2C);
    DATA(&k, "\x00\x1F\xFF\xFF");
    assert_int_equal(seen_at(&k, 135, 134, 239), 0x0000FF);
    static uint8_t pixels[3 * 135 * 240];
    sim_pixels(k.sim, PANEL_R0, pixels);
    uint32_t lit = 0;
    for (uint32_t i = 0; i < 135 * 240; i++) {
        lit += pixels[3 * i] != 0 || pixels[3 * i + 1] != 0 || pixels[3 * i + 2] != 0;
    }
    assert_int_equal(lit, 2);
    none(&k);
    sim_close(k.sim);
}

static void formats_are_decoded(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x320);
    plug(&k);
    wake_dbi(&k);
    command(&k, 0x21);
    show_dbi(&k, 240 * 320, 0x0000);
    command(&k, 0x3A);
    DATA(&k, "\x53");
    window(&k, "\0\0\0\x02", "\0\0\0\0");
    command(&k, 0x2C);
    DATA(&k, "\x12\x34\x56\xFE\xD0"); /* 123 456 FED, four bits left over */
    assert_int_equal(seen_at(&k, 240, 0, 0), 0x112233);
    assert_int_equal(seen_at(&k, 240, 1, 0), 0x445566);
    assert_int_equal(seen_at(&k, 240, 2, 0), 0xFFEEDD);
    command(&k, 0x3A);
    DATA(&k, "\x66");
    window(&k, "\0\0\0\0", "\0\0\0\0");
    command(&k, 0x2C);
    DATA(&k, "\x83\x40\xFC"); /* the lowest two bits do not count */
    assert_int_equal(seen_at(&k, 240, 0, 0), 0x8241FF);
    command(&k, 0x3A);
    DATA(&k, "\x55");
    command(&k, 0xB0); /* RAMCTRL: low byte first */
    DATA(&k, "\x00\xE8");
    command(&k, 0x2C);
    DATA(&k, "\x00\xF8");
    assert_int_equal(seen_at(&k, 240, 0, 0), 0xFF0000);
    none(&k);
    sim_close(k.sim);
}

/* After SWRESET: 18 bits a pixel, no mirroring, not inverted, the window is the whole memory. */
static void software_reset_restores_the_registers(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x320);
    plug(&k);
    wake_dbi(&k);
    command(&k, 0x21);
    command(&k, 0x36);
    DATA(&k, "\xC0");
    window(&k, "\0\x02\0\x03", "\0\x05\0\x05");
    command(&k, 0x01);
    wait_ms(&k, 120);
    command(&k, 0x11);
    wait_ms(&k, 120);
    command(&k, 0x2C);
    for (uint32_t i = 0; i < 240 * 320; i++) {
        data(&k, i == 241 ? "\xFC\0" : "\0\0", 3);
    }
    command(&k, 0x29);
    pin(&k, HAL_PIN_BACKLIGHT, true);
    assert_int_equal(seen_at(&k, 240, 0, 0), 0xFFFFFF);
    assert_int_equal(seen_at(&k, 240, 1, 1), 0x00FFFF);
    none(&k);
    sim_close(k.sim);
}

static void memory_write_continues_after_other_commands(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x320);
    plug(&k);
    wake_dbi(&k);
    command(&k, 0x21);
    show_dbi(&k, 240 * 320, 0x0000);
    window(&k, "\0\x07\0\x08", "\0\x01\0\x02");
    command(&k, 0x2C);
    DATA(&k, "\xF8\x00");
    command(&k, 0x00);
    command(&k, 0x3C);
    DATA(&k, "\x07\xE0\x00\x1F");
    assert_int_equal(seen_at(&k, 240, 7, 1), 0xFF0000);
    assert_int_equal(seen_at(&k, 240, 8, 1), 0x00FF00);
    assert_int_equal(seen_at(&k, 240, 7, 2), 0x0000FF);
    none(&k);
    sim_close(k.sim);
}

static void ili9488_takes_three_and_eighteen_bits(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_ili9488_320x480);
    plug(&k);
    wake_dbi(&k);
    only(&k, SIM_BAD_PARAMETER, 1); /* 16 bits */
    command(&k, 0x3A);
    DATA(&k, "\x11");
    command(&k, 0x36);
    DATA(&k, "\x48");
    window(&k, "\0\0\0\x01", "\0\0\0\0");
    command(&k, 0x2C);
    DATA(&k, "\x21"); /* xx100001: red, blue */
    assert_int_equal(sim_counters(k.sim).pixels, 2);
    only(&k, SIM_BAD_PARAMETER, 1);
    sim_close(k.sim);
}

/* ILI9341: this glass begins at the right of the memory, and starts with blue. B6h's second parameter: GS 40h, SS 20h.
 */
static void display_function_control_turns_the_scan(void **state)
{
    (void)state;
    static const struct {
        const char *parameters;
        uint32_t x, y;
    } cases[] = {{"\x08\x82\x27", 237, 5}, {"\x08\xA2\x27", 2, 5}, {"\x08\xC2\x27", 237, 314}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct sim_bus k = sim_bus_with(&panel_ili9341_240x320);
        plug(&k);
        wake_dbi(&k);
        show_dbi(&k, 240 * 320, 0x0000);
        command(&k, 0x36);
        DATA(&k, "\x08");
        command(&k, 0xB6);
        data(&k, cases[i].parameters, 3);
        window(&k, "\0\x02\0\x02", "\0\x05\0\x05");
        command(&k, 0x2C);
        DATA(&k, "\xF8\x00");
        assert_int_equal(seen_at(&k, 240, cases[i].x, cases[i].y), 0xFF0000);
        none(&k);
        sim_close(k.sim);
    }
}

static void what_is_off_or_asleep_is_dark(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    assert_int_equal(seen_at(&k, 240, 9, 9), 0);
    wake_dbi(&k);
    command(&k, 0x21);
    fill_dbi(&k, 240 * 320, 0xFFFF);
    assert_int_equal(seen_at(&k, 240, 9, 9), 0);
    command(&k, 0x29);
    assert_int_equal(seen_at(&k, 240, 9, 9), 0);
    pin(&k, HAL_PIN_BACKLIGHT, true);
    assert_int_equal(seen_at(&k, 240, 9, 9), 0xFFFFFF);
    pin(&k, HAL_PIN_BACKLIGHT, false);
    assert_int_equal(seen_at(&k, 240, 9, 9), 0);
    pin(&k, HAL_PIN_BACKLIGHT, true);
    command(&k, 0x28);
    assert_int_equal(seen_at(&k, 240, 9, 9), 0);
    command(&k, 0x29);
    assert_int_equal(seen_at(&k, 240, 9, 9), 0xFFFFFF);
    command(&k, 0x10);
    assert_int_equal(seen_at(&k, 240, 9, 9), 0);
    wait_ms(&k, 120);
    command(&k, 0x11);
    assert_int_equal(seen_at(&k, 240, 9, 9), 0xFFFFFF);
    wait_ms(&k, 120);
    pin(&k, HAL_PIN_RESET, false);
    assert_int_equal(seen_at(&k, 240, 9, 9), 0);
    none(&k);
    sim_close(k.sim);
}

static void memory_is_noise_after_power_on(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    command(&k, 0x29);
    pin(&k, HAL_PIN_BACKLIGHT, true);
    uint32_t differing = 0;
    for (uint32_t i = 0; i < 100; i++) {
        differing += seen_at(&k, 240, i, 0) != seen_at(&k, 240, i + 1, 0);
    }
    assert_true(differing > 90);
    assert_int_equal(sim_complaint_count_of(k.sim, SIM_ON_WITHOUT_FRAME), 1);
    assert_int_equal(sim_complaint_count_of(k.sim, SIM_LIT_WITHOUT_FRAME), 1);
    assert_int_equal(sim_complaint_count(k.sim), 2);
    sim_close(k.sim);
}

/* SSD1351: 0x74 is upright on its modules; 0x75 counts downwards first; 0x76 mirrors; 0x70 swaps red and blue. */
static void ssd1351_remaps(void **state)
{
    (void)state;
    static const struct {
        char remap;
        uint16_t x[2], y[2];
        uint32_t first;
    } cases[] = {
        {'\x74', {4, 5}, {6, 6}, 0xFF0000},     {'\x75', {4, 4}, {6, 7}, 0xFF0000},
        {'\x76', {123, 122}, {6, 6}, 0xFF0000}, {'\x64', {4, 5}, {121, 121}, 0xFF0000},
        {'\x70', {4, 5}, {6, 6}, 0x0000FF},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct sim_bus k = sim_bus_with(&panel_ssd1351_128x128);
        plug(&k);
        wake_ssd1351(&k);
        command(&k, 0xA0);
        data(&k, &cases[i].remap, 1);
        command(&k, 0x5C);
        for (uint32_t n = 0; n < 128 * 128; n++) {
            DATA(&k, "\0\0");
        }
        command(&k, 0xAF);
        command(&k, 0x15);
        DATA(&k, "\x04\x05");
        command(&k, 0x75);
        DATA(&k, "\x06\x07");
        command(&k, 0x5C);
        DATA(&k, "\xF8\x00\x07\xE0");
        assert_int_equal(seen_at(&k, 128, cases[i].x[0], cases[i].y[0]), cases[i].first);
        assert_int_equal(seen_at(&k, 128, cases[i].x[1], cases[i].y[1]), 0x00FF00);
        none(&k);
        sim_close(k.sim);
    }
}

/* Start line, COM lines that are not split to both sides, and fewer lines than the glass has. */
static void ssd1351_moves_lines(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_ssd1351_128x128);
    plug(&k);
    wake_ssd1351(&k);
    command(&k, 0xA0);
    DATA(&k, "\x74");
    command(&k, 0x5C);
    for (uint32_t n = 0; n < 128 * 128; n++) { /* line 6 is red */
        data(&k, n / 128 == 6 ? "\xF8" : "\0\0", 2);
    }
    command(&k, 0xAF);
    assert_int_equal(seen_at(&k, 128, 0, 6), 0xFF0000);
    command(&k, 0xA1);
    DATA(&k, "\x02");
    assert_int_equal(seen_at(&k, 128, 0, 4), 0xFF0000);
    command(&k, 0xA1);
    DATA(&k, "\x00");
    command(&k, 0xA0);
    DATA(&k, "\x54");
    assert_int_equal(seen_at(&k, 128, 0, 12), 0xFF0000);
    command(&k, 0xA0);
    DATA(&k, "\x74");
    command(&k, 0xA1);
    DATA(&k, "\x72");
    assert_int_equal(seen_at(&k, 128, 0, 20), 0xFF0000);
    command(&k, 0xCA);
    DATA(&k, "\x0F"); /* 16 lines */
    assert_int_equal(seen_at(&k, 128, 0, 20), 0x000000);
    none(&k);
    sim_close(k.sim);
}

static void ssd1351_locks_commands(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_ssd1351_128x128);
    plug(&k);
    wait_ms(&k, 1);
    command(&k, 0xB3);
    DATA(&k, "\xF1");
    only(&k, SIM_BAD_PARAMETER, 1);
    for (int locked = 1; locked >= 0; locked--) { /* 10.1.22 names them */
        command(&k, 0xA2);
        DATA(&k, "\x00");
        command(&k, 0xB1);
        DATA(&k, "\x32");
        command(&k, 0xBB);
        DATA(&k, "\x17");
        command(&k, 0xBE);
        DATA(&k, "\x05");
        command(&k, 0xC1);
        DATA(&k, "\xC8\x80\xC8");
        only(&k, SIM_BAD_PARAMETER, 6);
        command(&k, 0xFD);
        DATA(&k, "\xB1");
    }
    command(&k, 0xB3);
    DATA(&k, "\xF1");
    only(&k, SIM_BAD_PARAMETER, 6);
    command(&k, 0xFD);
    DATA(&k, "\x16");
    command(&k, 0xA6);
    only(&k, SIM_BAD_PARAMETER, 7);
    sim_close(k.sim);
}

/* SSD0323: parameters with D/C low, a byte is two pixels. 52h is upright with the high half at the left. */
static void ssd0323_takes_two_greys_a_byte(void **state)
{
    (void)state;
    static const uint8_t set_up[] = {0xA8, 0x3F, 0xA2, 0x4C, 0xA0, 0x52};
    static const uint8_t corner[] = {0x15, 2, 3, 0x75, 5, 5};
    struct sim_bus k = sim_bus_with(&panel_ssd0323_128x64);
    plug(&k);
    wait_ms(&k, 1);
    k.hal.ops->bus_write(k.hal.context, HAL_COMMAND, set_up, sizeof set_up);
    for (uint32_t i = 0; i < 64 * 80; i++) {
        DATA(&k, "\0");
    }
    command(&k, 0xAF);
    k.hal.ops->bus_write(k.hal.context, HAL_COMMAND, corner, sizeof corner);
    DATA(&k, "\x1F\xA0");
    assert_int_equal(seen_at(&k, 128, 4, 5), 0x111111);
    assert_int_equal(seen_at(&k, 128, 5, 5), 0xFFFFFF);
    assert_int_equal(seen_at(&k, 128, 6, 5), 0xAAAAAA);
    assert_int_equal(seen_at(&k, 128, 7, 5), 0x000000);
    command(&k, 0xA7);
    assert_int_equal(seen_at(&k, 128, 4, 5), 0xEEEEEE);
    static const uint8_t not_split[] = {0xA4, 0xA0, 0x12};
    k.hal.ops->bus_write(k.hal.context, HAL_COMMAND, not_split, sizeof not_split);
    assert_int_equal(seen_at(&k, 128, 4, 10), 0x111111);
    none(&k);
    sim_close(k.sim);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inversion_and_colour_order_are_seen),
        cmocka_unit_test(memory_access_control_mirrors_and_swaps),
        cmocka_unit_test(the_glass_shows_a_part_of_the_memory),
        cmocka_unit_test(formats_are_decoded),
        cmocka_unit_test(software_reset_restores_the_registers),
        cmocka_unit_test(memory_write_continues_after_other_commands),
        cmocka_unit_test(ili9488_takes_three_and_eighteen_bits),
        cmocka_unit_test(display_function_control_turns_the_scan),
        cmocka_unit_test(what_is_off_or_asleep_is_dark),
        cmocka_unit_test(memory_is_noise_after_power_on),
        cmocka_unit_test(ssd1351_remaps),
        cmocka_unit_test(ssd1351_moves_lines),
        cmocka_unit_test(ssd1351_locks_commands),
        cmocka_unit_test(ssd0323_takes_two_greys_a_byte),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
