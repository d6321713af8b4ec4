/* panels_dbi: what the tables of MIPI DBI controllers send, against the datasheets: commands and bits, the times that
 * they demand, and voltages and rates computed by their formulas. (Which bits a command has is the model's:
 * test_sim_table.) */
#include "panel_steps.h"

#include <math.h>
#include <string.h>

static bool is_dbi(const struct panel *p)
{
    return strncmp(p->name, "ssd", 3) != 0 && strncmp(p->name, "sh", 2) != 0 && strncmp(p->name, "ls0", 3) != 0;
}

/* The serial write cycles of the data sheets, in ns, and COLMOD for 16, 18 and 12 bits a pixel; 0: it has no such
 * format. */
static const struct {
    const struct panel *panel;
    unsigned cycle_ns;
    uint8_t colmod[3];
} sheets[] = {
    {&panel_st7789_240x240, 16, {0x55, 0x66, 0x53}},  {&panel_gc9a01_240x240, 10, {0x55, 0x66, 0x53}},
    {&panel_ili9341_240x320, 100, {0x55, 0x66, 0}},   {&panel_ili9488_320x480, 50, {0, 0x66, 0}},
    {&panel_st7796s_320x480, 66, {0x55, 0x66, 0}},    {&panel_hx8357d_320x480, 66, {0x55, 0x66, 0}},
    {&panel_st7735s_128x128, 66, {0x05, 0x06, 0x03}},
};

static void controllers_are_those_of_the_data_sheets(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof sheets / sizeof sheets[0]; i++) {
        const struct panel_controller *const c = sheets[i].panel->controller;
        assert_int_equal(c->write_hz, 1000000000 / sheets[i].cycle_ns);
        assert_true(c->init_hz <= c->write_hz);
        assert_true(c->reset_low_us >= 10 && c->reset_high_us >= 120000);
        assert_true(c->set_column == 0x2A && c->set_row == 0x2B && c->memory_write == 0x2C && c->set_format == 0x3A);
        assert_true(c->set_rotation == 0x36 && c->rotation_bit_my == 0x80 && c->rotation_bit_mx == 0x40);
        assert_true(c->rotation_bit_mv == 0x20 && c->rotation_bit_mx_pair == 0 && c->window_turns);
        assert_true(c->address_bytes == 2 && c->column_pixels == 1 && !c->parameters_are_commands);
        for (unsigned format = 0; format < 3; format++) {
            const bool has = (sheets[i].panel->formats & PANEL_FORMAT_BIT(format)) != 0;
            assert_int_equal(has, sheets[i].colmod[format] != 0);
            assert_int_equal(c->format_value[format], sheets[i].colmod[format]);
        }
        assert_int_equal(sheets[i].panel->formats & PANEL_FORMAT_BIT(PANEL_GREY4), 0);
    }
}

/* SWRESET and SLPOUT want 120 ms behind them (ST7735S: SWRESET, too), and nothing else comes before. DISPON comes
 * later. */
static void waking_takes_the_time_that_it_must(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < panel_count; i++) {
        const struct panel *const p = panel_list[i];
        struct panel_step step = {0};
        uint16_t at = 0;
        if (!is_dbi(p)) {
            continue;
        }
        for (unsigned k = 0; k < 2; k++) {
            assert_true(panel_step_next(p->init, p->init_bytes, &at, &step));
            assert_true(step.code == (k == 0 ? 0x01 : 0x11) && step.count == 0);
            assert_true(panel_step_next(p->init, p->init_bytes, &at, &step));
            assert_true(step.code == DELAY && step.count == 1 && step.parameters[0] >= 120);
        }
        while (panel_step_next(p->init, p->init_bytes, &at, &step)) {
            assert_true(step.code != 0x29 && step.code != 0x28 && step.code != 0x36 && step.code != 0x3A);
        }
    }
}

