/* See wire_replay.h. */
#include "wire_replay.h"

#include "sim.h"
#include "sim_model.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum role { DC, RESET, BACKLIGHT, SELECT, ROLES };

#define COMPLAINTS_TOLD 32
#define NAME_MAX_BYTES  40

struct wire {
    struct wire_config config;
    struct board board; /* without its SPI unit: the wires tell clock and time themselves */
    struct hal hal;
    struct sim *sim;
    struct sim before; /* the state before, with the picture from before the panel went dark (its memory is sim's) */
    uint8_t *rgb;

    char names[64][NAME_MAX_BYTES];
    int bit[ROLES]; /* its line, -1: none */
    bool resolved;

    uint64_t last_ns; /* end of the last event, stream's time */
    uint32_t clock_hz;

    uint64_t run_pixels;   /* counter of pixels when the memory write began */
    uint64_t shown_pixels; /* ... when the last frame was told */
    bool pending;          /* a frame is complete, but not yet seen */
    bool seen_once;        /* rgb is a picture that was seen */
    bool was_reset, was_byte, was_frame, was_on, was_lit;

    uint32_t frames;
    uint32_t complaints, model_complaints;
    int status; /* of config.frame */
};

static void reject(struct wire *w, const char *complaint)
{
    if (w->complaints++ < COMPLAINTS_TOLD) {
        w->config.reject(w->config.context, complaint);
    }
}

__attribute__((format(printf, 2, 3))) static void reject_at(struct wire *w, const char *format, ...)
{
    char text[160];
    const int n = snprintf(text, sizeof text, "%llu.%03llu ms: ", (unsigned long long)(w->last_ns / 1000000),
                           (unsigned long long)(w->last_ns / 1000 % 1000));
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + n, sizeof text - (size_t)n, format, arguments);
    va_end(arguments);
    reject(w, text);
}

/* Passes on the new complaints of the model. */
static void pass_complaints_on(struct wire *w)
{
    for (; w->model_complaints < sim_complaint_count(w->sim); w->model_complaints++) {
        const char *text = sim_complaint(w->sim, w->model_complaints);
        reject(w, text != NULL ? text : "more");
    }
}

static void step(const struct wire *w, const char *what)
{
    if (w->config.order) {
        w->config.step(w->config.context, w->last_ns, what);
    }
}

/* ---- frames ------------------------------------------------------------------------------------- */

static bool is_on(const struct sim *sim)
{
    return sim->glass.model->shows(sim) && !sim->reset_low;
}

static bool is_seen(const struct sim *sim)
{
    return is_on(sim) && (sim->backlight || !sim->glass.backlit);
}

static void tell_frame(struct wire *w, const struct sim *sim)
{
    w->pending = false;
    w->shown_pixels = sim->counters.pixels;
    if (w->config.last && !is_seen(sim)) {
        return; /* the last picture that was seen stays */
    }
    sim_pixels(sim, w->config.rotation, w->rgb);
    w->seen_once = true;
    if (!w->config.last && w->status == 0) {
        w->status = w->config.frame(w->config.context, w->frames, w->rgb);
        w->frames++;
    }
}

/* Looks back when the panel goes dark: the picture on it may be the last one, or one that was not told yet. */
static void look_back(struct wire *w)
{
    if (!is_seen(&w->before) || is_seen(w->sim)) {
        return;
    }
    if (w->config.last) {
        sim_pixels(&w->before, w->config.rotation, w->rgb);
        w->seen_once = true;
    } else if (w->pending || (w->config.idle_ns != 0 && w->shown_pixels != w->before.counters.pixels)) {
        tell_frame(w, &w->before);
    }
}

/* Is called after every command and change of a pin. */
static void look(struct wire *w)
{
    const bool on = is_on(w->sim),
               lit = w->sim->backlight && w->sim->glass.backlit && w->sim->board->pins.backlight.wired;
    look_back(w);
    if (on != w->was_on) {
        step(w, on ? "display on" : "display off");
        w->was_on = on;
    }
    if (lit != w->was_lit) {
        step(w, lit ? "backlight on" : "backlight off");
        w->was_lit = lit;
        if (lit && !on) {
            reject_at(w, "backlight on while the display is off");
        }
    }
    if (w->pending && is_seen(w->sim)) {
        tell_frame(w, w->sim);
    }
}

