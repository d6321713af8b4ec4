/*
 * Model of the controllers with MIPI DBI type C option 3: ST7789, GC9A01, ILI9341, ILI9488, ST7796S, HX8357D,
 * ST7735S, and an ILI9486 whose parallel interface is driven by a shift register. They share the commands of the MIPI
 * display command set; each has its own list of further ones (dbi_table.c), of formats, and its own memory. What is
 * SIM_SHOWN in the tables is followed here.
 */
#include "sim_model.h"

#include "sim_table.h"

#include <string.h>

enum {
    SWRESET = 0x01,
    SLPIN = 0x10,
    SLPOUT = 0x11,
    INVOFF = 0x20,
    INVON = 0x21,
    DISPOFF = 0x28,
    DISPON = 0x29,
    CASET = 0x2A,
    RASET = 0x2B,
    RAMWR = 0x2C,
    MADCTL = 0x36,
    COLMOD = 0x3A,
    RAMCTRL = 0xB0,  /* ST7789 */
    DISCTRL = 0xB6,  /* ILI9341, ILI9488, GC9A01, ST7796S */
    EM = 0xB7,       /* ST7796S */
    LCMCTRL = 0xC0,  /* ST7789 */
    GATECTRL = 0xE4, /* ST7789 */
    UNLOCK1 = 0xFE,  /* GC9A01 */
    UNLOCK2 = 0xEF,  /* GC9A01 */
    CSCON = 0xF0,    /* ST7796S */
    SETEXTC = 0xB9,  /* HX8357D */
    SETPANEL = 0xCC, /* HX8357D */
};

#define MS 1000000ULL

enum { EPF_ZERO, EPF_ONE, EPF_MSB, EPF_GREEN }; /* ST7789V 9.2.1, ST7796S 9.3.8 */

enum { UNLOCKED = 3 };

#define LCM_AT_RESET 0x2C /* ST7789V 9.2.10 */

/* What differs between the controllers. */
struct dbi_kind {
    const struct sim_model *model;
    const struct sim_table *table;
    uint8_t formats; /* bit n: COLMOD low bits may be n (1: 3, 3: 12, 5: 16, 6: 18 bits a pixel) */
    uint8_t format_at_reset;
    uint8_t epf_at_reset;
    const char *unlock; /* what opens the registers that are locked after reset; NULL: there are none */
};

static const struct dbi_kind kinds[] = {
    {&sim_model_st7789, &sim_table_st7789, 1 << 3 | 1 << 5 | 1 << 6, 6, EPF_GREEN, NULL},
    {&sim_model_gc9a01, &sim_table_gc9a01, 1 << 3 | 1 << 5 | 1 << 6, 6, EPF_MSB, "FEh and EFh"},
    {&sim_model_ili9341, &sim_table_ili9341, 1 << 5 | 1 << 6, 6, EPF_MSB, NULL},
    {&sim_model_ili9488, &sim_table_ili9488, 1 << 1 | 1 << 6, 6, EPF_MSB, NULL},
    {&sim_model_st7796, &sim_table_st7796, 1 << 5 | 1 << 6, 6, EPF_ZERO, "F0h C3h and F0h 96h"},
    {&sim_model_hx8357d, &sim_table_hx8357d, 1 << 5 | 1 << 6, 6, EPF_MSB, "B9h FFh 83h 57h"},
    {&sim_model_ili9486, &sim_table_ili9486, 1 << 5, 6, EPF_MSB, NULL},
    {&sim_model_st7735s, &sim_table_st7735s, 1 << 3 | 1 << 5 | 1 << 6, 6, EPF_MSB, NULL},
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
    d->epf = kind_of(sim)->epf_at_reset;
    d->lines = sim->glass.ram_height;
    d->x1 = (uint16_t)(sim->glass.ram_width - 1);
    d->y1 = (uint16_t)(sim->glass.ram_height - 1);
    d->wake_ns = sim->time_ns + kind_of(sim)->table->sleep_wait_ms * MS;
    for (uint32_t i = 0; i < count; i++) {
        sim->memory[i].written = 0;
    }
}

