/*
 * Models of the OLED controllers SSD1306, SSD1309 (128 x 64), SH1106 (132 x 64) and SH1107 (128 x 128): one bit a
 * pixel, in pages of 8 rows, whose bytes have the upper row in bit 0. Each column of the memory belongs to a segment
 * and each row to a COM line; in an SH1107 it is the other way round. Commands and parameters come with D/C low, bytes
 * of the memory with D/C high. Their commands are in page_table.c; what is SIM_SHOWN there is followed here.
 */
#include "sim_model.h"

#include "sim_table.h"

#include <string.h>

static const struct sim_table *table_of(const struct sim *sim)
{
    const struct sim_model *model = sim->glass.model;
    return model == &sim_model_ssd1306   ? &sim_table_ssd1306
           : model == &sim_model_ssd1309 ? &sim_table_ssd1309
           : model == &sim_model_sh1106  ? &sim_table_sh1106
                                         : &sim_table_sh1107;
}

static bool columns_are_lines(const struct sim *sim)
{
    return sim->glass.model == &sim_model_sh1107;
}

/* COM lines of the controller. */
static uint32_t lines_of(const struct sim *sim)
{
    return columns_are_lines(sim) ? sim->glass.ram_width : sim->glass.ram_height;
}

/* An SSD1306 wakes without its charge pump, an SH1106 with its converter; the supply of the others comes from outside.
 */
static void reset(struct sim *sim)
{
    const uint32_t count = (uint32_t)sim->glass.ram_width * sim->glass.ram_height;
    sim->u.page = (struct sim_page){.mux = (uint8_t)(lines_of(sim) - 1),
                                    .com_pins = 0x12,
                                    .mode = 0xA4,
                                    .powered = sim->glass.model != &sim_model_ssd1306};
    for (uint32_t i = 0; i < count; i++) {
        sim->memory[i].written = 0;
    }
}

/* ---- bytes of the memory ------------------------------------------------------------------------ */

/* Where row and column lie in the memory. A1h (A0h) counts segments from the last one: it holds for bytes that come
 * after it. */
static struct sim_cell *place(struct sim *sim, uint32_t row, uint32_t column)
{
    const uint32_t columns = sim->glass.ram_width, rows = sim->glass.ram_height;
    if (sim->u.page.remap && columns_are_lines(sim)) {
        row = rows - 1 - row;
    } else if (sim->u.page.remap) {
        column = columns - 1 - column;
    }
    return &sim->memory[row * columns + column];
}

/* Takes 8 pixels of a column. */
static void data(struct sim *sim, uint8_t byte)
{
    struct sim_page *p = &sim->u.page;
    const uint32_t columns = sim->glass.ram_width;
    if (p->parameter_wanted) {
        sim_complain(sim, SIM_PARAMETER_COUNT, "command %02Xh without its parameter", p->command->code);
        p->parameter_wanted = false;
    }
    if (p->column >= columns) {
        sim_complain(sim, SIM_TOO_MANY_PIXELS, "a byte for column %u of %u", p->column, columns);
        return;
    }
    for (uint32_t i = 0; i < 8; i++) {
        const uint8_t level = (byte >> i & 1) != 0 ? 255 : 0;
        *place(sim, 8U * p->page + i, p->column) = (struct sim_cell){level, level, level, 1};
    }
    sim->counters.pixels += 8;
    p->column++;
}

/* ---- commands ----------------------------------------------------------------------------------- */

/* The code by which a command stands in its table: numbers in its lowest bits are left out. */
static uint8_t family(const struct sim *sim, uint8_t code)
{
    if (code < 0x20) {
        return code & 0xF0;
    }
    if (code >= 0x40 && code < 0x80) {
        return 0x40;
    }
    if (code >= 0xB0 && code < 0xB0 + sim->glass.ram_height / 8) {
        return 0xB0;
    }
    return sim->glass.model == &sim_model_sh1106 && code >= 0x30 && code < 0x34 ? 0x30 : code;
}

static void set_column(struct sim *sim, uint32_t column)
{
    sim->u.page.column = (uint8_t)column;
    if (column >= sim->glass.ram_width) {
        sim_complain(sim, SIM_WINDOW_OUTSIDE, "column %u of %u", column, sim->glass.ram_width);
    }
}

static void display_on(struct sim *sim)
{
    if (!sim_frame_complete(sim)) {
        sim_complain(sim, SIM_ON_WITHOUT_FRAME, "display on (AFh) before a complete frame");
    }
    sim->u.page.on = true;
}

/* Carries out a command that has no parameter. */
static void execute(struct sim *sim, uint8_t code)
{
    struct sim_page *p = &sim->u.page;
    switch (family(sim, code)) {
    case 0x00:
        p->column = (uint8_t)((p->column & 0xF0) | (code & 15)); /* the high half may follow */
        break;
    case 0x10:
        set_column(sim, (code & 15U) << 4 | (p->column & 15U));
        break;
    case 0x40:
        p->start = code & 0x3F;
        break;
    case 0xA0:
    case 0xA1:
        p->remap = code & 1;
        break;
    case 0xA4:
    case 0xA5:
        p->mode = code;
        break;
    case 0xA6:
    case 0xA7:
        p->inverse = code & 1;
        break;
    case 0xAE:
        p->on = false;
        break;
    case 0xAF:
        display_on(sim);
        break;
    case 0xB0:
        p->page = code & 15;
        break;
    case 0xC0:
    case 0xC8:
        p->from_last = code == 0xC8;
        break;
    default:
        break;
    }
}