static void frame_is_complete(struct wire *w)
{
    if (!w->was_frame) {
        step(w, "first frame");
        w->was_frame = true;
    }
    w->run_pixels = w->sim->counters.pixels;
    w->pending = w->config.idle_ns == 0 && !w->config.notes;
    look(w);
}

/* ---- bytes -------------------------------------------------------------------------------------- */

static void first_byte(struct wire *w)
{
    w->was_byte = true;
    step(w, "init");
    if (w->bit[RESET] >= 0 && !w->was_reset) {
        reject_at(w, "the first byte comes without a reset before it");
    }
}

static void take_command(struct wire *w, const uint8_t *byte)
{
    w->before = *w->sim;
    w->hal.ops->bus_write(w->hal.context, HAL_COMMAND, byte, 1);
    w->run_pixels = w->sim->glass.model->pages ? w->run_pixels : w->sim->counters.pixels;
    look(w);
}

/* Is called after every byte of pixels. */
static void data_came(struct wire *w)
{
    const uint64_t all = (uint64_t)w->sim->glass.width * w->sim->glass.height;
    if (w->sim->counters.pixels - w->run_pixels >= all) {
        frame_is_complete(w);
    }
}

static void take_data(struct wire *w, const uint8_t *byte)
{
    if (w->pending) { /* complete, and still dark when the next one comes */
        tell_frame(w, w->sim);
    }
    w->hal.ops->bus_write(w->hal.context, HAL_DATA, byte, 1);
    data_came(w);
}

static void take_bytes(struct wire *w, const struct wire_event *event, enum hal_dc dc)
{
    if (!w->was_byte) {
        first_byte(w);
    }
    for (size_t i = 0; i < event->count; i++) {
        if (dc == HAL_COMMAND) {
            take_command(w, &event->bytes[i]);
        } else {
            take_data(w, &event->bytes[i]);
        }
    }
}

/* A message on the I2C bus. The picture before it is kept for look(): it may turn the display off. */
static void take_message(struct wire *w, const struct wire_event *event)
{
    if (!w->was_byte) {
        first_byte(w);
    }
    w->hal.ops->bus_clock(w->hal.context, event->got_hz);
    sim_i2c_start(w->sim);
    sim_i2c_byte(w->sim, (uint8_t)(event->number << 1));
    for (size_t i = 0; i < event->count; i++) {
        const struct sim_i2c *i2c = &w->sim->i2c;
        if (w->pending && i2c->expects == SIM_I2C_BYTE && i2c->dc == HAL_DATA) {
            tell_frame(w, w->sim);
        }
        w->before = *w->sim;
        sim_i2c_byte(w->sim, event->bytes[i]);
        if (w->sim->counters.pixels != w->before.counters.pixels) {
            data_came(w);
        }
        look(w);
    }
}

/* ---- lines -------------------------------------------------------------------------------------- */

static int named(const struct wire *w, const char *name)
{
    for (int i = 0; i < 64; i++) {
        if (name != NULL && strcmp(w->names[i], name) == 0) {
            return i;
        }
    }
    return -1;
}

/* Finds the number of a line. "GPIO25" and "chip:25" are line 25, unless the stream gives line 25 another name. */
static int numbered(const struct wire *w, const struct board_pin *pin)
{
    uint32_t number = pin->number;
    if (pin->line != NULL) {
        const char *digits = pin->line + strlen(pin->line);
        while (digits > pin->line && digits[-1] >= '0' && digits[-1] <= '9') {
            digits--;
        }
        number = *digits == '\0' ? 64 : (uint32_t)strtoul(digits, NULL, 10);
    }
    return number < 64 && w->names[number][0] == '\0' ? (int)number : -1;
}

