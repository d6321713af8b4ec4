/* dbi_table: the tables of the MIPI DBI controllers against the codes of the MIPI display command set, the waits of the
 * data sheets, and what the panels send. (What each field does to the picture: test_sim_table.) */
#include "sim_table_checks.h"

#include <string.h>

static const struct sim_table *const own[] = {&sim_table_st7789,  &sim_table_gc9a01, &sim_table_ili9341,
                                              &sim_table_ili9488, &sim_table_st7796, &sim_table_hx8357d,
                                              &sim_table_ili9486, &sim_table_st7735s};
enum { OWN = sizeof own / sizeof own[0] };
static const char *const names[OWN] = {"ST7789",  "GC9A01",  "ILI9341", "ILI9488",
                                       "ST7796S", "HX8357D", "ILI9486", "ST7735S"};

static void tables_have_each_command_once(void **state)
{
    (void)state;
    sim_table_check(&sim_table_dbi);
    for (int i = 0; i < OWN; i++) {
        sim_table_check(own[i]);
        for (size_t k = 0; k < own[i]->count; k++) {
            assert_null(sim_table_find(&sim_table_dbi, own[i]->commands[k].code));
        }
    }
}

/* MIPI DCS 1.3: codes and numbers of parameters; the memory write takes pixels. */
static void commands_of_mipi_have_their_codes(void **state)
{
    static const struct {
        uint8_t code, parameters;
        const char *name;
    } mipi[] = {{0x00, 0, "NOP"},    {0x01, 0, "SWRESET"}, {0x10, 0, "SLPIN"}, {0x11, 0, "SLPOUT"},
                {0x13, 0, "NORON"},  {0x20, 0, "INVOFF"},  {0x21, 0, "INVON"}, {0x28, 0, "DISPOFF"},
                {0x29, 0, "DISPON"}, {0x2A, 4, "CASET"},   {0x2B, 4, "RASET"}, {0x2C, SIM_PIXELS, "RAMWR"},
                {0x34, 0, "TEOFF"},  {0x35, 1, "TEON"}};
    (void)state;
    assert_int_equal(sim_table_dbi.count, sizeof mipi / sizeof mipi[0]);
    for (size_t i = 0; i < sizeof mipi / sizeof mipi[0]; i++) {
        const struct sim_command *const c = sim_table_find(&sim_table_dbi, mipi[i].code);
        assert_non_null(c);
        assert_string_equal(c->name, mipi[i].name);
        assert_true(c->least == mipi[i].parameters && c->most == mipi[i].parameters && !c->needs_unlock);
    }
    for (int i = 0; i < OWN; i++) { /* MADCTL: ML and MH turn no picture, and the lowest bits are 0; COLMOD */
        const struct sim_command *const madctl = sim_table_find(own[i], 0x36), *const colmod =
                                                                                   sim_table_find(own[i], 0x3A);
        uint8_t shown = 0;
        for (uint32_t k = 0; k < madctl->field_count; k++) {
            shown |= madctl->fields[k].effect == SIM_SHOWN ? madctl->fields[k].bits : 0;
        }
        assert_int_equal(shown, 0xE8);
        assert_true(madctl->most == 1 && colmod->most == 1);
    }
    assert_int_equal(sim_table_find(&sim_table_st7789, 0xB0)->most, 2); /* RAMCTRL */
}

static void what_the_panels_send_is_taken(void **state)
{
    (void)state;
    for (uint32_t p = 0; p < panel_count; p++) {
        for (int i = 0; i < OWN; i++) {
            const struct panel *const panel = panel_list[p];
            if (strcmp(panel->controller->name, names[i]) == 0) {
                sim_table_check_sequence(own[i], &sim_table_dbi, panel->init, panel->init_bytes);
                sim_table_check_sequence(own[i], &sim_table_dbi, panel->controller->on, panel->controller->on_bytes);
                sim_table_check_sequence(own[i], &sim_table_dbi, panel->controller->off, panel->controller->off_bytes);
            }
        }
    }
}

/* 5 ms to the next command and 120 ms to the next of sleep; ST7735S 10.1.2, 10.1.11: 120 ms after each. */
static void waits_are_those_of_the_data_sheets(void **state)
{
    (void)state;
    for (int i = 0; i < OWN; i++) {
        assert_int_equal(own[i]->sleep_wait_ms, 120);
        assert_int_equal(own[i]->command_wait_ms, own[i] == &sim_table_st7735s ? 120 : 5);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_have_each_command_once),
        cmocka_unit_test(commands_of_mipi_have_their_codes),
        cmocka_unit_test(what_the_panels_send_is_taken),
        cmocka_unit_test(waits_are_those_of_the_data_sheets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
