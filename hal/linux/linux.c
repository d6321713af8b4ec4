/* See linux.h. The operations are here, the bus is in spi.c and sender.c, the lines are in lines.c. */
#define _POSIX_C_SOURCE 200809L
#include "linux.h"

#include "debounce.h"
#include "fail.h"
#include "i2c.h"
#include "lines.h"
#include "sender.h"
#include "spi.h"

#include <errno.h>
#include <poll.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { SETTLE_US = 8000, EDGES_MAX = 256 };

static uint64_t now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000U + (uint64_t)now.tv_nsec;
}

static bool wired(const struct linux_line *line)
{
    return line->request != NULL;
}

static int set_line(struct linux_hal *h, struct linux_line *line, const char *what, bool level)
{
    const int status = linux_gpio_set(line, level != line->active_low);
    return status == 0
               ? HAL_OK
               : linux_fail(h->error, linux_status(-status), "the %s line cannot be set: %s", what, strerror(-status));
}

/* ---- open and close ----------------------------------------------------------------------------- */

static void linux_close(void *context)
{
    struct linux_hal *h = context;
    if (!h->opened) {
        return;
    }
    linux_sender_stop(h);
    if (wired(&h->backlight)) {
        linux_gpio_set(&h->backlight, h->backlight.active_low);
    }
    for (uint32_t i = 0; i < BOARD_BUTTONS_MAX; i++) {
        linux_gpio_release(&h->buttons[i].line);
    }
    linux_gpio_release(&h->tearing);
    linux_gpio_release(&h->backlight);
    linux_gpio_release(&h->reset);
    linux_gpio_release(&h->dc);
    if (h->spi.descriptor >= 0) {
        close(h->spi.descriptor);
    }
    pthread_cond_destroy(&h->changed);
    pthread_mutex_destroy(&h->mutex);
    h->spi.descriptor = -1;
    h->opened = false;
}

/* Takes an output whose first level, in the sense of hal.h, is `level`. */
static int open_output(struct linux_hal *h, struct linux_line *line, const struct board_pin *pin, bool level)
{
    const struct linux_gpio_want want = {.use = GPIO_OUT, .level = level != pin->active_low};
    return linux_line_open(line, h->board, pin, &want, h->error);
}

static int open_lines(struct linux_hal *h)
{
    const struct board_pins *pins = &h->board->pins;
    const struct linux_gpio_want edges = {.use = pins->tearing.active_low ? GPIO_IN_BOTH : GPIO_IN_RISING};
    if (!pins->dc.wired && !h->i2c) {
        return linux_fail(h->error, HAL_EINVAL, "board %s has no D/C line", h->board->name);
    }
    int status = open_output(h, &h->dc, &pins->dc, false);
    status = status < 0 ? status : open_output(h, &h->reset, &pins->reset, true);
    status = status < 0 ? status : open_output(h, &h->backlight, &pins->backlight, false);
    return status < 0 ? status : linux_line_open(&h->tearing, h->board, &pins->tearing, &edges, h->error);
}

/* Opens the lines of the buttons. A button connects its line to ground (active low) or to the supply; a pull-up or
 * pull-down makes the other level. */
static int open_buttons(struct linux_hal *h)
{
    for (uint32_t i = 0; i < h->board->button_count && i < BOARD_BUTTONS_MAX; i++) {
        const struct board_pin *pin = &h->board->buttons[i].pin;
        struct linux_button *button = &h->buttons[i];
        const struct linux_gpio_want want = {
            .use = GPIO_IN_BOTH, .pull_up = pin->active_low, .pull_down = !pin->active_low, .debounce_us = SETTLE_US};
        int status = linux_line_open(&button->line, h->board, pin, &want, h->error);
        if (status == HAL_OK && wired(&button->line)) {
            const int level = linux_gpio_get(&button->line);
            linux_debounce_start(button, level >= 0 && (level > 0) != pin->active_low, now_ns());
        }
        if (status < 0) {
            return status;
        }
    }
    return HAL_OK;
}

