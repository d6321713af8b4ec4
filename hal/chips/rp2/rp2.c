/* See rp2.h and port.h: the operations of struct hal_ops, and the ROM's boot loader. */
#include "rp2.h"
#include "port.h"
#include <cpu.h>

#include <stddef.h>

#define ALARM_MIN_US 100 /* an alarm for a shorter time could be set too late */

static void set_pin(const struct board_pin *pin, bool level)
{
    if (pin->wired) {
        rp2_pin_write(pin->number, level != pin->active_low);
    }
}

static void open_output(const struct board_pin *pin, bool level)
{
    if (pin->wired) {
        rp2_pin_output(pin->number, level != pin->active_low);
    }
}

static int rp2_open(void *context, const struct board *board)
{
    const struct board **open = context;
    *open = board;
    open_output(&board->pins.backlight, false);
    open_output(&board->pins.reset, true);
    for (uint32_t i = 0; i < board->button_count; i++) {
        rp2_pin_input(board->buttons[i].pin.number);
    }
    if (board->pins.tearing.wired) {
        rp2_pin_input(board->pins.tearing.number);
    }
    REG(TIMER_INTE) = 1;
    cpu_interrupt_enable(IRQ_TIMER_0);
    return rp2_bus_open(board);
}

static int rp2_pin_set(void *context, enum hal_pin pin, bool level)
{
    const struct board *const *open = context;
    const struct board_pins *pins = &(*open)->pins;
    set_pin(pin == HAL_PIN_RESET ? &pins->reset : &pins->backlight, level);
    return HAL_OK;
}

static uint32_t rp2_time_us(void *context)
{
    (void)context;
    return REG(TIMER_TIMERAWL);
}

/* Waits one microsecond more, for the first has already begun. The alarm only wakes the core; the loop ends the wait.
 */
static void rp2_delay_us(void *context, uint32_t us)
{
    const uint32_t start = rp2_time_us(context);
    const bool sleep = us >= ALARM_MIN_US;
    if (sleep) {
        REG(TIMER_ALARM0) = start + us + 2; /* surely late enough for the loop to end */
    }
    while (rp2_time_us(context) - start <= us) {
        if (sleep) {
            cpu_wait_event();
        }
    }
}

void rp2_timer_interrupt(void)
{
    REG(TIMER_INTR) = 1;
}

/* The pin latches its edge, so this first clears an edge from before the call. */
static int rp2_te_wait(void *context, uint32_t timeout_us) /* called as te_wait */
{
    const struct board *const *open = context;
    const uint32_t pin = (*open)->pins.tearing.number, start = rp2_time_us(context);
    REG(IO_BANK0_INTR(pin)) = INTR_EDGE_HIGH(pin);
    while ((REG(IO_BANK0_INTR(pin)) & INTR_EDGE_HIGH(pin)) == 0) {
        if (rp2_time_us(context) - start > timeout_us) {
            return HAL_ETIMEDOUT;
        }
    }
    return HAL_OK;
}

static uint32_t rp2_buttons(void *context)
{
    const struct board *const *open = context;
    const uint32_t levels = REG(SIO_GPIO_IN);
    uint32_t pressed = 0;
    for (uint32_t i = 0; i < (*open)->button_count; i++) {
        const struct board_button *b = &(*open)->buttons[i];
        const bool high = (levels >> b->pin.number & 1) != 0;
        pressed |= high != b->pin.active_low ? b->button : 0;
    }
    return pressed;
}

static void rp2_close(void *context)
{
    rp2_bus_close();
    rp2_pin_set(context, HAL_PIN_BACKLIGHT, false);
}

#define RP2_OPS(te)                                                                                                    \
    {                                                                                                                  \
        .name = "rp2", .open = rp2_open, .bus_clock = rp2_bus_clock, .bus_write = rp2_bus_write,                       \
        .bus_write_rows = rp2_bus_write_rows, .bus_queue = rp2_bus_queue, .bus_written = rp2_bus_written,              \
        .bus_until = rp2_bus_until, .bus_flush = rp2_bus_flush, .bus_wait = rp2_bus_wait, .pin_set = rp2_pin_set,      \
        .te_wait = (te), .time_us = rp2_time_us, .delay_us = rp2_delay_us, .buttons = rp2_buttons, .close = rp2_close, \
    }

static const struct hal_ops ops = RP2_OPS(NULL), ops_with_te = RP2_OPS(rp2_te_wait);

struct hal port_hal(void)
{
    static const struct board *open_board;
    return (struct hal){board_here->pins.tearing.wired ? &ops_with_te : &ops, &open_board};
}

void rp2_dark(void)
{
    open_output(&board_here->pins.backlight, false);
    open_output(&board_here->pins.reset, false);
}

void port_boot_loader(void)
{
    rp2_watchdog_stop();
    rp2_dark();
    start_boot_loader();
}
