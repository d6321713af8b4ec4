/* panels_ssd: what the tables of SSD1351 and SSD0323 send, against their datasheets. */
#include "panel_steps.h"

static void each_display_goes_on_by_afh_and_sleeps_by_aeh(void **state)
{
    static const struct panel *const panels[] = {&panel_ssd1351_128x128, &panel_ssd0323_128x64};
    static const uint8_t on[] = {0xAF, 0}, off[] = {0xAE, 0};
    (void)state;
    for (int i = 0; i < 2; i++) {
        const struct panel_controller *const c = panels[i]->controller;
        struct panel_step step;
        assert_true(c->on_bytes == 2 && c->off_bytes == 2);
        assert_memory_equal(c->on, on, 2);
        assert_memory_equal(c->off, off, 2);
        panel_step_of(panels[i], 0xAE, 0); /* asleep while it is set up */
        for (uint16_t at = 0; panel_step_next(panels[i]->init, panels[i]->init_bytes, &at, &step);) {
            assert_true(step.code != 0xAF && step.code != 0xA5);
        }
        assert_true(c->set_column == 0x15 && c->set_row == 0x75 && c->set_rotation == 0xA0);
        assert_true(c->address_bytes == 1 && !c->window_turns && c->set_format == 0);
        assert_true(c->reset_low_us >= 3 && c->reset_high_us >= 3 && c->init_hz <= c->write_hz);
    }
}

/* SSD1351, table 13-4: a cycle of 50 ns. 10.1.5: A[0] vertical increment, A[1] columns, A[2] colours C-B-A, A[4] COM
 * from the last, A[5] COM split, A[7:6] 65k colours. */
static void ssd1351_is_set_up_for_128_lines_of_65k_colours(void **state)
{
    const struct panel *const p = &panel_ssd1351_128x128;
    const struct panel_controller *const c = p->controller;
    const uint8_t *bytes = p->init;
    (void)state;
    assert_true(c->write_hz == 1000000000 / 50 && c->memory_write == 0x5C && c->column_pixels == 1);
    assert_true(c->rotation_bit_mv == 1 && c->rotation_bit_mx == 2 && c->rotation_bit_my == 0x10);
    assert_true(c->rotation_bit_mx_pair == 0 && !c->parameters_are_commands);
    assert_int_equal(p->rotation_base, 1 << 6 | 1 << 5 | 1 << 4 | 1 << 2);
    assert_int_equal(p->formats, PANEL_FORMAT_BIT(PANEL_RGB565));
    /* unlocked by 12h, then B1h, before all else */
    assert_true(bytes[0] == 0xFD && bytes[1] == 1 && bytes[2] == 0x12 && bytes[3] == 0xFD && bytes[5] == 0xB1);
    assert_int_equal(panel_step_of(p, 0xCA, 1)[0] + 1, 128);
    assert_true(panel_step_of(p, 0xA1, 1)[0] == 0 && panel_step_of(p, 0xA2, 1)[0] == 0);
    assert_true(panel_step_of(p, 0xB3, 1)[0] >> 4 == 15 && (panel_step_of(p, 0xB3, 1)[0] & 15) == 1);
    assert_int_equal(panel_step_of(p, 0xAB, 1)[0] & 1, 1);
    const uint8_t phases = panel_step_of(p, 0xB1, 1)[0]; /* 2 n + 1 and n clocks */
    assert_true(2 * (phases & 15) + 1 == 5 && phases >> 4 == 3);
    const uint8_t *const vsl = panel_step_of(p, 0xB4, 3);
    assert_true(vsl[0] == 0xA0 && vsl[1] == 0xB5 && vsl[2] == 0x55);
    const double precharge = .2 + panel_step_of(p, 0xBB, 1)[0] * .4 / 31,
                 vcomh = .72 + panel_step_of(p, 0xBE, 1)[0] * .02;
    assert_true(precharge > .49 && precharge < .51 && vcomh > .815 && vcomh < .825);
    assert_true(panel_step_of(p, 0xC7, 1)[0] == 15 && panel_step_of(p, 0xB5, 1)[0] == 0);
    const uint8_t *const contrast = panel_step_of(p, 0xC1, 3);
    assert_true(contrast[0] == contrast[2] && contrast[1] < contrast[0]); /* green is the brightest */
    assert_int_equal(panel_step_of(p, 0xB6, 1)[0], 1);
    panel_step_of(p, 0xA6, 0);
}

/* SSD0323: a cycle of 250 ns; two pixels in a byte. A[0] columns, A[1] nibbles, A[2] vertical increment, A[4] COM from
 * the last, A[6] COM split. */
static void ssd0323_is_set_up_for_64_lines_of_16_greys(void **state)
{
    const struct panel *const p = &panel_ssd0323_128x64;
    const struct panel_controller *const c = p->controller;
    (void)state;
    assert_true(c->write_hz == 1000000000 / 250 && c->memory_write == 0 && c->column_pixels == 2);
    assert_true(c->rotation_bit_mx == 1 && c->rotation_bit_mx_pair == 2 && c->rotation_bit_mv == 4);
    assert_true(c->rotation_bit_my == 0x10 && c->parameters_are_commands);
    assert_int_equal(p->rotation_base, 1 << 6 | 1 << 4 | 1 << 1);
    assert_int_equal(p->formats, PANEL_FORMAT_BIT(PANEL_GREY4));
    assert_int_equal(panel_step_of(p, 0xA8, 1)[0] + 1, 64);
    assert_int_equal(panel_step_of(p, 0xA2, 1)[0], 80 - 4); /* of 80 lines */
    assert_int_equal(panel_step_of(p, 0xA1, 1)[0], 0);
    assert_int_equal(panel_step_of(p, 0xAD, 1)[0], 3); /* 02h turns the converter off */
    assert_true(panel_step_of(p, 0xB3, 1)[0] >> 4 == 15 && (panel_step_of(p, 0xB3, 1)[0] & 15) == 1);
    const uint8_t *const greys = panel_step_of(p, 0xB8, 8);
    int last = 0;
    for (int level = 1; level < 16; level++) { /* pulse widths must not fall; the first has 3 bits of its own */
        const int width = greys[level / 2] >> (level % 2 == 0 ? 0 : 4) & 7;
        assert_true(level == 1 || width >= last);
        last = width;
    }
    assert_int_equal(last, 7);
    panel_step_of(p, 0xA4, 0);
    panel_step_of(p, 0x85, 0);
    assert_int_equal(panel_step_of(p, 0x81, 1)[0], 0x32);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_display_goes_on_by_afh_and_sleeps_by_aeh),
        cmocka_unit_test(ssd1351_is_set_up_for_128_lines_of_65k_colours),
        cmocka_unit_test(ssd0323_is_set_up_for_64_lines_of_16_greys),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
