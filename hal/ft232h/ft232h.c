/* See ft232h.h. The operations become MPSSE commands here; link.h carries them to the chip. */
#define _POSIX_C_SOURCE 200809L
#include "ft232h.h"

#include "link.h"
#include "mpsse.h"

#include <errno.h>
#include <string.h>
#include <time.h>

enum { PIN_CLOCK = 1, PIN_DATA = 2, PIN_DATA_IN = 4 }; /* bits of AD0, AD1, AD2 */

/* ---- pins --------------------------------------------------------------------------------------- */

static uint16_t bit_of(const struct board_pin *pin)
{
    const int number = pin->wired && pin->line != NULL ? ft232h_mpsse_pin(pin->line) : -1;
    return (uint16_t)(number < 0 ? 0U : 1U << number);
}

/* Sets a pin's level, in the sense of hal.h; a change goes into the stream. */
static int set_pin(struct ft232h *h, const struct board_pin *pin, bool level)
{
    uint8_t commands[MPSSE_PINS_MAX];
    const uint16_t bit = bit_of(pin);
    const uint16_t levels = (uint16_t)(level != pin->active_low ? h->levels | bit : h->levels & ~bit);
    const uint16_t changed = levels ^ h->levels;
    h->levels = levels;
    return ft232h_link_put(h->usb, commands, ft232h_mpsse_pins(commands, levels, h->outputs, changed));
}

/*
 * Refuses a wired pin that the engine cannot use so, or that another line has. `fixed` is the bit that it must be; 0:
 * any but the engine's own. used: the bits of the lines so far.
 */
static int check_pin(struct ft232h *h, uint16_t *used, const char *what, const struct board_pin *pin, uint16_t fixed)
{
    const uint16_t bit = bit_of(pin);
    if (!pin->wired) {
        return HAL_OK;
    }
    if (fixed != 0 ? bit != fixed : (bit & ~(PIN_CLOCK | PIN_DATA | PIN_DATA_IN)) == 0) {
        return ft232h_fail(h->error, HAL_EINVAL, "board %s: %s cannot be pin %s of an FT232H; it is %s", h->board->name,
                           what, pin->line == NULL ? "without a name" : pin->line,
                           fixed == PIN_CLOCK     ? "AD0"
                           : fixed == PIN_DATA    ? "AD1"
                           : fixed == PIN_DATA_IN ? "AD2"
                                                  : "one of AD3 to AD7, AC0 to AC7");
    }
    if ((bit & *used) != 0) {
        return ft232h_fail(h->error, HAL_EINVAL, "board %s: %s cannot be pin %s of an FT232H: another line has it",
                           h->board->name, what, pin->line);
    }
    *used |= bit;
    return HAL_OK;
}

static int check_board(struct ft232h *h)
{
    const struct board_pins *pins = &h->board->pins;
    const struct {
        const char *what;
        const struct board_pin *pin;
        uint16_t fixed;
    } lines[] = {
        {"clock", &pins->clock, PIN_CLOCK}, {"data", &pins->data, PIN_DATA}, {"data in", &pins->data_in, PIN_DATA_IN},
        {"select", &pins->select, 0},       {"D/C", &pins->dc, 0},           {"reset", &pins->reset, 0},
        {"backlight", &pins->backlight, 0}};
    uint16_t used = 0;
    int status = HAL_OK;
    for (size_t i = 0; i < sizeof lines / sizeof lines[0] && status == HAL_OK; i++) {
        status = check_pin(h, &used, lines[i].what, lines[i].pin, lines[i].fixed);
    }
    for (uint32_t i = 0; i < h->board->button_count && status == HAL_OK; i++) {
        status = check_pin(h, &used, "a button", &h->board->buttons[i].pin, 0);
    }
    if (status == HAL_OK && (!pins->dc.wired || (h->board->spi_mode != 0 && h->board->spi_mode != 3))) {
        return ft232h_fail(h->error, HAL_EINVAL, "board %s: an FT232H needs a D/C pin, and SPI mode 0 or 3",
                           h->board->name);
    }
    return status;
}

/* ---- the stream --------------------------------------------------------------------------------- */

