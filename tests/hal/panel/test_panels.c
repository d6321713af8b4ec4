/* panels: each panel of the list has a name of its own, which says its controller and its size. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panels.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static void each_panel_is_listed_once(void **state)
{
    static const char *const names[] = {"st7789-240x240",  "st7789-135x240",  "st7789-240x320",  "st7789-170x320",
                                        "st7789-240x280",  "gc9a01-240x240",  "ili9341-240x320", "ili9488-320x480",
                                        "st7735s-128x128", "st7735s-128x160", "st7735s-80x160",  "ssd1351-128x128",
                                        "ssd0323-128x64"};
    (void)state;
    assert_int_equal(panel_count, sizeof names / sizeof names[0]);
    for (uint32_t i = 0; i < panel_count; i++) {
        uint32_t found = 0;
        for (uint32_t k = 0; k < panel_count; k++) {
            found += strcmp(panel_list[k]->name, names[i]) == 0;
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
