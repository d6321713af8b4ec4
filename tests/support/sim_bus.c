/* See sim_bus.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "sim_bus.h"

#include <string.h>

static uint8_t seen[3 * 480 * 320];

void command(struct sim_bus *k, uint8_t code)
{
    assert_int_equal(k->hal.ops->bus_write(k->hal.context, HAL_COMMAND, &code, 1), 0);
}

void data(struct sim_bus *k, const char *bytes, size_t n)
{
    uint8_t copy[64];
    memcpy(copy, bytes, n);
    assert_int_equal(k->hal.ops->bus_write(k->hal.context, HAL_DATA, copy, n), 0);
}

void wait_ms(struct sim_bus *k, uint32_t ms)
{
    k->hal.ops->delay_us(k->hal.context, 1000 * ms);
}

void pin(struct sim_bus *k, enum hal_pin p, bool level)
{
    assert_int_equal(k->hal.ops->pin_set(k->hal.context, p, level), 0);
}

struct sim_bus sim_bus_with(const struct panel *panel)
{
    struct sim_bus k = {.board = {.name = "test",
                                  .panel = panel,
                                  .spi_hz = 1000000,
                                  .pins = {.reset = BOARD_PIN(0), .backlight = BOARD_PIN(1)}}};
    return k;
}

void plug(struct sim_bus *k)
{
    k->sim = sim_open(&k->board, &k->hal);
    assert_non_null(k->sim);
    assert_true(k->hal.ops->bus_clock(k->hal.context, 1000000) > 0);
}

void wake_dbi(struct sim_bus *k)
{
    pin(k, HAL_PIN_RESET, false);
    wait_ms(k, 1);
    pin(k, HAL_PIN_RESET, true);
    wait_ms(k, 120);
    command(k, 0x11);
    wait_ms(k, 120);
    command(k, 0x3A);
    DATA(k, "\x55");
    if (strcmp(k->board.panel->controller->name, "ST7789") == 0) {
        command(k, 0xB0);
        DATA(k, "\x00\xE0");
    }
}

void wake_ssd1351(struct sim_bus *k)
{
    wait_ms(k, 1);
    command(k, 0xFD);
    DATA(k, "\xB1");
    command(k, 0xA2);
    DATA(k, "\0");
}

void window(struct sim_bus *k, const char *columns, const char *rows)
{
    command(k, 0x2A);
    data(k, columns, 4);
    command(k, 0x2B);
    data(k, rows, 4);
}

void fill_dbi(struct sim_bus *k, uint32_t pixels, uint16_t colour)
{
    uint8_t bytes[2] = {(uint8_t)(colour >> 8), (uint8_t)colour};
    command(k, 0x2C);
    for (uint32_t i = 0; i < pixels; i++) {
        k->hal.ops->bus_write(k->hal.context, HAL_DATA, bytes, 2);
    }
}

void show_dbi(struct sim_bus *k, uint32_t pixels, uint16_t colour)
{
    fill_dbi(k, pixels, colour);
    command(k, 0x29);
    pin(k, HAL_PIN_BACKLIGHT, true);
}

uint32_t seen_at(struct sim_bus *k, uint32_t width, uint32_t x, uint32_t y)
{
    sim_pixels(k->sim, PANEL_R0, seen);
    const uint8_t *p = seen + 3 * (y * width + x);
    return (uint32_t)p[0] << 16 | (uint32_t)p[1] << 8 | p[2];
}

void only(struct sim_bus *k, enum sim_complaint_kind kind, uint32_t n)
{
    for (unsigned i = 0; i < SIM_COMPLAINT_KINDS; i++) {
        uint32_t expected = i == (unsigned)kind ? n : 0;
        if (sim_complaint_count_of(k->sim, i) != expected) {
            fail_msg("%u complaints of kind %u, should be %u; the first: %s", sim_complaint_count_of(k->sim, i), i,
                     expected, sim_complaint_count(k->sim) ? sim_complaint(k->sim, 0) : "none");
        }
    }
    assert_int_equal(sim_complaint_count(k->sim), n);
}

void none(struct sim_bus *k)
{
    only(k, SIM_COMPLAINT_KINDS, 0);
    assert_null(sim_complaint(k->sim, 0));
}
