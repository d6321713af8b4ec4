/*
 * The model of host-sim/emulate/registers on a chip that is made up: each need, field, kind, alias and number of
 * registers is asked for and refused. And the tables of the real chips are whole: no need asks for a register that is
 * not there.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include <string.h>

#include "registers/registers.h"

enum { UNIT = 0x40000000, CONTROL = UNIT, SET_UP = UNIT + 4, STATUS = UNIT + 8, DATA = UNIT + 12, LIST = UNIT + 0x20 };
enum { OTHER = 0x50000000, RESET = 0x60000000, DONE = RESET + 4 };
#define OWN    0xd0000000
#define RESULT (OWN + 4)
enum { TOGGLE = 0x1000, SET = 0x2000, CLEAR = 0x3000 };

static const struct register_field bit0[] = {{"ON", 0, 1, 0, 1, "on"}};
static const struct register_field set_up_fields[] = {
    {"RATE", 0, 4, 2, 5, "slow"},
    {"RATE", 0, 4, 9, 9, "fast"},
    {"MODE", 8, 2, 0, 1, "kinds"},
};
static const struct register_field all[] = {{"ALL", 0, 32, 0, UINT32_MAX, "anything"}};
static const struct register_field byte[] = {{"BYTE", 0, 8, 0, 255, "a byte"}};

static const struct register_when set_up_when[] = {
    {.need = REGISTER_IS, .address = CONTROL, .mask = 1, .value = 0, .why = "it is on"},
};
static const struct register_when control_when[] = {
    {.changes = 1, .sets = 1, .need = REGISTER_AT_LEAST, .address = SET_UP, .mask = 15, .value = 4, .why = "no rate"},
    {.changes = 1,
     .clears = 1,
     .need = REGISTER_SEEN,
     .address = STATUS,
     .mask = 2,
     .value = 2,
     .since = DATA,
     .why = "not empty"},
};
static const struct register_when data_when[] = {
    {.need = REGISTER_SEEN,
     .address = STATUS,
     .mask = 1,
     .value = 1,
     .since = CONTROL,
     .since_mask = 1,
     .why = "no room"},
};
static const struct register_when other_when[] = {
    {.sets = 2, .need = REGISTER_WAITED, .address = OTHER, .mask = 1, .value = 500, .why = "too soon"},
    {.sets = 4, .need = REGISTER_WRITTEN, .address = LIST + 8, .why = "not written"},
    {.sets = 8, .need = REGISTER_WRITTEN, .address = LIST + 8, .since = SET_UP, .why = "not written since"},
    {.changes = 32, .need = REGISTER_WRITTEN, .address = LIST + 16, .why = "not changed"},
    {.sets = 64, .need = REGISTER_IS, .address = DATA, .mask = 255, .value = 0, .why = "kept"},
    {.sets = 16, .need = REGISTER_IS, .address = UNIT + 0x10, .mask = 0, .value = 0, .why = "asks for nothing"},
};
static const struct register_when result_when[] = {
    {.need = REGISTER_SEEN, .address = OWN, .mask = 1, .value = 1, .why = "not ready"},
};
static const struct register_when unit_when[] = {
    {.need = REGISTER_IS, .address = RESET, .mask = 1, .value = 0, .why = "in reset"},
    {.need = REGISTER_SEEN, .address = DONE, .mask = 1, .value = 1, .since = RESET, .since_mask = 1, .why = "not done"},
};

static const struct register_row unit_rows[] = {
    {"CONTROL", 0, .start = 0x30, REGISTER_LIST(bit0), REGISTER_LIST(control_when), "1.1"},
    {"SET_UP", 4, .start = 0, REGISTER_LIST(set_up_fields), REGISTER_LIST(set_up_when), "1.2"},
    {"STATUS", 8, .kind = REGISTER_STATUS, .source = "1.3"},
    {"DATA", 12, .kind = REGISTER_COMMAND, .narrow = true, .start = 0, REGISTER_LIST(byte), REGISTER_LIST(data_when),
     "1.4"},
    {"LIST", 0x20, 3, 8, .start = 0, REGISTER_LIST(all), .source = "1.5"},
};
static const struct register_row other_rows[] = {
    {"BITS", 0, .start = 0, REGISTER_LIST(byte), REGISTER_LIST(other_when), "2"},
};
static const struct register_row own_rows[] = {
    {"OWN", 0, .start = 0, REGISTER_LIST(all), .source = "3"},
    {"RESULT", 4, .kind = REGISTER_STATUS, .when = result_when, .when_count = 1, .source = "3"},
};
static const struct register_row reset_rows[] = {
    {"RESET", 0, .start = 1, REGISTER_LIST(bit0), .source = "4"},
    {"DONE", 4, .kind = REGISTER_STATUS, .source = "4"},
};
static const struct register_block blocks[] = {
    {"UNIT", UNIT, 0x4000, true, false, REGISTER_LIST(unit_rows), REGISTER_LIST(unit_when)},
    {"OTHER", OTHER, 0x100, .per_core = false, REGISTER_LIST(other_rows)},
    {"OWN", OWN, 0x100, .per_core = true, REGISTER_LIST(own_rows)},
    {"RESETS", RESET, 0x100, .per_core = false, REGISTER_LIST(reset_rows)},
};
static const struct register_chip chip = {"CHIP", "its manual", REGISTER_LIST(blocks), RESET};

static struct registers *r;

static void takes(uint32_t address, uint32_t value)
{
    const char *line = registers_write(r, 0, 0, address, value, 4);
    if (line != NULL) {
        fail_msg("%s", line);
    }
}

static void refuses(uint32_t address, uint32_t value, const char *why)
{
    const char *line = registers_write(r, 0, 0, address, value, 4);
    if (line == NULL || strstr(line, why) == NULL) {
        fail_msg("%08x = %x, for '%s': %s", (unsigned)address, (unsigned)value, why, line == NULL ? "taken" : line);
    }
}

static void reads(uint32_t address, uint32_t value)
{
    assert_null(registers_read(r, 0, 0, address, value, 4));
}

static int fresh(void **state)
{
    (void)state;
    r = registers_new(&chip, 2);
    assert_non_null(r);
    takes(RESET, 0);
    reads(DONE, 1);
    return 0;
}

static int end(void **state)
{
    (void)state;
    registers_free(r);
    return 0;
}

static void a_line_names_register_value_rule_and_section(void **state)
{
    (void)state;
    takes(SET_UP, 4);
    takes(CONTROL, 0x31);
    assert_string_equal(registers_write(r, 0, 0, SET_UP, 5, 4),
                        "UNIT SET_UP (40000004) = 00000005: it is on (its manual, 1.2)");
}

static void what_no_table_has_is_refused(void **state)
{
    (void)state;
    refuses(UNIT + 0x10, 0, "UNIT ? (40000010) = 00000000: no such register");
    refuses(0x70000000, 0, "CHIP ? (70000000)");
    refuses(OTHER + 0x100, 0, "CHIP ?");
    assert_non_null(strstr(registers_read(r, 0, 0, UNIT + 0x10, 7, 4), "UNIT ? (40000010) reads 00000007: no such"));
}

static void values_without_a_known_effect_are_refused(void **state)
{
    (void)state;
    takes(SET_UP, 2);
    takes(SET_UP, 5);
    takes(SET_UP, 0x109);
    refuses(SET_UP, 1, "RATE: the effect of 1 is not known, that of 2 to 5 is");
    refuses(SET_UP, 6, "RATE");
    refuses(SET_UP, 8, "RATE");
    refuses(SET_UP, 10, "RATE");
    refuses(SET_UP, 0x202, "MODE: the effect of 2");
}

static void bits_without_a_field_stay_as_they_start(void **state)
{
    (void)state;
    takes(CONTROL, 0x30);
    refuses(CONTROL, 0, "bits 30 are not in the table");
    refuses(CONTROL, 0x70, "bits 40 are not in the table");
    reads(STATUS, 1);
    refuses(DATA, 0x100, "bits 100");
}

static void a_status_is_not_written(void **state)
{
    (void)state;
    refuses(STATUS, 0, "it is read only");
}

static void a_register_takes_whole_words_unless_it_is_narrow(void **state)
{
    (void)state;
    reads(STATUS, 1);
    assert_null(registers_write(r, 0, 0, DATA, 0x55, 1));
    assert_non_null(strstr(registers_write(r, 0, 0, SET_UP, 2, 2), "whole words only"));
    assert_non_null(strstr(registers_write(r, 0, 0, SET_UP + 2, 2, 4), "whole words only"));
    assert_non_null(strstr(registers_read(r, 0, 0, STATUS, 2, 1), "whole words only"));
}

static void registers_alike_are_told_apart(void **state)
{
    (void)state;
    takes(LIST, 1);
    takes(LIST + 16, 1);
    refuses(OTHER, 4, "not written");
    takes(LIST + 8, 1);
    takes(OTHER, 4);
    refuses(LIST + 4, 1, "no such register");
    refuses(LIST + 24, 1, "no such register");
}

static void aliases_toggle_set_and_clear_bits(void **state)
{
    (void)state;
    takes(SET_UP, 4);
    takes(CONTROL + SET, 1);
    refuses(SET_UP, 5, "it is on");
    takes(CONTROL + TOGGLE, 1);
    takes(SET_UP + SET, 1);
    takes(CONTROL + SET, 1);
    takes(CONTROL + CLEAR, 1);
    refuses(SET_UP + SET, 10, "RATE: the effect of f");
    refuses(CONTROL + CLEAR, 0x10, "bits 10");
}

static void a_need_is_asked_only_of_the_bits_that_it_names(void **state)
{
    (void)state;
    takes(CONTROL, 0x30); /* changes nothing */
    refuses(CONTROL, 0x31, "no rate");
    registers_restart(r);
    takes(RESET, 0);
    reads(DONE, 1);
    takes(SET_UP, 4);
    takes(CONTROL, 0x31);
    takes(CONTROL, 0x31);
    takes(OTHER, 1); /* sets none of the bits that ask */
}

