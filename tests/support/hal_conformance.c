/* See hal_conformance.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "hal_conformance.h"
#include "panel.h"

#include <string.h>

static void check_operations(const struct hal *hal)
{
    const struct hal_ops *ops = hal->ops;
    assert_non_null(ops->name);
    assert_true(strlen(ops->name) > 0);
    assert_non_null(ops->open);
    assert_non_null(ops->bus_clock);
    assert_non_null(ops->bus_write);
    assert_non_null(ops->bus_wait);
    assert_non_null(ops->pin_set);
    assert_non_null(ops->time_us);
    assert_non_null(ops->delay_us);
    assert_non_null(ops->buttons);
    assert_non_null(ops->close); /* bus_read and te_wait may be NULL */
}

static void check_clock(const struct hal *hal)
{
    static const uint32_t asked[] = {100000, 1000000, 4000000, 16000000, 62500000, 3000000000U};
    assert_int_equal(hal->ops->bus_clock(hal->context, 0), HAL_EINVAL);
    for (size_t i = 0; i < sizeof asked / sizeof asked[0]; i++) {
        int32_t got = hal->ops->bus_clock(hal->context, asked[i]);
        assert_true(got > 0);
        assert_true((uint32_t)got <= asked[i]);
    }
}

/* NOPs, so that no panel minds; the backend must leave the caller's bytes alone. */
static void check_bus(const struct hal *hal)
{
    uint8_t bytes[3] = {0, 0, 0};
    assert_true(hal->ops->bus_clock(hal->context, 1000000) > 0);
    assert_int_equal(hal->ops->bus_write(hal->context, HAL_COMMAND, bytes, 0), 0);
    assert_int_equal(hal->ops->bus_wait(hal->context), 0); /* nothing to wait for */
    for (size_t n = 1; n <= sizeof bytes; n++) {
        assert_int_equal(hal->ops->bus_write(hal->context, HAL_COMMAND, bytes, n), 0);
        assert_int_equal(hal->ops->bus_write(hal->context, HAL_COMMAND, bytes, n), 0);
        assert_int_equal(hal->ops->bus_wait(hal->context), 0);
        assert_int_equal(hal->ops->bus_wait(hal->context), 0);
    }
    assert_memory_equal(bytes, "\0\0", sizeof bytes);
}

static void check_pins(const struct hal *hal)
{
    assert_int_equal(hal->ops->pin_set(hal->context, HAL_PIN_BACKLIGHT, false), 0);
    assert_int_equal(hal->ops->pin_set(hal->context, HAL_PIN_RESET, false), 0);
    hal->ops->delay_us(hal->context, 100);
    assert_int_equal(hal->ops->pin_set(hal->context, HAL_PIN_RESET, true), 0);
    assert_int_equal(hal->ops->buttons(hal->context) & ~31U, 0);
}

static void check_time(const struct hal *hal, bool keeps_time)
{
    uint32_t before = hal->ops->time_us(hal->context);
    hal->ops->delay_us(hal->context, 0);
    hal->ops->delay_us(hal->context, 2000);
    uint32_t passed = hal->ops->time_us(hal->context) - before; /* right also where the clock wraps */
    assert_true(passed < 1000000);
    assert_true(passed >= 2000 || !keeps_time);
}

/* The driver finds its way, in the board's format and with a clock that the backend reports. */
static void check_panel(const struct hal *hal, const struct board *board)
{
    static uint8_t scratch[512];
    static uint16_t line[1024];
    struct panel_config config = {board->panel, board->rotation, board->format, board->spi_hz, scratch, sizeof scratch};
    struct panel_driver d;
    assert_int_equal(panel_open(&d, hal, &config), 0);
    assert_true(d.clock_hz > 0 && (uint32_t)d.clock_hz <= board->spi_hz);
    for (int frame = 0; frame < 2; frame++) {
        assert_int_equal(panel_frame_begin(&d), 0);
        for (uint32_t y = 0; y < d.height; y++) {
            assert_int_equal(panel_rows(&d, line, 1), 0);
        }
        assert_int_equal(panel_frame_end(&d), 0);
    }
    assert_int_equal(panel_close(&d), 0);
}

void hal_conforms(const struct hal *hal, const struct board *board, const char *name, bool keeps_time)
{
    check_operations(hal);
    assert_string_equal(hal->ops->name, name);
    for (int turn = 0; turn < 2; turn++) { /* closed and opened again */
        assert_int_equal(hal->ops->open(hal->context, board), 0);
        check_clock(hal);
        check_pins(hal);
        check_time(hal, keeps_time);
        check_bus(hal);
        check_panel(hal, board);
        hal->ops->close(hal->context);
    }
}
