/* panel_probe: answers as the datasheets of the controllers give them, shifted by the clocks before them, on a bus that
 * the test plays. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panel_probe.h"
#include "panels.h"

#include <stdio.h>
#include <string.h>

/* ---- names ------------------------------------------------------------------------------------------------------ */

static const struct {
    const char *name;
    bool id4; /* answers D3h; else 04h */
    uint32_t id;
} controllers[] = {{"ILI9341", true, 0x009341},
                   {"ILI9488", true, 0x009488},
                   {"GC9A01", false, 0x009A01},
                   {"ST7789", false, 0x858552},
                   {"ST7735S", false, 0x7C89F0}};

/* The 24 bits from a bit of the answer on, in high or low bits around. */
static struct panel_answers answers_of(bool id4, uint32_t id, unsigned at, uint8_t around)
{
    struct panel_answers a;
    memset(&a, around, sizeof a);
    for (unsigned bit = 0; bit < 24; bit++) {
        uint8_t *const byte = (id4 ? a.id4 : a.id) + (at + bit) / 8, mask = (uint8_t)(0x80 >> (at + bit) % 8);
        *byte = (uint8_t)((*byte & ~mask) | (id >> (23 - bit) & 1 ? mask : 0));
    }
    return a;
}

static void each_controller_is_known_after_0_1_8_or_9_clocks(void **state)
{
    static const unsigned clocks[] = {0, 1, 8, 9};
    (void)state;
    for (size_t i = 0; i < sizeof controllers / sizeof controllers[0]; i++) {
        for (size_t k = 0; k < 4; k++) {
            for (int around = 0; around < 256; around += 255) {
                struct panel_answers a = answers_of(controllers[i].id4, controllers[i].id, clocks[k], (uint8_t)around);
                assert_string_equal(panel_probe_name(&a), controllers[i].name);
                assert_true(panel_probe_answered(&a));
            }
        }
    }
}

static void other_answers_have_no_name(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof controllers / sizeof controllers[0]; i++) {
        for (unsigned bit = 0; bit < 24; bit++) {
            const struct panel_answers a = answers_of(controllers[i].id4, controllers[i].id ^ 1u << bit, 1, 0);
            assert_null(panel_probe_name(&a));
        }
        const struct panel_answers late = answers_of(controllers[i].id4, controllers[i].id, 2, 0),
                                   elsewhere = answers_of(!controllers[i].id4, controllers[i].id, 8, 0);
        assert_null(panel_probe_name(&late));
        assert_null(panel_probe_name(&elsewhere));
    }
}

static void a_line_that_stands_still_is_no_answer(void **state)
{
    (void)state;
    struct panel_answers a;
    for (int level = 0; level < 256; level += 255) {
        memset(&a, level, sizeof a);
        assert_false(panel_probe_answered(&a));
        for (unsigned i = 0; i < sizeof a; i++) {
            ((uint8_t *)&a)[i] ^= 1;
            assert_true(panel_probe_answered(&a));
            ((uint8_t *)&a)[i] ^= 1;
        }
    }
    memset(&a, 0x55, sizeof a);
    assert_true(panel_probe_answered(&a));
}

/* ---- the bus ---------------------------------------------------------------------------------------------------- */

static char wire[300];
static int clock_status;
static uint8_t fails_at; /* a command */

static int bus_clock(void *context, uint32_t hz)
{
    (void)context;
    snprintf(wire + strlen(wire), sizeof wire - strlen(wire), "clock %u\n", (unsigned)hz);
    return clock_status;
}

static int pin_set(void *context, enum hal_pin pin, bool level)
{
    (void)context;
    snprintf(wire + strlen(wire), sizeof wire - strlen(wire), "%s %d\n", pin == HAL_PIN_RESET ? "reset" : "other",
             level);
    return 0;
}

static void delay_us(void *context, uint32_t us)
{
    (void)context;
    snprintf(wire + strlen(wire), sizeof wire - strlen(wire), "wait %u\n", (unsigned)us);
}

static int bus_read(void *context, uint8_t command, uint8_t *bytes, size_t n)
{
    (void)context;
    snprintf(wire + strlen(wire), sizeof wire - strlen(wire), "read %02x %u\n", command, (unsigned)n);
    memset(bytes, command + 1, n);
    return command == fails_at ? HAL_ETIMEDOUT : 0;
}

static void it_is_asked_slowly_after_a_reset(void **state)
{
    (void)state;
    const struct hal_ops ops = {.bus_clock = bus_clock, .pin_set = pin_set, .delay_us = delay_us, .bus_read = bus_read},
                         no_read = {.bus_clock = bus_clock, .pin_set = pin_set, .delay_us = delay_us};
    const struct hal hal = {&ops, NULL}, without = {&no_read, NULL};
    const struct panel_controller *const c = panel_ili9341_240x320.controller;
    struct board board = {.panel = &panel_ili9341_240x320, .pins = {.data_in = {.wired = true}}};
    struct panel_answers a;
    char expected[300];
    memset(&a, 0, sizeof a);
    clock_status = 1000; /* the clock that was really set */
    assert_int_equal(panel_probe_read(&hal, &board, &a), 0);
    snprintf(expected, sizeof expected, "clock %u\nreset 0\nwait %u\nreset 1\nwait %u\nread 04 5\nread d3 5\n",
             (unsigned)c->init_hz, (unsigned)c->reset_low_us, (unsigned)c->reset_high_us);
    assert_string_equal(wire, expected);
    assert_memory_equal(&a, "\5\5\5\5\5\xd4\xd4\xd4\xd4\xd4", 10);
    clock_status = 0;
    for (fails_at = 0x04; fails_at != 0; fails_at = fails_at == 0x04 ? 0xD3 : 0) {
        wire[0] = '\0';
        assert_int_equal(panel_probe_read(&hal, &board, &a), HAL_ETIMEDOUT);
        assert_int_equal(strstr(wire, "read d3") != NULL, fails_at == 0xD3);
    }
    wire[0] = '\0';
    clock_status = HAL_EIO;
    assert_int_equal(panel_probe_read(&hal, &board, &a), HAL_EIO);
    assert_null(strstr(wire, "reset"));
    wire[0] = '\0';
    assert_int_equal(panel_probe_read(&without, &board, &a), HAL_ENOSYS);
    board.pins.data_in.wired = false;
    assert_int_equal(panel_probe_read(&hal, &board, &a), HAL_ENOSYS);
    assert_string_equal(wire, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_controller_is_known_after_0_1_8_or_9_clocks),
        cmocka_unit_test(other_answers_have_no_name),
        cmocka_unit_test(a_line_that_stands_still_is_no_answer),
        cmocka_unit_test(it_is_asked_slowly_after_a_reset),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
