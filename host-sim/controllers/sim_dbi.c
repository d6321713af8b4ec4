/*
 * Model of the controllers with MIPI DBI type C option 3: ST7789, GC9A01, ILI9341, ILI9488, ST7735S. They share the
 * commands of the MIPI display command set; each has its own list of further ones, of formats, and its own memory.
 *
 * Modelled: the window, memory write and its continuation, MADCTL MY MX MV BGR, COLMOD, inversion, sleep, display on
 * and off, software and hardware reset with their waits, GS and SS of the display function control, byte order
 * (ST7789). Known and without effect here: voltages, gamma, frame rate, tearing line. Everything else is an unknown
 * command.
 */
#include "sim_model.h"

#include <string.h>

enum {
    NOP = 0x00,
    SWRESET = 0x01,
    SLPIN = 0x10,
    SLPOUT = 0x11,
    NORON = 0x13,
    INVOFF = 0x20,
    INVON = 0x21,
    GAMSET = 0x26,
    DISPOFF = 0x28,
    DISPON = 0x29,
    CASET = 0x2A,
    RASET = 0x2B,
    RAMWR = 0x2C,
    TEOFF = 0x34,
    TEON = 0x35,
    MADCTL = 0x36,
    COLMOD = 0x3A,
    RAMWRC = 0x3C,
    RAMCTRL = 0xB0, /* ST7789 */
    DISCTRL = 0xB6, /* ILI9341, ILI9488, GC9A01 */
};

#define MS     1000000ULL
#define PIXELS 255 /* instead of a number of parameters */

struct dbi_command {
    uint8_t code, least, most; /* parameters */
};

/* clang-format off */
/* Commands that all of them have. Their effect: start(), finish(). */
static const struct dbi_command common[] = {
    {NOP, 0, 0}, {SWRESET, 0, 0}, {SLPIN, 0, 0}, {SLPOUT, 0, 0}, {NORON, 0, 0}, {INVOFF, 0, 0}, {INVON, 0, 0},
    {GAMSET, 1, 1}, {DISPOFF, 0, 0}, {DISPON, 0, 0}, {CASET, 4, 4}, {RASET, 4, 4}, {RAMWR, PIXELS, PIXELS},
    {TEOFF, 0, 0}, {TEON, 1, 1}, {MADCTL, 1, 1}, {COLMOD, 1, 1},
};

static const struct dbi_command st7789_commands[] = {
    {RAMWRC, PIXELS, PIXELS}, {0x44, 2, 2}, {0x51, 1, 1}, {0x53, 1, 1}, {0x55, 1, 1}, {0x5E, 1, 1}, {RAMCTRL, 2, 2},
    {0xB1, 3, 3}, {0xB2, 5, 5}, {0xB3, 3, 3}, {0xB5, 1, 1}, {0xB7, 1, 1}, {0xB8, 4, 4}, {0xBA, 1, 1}, {0xBB, 1, 1},
    {0xBD, 1, 1}, {0xC0, 1, 1}, {0xC1, 3, 3}, {0xC2, 1, 2}, {0xC3, 1, 1}, {0xC4, 1, 1}, {0xC5, 1, 1}, {0xC6, 1, 1},
    {0xC7, 1, 1}, {0xC8, 1, 1}, {0xCA, 1, 1}, {0xCC, 1, 1}, {0xD0, 2, 2}, {0xD2, 1, 1}, {0xDF, 4, 4}, {0xE0, 14, 14},
    {0xE1, 14, 14}, {0xE2, 64, 64}, {0xE3, 64, 64}, {0xE4, 3, 3}, {0xE8, 2, 2}, {0xE9, 3, 3}, {0xEC, 1, 1},
};

/* The commands of the datasheet come first, then those that the sample code of the maker sends. */
static const struct dbi_command gc9a01_commands[] = {
    {RAMWRC, PIXELS, PIXELS}, {0x44, 2, 2}, {0x51, 1, 1}, {0x53, 1, 1}, {DISCTRL, 2, 2}, {0xBA, 1, 1}, {0xC3, 1, 1},
    {0xC4, 1, 1}, {0xC9, 1, 1}, {0xE8, 1, 1}, {0xF0, 6, 6}, {0xF1, 6, 6}, {0xF2, 6, 6}, {0xF3, 6, 6}, {0xFE, 0, 0},
    {0xEF, 0, 0}, {0xEB, 1, 1}, {0x84, 1, 1}, {0x85, 1, 1}, {0x86, 1, 1}, {0x87, 1, 1}, {0x88, 1, 1}, {0x89, 1, 1},
    {0x8A, 1, 1}, {0x8B, 1, 1}, {0x8C, 1, 1}, {0x8D, 1, 1}, {0x8E, 1, 1}, {0x8F, 1, 1}, {0x90, 4, 4}, {0xBC, 1, 1},
    {0xBD, 1, 1}, {0xBE, 1, 1}, {0xDF, 3, 3}, {0xE1, 2, 2}, {0xFF, 3, 3}, {0xED, 2, 2}, {0xAE, 1, 1}, {0xCD, 1, 1},
    {0x70, 9, 9}, {0x62, 12, 12}, {0x63, 12, 12}, {0x64, 7, 7}, {0x66, 10, 10}, {0x67, 10, 10}, {0x74, 7, 7},
    {0x98, 2, 2},
};

