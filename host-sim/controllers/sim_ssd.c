/*
 * Models of the OLED controllers SSD1351 (128 x 128, 65k or 262k colours) and SSD0323 (128 x 80, 16 greys) of Solomon
 * Systech. Modelled: the window and its two directions of increment, remapping of columns, nibbles, COM lines and
 * colours, start line and offset, multiplex ratio, display modes (normal, all on, all off, inverse), sleep, the command
 * lock. Known and without effect here: currents, phases, clocks, grey tables.
 */
#include "sim_model.h"

#include <string.h>

#define PIXELS 255

struct ssd_command {
    uint8_t code, parameters;
};

/* clang-format off */
static const struct ssd_command ssd1351_commands[] = {
    {0x15, 2}, {0x75, 2}, {0x5C, PIXELS}, {0xA0, 1}, {0xA1, 1}, {0xA2, 1}, {0xA4, 0}, {0xA5, 0}, {0xA6, 0}, {0xA7, 0},
    {0xAB, 1}, {0xAE, 0}, {0xAF, 0}, {0xB1, 1}, {0xB2, 3}, {0xB3, 1}, {0xB4, 3}, {0xB5, 1}, {0xB6, 1}, {0xB8, 63},
    {0xB9, 0}, {0xBB, 1}, {0xBE, 1}, {0xC1, 3}, {0xC7, 1}, {0xCA, 1}, {0xFD, 1},
};

static const struct ssd_command ssd0323_commands[] = {
    {0x15, 2}, {0x75, 2}, {0x81, 1}, {0x84, 0}, {0x85, 0}, {0x86, 0}, {0xA0, 1}, {0xA1, 1}, {0xA2, 1}, {0xA4, 0},
    {0xA5, 0}, {0xA6, 0}, {0xA7, 0}, {0xA8, 1}, {0xAD, 1}, {0xAE, 0}, {0xAF, 0}, {0xB0, 1}, {0xB1, 1}, {0xB2, 1},
    {0xB3, 1}, {0xB4, 1}, {0xB8, 8}, {0xBC, 1}, {0xBE, 1}, {0xBF, 1}, {0xE3, 0},
};
/* clang-format on */

static bool is_1351(const struct sim *sim)
{
    return sim->glass.model == &sim_model_ssd1351;
}

static uint32_t columns(const struct sim *sim)
{
    return is_1351(sim) ? 128 : 64;
}

static uint32_t window_size(const struct sim_ssd *s)
{
    return s->x0 > s->x1 || s->y0 > s->y1 ? 0 : (s->x1 - s->x0 + 1U) * (s->y1 - s->y0 + 1U);
}

static void reset(struct sim *sim)
{
    struct sim_ssd *s = &sim->u.ssd;
    uint32_t count = (uint32_t)sim->glass.ram_width * sim->glass.ram_height;
    memset(s, 0, sizeof *s);
    s->mode = is_1351(sim) ? 0xA6 : 0xA4;
    s->remap = is_1351(sim) ? 0x40 : 0x00;
    s->mux = is_1351(sim) ? 127 : 79;
    s->x1 = (uint8_t)(columns(sim) - 1);
    s->y1 = (uint8_t)(sim->glass.ram_height - 1);
    s->need = is_1351(sim) ? 0 : PIXELS;
    s->left = window_size(s);
    for (uint32_t i = 0; i < count; i++) {
        sim->memory[i].written = 0;
    }
}

/* ---- pixels ------------------------------------------------------------------------------------- */

/* Moves to the next column. At the end of the window it starts again. */
static void advance(struct sim_ssd *s, bool vertical)
{
    if (vertical) {
        if (s->y++ == s->y1) {
            s->y = s->y0;
            s->x = s->x == s->x1 ? s->x0 : (uint8_t)(s->x + 1);
        }
    } else if (s->x++ == s->x1) {
        s->x = s->x0;
        s->y = s->y == s->y1 ? s->y0 : (uint8_t)(s->y + 1);
    }
}

static bool room(struct sim *sim)
{
    struct sim_ssd *s = &sim->u.ssd;
    if (s->x >= columns(sim) || s->y >= sim->glass.ram_height) {
        return false;
    }
    if (s->left == 0) {
        if (!s->complained) {
            sim_complain(sim, SIM_TOO_MANY_PIXELS, "more pixels than the window has");
        }
        s->complained = true;
        s->left = window_size(s);
    }
    s->left--;
    return true;
}

