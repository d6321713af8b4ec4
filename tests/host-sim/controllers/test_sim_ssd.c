/* sim_ssd: SSD1351 and SSD0323 by themselves: bytes sent by hand, as the data sheets describe them, what is then seen,
 * and what is told of bytes that a controller would not take. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "sim_bus.h"

#include <string.h>

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

static void unknown_commands_are_named(void **state)
{
    (void)state;
    struct sim_bus oled = sim_bus_with(&panel_ssd0323_128x64);
    plug(&oled);
    wait_ms(&oled, 1);
    command(&oled, 0x5C);
    only(&oled, SIM_UNKNOWN_COMMAND, 1);
    sim_close(oled.sim);
}

static void wrong_numbers_of_parameters_are_seen(void **state)
{
    (void)state;
    struct sim_bus oled = sim_bus_with(&panel_ssd1351_128x128);
    plug(&oled);
    wait_ms(&oled, 1);
    command(&oled, 0x15);
    DATA(&oled, "\0");
    command(&oled, 0xA6);
    only(&oled, SIM_PARAMETER_COUNT, 1);
    sim_close(oled.sim);
}

static void data_without_a_command_is_seen(void **state)
{
    (void)state;
    struct sim_bus oled = sim_bus_with(&panel_ssd1351_128x128);
    plug(&oled);
    wait_ms(&oled, 1);
    command(&oled, 0x15);
    DATA(&oled, "\0\x7F\xFF"); /* pixels, but 5Ch was forgotten */
    only(&oled, SIM_PIXELS_NOWHERE, 1);
    sim_close(oled.sim);
}

static void windows_outside_of_the_memory_are_seen(void **state)
{
    (void)state;
    struct sim_bus oled = sim_bus_with(&panel_ssd0323_128x64);
    static const uint8_t columns[] = {0x15, 0, 64};
    plug(&oled);
    wait_ms(&oled, 1);
    oled.hal.ops->bus_write(oled.hal.context, HAL_COMMAND, columns, sizeof columns);
    only(&oled, SIM_WINDOW_OUTSIDE, 1);
    sim_close(oled.sim);
}

static void more_pixels_than_the_window_has_are_seen(void **state)
{
    (void)state;
    struct sim_bus oled = sim_bus_with(&panel_ssd1351_128x128);
    plug(&oled);
    wait_ms(&oled, 1);
    command(&oled, 0x15);
    DATA(&oled, "\0\0");
    command(&oled, 0x75);
    DATA(&oled, "\0\0");
    command(&oled, 0x5C);
    DATA(&oled, "\0\0");
    none(&oled);
    DATA(&oled, "\0\0");
    only(&oled, SIM_TOO_MANY_PIXELS, 1);
    sim_close(oled.sim);
}

/* Pixels 1 to 6 of a window of 2 x 2, along rows or columns: the fifth is told, and begins it again. */
static void a_window_is_filled_and_begun_again(void **state)
{
    static const char remaps[2] = {'\x74', '\x75'};
    static const uint16_t at[2][4][2] = {{{4, 6}, {5, 6}, {4, 7}, {5, 7}}, {{4, 6}, {4, 7}, {5, 6}, {5, 7}}};
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct sim_bus k = sim_bus_with(&panel_ssd1351_128x128);
        plug(&k);
        wake_ssd1351(&k);
        command(&k, 0xA0);
        data(&k, &remaps[i], 1);
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
        DATA(&k, "\xF8\x00\x07\xE0\x00\x1F\xFF\xFF");
        none(&k);
        assert_int_equal(seen_at(&k, 128, at[i][0][0], at[i][0][1]), 0xFF0000);
        assert_int_equal(seen_at(&k, 128, at[i][1][0], at[i][1][1]), 0x00FF00);
        assert_int_equal(seen_at(&k, 128, at[i][2][0], at[i][2][1]), 0x0000FF);
        assert_int_equal(seen_at(&k, 128, at[i][3][0], at[i][3][1]), 0xFFFFFF);
        DATA(&k, "\x00\x1F\x00\x1F");
        only(&k, SIM_TOO_MANY_PIXELS, 1);
        assert_int_equal(seen_at(&k, 128, at[i][0][0], at[i][0][1]), 0x0000FF);
        assert_int_equal(seen_at(&k, 128, at[i][1][0], at[i][1][1]), 0x0000FF);
        DATA(&k, "\0");
        command(&k, 0xA6); /* in the middle of a pixel */
        assert_int_equal(sim_complaint_count_of(k.sim, SIM_SPLIT_PIXEL), 1);
        sim_close(k.sim);
    }
}

static void white_ssd1351(struct sim_bus *k)
{
    *k = sim_bus_with(&panel_ssd1351_128x128);
    plug(k);
    wake_ssd1351(k);
    command(k, 0xA0);
    DATA(k, "\x74");
    command(k, 0x5C);
    for (uint32_t n = 0; n < 128 * 128; n++) {
        DATA(k, "\xFF\xFF");
    }
    command(k, 0xAF);
}

/* Six bits at the low end of three bytes each. */
static void ssd1351_takes_262k_colours(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_ssd1351_128x128);
    plug(&k);
    wake_ssd1351(&k);
    command(&k, 0xA0);
    DATA(&k, "\xB4");
    command(&k, 0x5C);
    for (uint32_t n = 0; n < 128 * 128; n++) {
        DATA(&k, "\x01\x3E\x20");
    }
    command(&k, 0xAF);
    assert_int_equal(seen_at(&k, 128, 9, 9), 0x04FB82);
    none(&k);
    sim_close(k.sim);
}