static void take_parameter(struct sim *sim, uint8_t byte)
{
    struct sim_page *p = &sim->u.page;
    p->parameter_wanted = false;
    if (!sim_table_accepts(sim, p->command, 1, byte)) {
        return;
    }
    switch (p->command->code) {
    case 0x8D:
        p->powered = (byte & 4) != 0;
        break;
    case 0xA8:
        p->mux = byte;
        break;
    case 0xAD: /* of an SSD1306 it is the reference current */
        p->powered = sim->glass.model == &sim_model_sh1106 ? byte & 1 : p->powered;
        break;
    case 0xD3:
        p->offset = byte;
        break;
    case 0xDA:
        p->com_pins = byte;
        break;
    case 0xDC:
        p->start = byte;
        break;
    case 0xFD:
        p->locked = (byte & 4) != 0;
        break;
    default:
        break;
    }
}

static void command(struct sim *sim, uint8_t code)
{
    struct sim_page *p = &sim->u.page;
    if (p->parameter_wanted && !p->refused) {
        take_parameter(sim, code);
        return;
    }
    if (p->parameter_wanted) { /* that of a locked command has no effect */
        p->parameter_wanted = false;
        return;
    }
    p->command = sim_table_find(table_of(sim), family(sim, code));
    if (p->command == NULL) {
        sim_complain(sim, SIM_UNKNOWN_COMMAND, "command %02Xh is not known", code);
        return;
    }
    p->parameter_wanted = p->command->most != 0;
    p->refused = p->locked && code != 0xFD;
    if (p->refused) {
        sim_complain(sim, SIM_BAD_PARAMETER, "command %02Xh %s is locked", code, p->command->name);
    } else if (!p->parameter_wanted) {
        execute(sim, code);
    }
}

static void take_byte(struct sim *sim, enum hal_dc dc, uint8_t byte)
{
    if (dc == HAL_DATA) {
        data(sim, byte);
    } else {
        command(sim, byte);
    }
}

/* ---- the glass ---------------------------------------------------------------------------------- */

/*
 * What COM line `com` shows: a row of the memory, or a column of an SH1107. UINT32_MAX: it is not driven. The offset
 * moves the lines that are driven; C8h scans these, and no others, from the last one (SSD1306, tables 10-1 and 10-2).
 */
static uint32_t line_shown(const struct sim *sim, uint32_t com)
{
    const struct sim_page *p = &sim->u.page;
    const uint32_t all = lines_of(sim), line = (p->from_last ? com + all - p->offset : com + p->offset) % all;
    if (line > p->mux) {
        return UINT32_MAX;
    }
    return ((p->from_last ? p->mux - line : line) + p->start) % all;
}

/*
 * The place of the memory that is seen at (x, y). NULL: none. Modules hold the glass of the first three upside down:
 * the first segment is at the right, COM0 at the bottom. It is bonded to COM0 .. height - 1, with odd and even ones at
 * different sides unless it is in_order; if DAh says otherwise, the lines come in another order. A glass with an SH1107
 * is bonded to the COM lines from `left` on.
 */
static const struct sim_cell *cell(const struct sim *sim, uint32_t x, uint32_t y)
{
    const struct sim_page *p = &sim->u.page;
    const struct sim_glass *glass = &sim->glass;
    if (columns_are_lines(sim)) {
        const uint32_t column = line_shown(sim, glass->left + x);
        return column == UINT32_MAX ? NULL : &sim->memory[(glass->top + y) * glass->ram_width + column];
    }
    uint32_t com = glass->height - 1U - y;
    if (((p->com_pins & 0x10) == 0) != glass->in_order) {
        com = com % 2 * ((p->mux + 1U) / 2) + com / 2;
    }
    const uint32_t row = line_shown(sim, com), segment = glass->left + glass->width - 1U - x;
    return row == UINT32_MAX ? NULL : &sim->memory[row * glass->ram_width + segment];
}

static void look(const struct sim *sim, uint32_t x, uint32_t y, uint8_t rgb[3])
{
    const struct sim_page *p = &sim->u.page;
    const struct sim_cell *const c = cell(sim, x, y);
    if (c != NULL) {
        const bool lit = (p->mode == 0xA5 || c->r >= 128) != p->inverse;
        memset(rgb, lit ? 255 : 0, 3);
    }
}

static bool shows(const struct sim *sim)
{
    return sim->u.page.on && sim->u.page.powered;
}

static bool written(const struct sim *sim, uint32_t x, uint32_t y)
{
    const struct sim_cell *const c = cell(sim, x, y);
    return c == NULL || c->written != 0;
}

/* Fast mode. */
#define PAGE_MODEL                                                                                                     \
    .pages = true, .i2c_hz = 400000, .reset = reset, .byte = take_byte, .shows = shows, .look = look, .written = written

/* SSD1306 8.5 and 8.9, table 13-4: 3 us low, 3 us high, cycle 100 ns; SSD1309 likewise. SH1106 and SH1107: 10 us, 2 us,
 * 250 ns. */
const struct sim_model sim_model_ssd1306 = {
    .controller = "SSD1306", .write_hz = 10000000, .reset_pulse_ns = 3000, .reset_wait_ns = 3000, PAGE_MODEL};
const struct sim_model sim_model_ssd1309 = {
    .controller = "SSD1309", .write_hz = 10000000, .reset_pulse_ns = 3000, .reset_wait_ns = 3000, PAGE_MODEL};
const struct sim_model sim_model_sh1106 = {
    .controller = "SH1106", .write_hz = 4000000, .reset_pulse_ns = 10000, .reset_wait_ns = 2000, PAGE_MODEL};
const struct sim_model sim_model_sh1107 = {
    .controller = "SH1107", .write_hz = 4000000, .reset_pulse_ns = 10000, .reset_wait_ns = 2000, PAGE_MODEL};