static const struct dbi_command ili9341_commands[] = {
    {RAMWRC, PIXELS, PIXELS}, {0x44, 2, 2}, {0x51, 1, 1}, {0x53, 1, 1}, {0x55, 1, 1}, {0x5E, 1, 1}, {0xB0, 1, 1},
    {0xB1, 2, 2}, {0xB2, 2, 2}, {0xB3, 2, 2}, {0xB4, 1, 1}, {0xB5, 4, 4}, {DISCTRL, 3, 4}, {0xB7, 1, 1}, {0xC0, 1, 1},
    {0xC1, 1, 1}, {0xC5, 2, 2}, {0xC7, 1, 1}, {0xE0, 15, 15}, {0xE1, 15, 15}, {0xF6, 3, 3}, {0xCB, 5, 5},
    {0xCF, 3, 3}, {0xE8, 3, 3}, {0xEA, 2, 2}, {0xED, 4, 4}, {0xF2, 1, 1}, {0xF7, 1, 1},
};

static const struct dbi_command ili9488_commands[] = {
    {RAMWRC, PIXELS, PIXELS}, {0x44, 2, 2}, {0x51, 1, 1}, {0x53, 1, 1}, {0x55, 1, 1}, {0x5E, 1, 1}, {0xB0, 1, 1},
    {0xB1, 1, 2}, {0xB2, 2, 2}, {0xB3, 2, 2}, {0xB4, 1, 1}, {0xB5, 4, 4}, {DISCTRL, 3, 3}, {0xB7, 1, 1}, {0xBE, 2, 2},
    {0xC0, 2, 2}, {0xC1, 1, 1}, {0xC2, 1, 1}, {0xC5, 3, 4}, {0xE0, 15, 15}, {0xE1, 15, 15}, {0xE9, 1, 1},
    {0xF7, 4, 4},
};

static const struct dbi_command st7735s_commands[] = {
    {0xB1, 3, 3}, {0xB2, 3, 3}, {0xB3, 6, 6}, {0xB4, 1, 1}, {0xC0, 3, 3}, {0xC1, 1, 1}, {0xC2, 2, 2}, {0xC3, 2, 2},
    {0xC4, 2, 2}, {0xC5, 1, 1}, {0xC7, 1, 1}, {0xE0, 16, 16}, {0xE1, 16, 16}, {0xFC, 1, 1},
};
/* clang-format on */

/* What differs between the controllers. */
struct dbi_kind {
    const struct sim_model *model;
    const struct dbi_command *commands;
    size_t command_count;
    uint8_t formats; /* bit n: COLMOD low bits may be n (1: 3, 3: 12, 5: 16, 6: 18 bits a pixel) */
    uint8_t format_at_reset;
    bool disctrl, ramctrl;
};

#define LIST(list) list, sizeof(list) / sizeof((list)[0])

static const struct dbi_kind kinds[] = {
    {&sim_model_st7789, LIST(st7789_commands), 1 << 3 | 1 << 5 | 1 << 6, 6, false, true},
    {&sim_model_gc9a01, LIST(gc9a01_commands), 1 << 3 | 1 << 5 | 1 << 6, 6, true, false},
    {&sim_model_ili9341, LIST(ili9341_commands), 1 << 5 | 1 << 6, 6, true, false},
    {&sim_model_ili9488, LIST(ili9488_commands), 1 << 1 | 1 << 6, 6, true, false},
    {&sim_model_st7735s, LIST(st7735s_commands), 1 << 3 | 1 << 5 | 1 << 6, 6, false, false},
};

static const struct dbi_kind *kind_of(const struct sim *sim)
{
    const struct dbi_kind *kind = kinds;
    while (kind->model != sim->glass.model) {
        kind++;
    }
    return kind;
}