static void ssd1351_pixel(struct sim *sim, uint32_t first8, uint32_t second8, uint32_t third8)
{
    struct sim_ssd *s = &sim->u.ssd;
    if (room(sim)) {
        sim->memory[s->y * 128 + s->x] = (struct sim_cell){(uint8_t)first8, (uint8_t)second8, (uint8_t)third8, 1};
        sim->counters.pixels++;
    }
    advance(s, s->remap & 1);
}

static uint32_t widen5(uint32_t v)
{
    return (v & 31) << 3 | (v & 31) >> 2;
}

static uint32_t widen6(uint32_t v)
{
    return (v & 63) << 2 | (v & 63) >> 4;
}

/* 65k colours: two bytes. 262k: three bytes, six bits at the low end of each. */
static void ssd1351_data(struct sim *sim, uint8_t byte)
{
    struct sim_ssd *s = &sim->u.ssd;
    unsigned need = s->remap >> 6 == 1 ? 16 : 24;
    s->bits = s->bits << 8 | byte;
    s->bit_count += 8;
    if (s->bit_count < need) {
        return;
    }
    uint32_t v = s->bits;
    s->bit_count = 0;
    if (need == 24) {
        ssd1351_pixel(sim, widen6(v >> 16), widen6(v >> 8), widen6(v));
    } else {
        ssd1351_pixel(sim, widen5(v >> 11), widen6(v >> 5), widen5(v));
    }
}

/* One byte is two pixels side by side; A0h bit 1 says which half is the left one. */
static void ssd0323_data(struct sim *sim, uint8_t byte)
{
    struct sim_ssd *s = &sim->u.ssd;
    if (room(sim)) {
        uint8_t left = s->remap & 2 ? byte >> 4 : byte & 15;
        uint8_t right = s->remap & 2 ? byte & 15 : byte >> 4;
        struct sim_cell *c = &sim->memory[s->y * 128 + 2 * s->x];
        c[0] = (struct sim_cell){(uint8_t)(17 * left), (uint8_t)(17 * left), (uint8_t)(17 * left), 1};
        c[1] = (struct sim_cell){(uint8_t)(17 * right), (uint8_t)(17 * right), (uint8_t)(17 * right), 1};
        sim->counters.pixels += 2;
    }
    advance(s, s->remap & 4);
}

/* ---- commands ----------------------------------------------------------------------------------- */

static void set_window(struct sim *sim)
{
    struct sim_ssd *s = &sim->u.ssd;
    bool column = s->code == 0x15;
    uint32_t limit = column ? columns(sim) : sim->glass.ram_height;
    uint8_t first = s->parameters[0];
    uint8_t last = s->parameters[1];
    if (first > last || last >= limit) {
        sim_complain(sim, SIM_WINDOW_OUTSIDE, "%s %u..%u of %u", column ? "columns" : "rows", first, last, limit);
    }
    if (column) {
        s->x0 = s->x = first;
        s->x1 = last;
    } else {
        s->y0 = s->y = first;
        s->y1 = last;
    }
    s->left = window_size(s);
    s->complained = false;
}

static void lock(struct sim *sim, uint8_t value)
{
    struct sim_ssd *s = &sim->u.ssd;
    switch (value) {
    case 0x12:
    case 0x16:
        s->locked = value == 0x16;
        break;
    case 0xB0:
    case 0xB1:
        s->extra_unlocked = value == 0xB1;
        break;
    default:
        sim_complain(sim, SIM_BAD_PARAMETER, "command lock %02Xh", value);
        break;
    }
}

static void set_remap(struct sim *sim, uint8_t value)
{
    if (is_1351(sim) && value >> 6 != 1 && value >> 6 != 2) {
        sim_complain(sim, SIM_BAD_PARAMETER, "colour depth of A0h %02Xh is not known to the model", value);
        return;
    }
    sim->u.ssd.remap = value;
}

static void display_on(struct sim *sim)
{
    if (!sim_frame_complete(sim)) {
        sim_complain(sim, SIM_ON_WITHOUT_FRAME, "display on before a complete frame");
    }
    sim->u.ssd.on = true;
}