static void a_need_is_asked_where_the_bits_change(void **state)
{
    (void)state;
    takes(OTHER, 1);
    refuses(OTHER, 33, "not changed");
    takes(OTHER, 32);
    refuses(OTHER, 0, "not changed");
}

static void a_command_is_not_kept(void **state)
{
    (void)state;
    reads(DATA, 0); /* its needs are those of writes */
    reads(STATUS, 1);
    takes(DATA, 7);
    takes(OTHER, 64);
}

static void at_least_is_a_bound(void **state)
{
    (void)state;
    takes(SET_UP, 3);
    refuses(CONTROL, 0x31, "no rate");
    takes(CONTROL, 0x30);
    takes(SET_UP, 4);
    takes(CONTROL, 0x31);
}

static void a_status_is_seen_after_the_bits_changed(void **state)
{
    (void)state;
    refuses(DATA, 1, "no room"); /* never read */
    reads(STATUS, 2);
    refuses(DATA, 1, "no room"); /* other bits */
    reads(STATUS, 3);
    takes(DATA, 1);
    takes(DATA, 1);
    takes(SET_UP, 4);
    takes(CONTROL, 0x31);
    refuses(DATA, 1, "no room"); /* read before CONTROL changed */
    reads(STATUS, 1);
    takes(CONTROL, 0x31); /* does not change it */
    takes(DATA, 1);
}

