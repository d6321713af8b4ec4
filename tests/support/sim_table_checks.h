/* sim_table_checks: what must hold of any table of a controller's commands (sim_table.h), and of what a panel sends by
 * it. */
#ifndef SIM_TABLE_CHECKS_H
#define SIM_TABLE_CHECKS_H

#include "panel_steps.h"
#include "sim_table.h"

/* Fails unless each code is there once, and the fields of a command lie in its parameters and cover no bit twice. */
static inline void sim_table_check(const struct sim_table *table)
{
    for (size_t i = 0; i < table->count; i++) {
        const struct sim_command *const c = &table->commands[i];
        uint8_t covered[256] = {0};
        for (size_t k = 0; k < i; k++) {
            assert_int_not_equal(table->commands[k].code, c->code);
        }
        assert_true(c->name[0] != '\0' && c->least <= c->most && (c->exact == NULL || c->field_count == 0));
        assert_int_equal(c->exact == NULL && c->field_count == 0, c->most == 0 || c->most == SIM_PIXELS);
        for (uint32_t k = 0; k < c->field_count; k++) {
            const struct sim_field *const f = &c->fields[k];
            assert_true(f->first >= 1 && f->first <= f->last && f->last <= c->most && f->name[0] != '\0');
            assert_true(f->bits != 0 && f->least <= f->most && (f->least & ~f->bits) == 0 && (f->most & ~f->bits) == 0);
            for (uint32_t n = f->first; n <= f->last; n++) {
                assert_int_equal(covered[n] & f->bits, 0);
                covered[n] |= f->bits;
            }
        }
    }
}

/* Fails unless a panel's sequence has only commands of the tables (`more` may be NULL), with parameters that they take.
 */
static inline void sim_table_check_sequence(const struct sim_table *table, const struct sim_table *more,
                                            const uint8_t *bytes, uint16_t n)
{
    struct panel_step step = {0};
    for (uint16_t at = 0; panel_step_next(bytes, n, &at, &step);) {
        const struct sim_command *c = step.code != DELAY ? sim_table_find(table, step.code) : NULL;
        c = c == NULL && more != NULL && step.code != DELAY ? sim_table_find(more, step.code) : c;
        if (step.code == DELAY) {
            continue;
        }
        assert_non_null(c);
        assert_in_range(step.count, c->least, c->most);
        for (uint32_t k = 0; k < step.count; k++) {
            uint8_t rest = step.parameters[k];
            for (uint32_t i = 0; i < c->field_count; i++) {
                const struct sim_field *const f = &c->fields[i];
                if (k + 1 >= f->first && k + 1 <= f->last) {
                    assert_in_range(step.parameters[k] & f->bits, f->least, f->most);
                    rest &= (uint8_t)~f->bits;
                }
            }
            assert_int_equal(c->exact != NULL ? step.parameters[k] ^ c->exact[k] : rest, 0);
        }
    }
}

#endif