static void reset(struct sim *sim)
{
    struct sim_dbi *d = &sim->u.dbi;
    uint32_t count = (uint32_t)sim->glass.ram_width * sim->glass.ram_height;
    memset(d, 0, sizeof *d);
    d->sleeping = true;
    d->format = kind_of(sim)->format_at_reset;
    d->x1 = (uint16_t)(sim->glass.ram_width - 1);
    d->y1 = (uint16_t)(sim->glass.ram_height - 1);
    d->wake_ns = sim->time_ns + 120 * MS;
    for (uint32_t i = 0; i < count; i++) {
        sim->memory[i].written = 0;
    }
}

/* ---- pixels ------------------------------------------------------------------------------------- */

/* MV swaps the axes: these are the addresses as the host sees them. */
static uint32_t host_width(const struct sim *sim)
{
    return sim->u.dbi.madctl & 0x20 ? sim->glass.ram_height : sim->glass.ram_width;
}

static uint32_t host_height(const struct sim *sim)
{
    return sim->u.dbi.madctl & 0x20 ? sim->glass.ram_width : sim->glass.ram_height;
}

static void store(struct sim *sim, uint8_t r, uint8_t g, uint8_t b)
{
    struct sim_dbi *d = &sim->u.dbi;
    if (d->left == 0) {
        if (!d->complained) {
            sim_complain(sim, SIM_TOO_MANY_PIXELS, "more pixels than the window %u..%u x %u..%u has", d->x0, d->x1,
                         d->y0, d->y1);
        }
        d->complained = true;
        d->left = (d->x1 - d->x0 + 1U) * (d->y1 - d->y0 + 1U); /* it starts again */
        d->x = d->x0;
        d->y = d->y0;
    }
    d->left--;
    if (d->x < host_width(sim) && d->y < host_height(sim)) {
        uint32_t column = d->madctl & 0x20 ? d->y : d->x;
        uint32_t row = d->madctl & 0x20 ? d->x : d->y;
        column = d->madctl & 0x40 ? sim->glass.ram_width - 1U - column : column;
        row = d->madctl & 0x80 ? sim->glass.ram_height - 1U - row : row;
        sim->memory[row * sim->glass.ram_width + column] = (struct sim_cell){r, g, b, 1};
        sim->counters.pixels++;
    }
    if (d->x++ == d->x1) {
        d->x = d->x0;
        d->y++;
    }
}

/* Widens n bits (3 to 6) to eight by repeating them, highest first. */
static uint8_t widen(uint32_t value, unsigned n)
{
    uint32_t v = value & ((1U << n) - 1);
    return (uint8_t)((v << (8 - n) | (2 * n >= 8 ? v >> (2 * n - 8) : v << (8 - 2 * n))) & 255);
}

/* One bit a colour, two pixels a byte: xxRGBRGB. */
static void take_3_bits(struct sim *sim, uint8_t byte)
{
    for (int i = 3; i >= 0; i -= 3) {
        store(sim, byte >> (i + 2) & 1 ? 255 : 0, byte >> (i + 1) & 1 ? 255 : 0, byte >> i & 1 ? 255 : 0);
    }
}

static void take_pixel_byte(struct sim *sim, uint8_t byte)
{
    struct sim_dbi *d = &sim->u.dbi;
    if (d->sleeping && !d->complained) {
        sim_complain(sim, SIM_PIXELS_ASLEEP, "pixels in sleep mode");
        d->complained = true;
    }
    if (d->format == 1) {
        take_3_bits(sim, byte);
        return;
    }
    d->bits = d->bits << 8 | byte;
    d->bit_count += 8;
    if (d->format == 3 && d->bit_count >= 12) {
        uint32_t v = d->bits >> (d->bit_count -= 12);
        store(sim, widen(v >> 8, 4), widen(v >> 4, 4), widen(v, 4));
    } else if (d->format == 5 && d->bit_count == 16) {
        uint32_t v = d->low_byte_first ? (d->bits & 255) << 8 | (d->bits >> 8 & 255) : d->bits;
        store(sim, widen(v >> 11, 5), widen(v >> 5, 6), widen(v, 5));
        d->bit_count = 0;
    } else if (d->format == 6 && d->bit_count == 24) {
        store(sim, widen(d->bits >> 18, 6), widen(d->bits >> 10, 6), widen(d->bits >> 2, 6));
        d->bit_count = 0;
    }
}

/* ---- commands ----------------------------------------------------------------------------------- */

