/* See sim.h. The bus, the pins and the clock; what the bytes mean is up to the models. */
#include "sim.h"

#include "sim_model.h"

#include "chips/spi_clock.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- the wire ----------------------------------------------------------------------------------- */

static void check_clock(struct sim *sim)
{
    const struct sim_model *model = sim->glass.model;
    const uint32_t limit_hz = sim->board->i2c_address != 0 ? model->i2c_hz : model->write_hz;
    sim->clock_checked = true;
    if (sim->counters.clock_hz <= limit_hz) {
        return;
    }
    if (sim->board->over_limit) {
        snprintf(sim->note, sizeof sim->note, "%s: clock %u Hz is above the datasheet's %u Hz, as usual on this kit",
                 model->controller, sim->counters.clock_hz, limit_hz);
    } else {
        sim_complain(sim, SIM_OVER_CLOCK, "clock %u Hz is above the limit of %u Hz", sim->counters.clock_hz, limit_hz);
    }
}

static void check_reset(struct sim *sim)
{
    if (sim->reset_low) {
        sim_complain(sim, SIM_EARLY_COMMAND, "a byte while the reset line is low");
    } else if (sim->time_ns < sim->reset_ready_ns) {
        sim_complain(sim, SIM_EARLY_COMMAND, "a byte %u us after reset, %u us are needed",
                     (unsigned)((sim->time_ns + sim->glass.model->reset_wait_ns - sim->reset_ready_ns) / 1000),
                     sim->glass.model->reset_wait_ns / 1000);
    }
    sim->reset_done = true;
}

void sim_take_byte(struct sim *sim, enum hal_dc dc, uint8_t byte)
{
    if (!sim->clock_checked) {
        check_clock(sim);
    }
    if (!sim->reset_done) {
        check_reset(sim);
    }
    sim->counters.bytes++;
    sim->counters.command_bytes += dc == HAL_COMMAND;
    sim->glass.model->byte(sim, dc, byte);
}

/* A bit takes two half periods of the clock. */
static void time_passes(struct sim *sim, uint32_t half_periods)
{
    uint64_t rest = sim->bus_rest + 500000000ULL * half_periods;
    uint64_t ns = rest / sim->counters.clock_hz;
    sim->bus_rest = rest - ns * sim->counters.clock_hz; /* a second division would take as long as all else here */
    sim->time_ns += ns;
    sim->counters.bus_ns += ns;
}

void sim_bit(struct sim *sim, enum hal_dc dc, unsigned bit)
{
    time_passes(sim, 2);
    if (sim->shift_count > 0 && dc != sim->shift_dc) {
        sim_complain(sim, SIM_DC_MOVED, "D/C moved after bit %u of a byte", sim->shift_count);
    }
    sim->shift = (uint8_t)(sim->shift << 1 | (bit & 1));
    sim->shift_dc = dc;
    if (++sim->shift_count == 8) {
        sim->shift_count = 0;
        sim_take_byte(sim, dc, sim->shift); /* the controllers look at D/C with the last bit */
    }
}

/* Sends a byte bit by bit. D/C changes after four of the bits, or not at all. */
static void send_byte_bitwise(struct sim *sim, enum hal_dc dc, uint8_t byte, bool racy)
{
    enum hal_dc other = dc == HAL_DATA ? HAL_COMMAND : HAL_DATA;
    for (unsigned i = 0; i < 8; i++) {
        sim_bit(sim, racy && i >= 4 ? other : dc, byte >> (7 - i) & 1U);
    }
}

static void send_bytes(struct sim *sim, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (sim->shift_count > 0) { /* somebody left the wire in the middle of a byte */
            send_byte_bitwise(sim, dc, bytes[i], false);
            continue;
        }
        time_passes(sim, 16);
        sim_take_byte(sim, dc, bytes[i]);
    }
    time_passes(sim, spi_clock_pause(sim->board, (uint32_t)n));
}

/* A byte and its acknowledgement take 9 clocks, start and stop one each. */
static int send_message(struct sim *sim, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    const uint8_t head[2] = {(uint8_t)(sim->board->i2c_address << 1), dc == HAL_DATA ? 0x40 : 0x00};
    bool acknowledged = true;
    time_passes(sim, 4);
    sim_i2c_start(sim);
    for (size_t i = 0; i < n + 2 && acknowledged; i++) {
        time_passes(sim, 18);
        acknowledged = sim_i2c_byte(sim, i < 2 ? head[i] : bytes[i - 2]);
    }
    return acknowledged ? HAL_OK : HAL_EIO;
}

/* ---- operations --------------------------------------------------------------------------------- */

