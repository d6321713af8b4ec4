/* See registers.h. */
#include "registers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LINE   320
#define PLACES 256

/* A register as the program left it. Members `.._at` number the accesses, from 1 on; 0: never. */
struct cell {
    uint32_t value, seen; /* as written; as read last */
    uint64_t written_at, seen_at, changed_at[32], changed_ns[32];
};

/* Where the word at an address leads to. */
struct place {
    uint32_t address;
    bool known;
    const struct register_block *block;
    const struct register_row *row;
    uint32_t number, alias, cell; /* of the row's registers; of its addresses; of core 0's cells */
};

struct registers {
    const struct register_chip *chip;
    uint32_t cores, cell_count;
    uint64_t accesses;
    char line[LINE];
    struct place places[PLACES]; /* those found last, by address */
    struct cell cells[];         /* by core, block, row, number */
};

static uint32_t count_of(const struct register_row *row)
{
    return row->count == 0 ? 1 : row->count;
}

static uint32_t cells_of(const struct register_block *block)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < block->row_count; i++) {
        n += count_of(&block->rows[i]);
    }
    return n;
}

/* Whether the row has the register at this offset of its block; then sets its number. */
static bool row_has(const struct register_row *row, uint32_t offset, uint32_t *number)
{
    const uint32_t past = offset - row->offset;
    *number = row->stride == 0 ? 0 : past / row->stride;
    return offset >= row->offset && past == *number * row->stride && *number < count_of(row);
}

static void look_in(struct place *place, uint32_t offset)
{
    const struct register_block *block = place->block;
    place->alias = block->aliases ? offset >> 12 & 3 : 0;
    offset = block->aliases ? offset & ~0x3000U : offset;
    for (uint32_t i = 0; i < block->row_count; i++) {
        const struct register_row *row = &block->rows[i];
        if (row_has(row, offset, &place->number)) {
            place->row = row;
            place->cell += place->number;
            return;
        }
        place->cell += count_of(row);
    }
}

static struct place look_up(const struct register_chip *chip, uint32_t address)
{
    struct place place = {.address = address, .known = true};
    for (uint32_t b = 0; b < chip->block_count; b++) {
        const struct register_block *block = &chip->blocks[b];
        if (address - block->base < block->bytes) {
            place.block = block;
            look_in(&place, address - block->base);
            break;
        }
        place.cell += cells_of(block);
    }
    return place;
}

static struct place find(struct registers *r, uint32_t address)
{
    const uint32_t word = address & ~3U;
    struct place *place = &r->places[(word >> 2 ^ word >> 10 ^ word >> 16) % PLACES];
    if (!place->known || place->address != word) {
        *place = look_up(r->chip, word);
    }
    return *place;
}

static struct cell *cell_of(struct registers *r, uint32_t core, const struct place *place)
{
    return &r->cells[place->cell + (place->block->per_core ? core * r->cell_count : 0)];
}

/* Finds the state of a register. NULL: the table asks for a register that it does not have. */
static const struct cell *cell_at(struct registers *r, uint32_t core, uint32_t address)
{
    const struct place place = find(r, address);
    return place.row != NULL ? cell_of(r, core, &place) : NULL;
}

static uint64_t last_of(const uint64_t changed[32], uint32_t mask)
{
    uint64_t last = 0;
    for (uint32_t i = 0; mask >> i != 0 && i < 32; i++) {
        last = (mask >> i & 1) != 0 && changed[i] > last ? changed[i] : last;
    }
    return last;
}

/* Whether the access with this number, if it is asked for, came after what the need counts from. */
static bool is_later(struct registers *r, uint32_t core, const struct register_when *when, uint64_t at)
{
    const struct cell *since = when->since != 0 ? cell_at(r, core, when->since) : NULL;
    if (since == NULL) {
        return at != 0 && when->since == 0;
    }
    if (when->since_mask == 0) {
        return since->written_at == 0 || at > since->written_at;
    }
    return at > last_of(since->changed_at, when->since_mask);
}

static bool holds(struct registers *r, uint32_t core, uint64_t time_ns, const struct register_when *when)
{
    const struct cell *cell = cell_at(r, core, when->address);
    if (cell == NULL) {
        return false;
    }
    switch ((enum register_need)when->need) {
    case REGISTER_IS:
        return (cell->value & when->mask) == when->value;
    case REGISTER_AT_LEAST:
        return (cell->value & when->mask) >= when->value;
    case REGISTER_SEEN:
        return is_later(r, core, when, (cell->seen & when->mask) == when->value ? cell->seen_at : 0);
    case REGISTER_WRITTEN:
        return is_later(r, core, when, cell->written_at);
    case REGISTER_WAITED:
    default:
        return last_of(cell->changed_at, when->mask) == 0 ||
               time_ns >= last_of(cell->changed_ns, when->mask) + when->value;
    }
}

static const char *object(struct registers *r, const struct place *place, uint32_t address, const char *access,
                          uint32_t value, const char *why)
{
    char number[12] = "";
    const char *source = place->row != NULL ? place->row->source : NULL;
    if (place->row != NULL && place->row->count > 1) {
        snprintf(number, sizeof number, "[%u]", (unsigned)place->number);
    }
    snprintf(r->line, sizeof r->line, "%s %s%s (%08x) %s %08x: %s (%s%s%s)",
             place->block != NULL ? place->block->name : r->chip->name, place->row != NULL ? place->row->name : "?",
             number, (unsigned)address, access, (unsigned)value, why, r->chip->document, source != NULL ? ", " : "",
             source != NULL ? source : "");
    return r->line;
}

