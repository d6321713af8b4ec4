/* sim_line: LS013B7DH03 and LS027B7DH01 by themselves: messages sent by hand, as the data sheets draw them, what is
 * then seen, and what is told of messages that the panel would not take. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "sim_bus.h"

#include <string.h>

static void clock_hz(struct sim_bus *k, uint32_t hz)
{
    assert_true(k->hal.ops->bus_clock(k->hal.context, hz) > 0);
}

/* SCS rises for the mode; no byte is faster than it may be. */
static void mode(struct sim_bus *k, uint8_t byte)
{
    clock_hz(k, 83000);
    data(k, (const char *)&byte, 1);
    clock_hz(k, 1000000);
}

static void fall(struct sim_bus *k)
{
    k->hal.ops->delay_us(k->hal.context, 2);
    command(k, 0x00);
}

static uint8_t turned_over(unsigned byte)
{
    unsigned over = 0;
    for (unsigned i = 0; i < 8; i++) {
        over |= (byte >> i & 1) << (7 - i);
    }
    return (uint8_t)over;
}

/* Address and pixels, all the same byte, without a trailer. */
static void line(struct sim_bus *k, unsigned number, uint8_t pixels)
{
    char bytes[64];
    bytes[0] = (char)turned_over(number);
    memset(bytes + 1, pixels, k->board.panel->width / 8U);
    data(k, bytes, 1U + k->board.panel->width / 8U);
}

/* A panel that shows black. */
static void open_dark(struct sim_bus *k, const struct panel *panel)
{
    *k = sim_bus_with(panel);
    k->board.pins.reset.wired = false;
    plug(k);
    mode(k, 0x80);
    for (unsigned i = 1; i <= panel->height; i++) {
        line(k, i, 0x00);
        DATA(k, "\0");
    }
    DATA(k, "\0");
    fall(k);
    pin(k, HAL_PIN_BACKLIGHT, true);
    none(k);
}

static void the_first_bit_is_the_left_pixel_and_line_1_the_upper_one(void **state)
{
    static const struct panel *const panels[] = {&panel_ls013b7dh03_128x128, &panel_ls027b7dh01_400x240};
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct sim_bus k;
        const unsigned width = panels[i]->width, height = panels[i]->height;
        open_dark(&k, panels[i]);
        mode(&k, 0xC0);
        line(&k, 1, 0x80);
        DATA(&k, "\0");
        line(&k, height, 0x01);
        DATA(&k, "\0\0");
        fall(&k);
        none(&k);
        for (unsigned x = 0; x < width; x += 5) {
            assert_int_equal(seen_at(&k, width, x, 0), x % 8 == 0 ? 0xFFFFFF : 0);
            assert_int_equal(seen_at(&k, width, x, 1), 0);
            assert_int_equal(seen_at(&k, width, x, height - 1), x % 8 == 7 ? 0xFFFFFF : 0);
        }
        sim_close(k.sim);
    }
}

static void all_clear_makes_all_white(void **state)
{
    struct sim_bus k;
    (void)state;
    open_dark(&k, &panel_ls013b7dh03_128x128);
    assert_int_equal(seen_at(&k, 128, 77, 3), 0);
    mode(&k, 0x60);
    DATA(&k, "\0");
    fall(&k);
    none(&k);
    assert_int_equal(seen_at(&k, 128, 77, 3), 0xFFFFFF);
    pin(&k, HAL_PIN_BACKLIGHT, false); /* DISP low */
    assert_int_equal(seen_at(&k, 128, 77, 3), 0);
    sim_close(k.sim);
}

/* The line gets into the memory with the 16 clocks behind it. */
static void a_line_without_its_trailers_is_not_written(void **state)
{
    struct sim_bus k;
    (void)state;
    for (int trailers = 0; trailers <= 2; trailers++) {
        open_dark(&k, &panel_ls013b7dh03_128x128);
        mode(&k, 0xC0);
        line(&k, 9, 0xFF);
        data(&k, "\0\0", (size_t)trailers);
        fall(&k);
        only(&k, SIM_CUT_MESSAGE, trailers < 2);
        assert_int_equal(seen_at(&k, 128, 0, 8), trailers < 2 ? 0 : 0xFFFFFF);
        sim_close(k.sim);
    }
    open_dark(&k, &panel_ls013b7dh03_128x128);
    mode(&k, 0x60); /* all clear without its own */
    fall(&k);
    only(&k, SIM_CUT_MESSAGE, 1);
    sim_close(k.sim);
}

static void a_line_that_begins_where_the_trailer_is_missing_is_told(void **state)
{
    struct sim_bus k;
    (void)state;
    open_dark(&k, &panel_ls013b7dh03_128x128);
    mode(&k, 0xC0);
    line(&k, 1, 0xFF);
    line(&k, 2, 0xFF); /* its address comes in the place of the trailer */
    fall(&k);
    only(&k, SIM_SPLIT_PIXEL, 1);
    assert_non_null(strstr(sim_complaint(k.sim, 0), "a byte 40h behind line 1 in the place of its trailer"));
    sim_close(k.sim);
}

static void only_lines_that_exist_are_taken(void **state)
{
    static const struct {
        const struct panel *panel;
        unsigned line;
        bool exists;
    } lines[] = {{&panel_ls013b7dh03_128x128, 0, false},  {&panel_ls013b7dh03_128x128, 1, true},
                 {&panel_ls013b7dh03_128x128, 128, true}, {&panel_ls013b7dh03_128x128, 129, false},
                 {&panel_ls027b7dh01_400x240, 240, true}, {&panel_ls027b7dh01_400x240, 241, false}};
    (void)state;
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        struct sim_bus k;
        open_dark(&k, lines[i].panel);
        mode(&k, 0xC0);
        line(&k, lines[i].line, 0x55);
        DATA(&k, "\0\0");
        fall(&k);
        only(&k, SIM_WINDOW_OUTSIDE, !lines[i].exists);
        sim_close(k.sim);
    }
}

