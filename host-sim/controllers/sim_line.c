/*
 * Models of Sharp's memory LCDs LS013B7DH03 (128 x 128) and LS027B7DH01 (400 x 240), by their specifications' chapters
 * on timing and on input signals: one bit a pixel, in lines.
 *
 * The panel listens while SCS is high, which is D/C here (hal/panel/panel_line.h). Its clock must not run faster, SCS
 * not rise later and not fall earlier than the specification says. A message is a mode, whose first bits are M0, M1 and
 * M2, and with M0 lines: address, pixels and 8 clocks. A line gets into the memory with the 16 clocks after its pixels;
 * 8 of them may be the next line's address. Without M0 there are 8 clocks after the mode. Bits that the specification
 * calls dummy must be 0 here, so that a byte in the wrong place is seen.
 *
 * SCS may rise with the first bit of the message, for all that a byte and its D/C tell: so half a period of the clock
 * is what counts as tsSCS. It was low for at least a byte, which is longer than twSCSL.
 */
#include "sim_model.h"

enum { M0 = 0x80, M1 = 0x40, M2 = 0x20 };

#define STILL_NS_MAX 1000000000u /* how long VCOM may stay as it is */

static void reset(struct sim *sim)
{
    const uint32_t count = (uint32_t)sim->glass.ram_width * sim->glass.ram_height;
    sim->u.line = (struct sim_line){.toggled_ns = sim->time_ns};
    for (uint32_t i = 0; i < count; i++) {
        sim->memory[i].written = 0;
    }
}

/* While DISP is high, VCOM must be toggled. */
static void rest(struct sim *sim)
{
    struct sim_line *l = &sim->u.line;
    const uint64_t still_ns = sim->time_ns - l->toggled_ns;
    if (sim->backlight && still_ns > STILL_NS_MAX && !l->still) {
        l->still = true;
        sim_complain(sim, SIM_VCOM_STILL, "VCOM (M1) was not toggled for %u ms: once a second is needed",
                     (unsigned)(still_ns / 1000000));
    }
}

/* ---- a message ---------------------------------------------------------------------------------- */

static void toggle(struct sim_line *l, bool vcom, uint64_t now_ns)
{
    if (vcom != l->vcom) {
        l->vcom = vcom;
        l->toggled_ns = now_ns;
        l->still = false;
    }
}

static void clear(struct sim *sim)
{
    const uint32_t count = (uint32_t)sim->glass.ram_width * sim->glass.ram_height;
    for (uint32_t i = 0; i < count; i++) {
        struct sim_cell *cell = &sim->memory[i];
        cell->r = cell->g = cell->b = 255;
    }
}

/* SCS has risen. */
static void take_mode(struct sim *sim, uint8_t mode)
{
    struct sim_line *l = &sim->u.line;
    const uint32_t lead_ns = 500000000 / sim->counters.clock_hz;
    l->listening = true;
    l->refused = l->ended = false;
    l->mode = mode;
    l->line = 0;
    l->taken = 0;
    if (lead_ns < sim->glass.model->select_lead_ns) {
        sim_complain(sim, SIM_SELECT_TIME, "SCS may rise %u ns before the clock's first edge, tsSCS is %u ns", lead_ns,
                     sim->glass.model->select_lead_ns);
    }
    if ((mode & ~(M0 | M1 | M2)) != 0 || (mode & (M0 | M2)) == (M0 | M2)) {
        sim_complain(sim, SIM_UNKNOWN_COMMAND, "mode %02Xh: M0, M1 or M1, M2 come first, then zeros", mode);
        l->refused = true;
        return;
    }
    toggle(l, (mode & M1) != 0, sim->time_ns);
    if ((mode & M2) != 0) {
        clear(sim);
    }
}

/* Puts the latch into the memory. */
static void write_line(struct sim *sim)
{
    const struct sim_line *l = &sim->u.line;
    const uint32_t width = sim->glass.ram_width;
    struct sim_cell *row = sim->memory + (size_t)(l->line - 1U) * width;
    for (uint32_t x = 0; x < width; x++) {
        const uint8_t level = (l->pixels[x / 8] >> (7 - x % 8) & 1) != 0 ? 255 : 0;
        row[x] = (struct sim_cell){level, level, level, 1};
    }
    sim->counters.pixels += width;
}