static void begin_memory_write(struct sim *sim)
{
    struct sim_dbi *d = &sim->u.dbi;
    if (d->x0 > d->x1 || d->y0 > d->y1 || d->x1 >= host_width(sim) || d->y1 >= host_height(sim)) {
        sim_complain(sim, SIM_WINDOW_OUTSIDE, "window %u..%u x %u..%u in a memory of %u x %u", d->x0, d->x1, d->y0,
                     d->y1, host_width(sim), host_height(sim));
    }
    d->x = d->x0;
    d->y = d->y0;
    d->left = d->x0 > d->x1 || d->y0 > d->y1 ? 0 : (d->x1 - d->x0 + 1U) * (d->y1 - d->y0 + 1U);
    d->complained = false;
}

static void sleep_out(struct sim *sim)
{
    struct sim_dbi *d = &sim->u.dbi;
    if (sim->time_ns < d->wake_ns) {
        sim_complain(sim, SIM_EARLY_COMMAND, "SLPOUT within 120 ms of reset or SLPIN");
    }
    d->sleeping = false;
    d->ready_ns = sim->time_ns + 5 * MS;
    d->nap_ns = sim->time_ns + 120 * MS;
}

static void sleep_in(struct sim *sim)
{
    struct sim_dbi *d = &sim->u.dbi;
    if (sim->time_ns < d->nap_ns) {
        sim_complain(sim, SIM_EARLY_COMMAND, "SLPIN within 120 ms of SLPOUT");
    }
    d->sleeping = true;
    d->ready_ns = sim->time_ns + 5 * MS;
    d->wake_ns = sim->time_ns + 120 * MS;
}

static void software_reset(struct sim *sim)
{
    reset(sim);
    sim->u.dbi.ready_ns = sim->time_ns + 5 * MS;
}

/* Executes commands that act when their code arrives. */
static void start(struct sim *sim, uint8_t code)
{
    struct sim_dbi *d = &sim->u.dbi;
    switch (code) {
    case SWRESET:
        software_reset(sim);
        break;
    case SLPIN:
        sleep_in(sim);
        break;
    case SLPOUT:
        sleep_out(sim);
        break;
    case INVOFF:
    case INVON:
        d->inverted = code == INVON;
        break;
    case DISPOFF:
        d->on = false;
        break;
    case DISPON:
        if (!sim_frame_complete(sim)) {
            sim_complain(sim, SIM_ON_WITHOUT_FRAME, "DISPON before a complete frame");
        }
        d->on = true;
        break;
    case RAMWR:
        begin_memory_write(sim);
        break;
    default:
        break;
    }
}

static void set_format(struct sim *sim, uint8_t value)
{
    uint8_t format = value & 7;
    if ((kind_of(sim)->formats >> format & 1) == 0) {
        sim_complain(sim, SIM_BAD_PARAMETER, "COLMOD %02Xh is not available on the serial interface", value);
        return;
    }
    sim->u.dbi.format = format;
}

/* Executes commands when their parameters are complete. */
static void finish(struct sim *sim)
{
    struct sim_dbi *d = &sim->u.dbi;
    const uint8_t *p = d->parameters;
    switch (d->code) {
    case CASET:
        d->x0 = (uint16_t)(p[0] << 8 | p[1]);
        d->x1 = (uint16_t)(p[2] << 8 | p[3]);
        break;
    case RASET:
        d->y0 = (uint16_t)(p[0] << 8 | p[1]);
        d->y1 = (uint16_t)(p[2] << 8 | p[3]);
        break;
    case MADCTL:
        d->madctl = p[0];
        break;
    case COLMOD:
        set_format(sim, p[0]);
        break;
    case RAMCTRL:
        d->low_byte_first = kind_of(sim)->ramctrl && (p[1] & 8) != 0;
        break;
    case DISCTRL:
        d->scan = kind_of(sim)->disctrl ? p[1] & 0x60 : 0;
        break;
    default:
        break;
    }
}

static const struct dbi_command *find(const struct dbi_command *list, size_t count, uint8_t code)
{
    for (size_t i = 0; i < count; i++) {
        if (list[i].code == code) {
            return &list[i];
        }
    }
    return NULL;
}

/* Checks that the previous command is complete. */
static void check_last(struct sim *sim)
{
    const struct sim_dbi *d = &sim->u.dbi;
    if (d->command == NULL) {
        return;
    }
    if (d->command->least == PIXELS) {
        if (d->bit_count != 0 && d->left != 0) {
            sim_complain(sim, SIM_SPLIT_PIXEL, "a command after %u bits of a pixel", d->bit_count);
        }
    } else if (d->parameter_count < d->command->least) {
        sim_complain(sim, SIM_PARAMETER_COUNT, "command %02Xh with %u parameters, it has %u", d->code,
                     d->parameter_count, d->command->least);
    }
}

