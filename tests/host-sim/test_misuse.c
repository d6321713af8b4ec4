/* Each kind of misuse raises its complaint, and only that one; time on the simulated bus. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "sim_bus.h"

#include <string.h>

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

    struct sim_bus oled = sim_bus_with(&panel_ssd1351_128x128);
    plug(&oled);
    wait_ms(&oled, 1);
    command(&oled, 0x15);
    DATA(&oled, "\0");
    command(&oled, 0xA6);
    only(&oled, SIM_PARAMETER_COUNT, 1);
    sim_close(oled.sim);
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

    struct sim_bus oled = sim_bus_with(&panel_ssd1351_128x128);
    plug(&oled);
    wait_ms(&oled, 1);
    command(&oled, 0x15);
    DATA(&oled, "\0\x7F\xFF"); /* pixels, but 5Ch was forgotten */
    only(&oled, SIM_PIXELS_NOWHERE, 1);
    sim_close(oled.sim);
}

static void short_reset_and_early_bytes_are_seen(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wait_ms(&k, 130);
    pin(&k, HAL_PIN_RESET, false);
    k.hal.ops->delay_us(k.hal.context, 9);
    pin(&k, HAL_PIN_RESET, true);
    only(&k, SIM_SHORT_RESET, 1);
    sim_close(k.sim);

    struct sim_bus early = sim_bus_with(&panel_st7789_240x240);
    plug(&early);
    pin(&early, HAL_PIN_RESET, false);
    wait_ms(&early, 1);
    pin(&early, HAL_PIN_RESET, true);
    wait_ms(&early, 4);
    command(&early, 0x00);
    only(&early, SIM_EARLY_COMMAND, 1);
    wait_ms(&early, 1);
    command(&early, 0x00);
    only(&early, SIM_EARLY_COMMAND, 1);
    command(&early, 0x11); /* within 120 ms of reset */
    only(&early, SIM_EARLY_COMMAND, 2);
    sim_close(early.sim);
}

/* A byte that comes in a reset is seen, also when bytes have come before it. */
static void a_byte_in_or_right_after_reset_is_seen(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    pin(&k, HAL_PIN_RESET, false);
    wait_ms(&k, 1);
    command(&k, 0x00);
    only(&k, SIM_EARLY_COMMAND, 1);
    pin(&k, HAL_PIN_RESET, true);
    command(&k, 0x00);
    only(&k, SIM_EARLY_COMMAND, 2);
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

static void data_command_line_must_not_move_inside_a_byte(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    for (unsigned i = 0; i < 8; i++) {
        sim_bit(k.sim, HAL_COMMAND, 0);
    }
    none(&k);
    for (unsigned i = 0; i < 8; i++) {
        sim_bit(k.sim, i < 7 ? HAL_DATA : HAL_COMMAND, 0);
    }
    only(&k, SIM_DC_MOVED, 1);
    sim_close(k.sim);
}

/* One clock pulse too many, and every byte after it is another one: 0 0010001 0.. is 11h, SLPOUT. */
static void a_stray_clock_pulse_shifts_the_bytes(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wait_ms(&k, 130);
    sim_bit(k.sim, HAL_COMMAND, 0);
    command(&k, 0x22);
    wait_ms(&k, 1);
    none(&k);
    command(&k, 0x00); /* too early after SLPOUT */
    only(&k, SIM_EARLY_COMMAND, 1);
    sim_close(k.sim);
}

/* A backend that does not wait for its shift register: the last pixel byte is taken for a command. */
static void a_racing_backend_is_caught(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    sim_fault(k.sim, SIM_FAULT_DC_EARLY, 2);
    command(&k, 0x2C);
    DATA(&k, "\xF8\x00");
    assert_int_equal(sim_complaint_count_of(k.sim, SIM_DC_MOVED), 1);
    assert_int_equal(sim_complaint_count_of(k.sim, SIM_SPLIT_PIXEL), 1); /* NOP after 8 bits */
    sim_close(k.sim);
}

static void a_clock_above_the_limit_is_seen(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_ili9341_240x320);
    plug(&k);
    wake_dbi(&k);
    k.hal.ops->bus_clock(k.hal.context, 10000000);
    command(&k, 0x00);
    none(&k);
    k.hal.ops->bus_clock(k.hal.context, 10000001);
    command(&k, 0x00);
    command(&k, 0x00);
    only(&k, SIM_OVER_CLOCK, 1);
    assert_null(sim_note(k.sim));
    sim_close(k.sim);

    struct sim_bus usual = sim_bus_with(&panel_ili9341_240x320);
    usual.board.over_limit = true;
    plug(&usual);
    wake_dbi(&usual);
    usual.hal.ops->bus_clock(usual.hal.context, 32000000);
    command(&usual, 0x00);
    none(&usual);
    assert_non_null(strstr(sim_note(usual.sim), "32000000"));
    sim_close(usual.sim);
}