/* ---- pixels ------------------------------------------------------------------------------------- */

/* The bits MY MX MV BGR of MADCTL, turned over by ST7789's LCMCTRL. */
static uint8_t madctl_of(const struct sim *sim)
{
    const struct sim_dbi *d = &sim->u.dbi;
    return d->madctl ^
           (uint8_t)((d->lcm & 0x40) << 1 | (d->lcm & 0x08) << 3 | (d->lcm & 0x02) << 4 | (d->lcm & 0x20) >> 2);
}

/* The size of the memory as the host addresses it: MV swaps the axes. */
static uint32_t host_width(const struct sim *sim)
{
    return madctl_of(sim) & 0x20 ? sim->glass.ram_height : sim->glass.ram_width;
}

static uint32_t host_height(const struct sim *sim)
{
    return madctl_of(sim) & 0x20 ? sim->glass.ram_width : sim->glass.ram_height;
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
    const uint8_t madctl = madctl_of(sim);
    uint32_t column = madctl & 0x20 ? d->y : d->x, row = madctl & 0x20 ? d->x : d->y;
    if (column < sim->glass.ram_width && row < sim->glass.ram_height) {
        column = madctl & 0x40 ? sim->glass.ram_width - 1U - column : column;
        row = madctl & 0x80 ? sim->glass.ram_height - 1U - row : row;
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

/*
 * Red or blue of a 16-bit pixel: the glass has six bits, and EPF says where the lowest one comes from. As the highest
 * one repeated they are the colour that was sent, and become 8 bits as 5 bits do; another lowest bit is a level of the
 * glass in between, and becomes 8 bits as 6 bits do. So each of the 64 levels has one value, and they rise with it.
 */
static uint8_t five_bits(const struct sim_dbi *d, uint32_t five, uint32_t green)
{
    const uint32_t value = five & 31, highest = value >> 4;
    const uint32_t lowest[] = {[EPF_ZERO] = 0, [EPF_ONE] = 1, [EPF_MSB] = highest, [EPF_GREEN] = green & 1};
    return lowest[d->epf] == highest ? widen(value, 5) : widen(value << 1 | lowest[d->epf], 6);
}

/* ST7789V 9.2.1 shows EPF for 16 bits a pixel only: with 12 the model knows what EPF_MSB does. */
static void check_epf(struct sim *sim)
{
    struct sim_dbi *d = &sim->u.dbi;
    if (d->format == 3 && d->epf != EPF_MSB && !d->complained) {
        sim_complain(sim, SIM_BAD_PARAMETER, "12 bits a pixel with EPF %u of RAMCTRL (B0h): send EPF 2", d->epf);
        d->complained = true;
    }
}

/* Takes a byte of two pixels, with one bit a colour: xxRGBRGB. */
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
        sim_complain(sim, SIM_PIXELS_ASLEEP, "pixels in sleep mode: SLPOUT (11h) is missing");
        d->complained = true;
    }
    check_epf(sim);
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
        store(sim, five_bits(d, v >> 11, v >> 5), widen(v >> 5, 6), five_bits(d, v, v >> 5));
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

/* The times from now to the next command, and to the next SLPOUT, SLPIN or SWRESET. */
static uint64_t next_command(const struct sim *sim)
{
    return sim->time_ns + kind_of(sim)->table->command_wait_ms * MS;
}

static uint64_t next_sleep(const struct sim *sim)
{
    return sim->time_ns + kind_of(sim)->table->sleep_wait_ms * MS;
}

static void sleep_out(struct sim *sim)
{
    struct sim_dbi *d = &sim->u.dbi;
    if (sim->time_ns < d->wake_ns) {
        sim_complain(sim, SIM_EARLY_COMMAND, "SLPOUT (11h) within 120 ms of reset or SLPIN");
    }
    d->sleeping = false;
    d->ready_ns = next_command(sim);
    d->nap_ns = next_sleep(sim);
}

static void sleep_in(struct sim *sim)
{
    struct sim_dbi *d = &sim->u.dbi;
    if (sim->time_ns < d->nap_ns) {
        sim_complain(sim, SIM_EARLY_COMMAND, "SLPIN (10h) within 120 ms of SLPOUT (11h)");
    }
    d->sleeping = true;
    d->ready_ns = next_command(sim);
    d->wake_ns = next_sleep(sim);
}

static void software_reset(struct sim *sim)
{
    if (sim->time_ns < sim->u.dbi.nap_ns) {
        sim_complain(sim, SIM_EARLY_COMMAND, "SWRESET (01h) within 120 ms of SLPOUT (11h)");
    }
    reset(sim);
    sim->u.dbi.ready_ns = next_command(sim);
}

/* Unlocks registers of a GC9A01 (6.5): FEh and EFh one after the other open those of levels 2 and 3 until the next
 * reset. */
static void unlock(struct sim *sim, uint8_t code)
{
    struct sim_dbi *d = &sim->u.dbi;
    if (kind_of(sim)->table == &sim_table_gc9a01 && d->unlock != UNLOCKED) {
        d->unlock = code == UNLOCK1 ? 1 : code == UNLOCK2 && d->unlock == 1 ? UNLOCKED : 0;
    }
}

/* CSCON of an ST7796S (9.3.23) opens or closes a part of command table 2. */
static void command_set(struct sim *sim, uint8_t value)
{
    struct sim_dbi *d = &sim->u.dbi;
    switch (value) {
    case 0xC3:
        d->unlock |= 1;
        break;
    case 0x96:
        d->unlock |= 2;
        break;
    case 0x3C:
        d->unlock &= ~1U;
        break;
    case 0x69:
        d->unlock &= ~2U;
        break;
    default:
        sim_complain(sim, SIM_BAD_PARAMETER, "F0h CSCON: %02Xh is none of C3h, 96h, 3Ch, 69h", value);
        break;
    }
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
            sim_complain(sim, SIM_ON_WITHOUT_FRAME, "DISPON (29h) before a complete frame");
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
        sim_complain(sim, SIM_BAD_PARAMETER, "3Ah COLMOD: %02Xh is not available on the serial interface", value);
        return;
    }
    sim->u.dbi.format = format;
}

