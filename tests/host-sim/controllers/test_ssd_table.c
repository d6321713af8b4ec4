/* ssd_table: the tables of SSD1351 and SSD0323 against the command tables of their data sheets, and what the panels
 * send. */
#include "sim_table_checks.h"

struct known {
    uint8_t code, parameters;
    bool needs_unlock;
};

static void expect_known(const struct sim_table *table, const struct known *known, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const struct sim_command *const c = sim_table_find(table, known[i].code);
        assert_non_null(c);
        assert_true(c->least == known[i].parameters && c->most == known[i].parameters);
        assert_int_equal(c->needs_unlock, known[i].needs_unlock);
    }
}

static void ssd1351_has_the_commands_of_table_9_1(void **state)
{
    static const struct known known[] = {
        {0x15, 2, false}, {0x75, 2, false}, {0x5C, SIM_PIXELS, false}, {0xA0, 1, false}, {0xA1, 1, false},
        {0xA2, 1, true},  {0xA4, 0, false}, {0xA5, 0, false},          {0xA6, 0, false}, {0xA7, 0, false},
        {0xAB, 1, false}, {0xAE, 0, false}, {0xAF, 0, false},          {0xB1, 1, true},  {0xB3, 1, true},
        {0xB4, 3, false}, {0xB5, 1, false}, {0xB6, 1, false},          {0xBB, 1, true},  {0xBE, 1, true},
        {0xC1, 3, true},  {0xC7, 1, false}, {0xCA, 1, false},          {0xFD, 1, false}};
    (void)state;
    sim_table_check(&sim_table_ssd1351);
    expect_known(&sim_table_ssd1351, known, sizeof known / sizeof known[0]);
    sim_table_check_sequence(&sim_table_ssd1351, NULL, panel_ssd1351_128x128.init, panel_ssd1351_128x128.init_bytes);
}

static void ssd0323_has_the_commands_of_its_table(void **state)
{
    static const struct known known[] = {
        {0x15, 2, false}, {0x75, 2, false}, {0x81, 1, false}, {0xA0, 1, false}, {0xA1, 1, false}, {0xA2, 1, false},
        {0xA4, 0, false}, {0xA5, 0, false}, {0xA6, 0, false}, {0xA7, 0, false}, {0xA8, 1, false}, {0xAD, 1, false},
        {0xAE, 0, false}, {0xAF, 0, false}, {0xB1, 1, false}, {0xB2, 1, false}, {0xB3, 1, false}, {0xB8, 8, false},
        {0xBC, 1, false}, {0xBE, 1, false}, {0xBF, 1, false}};
    (void)state;
    sim_table_check(&sim_table_ssd0323);
    expect_known(&sim_table_ssd0323, known, sizeof known / sizeof known[0]);
    assert_null(sim_table_find(&sim_table_ssd0323, 0x5C)); /* pixels come without a command */
    sim_table_check_sequence(&sim_table_ssd0323, NULL, panel_ssd0323_128x64.init, panel_ssd0323_128x64.init_bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ssd1351_has_the_commands_of_table_9_1),
        cmocka_unit_test(ssd0323_has_the_commands_of_its_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