/* Lowest bit first in the mode; M0 with M2; a dummy bit; bytes behind the end; a byte for nobody. */
static void wrong_bytes_are_told(void **state)
{
    static const uint8_t modes[] = {0x01, 0xA0, 0x90, 0x08, 0xFF};
    struct sim_bus k;
    (void)state;
    for (size_t i = 0; i < sizeof modes; i++) {
        open_dark(&k, &panel_ls013b7dh03_128x128);
        mode(&k, modes[i]);
        DATA(&k, "\0");
        fall(&k);
        only(&k, SIM_UNKNOWN_COMMAND, 1);
        sim_close(k.sim);
    }
    open_dark(&k, &panel_ls013b7dh03_128x128);
    mode(&k, 0x40);
    DATA(&k, "\0\0");
    fall(&k);
    only(&k, SIM_TOO_MANY_PIXELS, 1);
    mode(&k, 0x80);
    line(&k, 1, 0);
    DATA(&k, "\0\0\0");
    fall(&k);
    only(&k, SIM_TOO_MANY_PIXELS, 2);
    sim_close(k.sim);
    open_dark(&k, &panel_ls013b7dh03_128x128);
    command(&k, 0xC0);
    only(&k, SIM_PIXELS_NOWHERE, 1);
    sim_close(k.sim);
}

static void scs_that_moves_too_near_to_the_clock_is_told(void **state)
{
    struct sim_bus k;
    (void)state;
    open_dark(&k, &panel_ls013b7dh03_128x128);
    DATA(&k, "\x40\0"); /* half a period of 1 MHz */
    fall(&k);
    only(&k, SIM_SELECT_TIME, 1);
    assert_non_null(strstr(sim_complaint(k.sim, 0), "tsSCS is 6000 ns"));
    mode(&k, 0x00);
    DATA(&k, "\0");
    command(&k, 0x00); /* at once */
    only(&k, SIM_SELECT_TIME, 2);
    assert_non_null(strstr(sim_complaint(k.sim, 1), "thSCS is 2000 ns"));
    sim_close(k.sim);
    open_dark(&k, &panel_ls027b7dh01_400x240); /* 3 us and 1 us */
    clock_hz(&k, 166000);
    DATA(&k, "\x40\0");
    k.hal.ops->delay_us(k.hal.context, 1);
    command(&k, 0x00);
    none(&k);
    clock_hz(&k, 167000);
    DATA(&k, "\0\0");
    fall(&k);
    only(&k, SIM_SELECT_TIME, 1);
    sim_close(k.sim);
}

static void a_clock_or_mode_beyond_the_data_sheet_is_told(void **state)
{
    static const struct {
        const struct panel *panel;
        uint32_t hz;
    } limits[] = {{&panel_ls013b7dh03_128x128, 1100000}, {&panel_ls027b7dh01_400x240, 2000000}};
    struct sim_bus k;
    (void)state;
    for (int i = 0; i < 2; i++) {
        for (uint32_t over = 0; over < 2; over++) {
            open_dark(&k, limits[i].panel);
            mode(&k, 0x40);
            clock_hz(&k, limits[i].hz + over);
            DATA(&k, "\0");
            fall(&k);
            only(&k, SIM_OVER_CLOCK, over);
            sim_close(k.sim);
        }
    }
    k = sim_bus_with(&panel_ls013b7dh03_128x128);
    k.board.spi_mode = 3;
    plug(&k);
    only(&k, SIM_WRONG_MODE, 1);
    sim_close(k.sim);
}

/* A second, on a glass that shows something; once for each time that it is forgotten. */
static void vcom_that_stands_still_is_told(void **state)
{
    struct sim_bus k;
    (void)state;
    open_dark(&k, &panel_ls013b7dh03_128x128);
    for (int i = 0; i < 4; i++) { /* M1 changes in time */
        wait_ms(&k, 900);
        mode(&k, i % 2 == 0 ? 0x40 : 0x00);
        DATA(&k, "\0");
        fall(&k);
    }
    none(&k);
    wait_ms(&k, 600);
    mode(&k, 0x00); /* a message that does not toggle it */
    DATA(&k, "\0");
    fall(&k);
    none(&k);
    wait_ms(&k, 600);
    only(&k, SIM_VCOM_STILL, 1);
    wait_ms(&k, 5000);
    only(&k, SIM_VCOM_STILL, 1);
    mode(&k, 0x40);
    DATA(&k, "\0");
    fall(&k);
    wait_ms(&k, 1100);
    only(&k, SIM_VCOM_STILL, 2);
    sim_close(k.sim);
    open_dark(&k, &panel_ls013b7dh03_128x128);
    pin(&k, HAL_PIN_BACKLIGHT, false);
    wait_ms(&k, 9000);
    none(&k);
    sim_close(k.sim);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_first_bit_is_the_left_pixel_and_line_1_the_upper_one),
        cmocka_unit_test(all_clear_makes_all_white),
        cmocka_unit_test(a_line_without_its_trailers_is_not_written),
        cmocka_unit_test(a_line_that_begins_where_the_trailer_is_missing_is_told),
        cmocka_unit_test(only_lines_that_exist_are_taken),
        cmocka_unit_test(wrong_bytes_are_told),
        cmocka_unit_test(scs_that_moves_too_near_to_the_clock_is_told),
        cmocka_unit_test(a_clock_or_mode_beyond_the_data_sheet_is_told),
        cmocka_unit_test(vcom_that_stands_still_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