/* The first need that does not hold for an access that makes `is` of `was`; NULL: all hold. */
static const char *unmet(struct registers *r, uint32_t core, uint64_t time_ns, const struct register_when *when,
                         uint32_t count, uint32_t was, uint32_t is)
{
    for (uint32_t i = 0; i < count; i++) {
        const bool asked = (when[i].changes == 0 || ((was ^ is) & when[i].changes) != 0) &&
                           (when[i].sets == 0 || (is & when[i].sets) != 0) &&
                           (when[i].clears == 0 || (~is & when[i].clears) != 0);
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

/* Says what is wrong with the bits of a value, or returns NULL; text has room for LINE / 2 bytes. */
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
    const uint32_t changed = command ? value : cell->value ^ value;
    for (uint32_t i = 0; i < 32 && changed >> i != 0; i++) {
        if ((changed >> i & 1) != 0) {
            cell->changed_at[i] = r->accesses;
            cell->changed_ns[i] = time_ns;
        }
    }
    cell->written_at = r->accesses;
    cell->value = command ? cell->value : value;
}

static bool is_part(const struct register_row *row, uint32_t address, uint32_t bytes)
{
    return !row->narrow && (bytes != 4 || (address & 3) != 0);
}

/* Fills the cells of a block as the program finds them. Returns where the next block's begin. */
static struct cell *start_block(struct cell *cell, const struct register_block *block)
{
    for (uint32_t i = 0; i < block->row_count; i++) {
        for (uint32_t n = count_of(&block->rows[i]); n > 0; n--) {
            *cell++ = (struct cell){.value = block->rows[i].start};
        }
    }
    return cell;
}

/* Whether a block wants one of these bits of the chip's register of resets to be 0. */
static bool is_reset_by(const struct register_chip *chip, const struct register_block *block, uint32_t bits)
{
    for (uint32_t i = 0; i < block->when_count; i++) {
        const struct register_when *when = &block->when[i];
        if (when->need == REGISTER_IS && when->address == chip->resets && (when->mask & bits) != 0) {
            return true;
        }
    }
    return false;
}

/* Blocks that these bits put into reset forget what was written and read. No core has such a block of its own. */
static void reset_blocks(struct registers *r, uint32_t bits)
{
    struct cell *cell = r->cells;
    for (uint32_t b = 0; b < r->chip->block_count; b++) {
        const struct register_block *block = &r->chip->blocks[b];
        if (is_reset_by(r->chip, block, bits)) {
            start_block(cell, block);
        }
        cell += cells_of(block);
    }
}

const char *registers_write(struct registers *r, uint32_t core, uint64_t time_ns, uint32_t address, uint32_t value,
                            uint32_t bytes)
{
    char text[LINE / 2];
    const struct place place = find(r, address);
    r->accesses++;
    if (place.row == NULL) {
        return object(r, &place, address, "=", value, "no such register in the table");
    }
    if (place.row->kind == REGISTER_STATUS) {
        return object(r, &place, address, "=", value, "it is read only");
    }
    if (is_part(place.row, address, bytes)) {
        return object(r, &place, address, "=", value, "it takes whole words only");
    }
    struct cell *cell = cell_of(r, core, &place);
    const bool command = place.row->kind == REGISTER_COMMAND;
    const uint32_t was = command ? 0 : cell->value, is = after(was, place.alias, value);
    const char *why = unmet(r, core, time_ns, place.block->when, place.block->when_count, was, is);
    why = why != NULL ? why : unmet(r, core, time_ns, place.row->when, place.row->when_count, was, is);
    why = why != NULL ? why : bits_are_wrong(place.row, is, text);
    keep(r, cell, time_ns, is, command);
    if (place.block->base + place.row->offset == r->chip->resets) {
        reset_blocks(r, is & ~was);
    }
    return why != NULL ? object(r, &place, address, "=", value, why) : NULL;
}

const char *registers_read(struct registers *r, uint32_t core, uint64_t time_ns, uint32_t address, uint32_t value,
                           uint32_t bytes)
{
    const struct place place = find(r, address);
    r->accesses++;
    if (place.row == NULL) {
        return object(r, &place, address, "reads", value, "no such register in the table");
    }
    if (is_part(place.row, address, bytes)) {
        return object(r, &place, address, "reads", value, "it takes whole words only");
    }
    struct cell *cell = cell_of(r, core, &place);
    const uint32_t when_count = place.row->kind == REGISTER_STATUS ? place.row->when_count : 0;
    const char *why = unmet(r, core, time_ns, place.block->when, place.block->when_count, 0, 0);
    why = why != NULL ? why : unmet(r, core, time_ns, place.row->when, when_count, 0, 0);
    cell->seen = value;
    cell->seen_at = r->accesses;
    return why != NULL ? object(r, &place, address, "reads", value, why) : NULL;
}

uint32_t registers_value(struct registers *r, uint32_t core, uint32_t address)
{
    const struct cell *cell = cell_at(r, core, address);
    return cell != NULL ? cell->value : 0;
}

void registers_restart(struct registers *r)
{
    struct cell *cell = r->cells;
    for (uint32_t core = 0; core < r->cores; core++) {
        for (uint32_t b = 0; b < r->chip->block_count; b++) {
            cell = start_block(cell, &r->chip->blocks[b]);
        }
    }
}

struct registers *registers_new(const struct register_chip *chip, uint32_t cores)
{
    uint32_t cells = 0;
    for (uint32_t b = 0; b < chip->block_count; b++) {
        cells += cells_of(&chip->blocks[b]);
    }
    struct registers *r = calloc(1, sizeof *r + (size_t)cores * cells * sizeof r->cells[0]);
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