/* An address, its lowest bit first; or the second byte behind the last line. */
static void take_address(struct sim *sim, uint8_t byte)
{
    struct sim_line *l = &sim->u.line;
    uint32_t address = 0;
    for (uint32_t i = 0; i < 8; i++) {
        address |= (uint32_t)(byte >> (7 - i) & 1) << i;
    }
    if (l->line != 0) {
        write_line(sim);
    }
    if (address == 0 && l->line != 0) {
        l->ended = true;
        return;
    }
    if (address == 0 || address > sim->glass.ram_height) {
        sim_complain(sim, SIM_WINDOW_OUTSIDE, "line %u of 1 .. %u", address, sim->glass.ram_height);
        l->refused = true;
        return;
    }
    l->line = (uint8_t)address;
    l->taken = 1;
}

static void take_line_byte(struct sim *sim, uint8_t byte)
{
    struct sim_line *l = &sim->u.line;
    const uint32_t bytes = sim->glass.ram_width / 8U;
    if (l->ended) {
        sim_complain(sim, SIM_TOO_MANY_PIXELS, "a byte %02Xh behind the message's end", byte);
        l->refused = true;
    } else if (l->taken == 0) {
        take_address(sim, byte);
    } else if (l->taken <= bytes) {
        l->pixels[l->taken++ - 1] = byte;
    } else {
        l->taken = 0;
        if (byte != 0) {
            sim_complain(sim, SIM_SPLIT_PIXEL, "a byte %02Xh behind line %u in the place of its trailer", byte,
                         l->line);
            l->refused = true;
        }
    }
}

static void take_listened(struct sim *sim, uint8_t byte)
{
    struct sim_line *l = &sim->u.line;
    if (!l->listening) {
        take_mode(sim, byte);
    } else if (!l->refused && (l->mode & M0) != 0) {
        take_line_byte(sim, byte);
    } else if (!l->refused && (byte != 0 || l->ended)) {
        sim_complain(sim, SIM_TOO_MANY_PIXELS, "a byte %02Xh behind mode %02Xh and its trailer", byte, l->mode);
        l->refused = true;
    } else {
        l->ended = true;
    }
    l->last_ns = sim->time_ns;
}

/* SCS has fallen, at the latest when the byte began that just ended. */
static void end(struct sim *sim)
{
    struct sim_line *l = &sim->u.line;
    const uint64_t byte_ns = 8000000000u / sim->counters.clock_hz, lag_ns = sim->time_ns - byte_ns - l->last_ns;
    l->listening = false;
    if (lag_ns < sim->glass.model->select_lag_ns) {
        sim_complain(sim, SIM_SELECT_TIME, "SCS falls %u ns after the clock's last edge, thSCS is %u ns",
                     (unsigned)lag_ns, sim->glass.model->select_lag_ns);
    }
    if (!l->ended && !l->refused) {
        sim_complain(sim, SIM_CUT_MESSAGE, "SCS falls before the message's trailer: %s",
                     (l->mode & M0) != 0 ? "16 clocks follow the last line" : "8 clocks follow the mode");
    }
}

static void take_byte(struct sim *sim, enum hal_dc dc, uint8_t byte)
{
    rest(sim);
    if (dc == HAL_DATA) {
        take_listened(sim, byte);
        return;
    }
    if (sim->u.line.listening) {
        end(sim);
    }
    if (byte != 0) {
        sim_complain(sim, SIM_PIXELS_NOWHERE, "a byte %02Xh while SCS is low", byte);
    }
}

/* ---- the glass ---------------------------------------------------------------------------------- */

static bool shows(const struct sim *sim)
{
    (void)sim; /* DISP counts as a backlight, see sim_glass.c */
    return true;
}

static const struct sim_cell *cell_at(const struct sim *sim, uint32_t x, uint32_t y)
{
    return &sim->memory[y * sim->glass.ram_width + x];
}

static void look(const struct sim *sim, uint32_t x, uint32_t y, uint8_t rgb[3])
{
    rgb[0] = rgb[1] = rgb[2] = cell_at(sim, x, y)->r;
}

static bool written(const struct sim *sim, uint32_t x, uint32_t y)
{
    return cell_at(sim, x, y)->written != 0;
}

#define LINE_MODEL(name, hz, lead_ns, lag_ns)                                                                          \
    {                                                                                                                  \
        .controller = (name), .write_hz = (hz), .mode_0 = true, .select_lead_ns = (lead_ns),                           \
        .select_lag_ns = (lag_ns), .reset = reset, .byte = take_byte, .rest = rest, .shows = shows, .look = look,      \
        .written = written                                                                                             \
    }

/* fSCLK, tsSCS, thSCS */
const struct sim_model sim_model_ls013b7dh03 = LINE_MODEL("LS013B7DH03", 1100000, 6000, 2000);
const struct sim_model sim_model_ls027b7dh01 = LINE_MODEL("LS027B7DH01", 2000000, 3000, 1000);