/* Does the fault strike in this call? */
static bool fault_strikes(struct sim *sim, enum sim_fault fault)
{
    if (sim->fault != fault || --sim->fault_n > 0) {
        return false;
    }
    sim->fault = SIM_FAULT_NONE;
    return true;
}

static int sim_bus_open(void *context, const struct board *board)
{
    struct sim *sim = context;
    (void)board; /* given to sim_open already */
    return fault_strikes(sim, SIM_FAULT_OPEN) ? HAL_EACCES : HAL_OK;
}

static int32_t sim_bus_clock(void *context, uint32_t hz)
{
    struct sim *sim = context;
    const uint32_t i2c_hz = hz < sim->board->spi_hz ? hz : sim->board->spi_hz;
    const uint32_t got = sim->board->i2c_address != 0 ? i2c_hz : spi_clock_of(sim->board, hz);
    if (got == 0 || fault_strikes(sim, SIM_FAULT_CLOCK)) {
        return HAL_EINVAL;
    }
    sim->counters.clock_hz = got > INT32_MAX ? INT32_MAX : got;
    sim->bus_rest = 0;
    sim->clock_checked = false;
    return (int32_t)sim->counters.clock_hz;
}

static int sim_bus_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    struct sim *sim = context;
    if (n == 0) {
        return HAL_OK;
    }
    sim->counters.writes++;
    if (fault_strikes(sim, SIM_FAULT_WRITE)) {
        return HAL_EIO;
    }
    if (sim->board->i2c_address != 0) {
        return send_message(sim, dc, bytes, n);
    }
    if (fault_strikes(sim, SIM_FAULT_SHORT_WRITE)) {
        send_bytes(sim, dc, bytes, n / 2);
        return HAL_EIO;
    }
    if (fault_strikes(sim, SIM_FAULT_DC_EARLY)) {
        send_bytes(sim, dc, bytes, n - 1);
        send_byte_bitwise(sim, dc, bytes[n - 1], true);
        return HAL_OK;
    }
    send_bytes(sim, dc, bytes, n);
    return HAL_OK;
}

static int sim_bus_wait(void *context)
{
    return fault_strikes(context, SIM_FAULT_STUCK) ? HAL_ETIMEDOUT : HAL_OK;
}

static void reset_line(struct sim *sim, bool level)
{
    const struct sim_model *model = sim->glass.model;
    if (!level && !sim->reset_low) {
        sim->reset_low = true;
        sim->reset_done = false;
        sim->reset_fell_ns = sim->time_ns;
    } else if (level && sim->reset_low) {
        sim->reset_low = false;
        uint64_t pulse = sim->time_ns - sim->reset_fell_ns;
        if (pulse < model->reset_pulse_ns) {
            sim_complain(sim, SIM_SHORT_RESET, "reset pulse of %u ns, %u ns are needed", (unsigned)pulse,
                         model->reset_pulse_ns);
        }
        sim->reset_ready_ns = sim->time_ns + model->reset_wait_ns;
        sim->reset_done = false; /* a byte may have come in between */
        model->reset(sim);
    }
}

static int sim_pin_set(void *context, enum hal_pin pin, bool level)
{
    struct sim *sim = context;
    if (pin == HAL_PIN_RESET && sim->board->pins.reset.wired) {
        reset_line(sim, level);
    } else if (pin == HAL_PIN_BACKLIGHT && sim->board->pins.backlight.wired) {
        if (level && !sim->backlight && sim->glass.backlit && !sim_frame_complete(sim)) {
            sim_complain(sim, SIM_LIT_WITHOUT_FRAME, "backlight on before a complete frame");
        }
        sim->backlight = level;
    }
    return HAL_OK;
}

static uint32_t sim_time_us(void *context)
{
    const struct sim *sim = context;
    return (uint32_t)(sim->time_ns / 1000);
}

static void sim_delay_us(void *context, uint32_t us)
{
    struct sim *sim = context;
    if (sim->fault != SIM_FAULT_DELAY) {
        sim->time_ns += 1000ULL * us;
    }
    if (sim->glass.model->rest != NULL) {
        sim->glass.model->rest(sim);
    }
}

static uint32_t sim_buttons(void *context)
{
    const struct sim *sim = context;
    return sim->buttons;
}

static void sim_bus_close(void *context)
{
    struct sim *sim = context;
    sim->backlight = !sim->board->pins.backlight.wired;
}

const struct hal_ops sim_ops = {
    .name = "sim",
    .open = sim_bus_open,
    .bus_clock = sim_bus_clock,
    .bus_write = sim_bus_write,
    .bus_wait = sim_bus_wait,
    .pin_set = sim_pin_set,
    .time_us = sim_time_us,
    .delay_us = sim_delay_us,
    .buttons = sim_buttons,
    .close = sim_bus_close,
};

