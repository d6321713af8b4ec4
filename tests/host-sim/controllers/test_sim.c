/* sim: the bus, the pins and the clock of the simulated kit: time, and each kind of misuse that is seen there. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "sim_bus.h"

#include <string.h>

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

static void reset_has_its_least_times(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wait_ms(&k, 130);
    pin(&k, HAL_PIN_RESET, false);
    k.hal.ops->delay_us(k.hal.context, 10);
    pin(&k, HAL_PIN_RESET, true);
    k.hal.ops->delay_us(k.hal.context, 4992); /* the byte takes 8 */
    command(&k, 0x00);
    none(&k);
    sim_close(k.sim);
}

static void a_pulse_on_the_reset_line_resets_the_controller(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    command(&k, 0x21);
    show_dbi(&k, 240 * 320, 0xF800);
    assert_int_equal(seen_at(&k, 240, 0, 0), 0xFF0000);
    pin(&k, HAL_PIN_RESET, false);
    assert_int_equal(seen_at(&k, 240, 0, 0), 0x000000);
    wait_ms(&k, 1);
    pin(&k, HAL_PIN_RESET, true);
    assert_int_equal(seen_at(&k, 240, 0, 0), 0x000000); /* asleep */
    none(&k);
    sim_close(k.sim);
}

static void only_commands_count_as_such_and_a_short_write_sends_half(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wait_ms(&k, 130);
    command(&k, 0x2A);
    DATA(&k, "\0\0\0\1");
    assert_true(sim_counters(k.sim).bytes == 5 && sim_counters(k.sim).command_bytes == 1);
    sim_fault(k.sim, SIM_FAULT_SHORT_WRITE, 1);
    assert_int_equal(k.hal.ops->bus_write(k.hal.context, HAL_DATA, (const uint8_t *)"\0\0\0\0", 4), HAL_EIO);
    assert_int_equal(sim_counters(k.sim).bytes, 7);
    sim_fault(k.sim, SIM_FAULT_WRITE, 2); /* the second one */
    assert_int_equal(k.hal.ops->bus_write(k.hal.context, HAL_DATA, (const uint8_t *)"\0", 1), 0);
    assert_int_equal(k.hal.ops->bus_write(k.hal.context, HAL_DATA, (const uint8_t *)"\0", 1), HAL_EIO);
    assert_int_equal(k.hal.ops->bus_write(k.hal.context, HAL_DATA, (const uint8_t *)"\0", 1), 0);
    assert_int_equal(sim_counters(k.sim).bytes, 9);
    sim_close(k.sim);
}

/* An OLED shines by itself: its kit's backlight pin changes nothing. */
static void the_backlight_lights_what_has_one(void **state)
{
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    command(&k, 0x21);
    show_dbi(&k, 240 * 320, 0x07E0);
    pin(&k, HAL_PIN_BACKLIGHT, false);
    assert_int_equal(seen_at(&k, 240, 0, 0), 0x000000);
    pin(&k, HAL_PIN_BACKLIGHT, true);
    assert_int_equal(seen_at(&k, 240, 0, 0), 0x00FF00);
    k.hal.ops->close(k.hal.context);
    assert_int_equal(seen_at(&k, 240, 0, 0), 0x000000);
    sim_close(k.sim);

    struct sim_bus oled = sim_bus_with(&panel_ssd1351_128x128);
    plug(&oled);
    pin(&oled, HAL_PIN_BACKLIGHT, true);
    none(&oled);
    sim_close(oled.sim);
}

/* Row 0 red, column 0 of the rest green, the last pixel blue; a picture that is turned clockwise by quarters. */
static void a_picture_is_turned_back(void **state)
{
    static uint8_t rgb[4][3 * 240 * 240];
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_st7789_240x240);
    plug(&k);
    wake_dbi(&k);
    command(&k, 0x21);
    show_dbi(&k, 240 * 320, 0);
    window(&k, "\0\x05\0\x05", "\0\x09\0\x09");
    command(&k, 0x2C);
    DATA(&k, "\xFF\xFF");
    for (unsigned turns = 0; turns < 4; turns++) {
        static const unsigned at[4][2] = {{5, 9}, {9, 234}, {234, 230}, {230, 5}};
        sim_pixels(k.sim, turns, rgb[turns]);
        for (unsigned i = 0; i < 240 * 240; i++) {
            assert_int_equal(rgb[turns][3 * i], i == at[turns][1] * 240 + at[turns][0] ? 255 : 0);
        }
    }
    sim_close(k.sim);
}

static void a_round_glass_has_no_corners(void **state)
{
    static uint8_t rgb[3 * 240 * 240];
    (void)state;
    struct sim_bus k = sim_bus_with(&panel_gc9a01_240x240);
    plug(&k);
    wake_dbi(&k);
    command(&k, 0x21);
    show_dbi(&k, 240 * 240, 0xFFFF);
    sim_pixels(k.sim, PANEL_R0, rgb);
    for (uint32_t i = 0; i < 240 * 240; i++) {
        const double dx = i % 240 - 119.5, dy = i / 240 - 119.5; /* whole columns and rows */
        assert_int_equal(rgb[3 * i], dx * dx + dy * dy <= 120 * 120 ? 255 : 0);
    }
    none(&k);
    sim_close(k.sim);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(short_reset_and_early_bytes_are_seen),
        cmocka_unit_test(a_byte_in_or_right_after_reset_is_seen),
        cmocka_unit_test(data_command_line_must_not_move_inside_a_byte),
        cmocka_unit_test(a_stray_clock_pulse_shifts_the_bytes),
        cmocka_unit_test(a_racing_backend_is_caught),
        cmocka_unit_test(a_clock_above_the_limit_is_seen),
        cmocka_unit_test(a_delay_that_does_not_wait_is_caught),
        cmocka_unit_test(time_is_that_of_bits_and_delays),
        cmocka_unit_test(unwired_pins_do_nothing),
        cmocka_unit_test(complaints_are_counted_when_there_are_too_many_to_keep),
        cmocka_unit_test(reset_has_its_least_times),
        cmocka_unit_test(a_pulse_on_the_reset_line_resets_the_controller),
        cmocka_unit_test(only_commands_count_as_such_and_a_short_write_sends_half),
        cmocka_unit_test(the_backlight_lights_what_has_one),
        cmocka_unit_test(a_picture_is_turned_back),
        cmocka_unit_test(a_round_glass_has_no_corners),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
