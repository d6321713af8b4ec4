/* panels: each panel of PANELS_EACH is in the list, with a name of its own, which says its controller and its size. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panels.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

/* A panel that is left out of PANELS_EACH is missed by the board that names it: each has one. */
static void each_panel_is_listed_once(void **state)
{
#define NAMED(name) #name,
    static const char *const names[] = {PANELS_EACH(NAMED)};
    (void)state;
    assert_int_equal(panel_count, sizeof names / sizeof names[0]);
    for (uint32_t i = 0; i < panel_count; i++) {
        uint32_t found = 0;
        char name[40];
        snprintf(name, sizeof name, "%s", names[i]);
        *strchr(name, '_') = '-';
        for (uint32_t k = 0; k < panel_count; k++) {
            found += strcmp(panel_list[k]->name, name) == 0;
        }
        assert_int_equal(found, 1);
    }
}

static void a_name_is_the_controller_and_the_size(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < panel_count; i++) {
        const struct panel *const p = panel_list[i];
        char name[40];
        snprintf(name, sizeof name, "%s-%ux%u", p->controller->name, p->width, p->height);
        for (char *c = name; *c != '\0'; c++) {
            *c = (char)tolower(*c);
        }
        assert_string_equal(p->name, name);
    }
}

static void a_glass_lies_in_its_controllers_memory(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < panel_count; i++) {
        const struct panel *const p = panel_list[i];
        assert_true(p->x0 + p->width <= p->ram_width && p->y0 + p->height <= p->ram_height);
        assert_int_equal(p->round, strncmp(p->name, "gc9a01", 6) == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_panel_is_listed_once),
        cmocka_unit_test(a_name_is_the_controller_and_the_size),
        cmocka_unit_test(a_glass_lies_in_its_controllers_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
