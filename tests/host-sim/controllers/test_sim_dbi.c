/* sim_dbi: the controllers with MIPI DBI by themselves: bytes sent by hand, as the data sheets describe them, what is
 * then seen, and what is told of bytes that a controller would not take. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "sim_bus.h"

#include <string.h>

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

static void unknown_commands_are_named(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    command(&k, 0xD6);
    only(&k, SIM_UNKNOWN_COMMAND, 1);
    assert_non_null(strstr(sim_complaint(k.sim, 0), "ST7789"));
    assert_non_null(strstr(sim_complaint(k.sim, 0), "D6h"));
    sim_close(k.sim);

    struct sim_bus old = sim_bus_with(&panel_st7735s_128x160);
    plug(&old);
    wake_dbi(&old);
    command(&old, 0x3C); /* it has no continuation */
    only(&old, SIM_UNKNOWN_COMMAND, 1);
    sim_close(old.sim);
}

static void wrong_numbers_of_parameters_are_seen(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    command(&k, 0x2A);
    DATA(&k, "\0\0\0");
    only(&k, SIM_PARAMETER_COUNT, 0);
    command(&k, 0x00);
    only(&k, SIM_PARAMETER_COUNT, 1);
    command(&k, 0x36);
    DATA(&k, "\0\0");
    only(&k, SIM_PARAMETER_COUNT, 2);
    sim_close(k.sim);
}

static void pixels_in_sleep_are_rejected(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wait_ms(&k, 130);
    command(&k, 0x2C);
    DATA(&k, "\0\0\0\0");
    only(&k, SIM_PIXELS_ASLEEP, 1); /* once a memory write */
    sim_close(k.sim);
}

static void data_without_a_command_is_seen(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wait_ms(&k, 130);
    DATA(&k, "\0\0");
    only(&k, SIM_PIXELS_NOWHERE, 1);
    sim_close(k.sim);
}

static void sleep_commands_need_their_waits(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    command(&k, 0x01);
    wait_ms(&k, 4);
    command(&k, 0x00);
    only(&k, SIM_EARLY_COMMAND, 1); /* 5 ms after SWRESET */
    wait_ms(&k, 120);
    command(&k, 0x11);
    wait_ms(&k, 4);
    command(&k, 0x00);
    only(&k, SIM_EARLY_COMMAND, 2); /* 5 ms after SLPOUT */
    wait_ms(&k, 110);
    command(&k, 0x10);
    only(&k, SIM_EARLY_COMMAND, 3); /* 120 ms from SLPOUT to SLPIN */
    wait_ms(&k, 110);
    command(&k, 0x11);
    only(&k, SIM_EARLY_COMMAND, 4); /* 120 ms from SLPIN to SLPOUT */
    wait_ms(&k, 121);
    command(&k, 0x10);
    wait_ms(&k, 121);
    command(&k, 0x11);
    only(&k, SIM_EARLY_COMMAND, 4);
    sim_close(k.sim);
}

static void windows_outside_of_the_memory_are_seen(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    window(&k, "\0\0\0\xF0", "\0\0\0\0"); /* column 240 */
    command(&k, 0x2C);
    only(&k, SIM_WINDOW_OUTSIDE, 1);
    command(&k, 0x36);
    DATA(&k, "\x20"); /* turned it is inside */
    command(&k, 0x2C);
    only(&k, SIM_WINDOW_OUTSIDE, 1);
    window(&k, "\0\x09\0\x08", "\0\0\0\0");
    command(&k, 0x2C);
    only(&k, SIM_WINDOW_OUTSIDE, 2);
    sim_close(k.sim);
}

static void more_pixels_than_the_window_has_are_seen(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    window(&k, "\0\0\0\x01", "\0\0\0\0");
    command(&k, 0x2C);
    DATA(&k, "\0\0\0\0");
    none(&k);
    DATA(&k, "\0\0");
    only(&k, SIM_TOO_MANY_PIXELS, 1);
    sim_close(k.sim);
}

static void split_pixels_are_seen(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    command(&k, 0x2C);
    DATA(&k, "\0\0\0");
    command(&k, 0x00);
    only(&k, SIM_SPLIT_PIXEL, 1);
    sim_close(k.sim);
}

/* ST7789V 9.2.1: red 10000b has the sixth bit 0, 1, its highest bit or the lowest one of green. 33 of 63 is what 16 of
 * 31 is, widened as it was sent; 32 lies between. */