/* Sets how many lines are driven, by NL: 8 (n + 1), at most those of the memory. */
static void set_lines(struct sim *sim, uint8_t value)
{
    const uint32_t lines = 8 * (value + 1U);
    sim->u.dbi.lines = (uint16_t)(lines < sim->glass.ram_height ? lines : sim->glass.ram_height);
}

static void display_function(struct sim *sim)
{
    struct sim_dbi *d = &sim->u.dbi;
    const uint8_t *p = d->parameters;
    d->scan = p[1] & 0x60;
    d->black = kind_of(sim)->table == &sim_table_ili9341 && (p[1] & 0x80) == 0;
    if (d->command->least >= 3) {
        set_lines(sim, p[2]);
    }
}

/* Ends a command to a register that only one controller has. */
static void finish_own(struct sim *sim)
{
    struct sim_dbi *d = &sim->u.dbi;
    const uint8_t *p = d->parameters;
    const struct sim_table *table = kind_of(sim)->table;
    if (table == &sim_table_hx8357d) {
        d->unlock = d->code == SETEXTC ? UNLOCKED : d->unlock;
        d->scan = d->code == SETPANEL ? 0x40 : d->scan;
        d->lcm = d->code == SETPANEL ? 0x20 : d->lcm;
    } else if (d->code == DISCTRL) { /* ST7789 and ST7735S have none */
        display_function(sim);
    } else if (table == &sim_table_st7789 && d->code == RAMCTRL) {
        d->epf = p[1] >> 4 & 3;
        d->low_byte_first = (p[1] & 8) != 0;
    } else if (table == &sim_table_st7796 && d->code == EM) {
        d->epf = p[0] >> 6;
    } else if (table == &sim_table_st7796 && d->code == CSCON) {
        command_set(sim, p[0]);
    } else if (table == &sim_table_st7789 && d->code == LCMCTRL) {
        d->lcm = p[0] ^ LCM_AT_RESET;
    } else if (table == &sim_table_st7789 && d->code == GATECTRL) {
        set_lines(sim, p[0]);
        d->scan = p[2] & 1 ? 0x40 : 0;
    }
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
    default:
        finish_own(sim);
        break;
    }
}