/* ---- the simulator's own functions -------------------------------------------------------------- */

/* After power-on the memory holds bright noise, the same every time. */
static void fill_with_noise(struct sim *sim)
{
    uint32_t count = (uint32_t)sim->glass.ram_width * sim->glass.ram_height;
    uint32_t state = 2463534242U;
    for (uint32_t i = 0; i < count; i++) {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        sim->memory[i] = (struct sim_cell){(uint8_t)(state | 0x40), (uint8_t)(state >> 8), (uint8_t)(state >> 16), 0};
    }
}

struct sim *sim_open(const struct board *board, struct hal *hal)
{
    struct sim_glass made;
    const struct sim_glass *glass = sim_glass_find(board->panel, &made);
    struct sim *sim = glass == NULL ? NULL : calloc(1, sizeof *sim);
    if (sim == NULL) {
        return NULL;
    }
    sim->board = board;
    sim->glass = *glass;
    sim->memory = calloc((size_t)glass->ram_width * glass->ram_height, sizeof *sim->memory);
    if (sim->memory == NULL) {
        free(sim);
        return NULL;
    }
    sim->counters.clock_hz = 1000000;
    sim->backlight = !board->pins.backlight.wired;
    sim->reset_ready_ns = glass->model->reset_wait_ns;
    fill_with_noise(sim);
    glass->model->reset(sim);
    if (glass->model->mode_0 && board->spi_mode != 0) {
        sim_complain(sim, SIM_WRONG_MODE, "SPI mode %u: the clock must be low when SCS rises, as in mode 0",
                     board->spi_mode);
    }
    *hal = (struct hal){&sim_ops, sim};
    if (sim_ops.open(sim, board) < 0) {
        sim_close(sim);
        return NULL;
    }
    return sim;
}

void sim_close(struct sim *sim)
{
    if (sim != NULL) {
        free(sim->memory);
        free(sim);
    }
}

/* The inscribed circle: pixels whose centre lies within half the width of the middle. */
static bool has_glass(const struct sim_glass *glass, uint32_t x, uint32_t y)
{
    if (!glass->round) {
        return true;
    }
    int32_t dx = 2 * (int32_t)x + 1 - glass->width;
    int32_t dy = 2 * (int32_t)y + 1 - glass->height;
    return dx * dx + dy * dy <= glass->width * glass->width;
}

void sim_pixels(const struct sim *sim, unsigned rotation, uint8_t *rgb)
{
    const struct sim_glass *glass = &sim->glass;
    uint32_t width = rotation & 1 ? glass->height : glass->width;
    uint32_t height = rotation & 1 ? glass->width : glass->height;
    bool seen = glass->model->shows(sim) && (sim->backlight || !glass->backlit) && !sim->reset_low;
    for (uint32_t py = 0; py < height; py++) {
        for (uint32_t px = 0; px < width; px++, rgb += 3) {
            /* Where the picture's pixel is on the upright glass, after a clockwise turn. */
            uint32_t x[4] = {px, glass->width - 1U - py, glass->width - 1U - px, py};
            uint32_t y[4] = {py, px, glass->height - 1U - py, glass->height - 1U - px};
            rgb[0] = rgb[1] = rgb[2] = 0;
            if (seen && has_glass(glass, x[rotation & 3], y[rotation & 3])) {
                glass->model->look(sim, x[rotation & 3], y[rotation & 3], rgb);
            }
        }
    }
}

struct sim_counters sim_counters(const struct sim *sim)
{
    return sim->counters;
}

uint64_t sim_time_ns(const struct sim *sim)
{
    return sim->time_ns;
}

void sim_buttons_set(struct sim *sim, uint32_t buttons)
{
    sim->buttons = buttons;
}

uint32_t sim_complaint_count(const struct sim *sim)
{
    return sim->complaint_count;
}

uint32_t sim_complaint_count_of(const struct sim *sim, enum sim_complaint_kind kind)
{
    return sim->complaint_count_of[kind];
}

const char *sim_complaint(const struct sim *sim, uint32_t i)
{
    return i < sim->complaint_count && i < SIM_COMPLAINTS_KEPT ? sim->complaints[i] : NULL;
}

const char *sim_note(const struct sim *sim)
{
    return sim->note[0] != 0 ? sim->note : NULL;
}

void sim_fault(struct sim *sim, enum sim_fault fault, uint32_t n)
{
    sim->fault = fault;
    sim->fault_n = n;
}