static int linux_open(void *context, const struct board *board)
{
    struct linux_hal *h = context;
    linux_close(h);
    const char *path = h->spi_path;
    const size_t bufsiz = linux_spi_bufsiz();
    memset(h, 0, sizeof *h);
    h->spi_path = path;
    h->board = board;
    h->i2c = board->i2c_address != 0;
    h->bufsiz = h->i2c ? LINUX_I2C_BYTES : bufsiz != 0 ? bufsiz : 4096; /* the kernel's default */
    h->dc_now = HAL_COMMAND;
    h->opened = true;
    pthread_mutex_init(&h->mutex, NULL);
    pthread_cond_init(&h->changed, NULL);
    int status =
        h->i2c ? linux_i2c_open(&h->spi, board, path, h->error) : linux_spi_open(&h->spi, board, path, h->error);
    status = status < 0 ? status : open_lines(h);
    status = status < 0 ? status : open_buttons(h);
    status = status < 0 ? status : linux_sender_start(h);
    if (status < 0) {
        linux_close(h);
    }
    return status;
}

/* ---- the other operations ----------------------------------------------------------------------- */

static int32_t linux_bus_clock(void *context, uint32_t hz)
{
    struct linux_hal *h = context;
    const int status = linux_sender_idle(h);
    if (status < 0) {
        return status;
    }
    if (hz == 0) {
        return linux_fail(h->error, HAL_EINVAL, "%s: a clock of 0 Hz was asked for", h->spi.name);
    }
    if (h->i2c) { /* the device tree's; the board says what it should be */
        h->spi.clock_hz = hz < h->board->spi_hz ? hz : h->board->spi_hz;
        return (int32_t)h->spi.clock_hz;
    }
    const int32_t got = linux_spi_clock(&h->spi, hz, h->error);
    h->best_ns = h->best_bytes = 0;
    return got;
}

static int linux_bus_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    return linux_sender_write(context, dc, bytes, n);
}

static void linux_bus_flush(void *context)
{
    linux_sender_flush(context);
}

static int linux_bus_wait(void *context)
{
    return linux_sender_idle(context);
}

static uint32_t linux_write_ns(void *context)
{
    struct linux_hal *h = context;
    pthread_mutex_lock(&h->mutex);
    const uint32_t ns = h->write_ns;
    pthread_mutex_unlock(&h->mutex);
    return ns;
}

static int linux_bus_read(void *context, uint8_t command, uint8_t *bytes, size_t n)
{
    struct linux_hal *h = context;
    int status = linux_sender_idle(h);
    if (status < 0) {
        return status;
    }
    if (!h->board->pins.data_in.wired) {
        return linux_fail(h->error, HAL_ENOSYS, "board %s has no data line from the panel", h->board->name);
    }
    if (n == 0 || n > linux_spi_piece(n, h->bufsiz)) {
        return linux_fail(h->error, HAL_EINVAL, "%s: %zu bytes cannot be read at once", h->spi.name, n);
    }
    status = linux_sender_dc(h, HAL_COMMAND);
    return status < 0 ? status : linux_spi_read(&h->spi, command, bytes, n, h->error);
}

static int linux_pin_set(void *context, enum hal_pin pin, bool level)
{
    struct linux_hal *h = context;
    struct linux_line *line = pin == HAL_PIN_RESET ? &h->reset : &h->backlight;
    const int status = linux_sender_idle(h);
    if (status < 0 || !wired(line)) {
        return status;
    }
    return set_line(h, line, pin == HAL_PIN_RESET ? "reset" : "backlight", level);
}

static bool edge_waits(struct linux_line *line, int timeout_ms)
{
    struct pollfd waiting = {.fd = linux_gpio_descriptor(line), .events = POLLIN};
    return poll(&waiting, 1, timeout_ms) > 0 && (waiting.revents & POLLIN) != 0;
}