static void a_need_since_a_write_asks_nothing_before_the_first(void **state)
{
    (void)state;
    takes(SET_UP, 4);
    takes(CONTROL, 0x31);
    takes(CONTROL, 0x30);
    takes(CONTROL, 0x31);
    reads(STATUS, 3);
    takes(DATA, 0);
    refuses(CONTROL, 0x30, "not empty");
    takes(CONTROL, 0x31);
    reads(STATUS, 1);
    refuses(CONTROL, 0x30, "not empty");
    takes(CONTROL, 0x31);
    reads(STATUS, 2);
    takes(CONTROL, 0x30);
}

static void a_wait_is_as_long_as_it_says(void **state)
{
    (void)state;
    assert_null(registers_write(r, 0, 10, OTHER, 2, 4)); /* bit 0 has never changed */
    assert_null(registers_write(r, 0, 1000, OTHER, 1, 4));
    assert_non_null(registers_write(r, 0, 1499, OTHER, 3, 4));
    assert_null(registers_write(r, 0, 1500, OTHER, 3, 4));
    assert_null(registers_write(r, 0, 1500, OTHER, 3, 4));
    assert_non_null(registers_write(r, 0, 1400, OTHER, 2, 4));
    assert_non_null(registers_write(r, 0, 1899, OTHER, 2, 4));
    assert_null(registers_write(r, 0, 1900, OTHER, 2, 4));
}

