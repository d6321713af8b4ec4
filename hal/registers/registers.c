/* See registers.h. */
#include "registers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LINE       320
#define NEVER_SEEN 0

/* A register as the program left it. `when` numbers are those of accesses, from 1 on; 0: never. */
struct cell {
    uint32_t value, seen; /* as written; as read last */
    uint64_t seen_at, changed_at[32], changed_ns[32];
};

struct registers {
    const struct register_chip *chip;
    uint32_t cores, cell_count;
    uint64_t accesses;
    char line[LINE];
    struct cell cells[]; /* by core, block, row, number */
};

/* Where an address leads to. */
struct place {
    const struct register_block *block;
    const struct register_row *row;
    uint32_t number, alias, cell;
};

static uint32_t count_of(const struct register_row *row)
{
    return row->count == 0 ? 1 : row->count;
}

static uint32_t cells_of(const struct register_chip *chip)
{
    uint32_t n = 0;
    for (uint32_t b = 0; b < chip->block_count; b++) {
        for (uint32_t i = 0; i < chip->blocks[b].row_count; i++) {
            n += count_of(&chip->blocks[b].rows[i]);
        }
    }
    return n;
}

/* Whether the row has the register at this offset of its block; then sets its number. */
static bool row_has(const struct register_row *row, uint32_t offset, uint32_t *number)
{
    const uint32_t past = offset - row->offset;
    *number = row->stride == 0 ? 0 : past / row->stride;
    return offset >= row->offset && (row->stride == 0 ? past : past % row->stride) == 0 && *number < count_of(row);
}

static const struct register_block *block_at(const struct register_chip *chip, uint32_t address)
{
    for (uint32_t b = 0; b < chip->block_count; b++) {
        if (address - chip->blocks[b].base < chip->blocks[b].bytes) {
            return &chip->blocks[b];
        }
    }
    return NULL;
}

/* Sets place->block, and place->row where there is one. */
static void find(const struct registers *r, uint32_t core, uint32_t address, struct place *place)
{
    memset(place, 0, sizeof *place);
    place->block = block_at(r->chip, address);
    place->cell = 0;
    for (const struct register_block *b = r->chip->blocks; place->block != NULL && b <= place->block; b++) {
        uint32_t offset = (address & ~3U) - b->base;
        place->alias = b->aliases ? offset >> 12 & 3 : 0;
        offset = b->aliases ? offset & ~0x3000U : offset;
        for (uint32_t i = 0; i < b->row_count && place->row == NULL; i++) {
            if (b == place->block && row_has(&b->rows[i], offset, &place->number)) {
                place->row = &b->rows[i];
                place->cell += place->number + (b->per_core ? core * r->cell_count : 0);
            } else {
                place->cell += count_of(&b->rows[i]);
            }
        }
    }
}

static const struct cell *cell_at(const struct registers *r, uint32_t core, uint32_t address)
{
    struct place place;
    find(r, core, address, &place);
    return place.row != NULL ? &r->cells[place.cell] : NULL;
}

static uint64_t last_change(const uint64_t changed[32], uint32_t mask)
{
    uint64_t last = 0;
    for (uint32_t i = 0; i < 32; i++) {
        last = (mask >> i & 1) != 0 && changed[i] > last ? changed[i] : last;
    }
    return last;
}

static bool holds(const struct registers *r, uint32_t core, uint64_t time_ns, const struct register_when *when)
{
    const struct cell *cell = cell_at(r, core, when->address);
    const struct cell *since = when->since != 0 ? cell_at(r, core, when->since) : NULL;
    if (cell == NULL) {
        return false; /* a table that asks for a register that it does not have */
    }
    switch ((enum register_need)when->need) {
    case REGISTER_IS:
        return (cell->value & when->mask) == when->value;
    case REGISTER_AT_LEAST:
        return (cell->value & when->mask) >= when->value;
    case REGISTER_SEEN:
        return cell->seen_at != NEVER_SEEN && (cell->seen & when->mask) == when->value &&
               (since == NULL || cell->seen_at > last_change(since->changed_at, when->since_mask));
    case REGISTER_WAITED:
    default:
        return time_ns >= last_change(cell->changed_ns, when->mask) + when->value;
    }
}

static const char *object(struct registers *r, const struct place *place, uint32_t address, const char *access,
                          uint32_t value, const char *why)
{
    char number[12] = "";
    if (place->row != NULL && place->row->count > 1) {
        snprintf(number, sizeof number, "[%u]", (unsigned)place->number);
    }
    snprintf(r->line, sizeof r->line, "%s %s%s (%08x) %s %08x: %s (%s%s%s)",
             place->block != NULL ? place->block->name : r->chip->name, place->row != NULL ? place->row->name : "?",
             number, (unsigned)address, access, (unsigned)value, why, r->chip->document,
             place->row != NULL && place->row->source != NULL ? ", " : "",
             place->row != NULL && place->row->source != NULL ? place->row->source : "");
    return r->line;
}

/* The first need that does not hold for a write that makes `new` of `old`; NULL: all hold. */
static const char *unmet(const struct registers *r, uint32_t core, uint64_t time_ns, const struct register_when *when,
                         uint32_t count, uint32_t old, uint32_t new)
{
    for (uint32_t i = 0; i < count; i++) {
        const bool asked = (when[i].changes == 0 || ((old ^ new) & when[i].changes) != 0) &&
                           (when[i].sets == 0 || (new &when[i].sets) != 0);
        if (asked && !holds(r, core, time_ns, &when[i])) {
            return when[i].why;
        }
    }
    return NULL;
}