static void resolve_role(struct wire *w, enum role role, const char *name, const struct board_pin *pin)
{
    w->bit[role] = -1;
    if (!pin->wired) {
        return;
    }
    int bit = named(w, name);
    bit = bit >= 0 ? bit : named(w, pin->line);
    bit = bit >= 0 ? bit : numbered(w, pin);
    w->bit[role] = bit;
    if (bit < 0 && role != SELECT) {
        reject_at(w, "the stream has no line for %s (%s)", name, pin->line != NULL ? pin->line : "see its names");
    }
}

static void resolve(struct wire *w)
{
    const struct board_pins *pins = &w->config.board->pins;
    if (w->resolved) {
        return;
    }
    w->resolved = true;
    resolve_role(w, DC, "dc", &pins->dc);
    resolve_role(w, RESET, "reset", &pins->reset);
    resolve_role(w, BACKLIGHT, "backlight", &pins->backlight);
    resolve_role(w, SELECT, "select", &pins->select);
}

static bool is_active(const struct wire *w, enum role role, uint64_t levels)
{
    const struct board_pins *pins = &w->config.board->pins;
    const struct board_pin *pin[ROLES] = {&pins->dc, &pins->reset, &pins->backlight, &pins->select};
    const bool high = w->bit[role] >= 0 && (levels >> w->bit[role] & 1) != 0;
    return high != pin[role]->active_low;
}

static void set_levels(struct wire *w, uint64_t levels)
{
    static const enum hal_pin pins[] = {[RESET] = HAL_PIN_RESET, [BACKLIGHT] = HAL_PIN_BACKLIGHT};
    for (enum role role = RESET; role <= BACKLIGHT; role++) {
        if (w->bit[role] < 0) {
            continue;
        }
        const bool level = is_active(w, role, levels);
        w->before = *w->sim;
        w->hal.ops->pin_set(w->hal.context, pins[role], level);
        if (role == RESET && level == w->before.reset_low) {
            step(w, level ? "reset ends" : "reset begins");
            w->was_reset = true;
            w->was_byte = w->was_frame = false;
        }
        look(w);
    }
}

/* ---- events ------------------------------------------------------------------------------------- */

/* Lets the model's clock run while the wire rests. */
static void time_passes(struct wire *w, uint64_t until_ns)
{
    if (until_ns < w->last_ns) {
        reject_at(w, "time goes back");
        return;
    }
    const uint64_t gap = until_ns - w->last_ns;
    if (w->config.idle_ns != 0 && gap >= w->config.idle_ns && w->shown_pixels != w->sim->counters.pixels &&
        is_seen(w->sim)) {
        tell_frame(w, w->sim);
    }
    w->sim->time_ns += gap;
    w->last_ns = until_ns;
    if (w->sim->glass.model->rest != NULL) {
        w->sim->glass.model->rest(w->sim);
    }
}

static void check_transfer(struct wire *w, const struct wire_event *event)
{
    const uint64_t changed = event->levels ^ event->levels_at_end;
    static const char *const roles[ROLES] = {"D/C", "reset", "backlight", "chip select"};
    for (enum role role = DC; role < ROLES; role++) {
        if (role != BACKLIGHT && w->bit[role] >= 0 && (changed >> w->bit[role] & 1) != 0) {
            reject_at(w, "%s moved during a transfer of %zu bytes", roles[role], event->count);
        }
    }
    const bool cpha = event->mode & WIRE_CPHA, cpol = event->mode & WIRE_CPOL;
    const bool mode_0 = w->sim->glass.model->mode_0;
    if (cpha != cpol || (mode_0 && cpha) || (event->mode & ~(uint32_t)(WIRE_CPHA | WIRE_CPOL | WIRE_NO_CS)) != 0) {
        reject_at(w, "SPI mode %Xh: %s, highest bit first", (unsigned)event->mode,
                  mode_0 ? "the panel wants 0" : "panels want 0 or 3");
    }
    if (event->word_bits != 8) {
        reject_at(w, "%u bits a word instead of 8", (unsigned)event->word_bits);
    }
    const bool driven = event->select != WIRE_NO_SELECT && w->config.board->pins.select.wired;
    if (driven && (event->mode & WIRE_NO_CS) != 0) {
        reject_at(w, "the panel is not selected (mode %Xh)", (unsigned)event->mode);
    }
}