static void written_since_counts_from_a_write(void **state)
{
    (void)state;
    takes(OTHER, 8); /* SET_UP was never written */
    takes(SET_UP, 4);
    refuses(OTHER, 8, "not written since");
    takes(LIST + 8, 0);
    takes(OTHER, 8);
    takes(SET_UP, 4);
    refuses(OTHER, 8, "not written since");
}

static void a_need_for_a_register_that_is_not_there_never_holds(void **state)
{
    (void)state;
    refuses(OTHER, 16, "asks for nothing");
}

static void a_status_with_a_need_is_not_read_before(void **state)
{
    (void)state;
    assert_non_null(strstr(registers_read(r, 0, 0, RESULT, 5, 4), "OWN RESULT (d0000004) reads 00000005: not ready"));
    reads(OWN, 1);
    reads(RESULT, 5);
}

static void each_core_has_its_own(void **state)
{
    (void)state;
    reads(OWN, 1);
    reads(RESULT, 5);
    assert_non_null(registers_read(r, 1, 0, RESULT, 5, 4));
    assert_null(registers_read(r, 1, 0, OWN, 1, 4));
    assert_null(registers_read(r, 1, 0, RESULT, 5, 4));
    assert_null(registers_write(r, 1, 0, SET_UP, 4, 4)); /* what is not a core's is for both */
    takes(CONTROL, 0x31);
    assert_non_null(registers_write(r, 1, 0, SET_UP, 4, 4));
}

static void a_block_has_needs_of_all_accesses(void **state)
{
    (void)state;
    takes(RESET, 1);
    refuses(SET_UP, 4, "in reset");
    assert_non_null(strstr(registers_read(r, 0, 0, STATUS, 1, 4), "in reset"));
    takes(RESET, 0);
    refuses(SET_UP, 4, "not done");
    reads(DONE, 0);
    refuses(SET_UP, 4, "not done");
    reads(DONE, 1);
    takes(SET_UP, 4);
    reads(STATUS, 1);
}

static void a_block_that_is_put_into_reset_forgets_all(void **state)
{
    (void)state;
    takes(SET_UP, 4);
    takes(CONTROL, 0x31);
    takes(LIST + 8, 1);
    takes(OTHER, 5);
    refuses(SET_UP, 5, "it is on");
    takes(RESET, 0); /* it is no reset */
    refuses(SET_UP, 5, "it is on");
    takes(RESET, 1);
    takes(RESET, 0);
    reads(DONE, 1);
    refuses(OTHER, 5, "not written");
    refuses(CONTROL, 0x31, "no rate");
    takes(CONTROL, 0x30);
    takes(SET_UP, 5);
}

static void a_reset_leaves_other_blocks(void **state)
{
    (void)state;
    assert_null(registers_write(r, 0, 1000, OTHER, 1, 4));
    takes(RESET, 1);
    assert_non_null(registers_write(r, 0, 1499, OTHER, 3, 4));
}

static void a_restart_forgets_all(void **state)
{
    (void)state;
    takes(LIST + 8, 1);
    reads(OWN, 1);
    registers_restart(r);
    refuses(SET_UP, 4, "in reset");
    refuses(OTHER, 4, "not written");
    assert_non_null(registers_read(r, 0, 0, RESULT, 5, 4));
}

/* More registers than the model remembers the places of, all with other values. */
static void places_that_share_a_memory_are_found_again(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 0x4000; i += 4) {
        (void)registers_read(r, 0, 0, UNIT + i, 0, 4);
        (void)registers_read(r, 0, 0, OTHER + i, 0, 4);
    }
    takes(SET_UP, 4);
    takes(CONTROL + SET, 1);
    refuses(SET_UP, 4, "it is on");
}

