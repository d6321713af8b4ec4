/* panels_page: what the tables of SSD1306, SSD1309, SH1106 and SH1107 send, against their datasheets. */
#include "panel_steps.h"

static const struct glass {
    const struct panel *panel;
    unsigned width, height, columns, left, pins, cycle_ns, reset_ns;
} glasses[] = {
    {&panel_ssd1306_128x64, 128, 64, 128, 0, 0x12, 100, 3000},
    {&panel_ssd1306_128x32, 128, 32, 128, 0, 0x02, 100, 3000},
    {&panel_ssd1306_72x40, 72, 40, 128, 28, 0x12, 100, 3000},
    {&panel_ssd1309_128x64, 128, 64, 128, 0, 0x12, 100, 3000},
    {&panel_sh1106_128x64, 128, 64, 132, 2, 0x12, 250, 10000},
};

static void each_is_upright_with_columns_and_lines_from_the_last_one(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof glasses / sizeof glasses[0]; i++) {
        const struct panel *const p = glasses[i].panel;
        const struct panel_controller *const c = p->controller;
        const struct panel_place place = panel_place(p, PANEL_R0), turned = panel_place(p, PANEL_R180);
        assert_int_equal(c->set_rotation | (place.rotation_byte & c->rotation_bit_mx), 0xA1);
        assert_int_equal(c->set_scan | (place.rotation_byte & c->rotation_bit_my), 0xC8);
        assert_int_equal(turned.rotation_byte, 0);
        assert_true(place.column == glasses[i].left && place.row == 0 && turned.column == glasses[i].left);
        assert_true(p->width == glasses[i].width && p->height == glasses[i].height);
        assert_int_equal(p->ram_width, glasses[i].columns);
        assert_true(c->set_page == 0xB0 && c->parameters_are_commands && !c->window_turns);
    }
}

/* Columns of an SH1107 are COM lines, so C0h and C8h mirror columns and A0h and A1h rows; x0 is the same in both
 * directions. */
static void an_sh1107_lies_across(void **state)
{
    static const struct {
        const struct panel *panel;
        unsigned width, left;
    } across[] = {{&panel_sh1107_64x128, 64, 32}, {&panel_sh1107_128x128, 128, 0}};
    static const uint8_t mirrors[4][2] = {{0xC0, 0xA0}, {0xC8, 0xA0}, {0xC8, 0xA1}, {0xC0, 0xA1}};
    (void)state;
    for (size_t i = 0; i < sizeof across / sizeof across[0]; i++) {
        const struct panel *const p = across[i].panel;
        const struct panel_controller *const c = p->controller;
        assert_true(p->width == across[i].width && p->height == 128 && p->ram_width == 128 && p->ram_height == 128);
        assert_true(c->set_page == 0xB0 && c->parameters_are_commands && !c->window_turns);
        for (unsigned rotation = 0; rotation < 4; rotation++) {
            const struct panel_place place = panel_place(p, rotation);
            assert_int_equal(c->set_rotation | (place.rotation_byte & c->rotation_bit_mx), mirrors[rotation][0]);
            assert_int_equal(c->set_scan | (place.rotation_byte & c->rotation_bit_my), mirrors[rotation][1]);
            assert_true(place.column == across[i].left && place.row == 0);
        }
    }
}

static void an_sh1107_is_set_up_for_all_lines(void **state)
{
    static const struct panel *const panels[] = {&panel_sh1107_64x128, &panel_sh1107_128x128};
    (void)state;
    for (size_t i = 0; i < sizeof panels / sizeof panels[0]; i++) {
        const struct panel *const p = panels[i];
        assert_int_equal(p->controller->write_hz, 1000000000 / 250);
        assert_true(p->controller->init_hz <= 4000000 && p->controller->reset_low_us >= 10);
        panel_step_of(p, 0xAE, 0);
        panel_step_of(p, 0x20, 0); /* addressing by pages: no parameter */
        assert_int_equal(panel_step_of(p, 0xA8, 1)[0], 127);
        assert_int_equal(panel_step_of(p, 0xD3, 1)[0], 0);
        assert_int_equal(panel_step_of(p, 0xDC, 1)[0], 0);    /* start line */
        assert_int_equal(panel_step_of(p, 0xAD, 1)[0], 0x8A); /* no converter inside */
        assert_int_equal(panel_step_of(p, 0xD5, 1)[0], 0x50);
        assert_int_equal(panel_step_of(p, 0xD9, 1)[0], 0x22);
        assert_int_equal(panel_step_of(p, 0xDB, 1)[0], 0x35);
        assert_int_equal(panel_step_of(p, 0x81, 1)[0], 0x6F);
        panel_step_of(p, 0xA4, 0);
        panel_step_of(p, 0xA6, 0);
        for (uint16_t at = 0; at < p->init_bytes; at = (uint16_t)(at + 2 + p->init[at + 1])) {
            assert_true(p->init[at] != 0xDA && (p->init[at] < 0x40 || p->init[at] >= 0x80)); /* it has none of these */
        }
    }
}

