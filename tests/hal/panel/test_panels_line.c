/* panels_line: the tables of the memory LCDs LS013B7DH03 and LS027B7DH01, against their data sheets. */
#include "panel_steps.h"

#include "panel_line.h"

static void sizes_and_clocks_are_those_of_the_data_sheets(void **state)
{
    static const struct {
        const struct panel *panel;
        unsigned width, height, hz, rise_ns; /* fSCLK; tsSCS */
    } sheets[] = {{&panel_ls013b7dh03_128x128, 128, 128, 1100000, 6000},
                  {&panel_ls027b7dh01_400x240, 400, 240, 2000000, 3000}};
    (void)state;
    for (size_t i = 0; i < sizeof sheets / sizeof sheets[0]; i++) {
        const struct panel *const p = sheets[i].panel;
        const struct panel_controller *const c = p->controller;
        assert_true(p->width == sheets[i].width && p->height == sheets[i].height);
        assert_true(p->ram_width == p->width && p->ram_height == p->height && p->x0 == 0 && p->y0 == 0);
        assert_int_equal(c->write_hz, sheets[i].hz);
        assert_true(500000000 / c->init_hz >= sheets[i].rise_ns);
        assert_ptr_equal(c->lines, &panel_line_ops);
        assert_int_equal(p->formats, PANEL_FORMAT_BIT(PANEL_MONO_DITHER) | PANEL_FORMAT_BIT(PANEL_MONO_THRESHOLD));
    }
}

/* No D/C, and so no command, in no sequence. */
static void there_are_no_commands(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < panel_count; i++) {
        const struct panel *const p = panel_list[i];
        if (p->controller->lines != NULL) {
            assert_int_equal(p->init_bytes + p->controller->on_bytes + p->controller->off_bytes, 0);
            assert_int_equal(panel_border_bytes(p->controller) + panel_start_bytes(p->controller), 0);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_and_clocks_are_those_of_the_data_sheets),
        cmocka_unit_test(there_are_no_commands),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