static void execute(struct sim *sim)
{
    struct sim_ssd *s = &sim->u.ssd;
    switch (s->code) {
    case 0x15:
    case 0x75:
        set_window(sim);
        break;
    case 0xA0:
        set_remap(sim, s->parameters[0]);
        break;
    case 0xA1:
        s->start = s->parameters[0];
        break;
    case 0xA2:
        s->offset = s->parameters[0];
        break;
    case 0xA4:
    case 0xA5:
    case 0xA6:
    case 0xA7:
        s->mode = s->code;
        break;
    case 0xA8:
    case 0xCA:
        s->mux = s->parameters[0];
        break;
    case 0xAE:
        s->on = false;
        break;
    case 0xAF:
        display_on(sim);
        break;
    case 0xFD:
        lock(sim, s->parameters[0]);
        break;
    default:
        break;
    }
}

/* SSD1351: FDh 16h locks all commands but itself; some are locked until FDh B1h. */
static bool is_locked(const struct sim *sim, uint8_t code)
{
    static const uint8_t extra[] = {0xA2, 0xB1, 0xB3, 0xBB, 0xBE, 0xC1};
    const struct sim_ssd *s = &sim->u.ssd;
    if (!is_1351(sim) || code == 0xFD) {
        return false;
    }
    return s->locked || (!s->extra_unlocked && memchr(extra, code, sizeof extra) != NULL);
}

static const struct ssd_command *find_in(const struct ssd_command *list, size_t count, uint8_t code)
{
    for (size_t i = 0; i < count; i++) {
        if (list[i].code == code) {
            return &list[i];
        }
    }
    return NULL;
}

#define LIST(list) list, sizeof(list) / sizeof((list)[0])

static const struct ssd_command *find(const struct sim *sim, uint8_t code)
{
    return is_1351(sim) ? find_in(LIST(ssd1351_commands), code) : find_in(LIST(ssd0323_commands), code);
}

static void begin(struct sim *sim, uint8_t code)
{
    struct sim_ssd *s = &sim->u.ssd;
    if (s->bit_count != 0) {
        sim_complain(sim, SIM_SPLIT_PIXEL, "a command after %u bits of a pixel", s->bit_count);
    }
    s->bit_count = 0;
    s->parameter_count = 0;
    s->code = 0;
    s->need = 0;
    const struct ssd_command *command = find(sim, code);
    if (command == NULL) {
        sim_complain(sim, SIM_UNKNOWN_COMMAND, "command %02Xh is not known", code);
        return;
    }
    s->need = command->parameters;
    if (is_locked(sim, code)) {
        sim_complain(sim, SIM_BAD_PARAMETER, "command %02Xh is locked", code);
        return; /* its parameters come, and have no effect */
    }
    s->code = code;
    if (s->need == 0) {
        execute(sim);
    }
}

static void parameter(struct sim *sim, uint8_t byte)
{
    struct sim_ssd *s = &sim->u.ssd;
    s->parameters[s->parameter_count++] = byte;
    if (s->parameter_count == s->need) {
        execute(sim);
    }
}

static bool wants_parameter(const struct sim_ssd *s)
{
    return s->need != PIXELS && s->parameter_count < s->need;
}

/* SSD1351: parameters and pixels with D/C high. */
static void ssd1351_byte(struct sim *sim, enum hal_dc dc, uint8_t byte)
{
    struct sim_ssd *s = &sim->u.ssd;
    if (dc == HAL_COMMAND) {
        if (wants_parameter(s)) {
            sim_complain(sim, SIM_PARAMETER_COUNT, "command %02Xh with %u parameters, it has %u", s->code,
                         s->parameter_count, s->need);
        }
        begin(sim, byte);
    } else if (s->need == PIXELS) {
        ssd1351_data(sim, byte);
    } else if (wants_parameter(s)) {
        parameter(sim, byte);
    } else if (s->code == 0 || s->code == 0x15 || s->code == 0x75) {
        sim_complain(sim, SIM_PIXELS_NOWHERE, "data without a command that takes it");
    } else {
        sim_complain(sim, SIM_PARAMETER_COUNT, "command %02Xh has only %u parameters", s->code, s->need);
    }
}