static int linux_te_wait(void *context, uint32_t timeout_us)
{
    struct linux_hal *h = context;
    uint64_t time_ns = 0;
    const int status = linux_sender_idle(h);
    if (status < 0) {
        return status;
    }
    if (!wired(&h->tearing)) {
        return HAL_ENOSYS;
    }
    for (int i = 0; i < EDGES_MAX && edge_waits(&h->tearing, 0); i++) {
        linux_gpio_edge(&h->tearing, &time_ns); /* an edge of an earlier frame */
    }
    const uint64_t end_ns = now_ns() + 1000ULL * timeout_us;
    for (uint64_t now = now_ns(); now < end_ns; now = now_ns()) {
        if (edge_waits(&h->tearing, (int)((end_ns - now + 999999) / 1000000))) {
            const int rising = linux_gpio_edge(&h->tearing, &time_ns);
            if (rising < 0) {
                return linux_fail(h->error, linux_status(-rising), "the TE line cannot be read: %s", strerror(-rising));
            }
            if ((rising > 0) != h->tearing.active_low) {
                return HAL_OK;
            }
        }
    }
    return linux_fail(h->error, HAL_ETIMEDOUT,
                      "no edge on the TE line for %u ms; look at its wire, or leave the line out",
                      (unsigned)(timeout_us / 1000));
}

static uint32_t linux_time_us(void *context)
{
    (void)context;
    return (uint32_t)(now_ns() / 1000);
}

/* Waits, counting from the last bit. An error of the bus stays for the next write or wait. */
static void linux_delay_us(void *context, uint32_t us)
{
    struct linux_hal *h = context;
    struct timespec end;
    linux_sender_wait(h);
    const uint64_t end_ns = now_ns() + 1000ULL * us;
    end.tv_sec = (time_t)(end_ns / 1000000000U);
    end.tv_nsec = (long)(end_ns % 1000000000U);
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &end, NULL) == EINTR) {
    }
}

static uint32_t linux_buttons(void *context)
{
    struct linux_hal *h = context;
    const uint64_t settle_ns = linux_gpio_debounces() ? 0 : 1000ULL * SETTLE_US;
    uint32_t held = 0;
    for (uint32_t i = 0; i < BOARD_BUTTONS_MAX; i++) {
        struct linux_button *button = &h->buttons[i];
        uint64_t time_ns = 0;
        for (int k = 0; k < EDGES_MAX && wired(&button->line) && edge_waits(&button->line, 0); k++) {
            const int rising = linux_gpio_edge(&button->line, &time_ns);
            if (rising < 0) {
                break;
            }
            linux_debounce_edge(button, (rising > 0) != button->line.active_low, time_ns, settle_ns);
        }
        if (wired(&button->line) && linux_debounce_look(button, now_ns(), settle_ns)) {
            held |= h->board->buttons[i].button;
        }
    }
    return held;
}

const struct hal_ops linux_ops = {
    .name = "linux",
    .open = linux_open,
    .bus_clock = linux_bus_clock,
    .bus_write = linux_bus_write,
    .bus_flush = linux_bus_flush,
    .bus_wait = linux_bus_wait,
    .write_ns = linux_write_ns,
    .bus_read = linux_bus_read,
    .pin_set = linux_pin_set,
    .te_wait = linux_te_wait,
    .time_us = linux_time_us,
    .delay_us = linux_delay_us,
    .buttons = linux_buttons,
    .close = linux_close,
};

const char *linux_hal_error(const struct linux_hal *h)
{
    return h->error;
}

uint32_t linux_hal_bits_per_second(const struct linux_hal *h)
{
    const uint64_t rate = h->best_ns == 0 ? 0 : h->best_bytes * 8000000000U / h->best_ns;
    return rate < h->spi.clock_hz ? (uint32_t)rate : h->spi.clock_hz;
}
