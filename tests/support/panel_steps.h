/* panel_steps: the commands of a sequence of bytes (panel.h), for the tests of the panels' tables. */
#ifndef PANEL_STEPS_H
#define PANEL_STEPS_H

#include "panels.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#define DELAY 0x00

struct panel_step {
    uint8_t code, count;
    const uint8_t *parameters;
};

/* Takes the next command of a sequence and returns whether there is one; fails if the sequence ends within it. */
static inline bool panel_step_next(const uint8_t *bytes, uint16_t n, uint16_t *at, struct panel_step *step)
{
    if (*at == n) {
        return false;
    }
    assert_true(*at + 2 <= n && *at + 2 + bytes[*at + 1] <= n);
    *step = (struct panel_step){bytes[*at], bytes[*at + 1], bytes + *at + 2};
    *at = (uint16_t)(*at + 2 + step->count);
    return true;
}

/* The parameters of the only command with this code in a panel's initialisation; fails unless it has so many. */
static inline const uint8_t *panel_step_of(const struct panel *panel, uint8_t code, uint8_t count)
{
    const uint8_t *found = NULL;
    struct panel_step step;
    for (uint16_t at = 0; panel_step_next(panel->init, panel->init_bytes, &at, &step);) {
        if (step.code == code) {
            assert_null(found);
            assert_int_equal(step.count, count);
            found = step.parameters;
        }
    }
    assert_non_null(found);
    return found;
}

#endif