static void each_is_set_up_for_its_lines(void **state)
{
    static const uint8_t on[] = {0xAF, 0}, off[] = {0xAE, 0};
    (void)state;
    for (size_t i = 0; i < sizeof glasses / sizeof glasses[0]; i++) {
        const struct panel *const p = glasses[i].panel;
        const struct panel_controller *const c = p->controller;
        assert_true(c->on_bytes == 2 && c->off_bytes == 2);
        assert_memory_equal(c->on, on, 2);
        assert_memory_equal(c->off, off, 2);
        assert_int_equal(c->write_hz, 1000000000 / glasses[i].cycle_ns);
        assert_true(c->init_hz <= c->write_hz && 1000 * c->reset_low_us >= glasses[i].reset_ns);
        panel_step_of(p, 0xAE, 0); /* asleep while it is set up */
        assert_int_equal(panel_step_of(p, 0xA8, 1)[0] + 1U, glasses[i].height);
        assert_int_equal(panel_step_of(p, 0xDA, 1)[0], glasses[i].pins);
        assert_int_equal(panel_step_of(p, 0xD3, 1)[0], 0);
        panel_step_of(p, 0x40, 0);
        panel_step_of(p, 0xA4, 0);
        panel_step_of(p, 0xA6, 0);
        assert_true(panel_step_of(p, 0x81, 1)[0] >= 0x40);
        assert_int_equal(panel_step_of(p, 0xD5, 1)[0], 0x80);
    }
}

static void each_gets_its_supply_and_pages(void **state)
{
    (void)state;
    for (size_t i = 0; i < 4; i++) {
        assert_int_equal(panel_step_of(glasses[i].panel, 0x20, 1)[0] & 3, 2); /* addressing by pages */
    }
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(panel_step_of(glasses[i].panel, 0x8D, 1)[0], 0x10 | 0x04); /* charge pump on */
        assert_int_equal(panel_step_of(glasses[i].panel, 0xDB, 1)[0] >> 4, 2);      /* 0.77 VCC */
        assert_int_equal(panel_step_of(glasses[i].panel, 0xD9, 1)[0], 0xF1);
    }
    assert_int_equal(panel_step_of(&panel_ssd1306_72x40, 0xAD, 1)[0], 0x30);
    const uint8_t *const bytes = panel_ssd1309_128x64.init;
    assert_true(bytes[0] == 0xFD && bytes[1] == 1 && bytes[2] == 0x12);          /* before all else */
    assert_int_equal(panel_step_of(&panel_ssd1309_128x64, 0xDB, 1)[0] >> 2, 13); /* 1101b: 0.78 VCC */
    assert_int_equal(panel_step_of(&panel_sh1106_128x64, 0xAD, 1)[0], 0x8A | 1);
    panel_step_of(&panel_sh1106_128x64, 0x32, 0);
    assert_true(panel_step_of(&panel_sh1106_128x64, 0xD9, 1)[0] == 0x1F &&
                panel_step_of(&panel_sh1106_128x64, 0xDB, 1)[0] == 0x40);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_is_upright_with_columns_and_lines_from_the_last_one),
        cmocka_unit_test(an_sh1107_lies_across),
        cmocka_unit_test(an_sh1107_is_set_up_for_all_lines),
        cmocka_unit_test(each_is_set_up_for_its_lines),
        cmocka_unit_test(each_gets_its_supply_and_pages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
