/* See null.h, and hal.h for what each operation must do. */
#include "null.h"

static int null_open(void *context, const struct board *board)
{
    (void)context;
    (void)board;
    return HAL_OK;
}

static int32_t null_bus_clock(void *context, uint32_t hz)
{
    (void)context;
    if (hz == 0) {
        return HAL_EINVAL;
    }
    return hz > INT32_MAX ? INT32_MAX : (int32_t)hz;
}

static int null_bus_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    (void)context;
    (void)dc;
    (void)bytes;
    (void)n;
    return HAL_OK;
}

static int null_bus_wait(void *context)
{
    (void)context;
    return HAL_OK;
}

static int null_pin_set(void *context, enum hal_pin pin, bool level)
{
    (void)context;
    (void)pin;
    (void)level;
    return HAL_OK;
}

static uint32_t null_time_us(void *context)
{
    (void)context;
    return 0;
}

static void null_delay_us(void *context, uint32_t us)
{
    (void)context;
    (void)us;
}

static uint32_t null_buttons(void *context)
{
    (void)context;
    return 0;
}

static void null_close(void *context)
{
    (void)context;
}

const struct hal_ops null_ops = {
    .name = "null",
    .open = null_open,
    .bus_clock = null_bus_clock,
    .bus_write = null_bus_write,
    .bus_wait = null_bus_wait,
    .pin_set = null_pin_set,
    .time_us = null_time_us,
    .delay_us = null_delay_us,
    .buttons = null_buttons,
    .close = null_close,
};