static void take_command(struct sim *sim, uint8_t code)
{
    struct sim_dbi *d = &sim->u.dbi;
    const struct dbi_kind *kind = kind_of(sim);
    check_last(sim);
    if (sim->time_ns < d->ready_ns) {
        sim_complain(sim, SIM_EARLY_COMMAND, "command %02Xh within 5 ms of reset or sleep", code);
    }
    d->code = code;
    d->parameter_count = 0;
    d->bits = 0;
    d->bit_count = 0;
    d->command = find(common, sizeof common / sizeof common[0], code);
    if (d->command == NULL) {
        d->command = find(kind->commands, kind->command_count, code);
    }
    if (d->command == NULL) {
        sim_complain(sim, SIM_UNKNOWN_COMMAND, "command %02Xh is not known", code);
        return;
    }
    const struct dbi_command *command = d->command;
    start(sim, code);
    d->command = command; /* a reset forgets it */
    d->code = code;
}

static void take_data(struct sim *sim, uint8_t byte)
{
    struct sim_dbi *d = &sim->u.dbi;
    if (d->command == NULL) {
        if (d->parameter_count++ == 0 && d->code == 0) {
            sim_complain(sim, SIM_PIXELS_NOWHERE, "data without a command");
        }
        return;
    }
    if (d->command->least == PIXELS) {
        take_pixel_byte(sim, byte);
        return;
    }
    if (d->parameter_count == d->command->most) {
        sim_complain(sim, SIM_PARAMETER_COUNT, "command %02Xh has only %u parameters", d->code, d->command->most);
    }
    if (d->parameter_count < d->command->most) {
        d->parameters[d->parameter_count] = byte;
    }
    if (++d->parameter_count == d->command->least) {
        finish(sim);
    }
}

static void take_byte(struct sim *sim, enum hal_dc dc, uint8_t byte)
{
    if (dc == HAL_COMMAND) {
        take_command(sim, byte);
    } else {
        take_data(sim, byte);
    }
}

/* ---- the glass ---------------------------------------------------------------------------------- */

static const struct sim_cell *cell(const struct sim *sim, uint32_t x, uint32_t y)
{
    const struct sim_glass *glass = &sim->glass;
    bool right_to_left = glass->mirrored != ((sim->u.dbi.scan & 0x20) != 0);
    bool upwards = (sim->u.dbi.scan & 0x40) != 0;
    uint32_t column = glass->left + (right_to_left ? glass->width - 1U - x : x);
    uint32_t row = glass->top + (upwards ? glass->height - 1U - y : y);
    return &sim->memory[row * glass->ram_width + column];
}

static void look(const struct sim *sim, uint32_t x, uint32_t y, uint8_t rgb[3])
{
    const struct sim_dbi *d = &sim->u.dbi;
    const struct sim_cell *c = cell(sim, x, y);
    uint8_t flip = d->inverted == sim->glass.complement ? 0 : 255;
    bool swapped = ((d->madctl & 8) != 0) != sim->glass.bgr;
    rgb[0] = (swapped ? c->b : c->r) ^ flip;
    rgb[1] = c->g ^ flip;
    rgb[2] = (swapped ? c->r : c->b) ^ flip;
}

static bool shows(const struct sim *sim)
{
    return sim->u.dbi.on && !sim->u.dbi.sleeping;
}

static bool written(const struct sim *sim, uint32_t x, uint32_t y)
{
    return cell(sim, x, y)->written != 0;
}

/* The reset pulse takes 10 us, then 5 ms pass (the "reset timing" of the datasheets). The write limits are from their
 * tables of the serial timing. */
#define DBI_MODEL(text, hz)                                                                                            \
    {                                                                                                                  \
        .controller = (text), .write_hz = (hz), .reset_pulse_ns = 10000, .reset_wait_ns = 5000000, .reset = reset,     \
        .byte = take_byte, .shows = shows, .look = look, .written = written                                            \
    }

const struct sim_model sim_model_st7789 = DBI_MODEL("ST7789", 62500000);
const struct sim_model sim_model_gc9a01 = DBI_MODEL("GC9A01", 100000000);
const struct sim_model sim_model_ili9341 = DBI_MODEL("ILI9341", 10000000);
const struct sim_model sim_model_ili9488 = DBI_MODEL("ILI9488", 20000000);
const struct sim_model sim_model_st7735s = DBI_MODEL("ST7735S", 15151515);