static uint32_t mask_of(const struct register_field *field)
{
    return (field->bits == 32 ? UINT32_MAX : (1U << field->bits) - 1) << field->low;
}

/* Whether a row of the same bits takes the value. */
static bool field_takes(const struct register_row *row, const struct register_field *field, uint32_t value)
{
    const uint32_t part = (value & mask_of(field)) >> field->low;
    for (uint32_t i = 0; i < row->field_count; i++) {
        const struct register_field *f = &row->fields[i];
        if (f->low == field->low && f->bits == field->bits && part >= f->least && part <= f->most) {
            return true;
        }
    }
    return false;
}

/* NULL, or what is wrong with the bits of a value; text has room for LINE bytes. */
static const char *bits_are_wrong(const struct register_row *row, uint32_t value, char *text)
{
    uint32_t known = 0;
    for (uint32_t i = 0; i < row->field_count; i++) {
        const struct register_field *f = &row->fields[i];
        known |= mask_of(f);
        if (!field_takes(row, f, value)) {
            snprintf(text, LINE / 2, "%s: the effect of %x is not known, that of %x to %x is", f->name,
                     (unsigned)((value & mask_of(f)) >> f->low), (unsigned)f->least, (unsigned)f->most);
            return text;
        }
    }
    const uint32_t kept = row->kind == REGISTER_COMMAND ? 0 : row->start;
    if (((value ^ kept) & ~known) != 0) {
        snprintf(text, LINE / 2, "bits %x are not in the table", (unsigned)((value ^ kept) & ~known));
        return text;
    }
    return NULL;
}

/* What the register holds after a write through one of the aliases. */
static uint32_t after(uint32_t old, uint32_t alias, uint32_t value)
{
    return alias == 1 ? old ^ value : alias == 2 ? old | value : alias == 3 ? old & ~value : value;
}

static void keep(struct registers *r, struct cell *cell, uint64_t time_ns, uint32_t value, bool command)
{
    for (uint32_t i = 0; i < 32; i++) {
        if (((command ? value : cell->value ^ value) >> i & 1) != 0) {
            cell->changed_at[i] = r->accesses;
            cell->changed_ns[i] = time_ns;
        }
    }
    cell->value = command ? cell->value : value;
}

const char *registers_write(struct registers *r, uint32_t core, uint64_t time_ns, uint32_t address, uint32_t value,
                            uint32_t bytes)
{
    struct place place;
    char text[LINE / 2];
    find(r, core, address, &place);
    r->accesses++;
    if (place.row == NULL) {
        return object(r, &place, address, "=", value, "no such register in the table");
    }
    if (place.row->kind == REGISTER_STATUS) {
        return object(r, &place, address, "=", value, "it is read only");
    }
    if (bytes != 4 && !place.row->narrow) {
        return object(r, &place, address, "=", value, "it takes whole words only");
    }
    struct cell *cell = &r->cells[place.cell];
    const bool command = place.row->kind == REGISTER_COMMAND;
    const uint32_t old = command ? 0 : cell->value, new = after(old, place.alias, value);
    const char *why = unmet(r, core, time_ns, place.block->when, place.block->when_count, old, new);
    why = why != NULL ? why : unmet(r, core, time_ns, place.row->when, place.row->when_count, old, new);
    why = why != NULL ? why : bits_are_wrong(place.row, new, text);
    keep(r, cell, time_ns, new, command);
    return why != NULL ? object(r, &place, address, "=", value, why) : NULL;
}

const char *registers_read(struct registers *r, uint32_t core, uint64_t time_ns, uint32_t address, uint32_t value,
                           uint32_t bytes)
{
    struct place place;
    (void)bytes;
    find(r, core, address, &place);
    r->accesses++;
    if (place.row == NULL) {
        return object(r, &place, address, "reads", value, "no such register in the table");
    }
    struct cell *cell = &r->cells[place.cell];
    const char *why = unmet(r, core, time_ns, place.block->when, place.block->when_count, 0, 0);
    cell->seen = value;
    cell->seen_at = r->accesses;
    return why != NULL ? object(r, &place, address, "reads", value, why) : NULL;
}

void registers_restart(struct registers *r)
{
    memset(r->cells, 0, (size_t)r->cores * r->cell_count * sizeof r->cells[0]);
    r->accesses = 0;
    struct cell *cell = r->cells;
    for (uint32_t core = 0; core < r->cores; core++) {
        for (uint32_t b = 0; b < r->chip->block_count; b++) {
            const struct register_block *block = &r->chip->blocks[b];
            for (uint32_t i = 0; i < block->row_count; i++) {
                for (uint32_t n = count_of(&block->rows[i]); n > 0; n--) {
                    (cell++)->value = block->rows[i].start;
                }
            }
        }
    }
}

struct registers *registers_new(const struct register_chip *chip, uint32_t cores)
{
    const uint32_t cells = cells_of(chip);
    struct registers *r = malloc(sizeof *r + (size_t)cores * cells * sizeof r->cells[0]);
    if (r != NULL) {
        r->chip = chip;
        r->cores = cores;
        r->cell_count = cells;
        registers_restart(r);
    }
    return r;
}

void registers_free(struct registers *r)
{
    free(r);
}