static void lines_beyond_the_multiplex_ratio_are_dark(void **state)
{
    (void)state;
    struct sim_bus k;
    white_ssd1351(&k);
    command(&k, 0xCA);
    DATA(&k, "\x0F");
    assert_int_equal(seen_at(&k, 128, 0, 15), 0xFFFFFF);
    assert_int_equal(seen_at(&k, 128, 0, 16), 0x000000);
    none(&k);
    sim_close(k.sim);
}

static void modes_and_contrast_change_what_is_seen(void **state)
{
    (void)state;
    struct sim_bus k;
    white_ssd1351(&k);
    command(&k, 0xA7);
    assert_int_equal(seen_at(&k, 128, 0, 0), 0x000000);
    command(&k, 0xA5); /* all on, whatever the memory has */
    assert_int_equal(seen_at(&k, 128, 0, 0), 0xFFFFFF);
    command(&k, 0xA4);
    assert_int_equal(seen_at(&k, 128, 0, 0), 0x000000);
    command(&k, 0xA6);
    command(&k, 0xFD);
    DATA(&k, "\xB1");
    command(&k, 0xC1);
    DATA(&k, "\x80\x00\x80");
    assert_int_equal(seen_at(&k, 128, 0, 0), 0xFF00FF);
    command(&k, 0xAE);
    assert_int_equal(seen_at(&k, 128, 0, 0), 0x000000);
    none(&k);
    command(&k, 0x5C);
    DATA(&k, "\0\0");
    command(&k, 0xA5);
    command(&k, 0xAF);
    assert_int_equal(seen_at(&k, 128, 0, 0), 0xFF00FF);
    sim_close(k.sim);
}

static void the_lock_is_opened_by_itself(void **state)
{
    (void)state;
    struct sim_bus k;
    white_ssd1351(&k);
    command(&k, 0xFD);
    DATA(&k, "\x16");
    command(&k, 0xFD);
    DATA(&k, "\x12");
    command(&k, 0xA7);
    none(&k);
    assert_int_equal(seen_at(&k, 128, 0, 0), 0x000000);
    sim_close(k.sim);
}

/* 53h mirrors columns, with the halves of a byte; 56h runs along columns first. 13h has lines that are not split. */
static void ssd0323_remaps(void **state)
{
    static const uint8_t set_up[] = {0xA8, 0x3F, 0xA2, 0x4C, 0xA0, 0x52}, first[] = {0x15, 0, 1, 0x75, 0, 1};
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_ssd0323_128x64);
    plug(&k);
    wait_ms(&k, 1);
    k.hal.ops->bus_write(k.hal.context, HAL_COMMAND, set_up, sizeof set_up);
    for (uint32_t i = 0; i < 64 * 80; i++) {
        DATA(&k, "\0");
    }
    command(&k, 0xAF);
    k.hal.ops->bus_write(k.hal.context, HAL_COMMAND, first, sizeof first);
    DATA(&k, "\x12\x34\x56\x78"); /* rows of 1 2 3 4 and 5 6 7 8 */
    assert_int_equal(seen_at(&k, 128, 3, 1), 0x888888);
    static const uint8_t mirrored[] = {0xA0, 0x51};
    k.hal.ops->bus_write(k.hal.context, HAL_COMMAND, mirrored, sizeof mirrored);
    assert_int_equal(seen_at(&k, 128, 126, 0), 0x111111); /* pairs are, and not what is in them */
    static const uint8_t downwards[] = {0xA0, 0x56, 0x15, 0, 1, 0x75, 0, 1};
    k.hal.ops->bus_write(k.hal.context, HAL_COMMAND, downwards, sizeof downwards);
    DATA(&k, "\x12\x34\x56\x78");
    assert_int_equal(seen_at(&k, 128, 0, 1), 0x333333);
    assert_int_equal(seen_at(&k, 128, 2, 0), 0x555555);
    static const uint8_t not_split[] = {0xA0, 0x12, 0x75, 34, 34};
    k.hal.ops->bus_write(k.hal.context, HAL_COMMAND, not_split, sizeof not_split);
    DATA(&k, "\xF0");
    assert_int_equal(seen_at(&k, 128, 0, 5), 0xFFFFFF); /* 32 of 64 lines are at the other side: 5 shows 32 + 5 / 2 */
    none(&k);
    sim_close(k.sim);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ssd1351_remaps),
        cmocka_unit_test(ssd1351_moves_lines),
        cmocka_unit_test(ssd1351_locks_commands),
        cmocka_unit_test(ssd0323_takes_two_greys_a_byte),
        cmocka_unit_test(unknown_commands_are_named),
        cmocka_unit_test(wrong_numbers_of_parameters_are_seen),
        cmocka_unit_test(data_without_a_command_is_seen),
        cmocka_unit_test(windows_outside_of_the_memory_are_seen),
        cmocka_unit_test(more_pixels_than_the_window_has_are_seen),
        cmocka_unit_test(a_window_is_filled_and_begun_again),
        cmocka_unit_test(ssd1351_takes_262k_colours),
        cmocka_unit_test(lines_beyond_the_multiplex_ratio_are_dark),
        cmocka_unit_test(modes_and_contrast_change_what_is_seen),
        cmocka_unit_test(the_lock_is_opened_by_itself),
        cmocka_unit_test(ssd0323_remaps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