/* ---- the tables -------------------------------------------------------------------------------------------------- */

static bool has(const struct register_chip *table, uint32_t address)
{
    struct registers *model = registers_new(table, 1);
    assert_non_null(model);
    const char *line = registers_read(model, 0, 0, address, 0, 4);
    const bool there = line == NULL || strstr(line, "no such register") == NULL;
    registers_free(model);
    return there;
}

static void check_needs(const struct register_chip *table, const char *row, const struct register_when *when,
                        uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        if (!has(table, when[i].address) || (when[i].since != 0 && !has(table, when[i].since)) || when[i].why == NULL ||
            ((when[i].need == REGISTER_IS || when[i].need == REGISTER_SEEN) && (when[i].value & ~when[i].mask) != 0)) {
            fail_msg("%s %s: need %u can never hold: %s", table->name, row, (unsigned)i, when[i].why);
        }
    }
}

static void check_fields(const struct register_chip *table, const struct register_row *row)
{
    for (uint32_t i = 0; i < row->field_count; i++) {
        const struct register_field *f = &row->fields[i];
        const uint32_t most = f->bits == 32 ? UINT32_MAX : (1U << f->bits) - 1;
        if (f->low + f->bits > 32 || f->least > f->most || f->most > most || f->effect == NULL) {
            fail_msg("%s %s %s: no such bits or values", table->name, row->name, f->name);
        }
    }
    if (row->source == NULL || (row->kind == REGISTER_STATUS) != (row->field_count == 0)) {
        fail_msg("%s %s: no source, or no fields", table->name, row->name);
    }
}

static void check_table(const struct register_chip *table)
{
    for (uint32_t b = 0; b < table->block_count; b++) {
        const struct register_block *block = &table->blocks[b];
        check_needs(table, block->name, block->when, block->when_count);
        for (uint32_t i = 0; i < block->row_count; i++) {
            const struct register_row *row = &block->rows[i];
            check_needs(table, row->name, row->when, row->when_count);
            check_fields(table, row);
            if (row->offset >= block->bytes) {
                fail_msg("%s %s: outside of its block", table->name, row->name);
            }
        }
    }
}

static void the_tables_are_whole(void **state)
{
    (void)state;
    check_table(&rp2040_registers);
    check_table(&rp2350_registers);
    check_table(&stm32f4_registers);
    check_table(&lm3s6965_registers);
}

#define FRESH(test) cmocka_unit_test_setup_teardown(test, fresh, end)

int main(void)
{
    const struct CMUnitTest tests[] = {
        FRESH(a_line_names_register_value_rule_and_section),
        FRESH(what_no_table_has_is_refused),
        FRESH(values_without_a_known_effect_are_refused),
        FRESH(bits_without_a_field_stay_as_they_start),
        FRESH(a_status_is_not_written),
        FRESH(a_register_takes_whole_words_unless_it_is_narrow),
        FRESH(registers_alike_are_told_apart),
        FRESH(aliases_toggle_set_and_clear_bits),
        FRESH(a_need_is_asked_only_of_the_bits_that_it_names),
        FRESH(a_need_is_asked_where_the_bits_change),
        FRESH(a_command_is_not_kept),
        FRESH(at_least_is_a_bound),
        FRESH(a_status_is_seen_after_the_bits_changed),
        FRESH(a_need_since_a_write_asks_nothing_before_the_first),
        FRESH(a_wait_is_as_long_as_it_says),
        FRESH(written_since_counts_from_a_write),
        FRESH(a_need_for_a_register_that_is_not_there_never_holds),
        FRESH(a_status_with_a_need_is_not_read_before),
        FRESH(each_core_has_its_own),
        FRESH(a_block_has_needs_of_all_accesses),
        FRESH(a_block_that_is_put_into_reset_forgets_all),
        FRESH(a_reset_leaves_other_blocks),
        FRESH(a_restart_forgets_all),
        FRESH(places_that_share_a_memory_are_found_again),
        cmocka_unit_test(the_tables_are_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