/* Waits for the answer to a last command: then the engine has done all before it. */
static int finish(struct ft232h *h)
{
    static const uint8_t ask[] = {MPSSE_GET_LOW, MPSSE_SEND_NOW};
    uint8_t low = 0;
    if (!h->unfinished) {
        return HAL_OK;
    }
    int status = ft232h_link_put(h->usb, ask, sizeof ask);
    status = status < 0 ? status : ft232h_link_flush(h->usb);
    status = status < 0 ? status : ft232h_link_get(h->usb, &low, 1);
    h->unfinished = status < 0;
    return status;
}

static int put_bytes(struct ft232h *h, const uint8_t *bytes, size_t n)
{
    uint8_t head[MPSSE_BLOCK];
    int status = HAL_OK;
    while (n > 0 && status == HAL_OK) {
        const size_t piece = n < MPSSE_BLOCK_MAX ? n : MPSSE_BLOCK_MAX;
        ft232h_mpsse_block(head, MPSSE_OUT, piece);
        status = ft232h_link_put(h->usb, head, sizeof head);
        status = status < 0 ? status : ft232h_link_put(h->usb, bytes, piece);
        bytes += piece;
        n -= piece;
    }
    return status;
}

/* Sets D/C before select, for the panel reads D/C with the last bit of each byte. */
static int begin(struct ft232h *h, enum hal_dc dc)
{
    h->unfinished = true;
    const int status = set_pin(h, &h->board->pins.dc, dc == HAL_DATA);
    return status < 0 ? status : set_pin(h, &h->board->pins.select, true);
}

static int ft232h_bus_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    struct ft232h *h = context;
    if (n == 0) {
        return HAL_OK;
    }
    int status = begin(h, dc);
    status = status < 0 ? status : put_bytes(h, bytes, n);
    status = status < 0 ? status : set_pin(h, &h->board->pins.select, false);
    return status < 0 || n < FT232H_FLUSH_BYTES ? status : ft232h_link_flush(h->usb);
}

static int ft232h_bus_wait(void *context)
{
    return finish(context);
}

static int ft232h_bus_read(void *context, uint8_t command, uint8_t *bytes, size_t n)
{
    struct ft232h *h = context;
    uint8_t head[MPSSE_BLOCK + 1] = {0, 0, 0, MPSSE_SEND_NOW};
    if (!h->board->pins.data_in.wired) {
        return ft232h_fail(h->error, HAL_ENOSYS, "board %s has no data line from the panel", h->board->name);
    }
    if (n == 0 || n > MPSSE_BLOCK_MAX) {
        return ft232h_fail(h->error, HAL_EINVAL, "FT232H: %zu bytes cannot be read at once", n);
    }
    int status = finish(h);
    status = status < 0 ? status : begin(h, HAL_COMMAND);
    status = status < 0 ? status : put_bytes(h, &command, 1);
    ft232h_mpsse_block(head, MPSSE_IN, n);
    status = status < 0 ? status : ft232h_link_put(h->usb, head, sizeof head);
    status = status < 0 ? status : set_pin(h, &h->board->pins.select, false);
    status = status < 0 ? status : ft232h_link_flush(h->usb);
    return status < 0 ? status : ft232h_link_get(h->usb, bytes, n);
}

static int ft232h_pin_set(void *context, enum hal_pin pin, bool level)
{
    struct ft232h *h = context;
    const int status = set_pin(h, pin == HAL_PIN_RESET ? &h->board->pins.reset : &h->board->pins.backlight, level);
    h->unfinished = true;
    return status < 0 ? status : finish(h);
}

static int32_t ft232h_bus_clock(void *context, uint32_t hz)
{
    struct ft232h *h = context;
    uint8_t command[MPSSE_CLOCK];
    const uint32_t got = ft232h_mpsse_clock(command, hz);
    if (got == 0) {
        return ft232h_fail(h->error, HAL_EINVAL, "FT232H: no clock as slow as %u Hz; the slowest is 458 Hz",
                           (unsigned)hz);
    }
    int status = finish(h);
    ft232h_link_pace(h->usb, got);
    status = status < 0 ? status : ft232h_link_put(h->usb, command, sizeof command);
    h->unfinished = true;
    return status < 0 ? status : (int32_t)got;
}

/* ---- time and buttons --------------------------------------------------------------------------- */

static uint64_t now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000U + (uint64_t)now.tv_nsec;
}