static void a_delay_that_does_not_wait_is_caught(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    struct panel_config config = {&panel_st7789_240x240, 0, PANEL_RGB565, 1000000, NULL, 0};
    struct panel_driver d;
    plug(&k);
    sim_fault(k.sim, SIM_FAULT_DELAY, 1);
    assert_int_equal(panel_open(&d, &k.hal, &config), 0);
    assert_true(sim_complaint_count_of(k.sim, SIM_SHORT_RESET) == 1);
    assert_true(sim_complaint_count_of(k.sim, SIM_EARLY_COMMAND) >= 2);
    sim_close(k.sim);
}

/* 8 bits a byte at the clock; a delay is as long as it says. */
static void time_is_that_of_bits_and_delays(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wait_ms(&k, 130);
    uint64_t before = sim_time_ns(k.sim);
    k.hal.ops->bus_clock(k.hal.context, 3000000);
    for (int i = 0; i < 3; i++) {
        command(&k, 0x00); /* 2666.67 ns each */
    }
    assert_int_equal(sim_time_ns(k.sim) - before, 8000);
    assert_int_equal(sim_counters(k.sim).bytes, 3);
    assert_int_equal(sim_counters(k.sim).command_bytes, 3);
    assert_int_equal(sim_counters(k.sim).writes, 3);
    assert_int_equal(sim_counters(k.sim).bus_ns, 8000);
    wait_ms(&k, 7);
    assert_int_equal(sim_time_ns(k.sim) - before, 7008000);
    sim_close(k.sim);
}

/* Kits without a reset line, and those whose backlight is always on. */
static void unwired_pins_do_nothing(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    k.board.pins = (struct board_pins){.reset = {.wired = false}};
    plug(&k);
    wait_ms(&k, 130);
    pin(&k, HAL_PIN_RESET, false);
    pin(&k, HAL_PIN_RESET, true);
    pin(&k, HAL_PIN_BACKLIGHT, false);
    command(&k, 0x11);
    wait_ms(&k, 120);
    command(&k, 0x3A);
    DATA(&k, "\x55");
    command(&k, 0x21);
    fill_dbi(&k, 240 * 320, 0xFFFF);
    command(&k, 0x29);
    assert_int_equal(seen_at(&k, 240, 0, 0), 0xFFFFFF);
    none(&k);
    sim_close(k.sim);
}

static void complaints_are_counted_when_there_are_too_many_to_keep(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wait_ms(&k, 130);
    for (int i = 0; i < 100; i++) {
        command(&k, 0xFF);
    }
    only(&k, SIM_UNKNOWN_COMMAND, 100);
    assert_non_null(sim_complaint(k.sim, SIM_COMPLAINTS_KEPT - 1));
    assert_null(sim_complaint(k.sim, SIM_COMPLAINTS_KEPT));
    sim_close(k.sim);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unknown_commands_are_named),
        cmocka_unit_test(wrong_numbers_of_parameters_are_seen),
        cmocka_unit_test(pixels_in_sleep_are_rejected),
        cmocka_unit_test(data_without_a_command_is_seen),
        cmocka_unit_test(short_reset_and_early_bytes_are_seen),
        cmocka_unit_test(a_byte_in_or_right_after_reset_is_seen),
        cmocka_unit_test(sleep_commands_need_their_waits),
        cmocka_unit_test(windows_outside_of_the_memory_are_seen),
        cmocka_unit_test(more_pixels_than_the_window_has_are_seen),
        cmocka_unit_test(split_pixels_are_seen),
        cmocka_unit_test(data_command_line_must_not_move_inside_a_byte),
        cmocka_unit_test(a_stray_clock_pulse_shifts_the_bytes),
        cmocka_unit_test(a_racing_backend_is_caught),
        cmocka_unit_test(a_clock_above_the_limit_is_seen),
        cmocka_unit_test(a_delay_that_does_not_wait_is_caught),
        cmocka_unit_test(time_is_that_of_bits_and_delays),
        cmocka_unit_test(unwired_pins_do_nothing),
        cmocka_unit_test(complaints_are_counted_when_there_are_too_many_to_keep),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