static bool is_mine(const struct wire *w, const struct wire_event *event)
{
    if (event->select != WIRE_NO_SELECT) {
        return event->select == w->config.select;
    }
    return w->bit[SELECT] < 0 || is_active(w, SELECT, event->levels);
}

static void transfer(struct wire *w, const struct wire_event *event)
{
    set_levels(w, event->levels);
    const uint64_t start_ns = w->sim->time_ns;
    if (is_mine(w, event)) {
        check_transfer(w, event);
        if (w->clock_hz != event->got_hz) {
            w->clock_hz = event->got_hz;
            w->hal.ops->bus_clock(w->hal.context, event->got_hz);
        }
        if (event->kind == WIRE_SPI) {
            take_bytes(w, event, is_active(w, DC, event->levels_at_end) ? HAL_DATA : HAL_COMMAND);
        }
    }
    const uint64_t took = w->sim->time_ns - start_ns, real = event->end_ns - event->time_ns;
    w->sim->time_ns += real > took ? real - took : 0;
    w->last_ns = event->end_ns;
    set_levels(w, event->levels_at_end);
}

int wire_replay_event(struct wire *w, const struct wire_event *event)
{
    if (event->kind != WIRE_NAME && event->kind != WIRE_NOTE) {
        time_passes(w, event->time_ns);
    }
    switch (event->kind) {
    case WIRE_NAME:
        snprintf(w->names[event->number], NAME_MAX_BYTES, "%s", event->text);
        break;
    case WIRE_LEVEL:
        resolve(w);
        set_levels(w, event->levels);
        break;
    case WIRE_SPI:
    case WIRE_READ:
        resolve(w);
        transfer(w, event);
        break;
    case WIRE_I2C:
        resolve(w);
        take_message(w, event);
        w->sim->time_ns += event->end_ns - event->time_ns;
        w->last_ns = event->end_ns;
        break;
    case WIRE_LOST:
        reject_at(w, "%u events were lost", (unsigned)event->number);
        break;
    case WIRE_NOTE:
        if (w->config.notes && strcmp(event->text, "frame") == 0) {
            w->pending = true;
            look(w);
        }
        break;
    }
    pass_complaints_on(w);
    return w->status;
}

int wire_replay_end(struct wire *w)
{
    const bool rest = w->config.idle_ns != 0 && w->shown_pixels != w->sim->counters.pixels && is_seen(w->sim);
    if (w->pending || rest || (w->config.last && is_seen(w->sim))) {
        tell_frame(w, w->sim);
    }
    if (w->config.last && w->seen_once && w->status == 0) {
        w->status = w->config.frame(w->config.context, 0, w->rgb);
        w->frames = 1;
    }
    return w->status;
}

uint32_t wire_replay_complaints(const struct wire *w)
{
    return w->complaints;
}

uint32_t wire_replay_frames(const struct wire *w)
{
    return w->frames;
}

struct wire *wire_replay_open(const struct wire_config *config)
{
    const struct panel *panel = config->board->panel;
    struct wire *w = calloc(1, sizeof *w);
    if (w == NULL) {
        return NULL;
    }
    w->config = *config;
    w->board = *config->board;
    w->board.spi_unit = BOARD_SPI_ANY;
    w->sim = sim_open(&w->board, &w->hal);
    w->rgb = malloc((size_t)panel->width * panel->height * 3);
    for (int i = 0; i < ROLES; i++) {
        w->bit[i] = -1;
    }
    if (w->sim == NULL || w->rgb == NULL) {
        wire_replay_close(w);
        return NULL;
    }
    w->before = *w->sim;
    return w;
}

void wire_replay_close(struct wire *w)
{
    if (w != NULL) {
        sim_close(w->sim);
        free(w->rgb);
        free(w);
    }
}