static void epf_says_where_the_sixth_bit_comes_from(void **state)
{
    static const struct {
        char epf, high, low; /* of a pixel */
        uint8_t red;
    } cases[] = {{0x00, '\x80', 0x00, 130}, {0x10, '\x80', 0x00, 132}, {0x20, '\x80', 0x00, 132},
                 {0x30, '\x80', 0x00, 130}, {0x30, '\x80', 0x20, 132}, {0x00, 0x78, 0x00, 123},
                 {0x10, 0x78, 0x00, 125},   {0x20, 0x78, 0x20, 123},   {0x30, 0x78, 0x20, 125}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
        const char ramctrl[2] = {0, (char)(0xC0 | cases[i].epf)}, pixel[2] = {cases[i].high, cases[i].low};
        plug(&k);
        wake_dbi(&k);
        command(&k, 0x21);
        command(&k, 0xB0);
        data(&k, ramctrl, 2);
        show_dbi(&k, 240 * 320, 0);
        command(&k, 0x2C);
        data(&k, pixel, 2);
        assert_int_equal(seen_at(&k, 240, 0, 0) >> 16, cases[i].red);
        none(&k);
        sim_close(k.sim);
    }
}

static void pixels_beyond_the_window_begin_it_again(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    command(&k, 0x21);
    show_dbi(&k, 240 * 320, 0);
    window(&k, "\0\x04\0\x05", "\0\x06\0\x06");
    command(&k, 0x2C);
    DATA(&k, "\xFF\xFF\xFF\xFF\xF8\x00\x07\xE0");
    assert_int_equal(seen_at(&k, 240, 4, 6), 0xFF0000);
    assert_int_equal(seen_at(&k, 240, 5, 6), 0x00FF00);
    only(&k, SIM_TOO_MANY_PIXELS, 1);       /* told once */
    window(&k, "\0\0\0\0", "\0\0\x01\x40"); /* row 320 */
    command(&k, 0x2C);
    assert_int_equal(sim_complaint_count_of(k.sim, SIM_WINDOW_OUTSIDE), 1);
    sim_close(k.sim);
}

static void the_first_of_two_small_pixels_has_the_higher_bits(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_ili9488_320x480);
    plug(&k);
    pin(&k, HAL_PIN_RESET, false);
    wait_ms(&k, 1);
    pin(&k, HAL_PIN_RESET, true);
    wait_ms(&k, 121);
    command(&k, 0x11);
    wait_ms(&k, 121);
    command(&k, 0x3A);
    DATA(&k, "\x11");
    command(&k, 0x36);
    DATA(&k, "\x48");
    command(&k, 0x2C);
    for (uint32_t i = 0; i < 320 * 480 / 2; i++) {
        DATA(&k, "\0");
    }
    command(&k, 0x29);
    pin(&k, HAL_PIN_BACKLIGHT, true);
    command(&k, 0x2C);
    DATA(&k, "\x22"); /* 100 010 */
    assert_int_equal(seen_at(&k, 320, 0, 0), 0xFF0000);
    assert_int_equal(seen_at(&k, 320, 1, 0), 0x00FF00);
    none(&k);
    sim_close(k.sim);
}

static void word(struct sim_bus *k, enum hal_dc dc, uint8_t high, uint8_t low)
{
    const uint8_t bytes[2] = {high, low};
    assert_int_equal(k->hal.ops->bus_write(k->hal.context, dc, bytes, 2), 0);
}

static void parameter_words(struct sim_bus *k, uint8_t code, const char *parameters, size_t n)
{
    word(k, HAL_COMMAND, 0, code);
    for (size_t i = 0; i < n; i++) {
        word(k, HAL_DATA, 0, (uint8_t)parameters[i]);
    }
}

/* An ILI9486 with a shift register before it, awake, in black, with the window at column 319 - 2, row 5. */
static void wake_words(struct sim_bus *k)
{
    *k = sim_bus_with(&panel_ili9486_320x480);
    plug(k);
    wait_ms(k, 121);
    word(k, HAL_COMMAND, 0, 0x11);
    wait_ms(k, 121);
    parameter_words(k, 0x3A, "\x55", 1);
    parameter_words(k, 0x36, "\x08", 1);
    word(k, HAL_COMMAND, 0, 0x2C);
    for (uint32_t i = 0; i < 320 * 480; i++) {
        word(k, HAL_DATA, 0, 0);
    }
    word(k, HAL_COMMAND, 0, 0x29);
    pin(k, HAL_PIN_BACKLIGHT, true);
    parameter_words(k, 0x2A, "\0\x02\0\x03", 4);
    parameter_words(k, 0x2B, "\0\x05\0\x05", 4);
    word(k, HAL_COMMAND, 0, 0x2C);
}

/* Linux' ili9486.c: commands and parameters behind a byte 0, a pixel in one word. */
static void a_shift_register_makes_words_of_16_bits(void **state)
{
    (void)state;
    struct sim_bus k;
    wake_words(&k);
    word(&k, HAL_DATA, 0xF8, 0x00);
    word(&k, HAL_DATA, 0x07, 0xE0);
    assert_int_equal(seen_at(&k, 320, 317, 5), 0xFF0000);
    assert_int_equal(seen_at(&k, 320, 316, 5), 0x00FF00);
    assert_int_equal(seen_at(&k, 320, 315, 5), 0x000000);
    none(&k);
    sim_close(k.sim);
}