static void the_display_goes_on_and_off_by_the_same_commands(void **state)
{
    static const uint8_t on[] = {0x29, 0}, off[] = {0x28, 0, 0x10, 0, DELAY, 1, 5};
    (void)state;
    for (uint32_t i = 0; i < panel_count; i++) {
        const struct panel_controller *const c = panel_list[i]->controller;
        if (is_dbi(panel_list[i])) {
            assert_true(c->on_bytes == sizeof on && c->off_bytes == sizeof off);
            assert_memory_equal(c->on, on, sizeof on);
            assert_memory_equal(c->off, off, sizeof off);
        }
    }
}

/* IPS glasses show the complement of the memory, and are inverted: 21h, else 20h, as the last of the two. */
static void ips_glass_is_inverted(void **state)
{
    static const struct panel *const tn[] = {&panel_ili9341_240x320, &panel_ili9488_320x480, &panel_st7796s_320x480,
                                             &panel_hx8357d_320x480, &panel_ili9486_320x480, &panel_st7735s_128x128,
                                             &panel_st7735s_128x160};
    (void)state;
    for (uint32_t i = 0; i < panel_count; i++) {
        bool is_tn = false;
        for (size_t k = 0; k < sizeof tn / sizeof tn[0]; k++) {
            is_tn |= tn[k] == panel_list[i];
        }
        if (is_dbi(panel_list[i])) {
            panel_step_of(panel_list[i], is_tn ? 0x20 : 0x21, 0);
        }
    }
}

static void near_to(double value, double expected)
{
    assert_true(fabs(value - expected) < 1e-6);
}

/* ST7789V 9.2: frame rate = 10 MHz / (250 + 16 RTNA) / (320 + porches); AVDD, AVCL and VDS by two bits each. */
static void st7789_has_its_voltages_and_rate(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < panel_count; i++) {
        const struct panel *const p = panel_list[i];
        if (p->controller != &panel_st7789) {
            continue;
        }
        const uint8_t *const ram = panel_step_of(p, 0xB0, 2), *const porch = panel_step_of(p, 0xB2, 5),
                             *const power = panel_step_of(p, 0xD0, 2);
        assert_true(ram[0] == 0 && (ram[1] & 0x30) == 0x20 && (ram[1] & 0x08) == 0); /* EPF 10, high byte first */
        const double rate = 10e6 / (250 + 16 * (panel_step_of(p, 0xC6, 1)[0] & 31)) / (320 + porch[0] + porch[1]);
        assert_true(rate > 57 && rate < 63);
        assert_int_equal(porch[2], 0); /* no separate porches */
        assert_int_equal(power[0], 0xA4);
        near_to(6.4 + .2 * (power[1] >> 6), 6.8);
        near_to(-4.4 - .2 * (power[1] >> 4 & 3), -4.8);
        near_to(2.19 + .11 * (power[1] & 3), 2.3);
        assert_true(panel_step_of(p, 0xC2, 2)[0] == 1 && panel_step_of(p, 0xC2, 2)[1] == 0xFF);
        near_to((panel_step_of(p, 0xC4, 1)[0] - 0x20) * .025, 0); /* VDV */
        const double vcom = .1 + .025 * panel_step_of(p, 0xBB, 1)[0], vrh = 3.55 + .05 * panel_step_of(p, 0xC3, 1)[0];
        assert_true(vcom > .8 && vcom < 1.7 && vrh >= 3.55 && vrh < 4.6);
        assert_int_equal(panel_step_of(p, 0xC0, 1)[0], 0x2C);
        panel_step_of(p, 0x13, 0);
        panel_step_of(p, 0xE0, 14);
        panel_step_of(p, 0xE1, 14);
    }
}

