/*
 * sim_table: what may be sent to a display controller. dbi_table.c, ssd_table.c and page_table.c hold one entry a
 * command and one line a field of its parameters, each from the controller's data sheet; the models refuse whatever is
 * not in there. So a new command of hal/panel needs its entry here, and a field that changes what is seen needs the
 * model's code, too.
 *
 *   - A bit that no field covers must be 0: the data sheet prints it as 0 or as "-", or the model does not follow it.
 *   - A field takes the values least .. most of (parameter & bits).
 *   - `exact` is for registers without a public description: only the bytes that the maker publishes are taken.
 *
 * Numbers in `name` are sections of table->document.
 */
#ifndef SIM_TABLE_H
#define SIM_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct sim;

/* What a field does to the picture. */
enum sim_effect {
    SIM_SHOWN,   /* the model follows it: it changes what is seen, or what the bytes after it mean */
    SIM_FIXED,   /* the data sheet prints this value, or the model follows no other; another one is refused */
    SIM_VOLTAGE, /* changes no pixel: a voltage or current. Levels get brighter or darker and keep their order */
    SIM_TIMING,  /* changes no pixel: when and in which order lines are driven, or with which polarity */
    SIM_UNUSED,  /* changes no pixel: it belongs to an interface, a pin or a mode that is not in use here */
};

struct sim_field {
    uint8_t first, last; /* parameters that have it; the first one is 1 */
    uint8_t bits;
    uint8_t least, most;
    enum sim_effect effect;
    const char *name;
};

#define SIM_PIXELS 255 /* instead of a number of parameters: a memory write */

struct sim_command {
    uint8_t code;
    uint8_t least, most; /* parameters */
    bool needs_unlock;   /* refused until the controller's unlock commands came (FDh B1h; FEh, EFh; F0h C3h, F0h 96h;
                            B9h) */
    const char *name;
    const uint8_t *exact; /* `most` bytes; NULL: `fields` tell */
    const struct sim_field *fields;
    uint8_t field_count;
};

struct sim_table {
    const char *document;
    const struct sim_command *commands;
    size_t count;
    uint32_t command_wait_ms; /* from SWRESET, SLPIN or SLPOUT to the next command */
    uint32_t sleep_wait_ms;   /* from SWRESET or SLPIN to SLPOUT, and from SLPOUT to SLPIN or SWRESET */
};

/* Commands that all controllers of the MIPI display command set share; then those of each controller. */
extern const struct sim_table sim_table_dbi, sim_table_st7789, sim_table_gc9a01, sim_table_ili9341, sim_table_ili9488,
    sim_table_st7796, sim_table_hx8357d, sim_table_ili9486, sim_table_st7735s, sim_table_ssd1351, sim_table_ssd0323,
    sim_table_ssd1306, sim_table_ssd1309, sim_table_sh1106, sim_table_sh1107;

/* Finds a command. NULL: there is none of this code. */
const struct sim_command *sim_table_find(const struct sim_table *table, uint8_t code);

/* May this byte be parameter `number` (from 1) of the command? If not, the simulator complains and names the bits. */
bool sim_table_accepts(struct sim *sim, const struct sim_command *command, uint32_t number, uint8_t byte);

#endif
