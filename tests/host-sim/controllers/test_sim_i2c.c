/* sim_i2c: messages on the I2C bus of an SSD1306, by hand, as 8.1.5 of its data sheet draws them; and a whole kit. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panel_picture.h"
#include "sim_bus.h"
#include "sim_model.h"

static struct sim_bus open_i2c(const struct panel *panel)
{
    struct sim_bus k = sim_bus_with(panel);
    k.board.i2c_address = 0x3C;
    k.board.spi_hz = 400000;
    return k;
}

/* Sends a message; returns how many of its bytes were acknowledged. */
static size_t message(struct sim_bus *k, const uint8_t *bytes, size_t n)
{
    size_t acknowledged = 0;
    sim_i2c_start(k->sim);
    while (acknowledged < n && sim_i2c_byte(k->sim, bytes[acknowledged])) {
        acknowledged++;
    }
    return acknowledged;
}

#define MESSAGE(k, ...) message((k), (const uint8_t[]){__VA_ARGS__}, sizeof((const uint8_t[]){__VA_ARGS__}))

static void bit_6_of_the_control_byte_is_dc(void **state)
{
    (void)state;
    struct sim_bus k = open_i2c(&panel_ssd1306_128x64);
    plug(&k);
    wait_ms(&k, 1);
    assert_int_equal(MESSAGE(&k, 0x78, 0x00, 0xB2, 0x05, 0x11), 5);
    assert_true(k.sim->u.page.page == 2 && k.sim->u.page.column == 0x15);
    assert_int_equal(MESSAGE(&k, 0x78, 0x40, 0xAF, 0x01), 4); /* no commands */
    assert_true(k.sim->u.page.column == 0x17 && !k.sim->u.page.on);
    assert_int_equal(k.sim->memory[16 * 128 + 0x15].r, 255);
    assert_int_equal(k.sim->memory[20 * 128 + 0x15].r, 0);
    none(&k);
    sim_close(k.sim);
}

/* Co = 1: one byte, then another control byte. */
static void control_bytes_may_alternate(void **state)
{
    (void)state;
    struct sim_bus k = open_i2c(&panel_sh1106_128x64);
    plug(&k);
    wait_ms(&k, 1);
    assert_int_equal(MESSAGE(&k, 0x78, 0x80, 0xB1, 0x80, 0x02, 0xC0, 0xFF, 0x00, 0xB3, 0x04), 10);
    assert_true(k.sim->u.page.page == 3 && k.sim->u.page.column == 4);
    assert_int_equal(k.sim->memory[8 * 132 + 2].r, 255);
    none(&k);
    assert_int_equal(MESSAGE(&k, 0x78, 0x01, 0xE3), 3);
    only(&k, SIM_BAD_PARAMETER, 1);
    sim_close(k.sim);
}

static void nobody_else_answers(void **state)
{
    (void)state;
    struct sim_bus k = open_i2c(&panel_ssd1306_128x64);
    plug(&k);
    wait_ms(&k, 1);
    assert_int_equal(MESSAGE(&k, 0x7A, 0x00, 0xB2), 0); /* 3Dh */
    assert_int_equal(MESSAGE(&k, 0x79, 0x00), 0);       /* a read */
    assert_int_equal(k.sim->u.page.page, 0);
    k.board.i2c_address = 0x3D;
    const uint8_t byte = 0xE3;
    assert_int_equal(k.hal.ops->bus_write(k.hal.context, HAL_COMMAND, &byte, 1), HAL_EIO);
    sim_close(k.sim);

    k = open_i2c(&panel_ssd1351_128x128);
    plug(&k);
    assert_int_equal(MESSAGE(&k, 0x78, 0x00), 0);
    sim_close(k.sim);
}

/* 9 clocks a byte, start and stop; no faster than the board's clock. */
static void a_kit_shows_a_picture(void **state)
{
    (void)state;
    static uint16_t picture[PICTURE_PIXELS];
    static uint8_t scratch[256], seen[3 * PICTURE_PIXELS], expected[3 * PICTURE_PIXELS];
    struct sim_bus k = open_i2c(&panel_ssd1306_128x64);
    plug(&k);
    const struct panel_config config = {k.board.panel, PANEL_R0, PANEL_MONO_DITHER, 1000000, scratch, sizeof scratch};
    struct panel_driver d;
    assert_int_equal(panel_open(&d, &k.hal, &config), 0);
    assert_int_equal(d.clock_hz, 400000);
    for (uint32_t i = 0; i < 2; i++) {
        picture_fill(picture, d.width, d.height, i);
        const uint64_t before = sim_counters(k.sim).bus_ns;
        assert_int_equal(picture_draw(&d, picture, 8), 0);
        if (i == 1) { /* 8 pages: address and 3 commands, address and 128 bytes; each with a control byte */
            const uint64_t clocks = 8 * (9 * (2 + 3) + 2 + 9 * (2 + 128) + 2);
            assert_int_equal(sim_counters(k.sim).bus_ns - before, clocks * 2500);
        }
    }
    sim_pixels(k.sim, PANEL_R0, seen);
    picture_expect(picture, d.width, d.height, PANEL_MONO_DITHER, false, expected);
    picture_compare(seen, expected, d.width, d.height, "I2C");
    none(&k);
    sim_close(k.sim);
}

static void fast_mode_is_the_limit(void **state)
{
    (void)state;
    struct sim_bus k = open_i2c(&panel_ssd1306_128x64);
    k.board.spi_hz = 400001;
    plug(&k);
    wait_ms(&k, 1);
    command(&k, 0xE3);
    only(&k, SIM_OVER_CLOCK, 1);
    sim_close(k.sim);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bit_6_of_the_control_byte_is_dc),
        cmocka_unit_test(control_bytes_may_alternate),
        cmocka_unit_test(nobody_else_answers),
        cmocka_unit_test(a_kit_shows_a_picture),
        cmocka_unit_test(fast_mode_is_the_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