static uint32_t ft232h_time_us(void *context)
{
    (void)context;
    return (uint32_t)(now_ns() / 1000);
}

/* Waits, counting from the last bit. An error of finish() comes again with the next operation. */
static void ft232h_delay_us(void *context, uint32_t us)
{
    struct timespec end;
    finish(context);
    const uint64_t end_ns = now_ns() + 1000ULL * us;
    end.tv_sec = (time_t)(end_ns / 1000000000U);
    end.tv_nsec = (long)(end_ns % 1000000000U);
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &end, NULL) == EINTR) {
    }
}

/* Reads the buttons: asks for all pins. When a contact bounces just then, the next call sees it right. */
static uint32_t ft232h_buttons(void *context)
{
    static const uint8_t ask[] = {MPSSE_GET_LOW, MPSSE_GET_HIGH, MPSSE_SEND_NOW};
    struct ft232h *h = context;
    uint8_t levels[2] = {0, 0};
    uint32_t held = 0;
    if (h->board->button_count == 0 || finish(h) < 0 || ft232h_link_put(h->usb, ask, sizeof ask) < 0 ||
        ft232h_link_flush(h->usb) < 0 || ft232h_link_get(h->usb, levels, sizeof levels) < 0) {
        return 0;
    }
    for (uint32_t i = 0; i < h->board->button_count; i++) {
        const struct board_pin *pin = &h->board->buttons[i].pin;
        const bool high = (bit_of(pin) & (levels[0] | levels[1] << 8)) != 0;
        held |= pin->wired && high != pin->active_low ? h->board->buttons[i].button : 0U;
    }
    return held;
}

/* ---- open and close ----------------------------------------------------------------------------- */

static void add_output(struct ft232h *h, const struct board_pin *pin, bool level)
{
    const uint16_t bit = bit_of(pin);
    h->outputs |= bit;
    h->levels |= level != pin->active_low ? bit : 0U;
}

/* Starts with a panel that is not selected, runs and is dark; the clock rests. */
static int start(struct ft232h *h)
{
    static const uint8_t modes[] = {MPSSE_60_MHZ, MPSSE_ADAPTIVE_OFF, MPSSE_LOOPBACK_OFF};
    uint8_t commands[MPSSE_PINS_MAX];
    const struct board_pins *pins = &h->board->pins;
    h->outputs = PIN_CLOCK | PIN_DATA;
    h->levels = h->board->spi_mode == 3 ? PIN_CLOCK : 0;
    add_output(h, &pins->select, false);
    add_output(h, &pins->dc, false);
    add_output(h, &pins->reset, true);
    add_output(h, &pins->backlight, false);
    int status = ft232h_link_put(h->usb, modes, sizeof modes);
    status = status < 0
                 ? status
                 : ft232h_link_put(h->usb, commands, ft232h_mpsse_pins(commands, h->levels, h->outputs, UINT16_MAX));
    h->unfinished = true;
    return status < 0 ? status : finish(h);
}

static void ft232h_close(void *context)
{
    struct ft232h *h = context;
    if (h->usb != NULL) {
        ft232h_pin_set(h, HAL_PIN_BACKLIGHT, false);
        ft232h_link_close(h->usb);
        h->usb = NULL;
    }
}

static int ft232h_open(void *context, const struct board *board)
{
    struct ft232h *h = context;
    ft232h_close(h);
    const char *serial = h->serial;
    memset(h, 0, sizeof *h);
    h->serial = serial;
    h->board = board;
    int status = check_board(h);
    status = status < 0 ? status : ft232h_link_open(&h->usb, serial, h->error);
    status = status < 0 ? status : start(h);
    if (status < 0) {
        ft232h_close(h);
    }
    return status;
}

const struct hal_ops ft232h_ops = {
    .name = "ft232h",
    .open = ft232h_open,
    .bus_clock = ft232h_bus_clock,
    .bus_write = ft232h_bus_write,
    .bus_wait = ft232h_bus_wait,
    .bus_read = ft232h_bus_read,
    .pin_set = ft232h_pin_set,
    .time_us = ft232h_time_us,
    .delay_us = ft232h_delay_us,
    .buttons = ft232h_buttons,
    .close = ft232h_close,
};

const char *ft232h_error(const struct ft232h *h)
{
    return h->error;
}
