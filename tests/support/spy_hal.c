/* See spy_hal.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "spy_hal.h"

static void note(struct spy *spy, enum spy_event_kind kind, uint32_t value)
{
    assert_true(spy->count < SPY_EVENTS_MAX);
    spy->events[spy->count++] = (struct spy_event){kind, value};
}

static int release(struct spy *spy)
{
    size_t n = spy->held_bytes;
    spy->held_bytes = 0;
    return n == 0 ? 0 : spy->sim.ops->bus_write(spy->sim.context, spy->dc, spy->held, n);
}

static int spy_open(void *context, const struct board *board)
{
    struct spy *spy = context;
    return spy->sim.ops->open(spy->sim.context, board);
}

static int32_t spy_bus_clock(void *context, uint32_t hz)
{
    struct spy *spy = context;
    assert_int_equal(spy->held_bytes, 0); /* not while bytes are on their way */
    note(spy, SPY_CLOCK, hz);
    return spy->sim.ops->bus_clock(spy->sim.context, hz);
}

static int spy_bus_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    struct spy *spy = context;
    int status = release(spy);
    note(spy, dc == HAL_COMMAND ? SPY_COMMAND : SPY_DATA, dc == HAL_COMMAND ? bytes[0] : (uint32_t)n);
    spy->dc = dc;
    spy->held = bytes;
    spy->held_bytes = n;
    return status;
}

static int spy_bus_wait(void *context)
{
    struct spy *spy = context;
    int status = release(spy);
    return status < 0 ? status : spy->sim.ops->bus_wait(spy->sim.context);
}

static int spy_pin_set(void *context, enum hal_pin pin, bool level)
{
    struct spy *spy = context;
    assert_int_equal(spy->held_bytes, 0);
    note(spy, pin == HAL_PIN_RESET ? SPY_RESET : SPY_BACKLIGHT, level);
    return spy->sim.ops->pin_set(spy->sim.context, pin, level);
}

static uint32_t spy_time_us(void *context)
{
    struct spy *spy = context;
    return spy->sim.ops->time_us(spy->sim.context);
}

static void spy_delay_us(void *context, uint32_t us)
{
    struct spy *spy = context;
    note(spy, SPY_DELAY, us);
    spy->sim.ops->delay_us(spy->sim.context, us);
}

static uint32_t spy_buttons(void *context)
{
    struct spy *spy = context;
    return spy->sim.ops->buttons(spy->sim.context);
}

static void spy_close(void *context)
{
    struct spy *spy = context;
    release(spy);
    spy->sim.ops->close(spy->sim.context);
}

const struct hal_ops spy_ops = {
    .name = "spy",
    .open = spy_open,
    .bus_clock = spy_bus_clock,
    .bus_write = spy_bus_write,
    .bus_wait = spy_bus_wait,
    .pin_set = spy_pin_set,
    .time_us = spy_time_us,
    .delay_us = spy_delay_us,
    .buttons = spy_buttons,
    .close = spy_close,
};

uint32_t spy_find(const struct spy *spy, uint32_t from, enum spy_event_kind kind, uint32_t value)
{
    for (uint32_t i = from; i < spy->count; i++) {
        if (spy->events[i].kind == kind && spy->events[i].value == value) {
            return i;
        }
    }
    fail_msg("no event of kind %d with value %u after number %u", (int)kind, value, from);
    return 0;
}

uint32_t spy_count(const struct spy *spy, enum spy_event_kind kind, uint32_t value)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < spy->count; i++) {
        n += spy->events[i].kind == kind && spy->events[i].value == value;
    }
    return n;
}
