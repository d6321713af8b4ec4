/*
 * Models of the OLED controllers SSD1351 (128 x 128, 65k or 262k colours) and SSD0323 (128 x 80, 16 greys) of Solomon
 * Systech. Their commands are in ssd_table.c; what is SIM_SHOWN there is followed here.
 */
#include "sim_model.h"

#include "sim_table.h"

#include <string.h>

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
    s->offset = is_1351(sim) ? 0x60 : 0; /* SSD1351, table 9-1 */
    memset(s->contrast, 0x80, sizeof s->contrast);
    s->x1 = (uint8_t)(columns(sim) - 1);
    s->y1 = (uint8_t)(sim->glass.ram_height - 1);
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

/* Takes a byte of an SSD1351's pixels. 65k colours (A[7:6] 00 or 01): two bytes. 262k: three bytes, six bits at the low
 * end of each. */
static void ssd1351_data(struct sim *sim, uint8_t byte)
{
    struct sim_ssd *s = &sim->u.ssd;
    unsigned need = s->remap & 0x80 ? 24 : 16;
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

/* Takes a byte of an SSD0323's pixels: two side by side; A0h bit 1 says which half is the left one. */
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
    bool column = s->command->code == 0x15;
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
        sim_complain(sim, SIM_BAD_PARAMETER, "FDh command lock: %02Xh is none of 12h, 16h, B0h, B1h", value);
        break;
    }
}

static void display_on(struct sim *sim)
{
    if (!sim_frame_complete(sim)) {
        sim_complain(sim, SIM_ON_WITHOUT_FRAME, "display on (AFh) before a complete frame");
    }
    sim->u.ssd.on = true;
}

static void execute(struct sim *sim)
{
    struct sim_ssd *s = &sim->u.ssd;
    switch (s->command->code) {
    case 0x15:
    case 0x75:
        set_window(sim);
        break;
    case 0x81:
        memset(s->contrast, s->parameters[0], sizeof s->contrast);
        break;
    case 0xA0:
        s->remap = s->parameters[0];
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
        s->mode = s->command->code;
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
    case 0xC1:
        memcpy(s->contrast, s->parameters, sizeof s->contrast);
        break;
    case 0xFD:
        lock(sim, s->parameters[0]);
        break;
    default:
        break;
    }
}

/* Whether a command is locked. On an SSD1351 FDh 16h locks all commands but itself; some are locked until FDh B1h. */
static bool is_locked(const struct sim_ssd *s, const struct sim_command *command)
{
    return command->code != 0xFD && (s->locked || (command->needs_unlock && !s->extra_unlocked));
}

static void begin(struct sim *sim, uint8_t code)
{
    struct sim_ssd *s = &sim->u.ssd;
    if (s->bit_count != 0) {
        sim_complain(sim, SIM_SPLIT_PIXEL, "a command after %u bits of a pixel", s->bit_count);
    }
    s->bit_count = 0;
    s->parameter_count = 0;
    s->command = sim_table_find(is_1351(sim) ? &sim_table_ssd1351 : &sim_table_ssd0323, code);
    if (s->command == NULL) {
        sim_complain(sim, SIM_UNKNOWN_COMMAND, "command %02Xh is not known", code);
        return;
    }
    s->refused = is_locked(s, s->command); /* its parameters come, and have no effect */
    if (s->refused) {
        sim_complain(sim, SIM_BAD_PARAMETER, "command %02Xh %s is locked", code, s->command->name);
    } else if (s->command->most == 0) {
        execute(sim);
    }
}

static void parameter(struct sim *sim, uint8_t byte)
{
    struct sim_ssd *s = &sim->u.ssd;
    s->parameters[s->parameter_count++] = byte;
    s->refused = !sim_table_accepts(sim, s->command, s->parameter_count, byte) || s->refused;
    if (s->parameter_count == s->command->most && !s->refused) {
        execute(sim);
    }
}

static bool wants_parameter(const struct sim_ssd *s)
{
    return s->command != NULL && s->command->most != SIM_PIXELS && s->parameter_count < s->command->most;
}

static void parameters_are_missing(struct sim *sim)
{
    const struct sim_ssd *s = &sim->u.ssd;
    sim_complain(sim, SIM_PARAMETER_COUNT, "command %02Xh with %u parameters, it has %u", s->command->code,
                 s->parameter_count, s->command->most);
}

/* Takes data that no command waits for. After a window they are pixels without 5Ch. */
static void data_too_many(struct sim *sim)
{
    const struct sim_command *command = sim->u.ssd.command;
    if (command == NULL || command->code == 0x15 || command->code == 0x75) {
        sim_complain(sim, SIM_PIXELS_NOWHERE, "data without a command that takes it");
    } else {
        sim_complain(sim, SIM_PARAMETER_COUNT, "command %02Xh has only %u parameters", command->code, command->most);
    }
}

/* Takes a byte of an SSD1351: parameters and pixels come with D/C high. */
static void ssd1351_byte(struct sim *sim, enum hal_dc dc, uint8_t byte)
{
    const struct sim_ssd *s = &sim->u.ssd;
    if (dc == HAL_COMMAND) {
        if (wants_parameter(s)) {
            parameters_are_missing(sim);
        }
        begin(sim, byte);
    } else if (s->command != NULL && s->command->most == SIM_PIXELS) {
        if (!s->refused) {
            ssd1351_data(sim, byte);
        }
    } else if (wants_parameter(s)) {
        parameter(sim, byte);
    } else {
        data_too_many(sim);
    }
}

/* Takes a byte of an SSD0323: commands and parameters come with D/C low, pixels with D/C high. */
static void ssd0323_byte(struct sim *sim, enum hal_dc dc, uint8_t byte)
{
    struct sim_ssd *s = &sim->u.ssd;
    if (dc == HAL_DATA) {
        if (wants_parameter(s)) {
            parameters_are_missing(sim);
            s->command = NULL;
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
    const uint8_t stored[3] = {swapped ? c->b : c->r, c->g, swapped ? c->r : c->b};
    for (int i = 0; i < 3; i++) { /* without current nothing shines */
        rgb[i] = s->contrast[i] == 0 ? 0 : (uint8_t)((stored[i] | all) ^ flip);
    }
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
