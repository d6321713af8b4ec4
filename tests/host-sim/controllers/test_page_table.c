/* page_table: the tables of SSD1306, SSD1309, SH1106 and SH1107 against their data sheets, and what the panels send. */
#include "sim_table_checks.h"

/* Commands that a number's bits belong to stand by the first of them. */
static const uint8_t bare[] = {0x00, 0x10, 0xA0, 0xA1, 0xA4, 0xA5, 0xA6, 0xA7, 0xAE, 0xAF, 0xB0, 0xC0, 0xC8, 0xE3};
static const uint8_t with_one[] = {0x81, 0xA8, 0xD3, 0xD5, 0xD9, 0xDB};

static void expect(const struct sim_table *table, const uint8_t *codes, size_t n, unsigned parameters)
{
    for (size_t i = 0; i < n; i++) {
        const struct sim_command *const c = sim_table_find(table, codes[i]);
        assert_non_null(c);
        assert_true(c->least == parameters && c->most == parameters && !c->needs_unlock);
    }
}

static void each_has_the_commands_of_its_data_sheet(void **state)
{
    static const struct {
        const struct sim_table *table;
        const struct panel *panels[3];
        uint8_t more_bare[2], more[4], lacks[3];
    } known[] = {
        {&sim_table_ssd1306,
         {&panel_ssd1306_128x64, &panel_ssd1306_128x32, &panel_ssd1306_72x40},
         {0x40, 0x2E},
         {0x20, 0x8D, 0xAD, 0xDA},
         {0x30, 0xFD, 0xDC}},
        {&sim_table_ssd1309, {&panel_ssd1309_128x64}, {0x40, 0x2E}, {0x20, 0xFD, 0xDA, 0xDA}, {0x8D, 0xAD, 0x30}},
        {&sim_table_sh1106, {&panel_sh1106_128x64}, {0x40, 0x30}, {0xAD, 0xAD, 0xDA, 0xDA}, {0x20, 0x8D, 0x2E}},
        {&sim_table_sh1107,
         {&panel_sh1107_64x128, &panel_sh1107_128x128},
         {0x20, 0x20},
         {0xAD, 0xAD, 0xDC, 0xDC},
         {0x40, 0xDA, 0x30}},
    };
    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const struct sim_table *const table = known[i].table;
        sim_table_check(table);
        expect(table, bare, sizeof bare, 0);
        expect(table, with_one, sizeof with_one, 1);
        expect(table, known[i].more_bare, sizeof known[i].more_bare, 0);
        expect(table, known[i].more, sizeof known[i].more, 1);
        for (size_t k = 0; k < sizeof known[i].lacks; k++) {
            assert_null(sim_table_find(table, known[i].lacks[k]));
        }
        for (size_t k = 0; k < 3 && known[i].panels[k] != NULL; k++) {
            for (uint16_t at = 0, next; at < known[i].panels[k]->init_bytes; at = next) { /* 32h stands by 30h */
                const uint8_t *const step = known[i].panels[k]->init + at;
                next = (uint16_t)(at + 2 + step[1]);
                if (step[0] != 0x32) {
                    sim_table_check_sequence(table, NULL, step, (uint16_t)(2 + step[1]));
                }
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_has_the_commands_of_its_data_sheet)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