/* Checks that the previous command is complete. */
static void check_last(struct sim *sim)
{
    const struct sim_dbi *d = &sim->u.dbi;
    if (d->command == NULL) {
        return;
    }
    if (d->command->least == SIM_PIXELS) {
        if (d->bit_count != 0 && d->left != 0) {
            sim_complain(sim, SIM_SPLIT_PIXEL, "a command after %u bits of a pixel", d->bit_count);
        }
    } else if (d->parameter_count < d->command->least) {
        sim_complain(sim, SIM_PARAMETER_COUNT, "command %02Xh with %u parameters, it has %u", d->code,
                     d->parameter_count, d->command->least);
    }
}

static void check_wait(struct sim *sim, uint8_t code)
{
    if (sim->time_ns < sim->u.dbi.ready_ns) {
        sim_complain(sim, SIM_EARLY_COMMAND, "command %02Xh within %u ms of reset or sleep", code,
                     kind_of(sim)->table->command_wait_ms);
    }
}

static void take_command(struct sim *sim, uint8_t code)
{
    struct sim_dbi *d = &sim->u.dbi;
    check_last(sim);
    check_wait(sim, code);
    const struct sim_command *command = sim_table_find(&sim_table_dbi, code);
    command = command != NULL ? command : sim_table_find(kind_of(sim)->table, code);
    unlock(sim, code);
    if (command == NULL) {
        sim_complain(sim, SIM_UNKNOWN_COMMAND, "command %02Xh is not known", code);
    } else {
        start(sim, code);
    }
    /* A reset has forgotten these. */
    d->command = command;
    d->code = code;
    d->parameter_count = 0;
    d->bits = 0;
    d->bit_count = 0;
    d->refused = command != NULL && command->needs_unlock && d->unlock != UNLOCKED;
    if (d->refused) {
        sim_complain(sim, SIM_BAD_PARAMETER, "%02Xh %s before %s", code, command->name, kind_of(sim)->unlock);
    }
}

static void take_parameter(struct sim *sim, uint8_t byte)
{
    struct sim_dbi *d = &sim->u.dbi;
    if (d->parameter_count >= d->command->most) {
        if (d->parameter_count++ == d->command->most) {
            sim_complain(sim, SIM_PARAMETER_COUNT, "command %02Xh has only %u parameters", d->code, d->command->most);
        }
        return;
    }
    d->parameters[d->parameter_count++] = byte;
    d->refused = !sim_table_accepts(sim, d->command, d->parameter_count, byte) || d->refused;
    if (d->parameter_count == d->command->least && !d->refused) {
        finish(sim);
    }
}