/* ILI9341 8.3: VCOMH = 2.7 + 25 mV n, VCOML = -2.5 + 25 mV n, GVDD = 3 + 50 mV (n - 3), and lines (NL + 1) 8. */
static void ili9341_has_its_voltages_and_lines(void **state)
{
    const struct panel *const p = &panel_ili9341_240x320;
    (void)state;
    near_to(2.7 + .025 * panel_step_of(p, 0xC5, 2)[0], 4.25);
    near_to(-2.5 + .025 * panel_step_of(p, 0xC5, 2)[1], -1.5);
    near_to(3 + .05 * (panel_step_of(p, 0xC0, 1)[0] - 3), 4.6);
    assert_int_equal((panel_step_of(p, 0xB6, 3)[2] + 1) * 8, p->height);
    assert_int_equal(panel_step_of(p, 0xB6, 3)[1] & 0x60, 0);             /* GS and SS */
    const double rate = 615e3 / panel_step_of(p, 0xB1, 2)[1] / (320 + 4); /* fosc over clocks a line and lines */
    assert_true(rate > 78 && rate < 80);
    assert_int_equal(panel_step_of(p, 0xB1, 2)[0], 0);
    assert_int_equal(panel_step_of(p, 0xF2, 1)[0], 2);
    assert_int_equal(panel_step_of(p, 0x26, 1)[0], 1);
    panel_step_of(p, 0xE0, 15);
    panel_step_of(p, 0xE1, 15);
}

static void ili9488_has_its_lines(void **state)
{
    const struct panel *const p = &panel_ili9488_320x480;
    (void)state;
    assert_int_equal((panel_step_of(p, 0xB6, 3)[2] + 1) * 8, p->height);
    assert_int_equal(panel_step_of(p, 0xB6, 3)[1] & 0x60, 0);
    assert_int_equal(panel_step_of(p, 0xE9, 1)[0], 0);
    assert_int_equal(panel_step_of(p, 0xB0, 1)[0], 0);
    panel_step_of(p, 0xE0, 15);
    panel_step_of(p, 0xE1, 15);
}

/* ST7796S 9.3: F0h C3h and 96h open the other registers, so that they come first; VCOM = .3 + 25 mV n; GVDD over it
 * 3.55 + 50 mV n. */
static void st7796_is_unlocked_first_and_has_its_voltages(void **state)
{
    static const uint8_t keys[] = {0xC3, 0x96};
    const struct panel *const p = &panel_st7796s_320x480;
    struct panel_step step = {0};
    uint16_t at = 10; /* behind waking */
    (void)state;
    for (unsigned i = 0; i < 2; i++) {
        assert_true(panel_step_next(p->init, p->init_bytes, &at, &step) && step.code == 0xF0 && step.count == 1);
        assert_int_equal(step.parameters[0], keys[i]);
    }
    assert_int_equal((panel_step_of(p, 0xB6, 3)[2] + 1) * 8, p->height);
    assert_int_equal(panel_step_of(p, 0xB6, 3)[1] & 0x60, 0); /* GS and SS */
    assert_int_equal(panel_step_of(p, 0xB7, 1)[0] >> 6, 2);   /* EPF */
    near_to(3.55 + .05 * panel_step_of(p, 0xC1, 1)[0], 3.85);
    near_to(.3 + .025 * panel_step_of(p, 0xC5, 1)[0], .9);
    panel_step_of(p, 0xE0, 14);
    panel_step_of(p, 0xE1, 14);
}

/* B9h with FFh 83h 57h opens the other registers of an HX8357D. */
static void hx8357d_is_unlocked_first(void **state)
{
    static const uint8_t key[] = {0xFF, 0x83, 0x57};
    const struct panel *const p = &panel_hx8357d_320x480;
    struct panel_step step = {0};
    uint16_t at = 10; /* behind waking */
    (void)state;
    assert_true(panel_step_next(p->init, p->init_bytes, &at, &step) && step.code == 0xB9 && step.count == 3);
    assert_memory_equal(step.parameters, key, 3);
    assert_int_equal(panel_step_of(p, 0xCC, 1)[0], 0x05);
    assert_memory_equal(panel_step_of(p, 0xE0, 34), panel_step_of(p, 0xE0, 34) + 16, 16); /* both polarities alike */
}

