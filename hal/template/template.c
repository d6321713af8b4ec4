/*
 * Port to no chip: an image with it links, and does nothing. Copy this folder to port a chip, as hal/README.md tells.
 * hal.h, port.h and chips/cortexm/start.h say what each function must do; hal/chips/cortexm has the rest of port.h.
 */
#include "board.h"
#include "chips/cortexm/start.h"
#include "port.h"

/* ---- start, log -------------------------------------------------------------------------------------- */

uint32_t port_start(void)
{
    return 16000000; /* Hz */
}

void port_log(const char *text) /* called as put */
{
    (void)text;
}

int port_log_read(void)
{
    return -1;
}

void port_boot_loader(void)
{
}

void port_facts(port_put put) /* calls fact */
{
    put("chip: this port does not tell", 0, PORT_TEXT);
    put("\n", 0, PORT_TEXT);
}

void port_bus_stop(void)
{
}

/* ---- the operations of struct hal_ops ---------------------------------------------------------------- */

static int template_open(void *context, const struct board *board)
{
    (void)context;
    (void)board;
    return HAL_OK;
}

static int32_t template_bus_clock(void *context, uint32_t hz)
{
    (void)context;
    if (hz == 0) {
        return HAL_EINVAL;
    }
    return hz > INT32_MAX ? INT32_MAX : (int32_t)hz;
}

static int template_bus_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    (void)context;
    (void)dc;
    (void)bytes;
    (void)n;
    return HAL_OK;
}

static int template_bus_write_rows(void *context, const uint8_t *bytes, size_t n, size_t stride, size_t rows)
{
    (void)context;
    (void)bytes;
    (void)n;
    (void)stride;
    (void)rows;
    return HAL_OK;
}

static void template_bus_queue(void *context, bool on)
{
    (void)context;
    (void)on;
}

static uint32_t template_bus_written(void *context)
{
    (void)context;
    return 0;
}

static int template_bus_until(void *context, uint32_t written)
{
    (void)context;
    (void)written;
    return HAL_OK;
}

static int template_bus_wait(void *context)
{
    (void)context;
    return HAL_OK;
}

static uint32_t template_write_ns(void *context)
{
    (void)context;
    return 0;
}

/* NOLINTNEXTLINE(readability-non-const-parameter): hal.h has the type. */
static int template_bus_read(void *context, uint8_t command, uint8_t *bytes, size_t n)
{
    (void)context;
    (void)command;
    (void)bytes;
    (void)n;
    return HAL_ENOSYS;
}

static int template_pin_set(void *context, enum hal_pin pin, bool level)
{
    (void)context;
    (void)pin;
    (void)level;
    return HAL_OK;
}

static int template_te_wait(void *context, uint32_t timeout_us)
{
    (void)context;
    (void)timeout_us;
    return HAL_ENOSYS;
}

static uint32_t template_time_us(void *context)
{
    (void)context;
    return 0;
}

static void template_delay_us(void *context, uint32_t us)
{
    (void)context;
    (void)us;
}

static uint32_t template_buttons(void *context)
{
    (void)context;
    return 0;
}

static void template_close(void *context)
{
    (void)context;
}

struct hal port_hal(void)
{
    static const struct hal_ops ops = {
        .name = "template",
        .open = template_open,
        .bus_clock = template_bus_clock,
        .bus_write = template_bus_write,
        .bus_write_rows = template_bus_write_rows, /* NULL is allowed: see hal.h */
        .bus_queue = template_bus_queue,           /* NULL is allowed, with the next two */
        .bus_written = template_bus_written,
        .bus_until = template_bus_until,
        .bus_wait = template_bus_wait,
        .write_ns = template_write_ns, /* NULL is allowed */
        .bus_read = template_bus_read, /* NULL is allowed */
        .pin_set = template_pin_set,
        .te_wait = template_te_wait, /* NULL is allowed */
        .time_us = template_time_us,
        .delay_us = template_delay_us,
        .buttons = template_buttons,
        .close = template_close,
    };
    return (struct hal){&ops, NULL};
}