static void take_data(struct sim *sim, uint8_t byte)
{
    struct sim_dbi *d = &sim->u.dbi;
    if (d->command == NULL) {
        if (d->parameter_count++ == 0 && d->code == 0) {
            sim_complain(sim, SIM_PIXELS_NOWHERE, "data without a command");
        }
    } else if (d->command->least == SIM_PIXELS) {
        take_pixel_byte(sim, byte);
    } else {
        take_parameter(sim, byte);
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

/*
 * A shift register of 16 bits gives a word to the controller's parallel interface, with D/C as it stands at the last
 * bit. The controller takes commands and parameters from the low byte, and a pixel from both; the high byte of the
 * others must be 0, so that a stream that is out of step by a byte is seen.
 */
static void take_half_word(struct sim *sim, enum hal_dc dc, uint8_t byte)
{
    struct sim_dbi *d = &sim->u.dbi;
    d->half_word = !d->half_word;
    if (d->half_word) {
        d->high_byte = byte;
        d->high_dc = dc;
        return;
    }
    const uint8_t high = d->high_byte;
    const bool pixel = dc == HAL_DATA && d->command != NULL && d->command->least == SIM_PIXELS;
    if (d->high_dc != dc) {
        sim_complain(sim, SIM_DC_MOVED, "D/C moved inside of a word of 16 bits");
    }
    if (pixel) {
        take_data(sim, high);
    } else if (high != 0) {
        sim_complain(sim, SIM_BAD_PARAMETER, "%02X%02Xh: the high byte of a command or parameter is not 0", high, byte);
    }
    take_byte(sim, dc, byte);
}

/* ---- the glass ---------------------------------------------------------------------------------- */

static bool from_last_line(const struct sim_dbi *d)
{
    return ((d->scan & 0x40) != 0) != ((d->lcm & 0x01) != 0);
}

/* Finds the cell of the memory that a place of the glass shows. NULL: its line is not driven. */
static const struct sim_cell *cell(const struct sim *sim, uint32_t x, uint32_t y)
{
    const struct sim_glass *glass = &sim->glass;
    const struct sim_dbi *d = &sim->u.dbi;
    uint32_t column = glass->left + (glass->mirrored ? glass->width - 1U - x : x);
    uint32_t row = glass->top + y;
    if (row >= d->lines) {
        return NULL;
    }
    column = d->scan & 0x20 ? glass->ram_width - 1U - column : column;
    row = from_last_line(d) ? d->lines - 1U - row : row;
    return &sim->memory[row * glass->ram_width + column];
}

static void look(const struct sim *sim, uint32_t x, uint32_t y, uint8_t rgb[3])
{
    const struct sim_dbi *d = &sim->u.dbi;
    const struct sim_cell *c = cell(sim, x, y);
    if (c == NULL) {
        return; /* dark */
    }
    bool inverted = (d->inverted != ((d->lcm & 0x10) != 0)) != d->black;
    uint8_t flip = inverted == sim->glass.complement ? 0 : 255;
    bool swapped = ((madctl_of(sim) & 8) != 0) != sim->glass.bgr;
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
    const struct sim_cell *c = cell(sim, x, y);
    return c == NULL || c->written != 0; /* nothing of a line that is not driven is seen */
}

/* The reset pulse takes 10 us, then 5 ms pass (the "reset timing" of the datasheets). The write limits are from their
 * tables of the serial timing. */
#define DBI_MODEL_OF(text, hz, take)                                                                                   \
    {                                                                                                                  \
        .controller = (text), .write_hz = (hz), .reset_pulse_ns = 10000, .reset_wait_ns = 5000000, .reset = reset,     \
        .byte = (take), .shows = shows, .look = look, .written = written                                               \
    }
#define DBI_MODEL(text, hz) DBI_MODEL_OF(text, hz, take_byte)

const struct sim_model sim_model_st7789 = DBI_MODEL("ST7789", 62500000);
const struct sim_model sim_model_gc9a01 = DBI_MODEL("GC9A01", 100000000);
const struct sim_model sim_model_ili9341 = DBI_MODEL("ILI9341", 10000000);
const struct sim_model sim_model_ili9488 = DBI_MODEL("ILI9488", 20000000);
const struct sim_model sim_model_st7796 = DBI_MODEL("ST7796S", 15151515);
const struct sim_model sim_model_hx8357d = DBI_MODEL("HX8357D", 15151515);
const struct sim_model sim_model_ili9486 = DBI_MODEL_OF("ILI9486", 16000000, take_half_word);
const struct sim_model sim_model_st7735s = DBI_MODEL("ST7735S", 15151515);