/* 16 bits a word: a byte 0 before each of a command and its parameters, and pixels that are one word. */
static void ili9486_behind_a_shift_register_takes_words(void **state)
{
    const struct panel *const p = &panel_ili9486_320x480;
    (void)state;
    for (uint32_t i = 0; i < panel_count; i++) {
        assert_int_equal(panel_list[i]->controller->words, panel_list[i] == p);
    }
    assert_int_equal(p->formats, PANEL_FORMAT_BIT(PANEL_RGB565));
    assert_int_equal(p->controller->format_value[PANEL_RGB565], 0x55);
    assert_int_equal(panel_frame_bytes(p, PANEL_RGB565, 0), 2 * 320 * 480 + 2 * (5 + 5 + 1));
}

/* ST7735S 10.2: AVDD = 4.5 + .1 n, GVDD = 4.7 - .05 n, VCOM = -.425 - 25 mV n; the same rate in every mode. */
static void st7735s_has_its_voltages(void **state)
{
    static const struct panel *const panels[] = {&panel_st7735s_128x128, &panel_st7735s_128x160, &panel_st7735s_80x160};
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        const struct panel *const p = panels[i];
        const uint8_t *const power = panel_step_of(p, 0xC0, 3), *const normal = panel_step_of(p, 0xB1, 3);
        near_to(4.5 + .1 * (power[0] >> 5), 5);
        near_to(4.7 - .05 * (power[0] & 31), 4.6);
        near_to(4.7 - .05 * (power[1] & 31), 4.6); /* GVCL, its negative */
        near_to(-.425 - .025 * panel_step_of(p, 0xC5, 1)[0], -.775);
        assert_memory_equal(panel_step_of(p, 0xB2, 3), normal, 3);
        assert_memory_equal(panel_step_of(p, 0xB3, 6), normal, 3);
        assert_memory_equal(panel_step_of(p, 0xB3, 6) + 3, normal, 3);
        assert_int_equal(panel_step_of(p, 0xB4, 1)[0], 7);
        panel_step_of(p, 0xE0, 16);
        panel_step_of(p, 0xE1, 16);
        panel_step_of(p, 0x13, 0);
    }
}

/* FEh and EFh unlock the other registers, so that they come first. */
static void gc9a01_is_unlocked_first(void **state)
{
    const struct panel *const p = &panel_gc9a01_240x240;
    struct panel_step step = {0};
    uint16_t at = 10; /* behind waking */
    (void)state;
    assert_true(panel_step_next(p->init, p->init_bytes, &at, &step) && step.code == 0xFE && step.count == 0);
    assert_true(panel_step_next(p->init, p->init_bytes, &at, &step) && step.code == 0xEF && step.count == 0);
    assert_int_equal(panel_step_of(p, 0xB6, 2)[1] & 0x60, 0);
    for (uint8_t code = 0xF0; code <= 0xF3; code++) { /* gamma: 1 and 3 are alike, 2 and 4 are */
        assert_memory_equal(panel_step_of(p, code, 6), panel_step_of(p, code ^ 2, 6), 6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(controllers_are_those_of_the_data_sheets),
        cmocka_unit_test(waking_takes_the_time_that_it_must),
        cmocka_unit_test(the_display_goes_on_and_off_by_the_same_commands),
        cmocka_unit_test(ips_glass_is_inverted),
        cmocka_unit_test(st7789_has_its_voltages_and_rate),
        cmocka_unit_test(ili9341_has_its_voltages_and_lines),
        cmocka_unit_test(ili9488_has_its_lines),
        cmocka_unit_test(st7796_is_unlocked_first_and_has_its_voltages),
        cmocka_unit_test(hx8357d_is_unlocked_first),
        cmocka_unit_test(ili9486_behind_a_shift_register_takes_words),
        cmocka_unit_test(st7735s_has_its_voltages),
        cmocka_unit_test(gc9a01_is_unlocked_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