/* SSD0323: commands and parameters with D/C low, pixels with D/C high. */
static void ssd0323_byte(struct sim *sim, enum hal_dc dc, uint8_t byte)
{
    struct sim_ssd *s = &sim->u.ssd;
    if (dc == HAL_DATA) {
        if (wants_parameter(s)) {
            sim_complain(sim, SIM_PARAMETER_COUNT, "command %02Xh with %u parameters, it has %u", s->code,
                         s->parameter_count, s->need);
            s->need = 0;
        }
        ssd0323_data(sim, byte);
    } else if (wants_parameter(s)) {
        parameter(sim, byte);
    } else {
        begin(sim, byte);
    }
}

/* ---- the glass ---------------------------------------------------------------------------------- */

/* On SSD1351 modules the picture is upright when COM lines run from the last one (A0h bit 4). Even lines are bonded at
 * one side, odd ones at the other. */
static const struct sim_cell *ssd1351_cell(const struct sim *sim, uint32_t x, uint32_t y)
{
    const struct sim_ssd *s = &sim->u.ssd;
    uint32_t row = s->remap & 0x10 ? y : 127 - y;
    if ((s->remap & 0x20) == 0) {
        row = row % 2 * 64 + row / 2;
    }
    row = (row + s->start + s->offset) % 128;
    return &sim->memory[row * 128 + (s->remap & 2 ? 127 - x : x)];
}

/* On the Stellaris kits' glass the picture is upright when COM lines run from the last one with an offset of 76 lines.
 * Even and odd lines are bonded at different sides (A0h bit 6). */
static const struct sim_cell *ssd0323_cell(const struct sim *sim, uint32_t x, uint32_t y)
{
    const struct sim_ssd *s = &sim->u.ssd;
    uint32_t lines = s->mux + 1U;
    uint32_t row = s->remap & 0x10 ? y : (lines + 80 - 1 - y) % 80;
    if ((s->remap & 0x40) == 0) {
        row = row % 2 * (lines / 2) + row / 2;
    }
    row = (row + s->start + s->offset + 80 - 76) % 80;
    uint32_t pair = s->remap & 1 ? 63 - x / 2 : x / 2;
    return &sim->memory[row * 128 + 2 * pair + x % 2];
}

static const struct sim_cell *cell(const struct sim *sim, uint32_t x, uint32_t y)
{
    return is_1351(sim) ? ssd1351_cell(sim, x, y) : ssd0323_cell(sim, x, y);
}

static void look(const struct sim *sim, uint32_t x, uint32_t y, uint8_t rgb[3])
{
    const struct sim_ssd *s = &sim->u.ssd;
    const struct sim_cell *c = cell(sim, x, y);
    uint8_t off = is_1351(sim) ? 0xA4 : 0xA6;
    if (s->mode == off || y > s->mux) {
        return; /* dark */
    }
    uint8_t all = s->mode == 0xA5 ? 255 : 0;
    uint8_t flip = s->mode == 0xA7 ? 255 : 0;
    bool swapped = is_1351(sim) && (s->remap & 4) == 0;
    rgb[0] = ((swapped ? c->b : c->r) | all) ^ flip;
    rgb[1] = (c->g | all) ^ flip;
    rgb[2] = ((swapped ? c->r : c->b) | all) ^ flip;
}

static bool shows(const struct sim *sim)
{
    return sim->u.ssd.on;
}

static bool written(const struct sim *sim, uint32_t x, uint32_t y)
{
    return cell(sim, x, y)->written != 0;
}

/* SSD1351 8.9, table 13-4: 2 us low, 2 us high, cycle 50 ns. SSD0323: 3 us, 3 us, 250 ns. */
const struct sim_model sim_model_ssd1351 = {
    .controller = "SSD1351",
    .write_hz = 20000000,
    .reset_pulse_ns = 2000,
    .reset_wait_ns = 2000,
    .reset = reset,
    .byte = ssd1351_byte,
    .shows = shows,
    .look = look,
    .written = written,
};

const struct sim_model sim_model_ssd0323 = {
    .controller = "SSD0323",
    .write_hz = 4000000,
    .reset_pulse_ns = 3000,
    .reset_wait_ns = 3000,
    .reset = reset,
    .byte = ssd0323_byte,
    .shows = shows,
    .look = look,
    .written = written,
};