static void words_that_are_out_of_step_are_seen(void **state)
{
    (void)state;
    struct sim_bus k;
    wake_words(&k);
    command(&k, 0x00);
    only(&k, SIM_DC_MOVED, 0); /* half a word */
    DATA(&k, "\x12");
    only(&k, SIM_DC_MOVED, 1); /* D/C at the last bit counts: red's low byte is the second one */
    sim_close(k.sim);

    wake_words(&k);
    word(&k, HAL_COMMAND, 0x36, 0x00);
    only(&k, SIM_BAD_PARAMETER, 1);
    parameter_words(&k, 0x36, "", 0);
    word(&k, HAL_DATA, 0x01, 0x08);
    only(&k, SIM_BAD_PARAMETER, 2);
    sim_close(k.sim);
}

static void a_reset_does_not_come_right_after_waking(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wait_ms(&k, 130);
    command(&k, 0x11);
    wait_ms(&k, 119);
    command(&k, 0x01);
    only(&k, SIM_EARLY_COMMAND, 1);
    wait_ms(&k, 121);
    command(&k, 0x11);
    wait_ms(&k, 120);
    command(&k, 0x01);
    only(&k, SIM_EARLY_COMMAND, 1);
    sim_close(k.sim);
}

/* Rows 0 and 1 are red and green. LCMCTRL 6Ch is its reset value with XMY; GATECTRL: 128 lines, from the last one. */
static void lines_are_mirrored_driven_and_counted_as_commanded(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    command(&k, 0x21);
    show_dbi(&k, 240 * 320, 0xFFFF);
    command(&k, 0xC0);
    DATA(&k, "\x6C");
    window(&k, "\0\0\0\0", "\0\x50\0\x51"); /* rows 239 and 238 of 320 */
    command(&k, 0x2C);
    DATA(&k, "\xF8\x00\x07\xE0");
    assert_int_equal(seen_at(&k, 240, 0, 239), 0xFF0000);
    assert_int_equal(seen_at(&k, 240, 0, 238), 0x00FF00);
    command(&k, 0xE4);
    DATA(&k, "\x0F\0\x10"); /* 128 lines */
    assert_int_equal(seen_at(&k, 240, 0, 127), 0xFFFFFF);
    assert_int_equal(seen_at(&k, 240, 0, 128), 0x000000);
    command(&k, 0xC0);
    DATA(&k, "\x2C");
    window(&k, "\0\0\0\0", "\0\x7F\0\x7F");
    command(&k, 0x2C);
    DATA(&k, "\x00\x1F");
    assert_int_equal(seen_at(&k, 240, 0, 127), 0x0000FF);
    command(&k, 0xE4);
    DATA(&k, "\x0F\0\x11"); /* from the last one */
    assert_int_equal(seen_at(&k, 240, 0, 0), 0x0000FF);
    none(&k);
    sim_close(k.sim);
}

/* GC9A01 6.5: FEh and EFh, in this order and with nothing between, unlock until the next reset. */
static void registers_are_unlocked_by_two_commands_in_a_row(void **state)
{
    static const uint8_t codes[4][3] = {{0xFE, 0x00, 0xEF}, {0xEF, 0xFE, 0x00}, {0xFE, 0x00, 0x00}, {0xFE, 0xEF, 0x00}};
    (void)state;
    for (int i = 0; i < 4; i++) {
        struct sim_bus k = sim_bus_with(&panel_gc9a01_240x240);
        plug(&k);
        wake_dbi(&k);
        for (int c = 0; c < 3; c++) {
            command(&k, codes[i][c]);
        }
        command(&k, 0xC3);
        DATA(&k, "\x13");
        only(&k, SIM_BAD_PARAMETER, i < 3);
        sim_close(k.sim);
    }
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
        cmocka_unit_test(unknown_commands_are_named),
        cmocka_unit_test(wrong_numbers_of_parameters_are_seen),
        cmocka_unit_test(pixels_in_sleep_are_rejected),
        cmocka_unit_test(data_without_a_command_is_seen),
        cmocka_unit_test(sleep_commands_need_their_waits),
        cmocka_unit_test(windows_outside_of_the_memory_are_seen),
        cmocka_unit_test(more_pixels_than_the_window_has_are_seen),
        cmocka_unit_test(split_pixels_are_seen),
        cmocka_unit_test(epf_says_where_the_sixth_bit_comes_from),
        cmocka_unit_test(pixels_beyond_the_window_begin_it_again),
        cmocka_unit_test(the_first_of_two_small_pixels_has_the_higher_bits),
        cmocka_unit_test(a_shift_register_makes_words_of_16_bits),
        cmocka_unit_test(words_that_are_out_of_step_are_seen),
        cmocka_unit_test(a_reset_does_not_come_right_after_waking),
        cmocka_unit_test(lines_are_mirrored_driven_and_counted_as_commanded),
        cmocka_unit_test(registers_are_unlocked_by_two_commands_in_a_row),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
