/* sim_glass: glasses fit into the memory of their controllers, which the data sheets give, and boards of any size. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "hal.h"
#include "panels.h"
#include "sim.h"
#include "sim_model.h"

#include <string.h>

/* Columns and rows that are bonded: glass, memory, first column and row, flags. Sizes and memory are those of the data
 * sheets; the rest repeats what drivers in use send, and guards it against a slip. */
static const struct {
    const char *panel, *controller;
    unsigned width, height, ram_width, ram_height, left, top;
    const char *flags; /* m mirrored, b bgr, c complement, r round, l backlit, o in order */
} known[] = {
    {"st7789-240x240", "ST7789", 240, 240, 240, 320, 0, 0, "cl"},
    {"st7789-135x240", "ST7789", 135, 240, 240, 320, 52, 40, "cl"},
    {"st7789-240x320", "ST7789", 240, 320, 240, 320, 0, 0, "cl"},
    {"st7789-170x320", "ST7789", 170, 320, 240, 320, 35, 0, "cl"},
    {"st7789-172x320", "ST7789", 172, 320, 240, 320, 34, 0, "cl"},
    {"st7789-240x280", "ST7789", 240, 280, 240, 320, 0, 20, "cl"},
    {"gc9a01-240x240", "GC9A01", 240, 240, 240, 240, 0, 0, "mbcrl"},
    {"ili9341-240x320", "ILI9341", 240, 320, 240, 320, 0, 0, "mbl"},
    {"ili9488-320x480", "ILI9488", 320, 480, 320, 480, 0, 0, "mbl"},
    {"st7796s-320x480", "ST7796S", 320, 480, 320, 480, 0, 0, "mbl"},
    {"hx8357d-320x480", "HX8357D", 320, 480, 320, 480, 0, 0, "mbl"},
    {"ili9486-320x480", "ILI9486", 320, 480, 320, 480, 0, 0, "mbl"},
    {"st7735s-128x128", "ST7735S", 128, 128, 132, 132, 2, 1, "bl"},
    {"st7735s-128x160", "ST7735S", 128, 160, 132, 162, 2, 1, "bl"},
    {"st7735s-80x160", "ST7735S", 80, 160, 132, 162, 26, 1, "bcl"},
    {"ssd1351-128x128", "SSD1351", 128, 128, 128, 128, 0, 0, ""},
    {"ssd0323-128x64", "SSD0323", 128, 64, 128, 80, 0, 0, ""},
    {"ssd1306-128x64", "SSD1306", 128, 64, 128, 64, 0, 0, "m"},
    {"ssd1306-128x32", "SSD1306", 128, 32, 128, 64, 0, 0, "mo"},
    {"ssd1306-72x40", "SSD1306", 72, 40, 128, 64, 28, 0, "m"},
    {"ssd1309-128x64", "SSD1309", 128, 64, 128, 64, 0, 0, "m"},
    {"sh1106-128x64", "SH1106", 128, 64, 132, 64, 2, 0, "m"},
    {"sh1107-64x128", "SH1107", 64, 128, 128, 128, 32, 0, ""},
    {"sh1107-128x128", "SH1107", 128, 128, 128, 128, 0, 0, ""},
    {"ls013b7dh03-128x128", "LS013B7DH03", 128, 128, 128, 128, 0, 0, "l"},
    {"ls027b7dh01-400x240", "LS027B7DH01", 400, 240, 400, 240, 0, 0, "l"},
};

static void a_glass_is_found_by_its_panel(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const struct panel panel = {.name = known[i].panel, .width = 1, .height = 1}; /* geometry is not believed */
        struct sim_glass made = {.width = 4711};
        const struct sim_glass *const g = sim_glass_find(&panel, &made);
        assert_non_null(g);
        assert_string_equal(g->panel, known[i].panel);
        assert_non_null(strstr(g->model->controller, known[i].controller));
        assert_true(g->width == known[i].width && g->height == known[i].height);
        assert_true(g->ram_width == known[i].ram_width && g->ram_height == known[i].ram_height);
        assert_true(g->left == known[i].left && g->top == known[i].top);
        assert_true(g->left + g->width <= g->ram_width && g->top + g->height <= g->ram_height);
        const char *const f = known[i].flags;
        assert_true(g->mirrored == (strchr(f, 'm') != NULL) && g->bgr == (strchr(f, 'b') != NULL));
        assert_true(g->complement == (strchr(f, 'c') != NULL) && g->round == (strchr(f, 'r') != NULL));
        assert_true(g->backlit == (strchr(f, 'l') != NULL) && g->in_order == (strchr(f, 'o') != NULL));
        assert_int_equal(made.width, 4711);
    }
}

static void a_panel_that_nobody_sells_has_no_glass(void **state)
{
    (void)state;
    struct sim_glass made = {.width = 4711};
    static const char *const names[] = {"", "st7789", "st7789-240x241", "virtual2", "ST7789-240x240"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const struct panel panel = {.name = names[i], .width = 240, .height = 240};
        assert_null(sim_glass_find(&panel, &made));
    }
    assert_int_equal(made.width, 4711);
}

static void expect_virtual(uint16_t width, uint16_t height, unsigned band)
{
    struct sim_virtual v;
    struct sim_glass made = {0};
    assert_int_equal(sim_virtual(&v, width, height), 0);
    assert_ptr_equal(v.board.panel, &v.panel);
    assert_ptr_equal(v.board.title, v.title);
    assert_true(v.panel.width == width && v.panel.height == height);
    assert_true(v.panel.ram_width == width && v.panel.ram_height == height);
    assert_int_equal(v.board.band_height, band);
    assert_int_equal(v.board.spi_hz, 62500000);
    assert_int_equal(v.board.format, PANEL_RGB565);
    assert_true(v.board.scene_bytes == UINT32_MAX);
    const struct board_pin reset = BOARD_PIN(0), light = BOARD_PIN(1);
    assert_true(v.board.pins.reset.number == reset.number && v.board.pins.backlight.number == light.number);
    const struct sim_glass *const g = sim_glass_find(&v.panel, &made);
    assert_ptr_equal(g, &made);
    assert_ptr_equal(g->model, &sim_model_st7789);
    assert_true(g->width == width && g->height == height && g->ram_width == width && g->ram_height == height);
    assert_true(g->left == 0 && g->top == 0 && !g->mirrored && !g->bgr && g->complement && !g->round && g->backlit);
}

static void a_virtual_board_has_any_size_to_1024(void **state)
{
    (void)state;
    expect_virtual(1, 1, 1);
    expect_virtual(1024, 15, 15);
    expect_virtual(15, 16, 16);
    expect_virtual(640, 1024, 16);
    struct sim_virtual v;
    assert_int_equal(sim_virtual(&v, 320, 200), 0);
    assert_string_equal(v.title, "no kit: a glass of 320x200");
    assert_int_equal(sim_virtual(&v, 0, 1), HAL_EINVAL);
    assert_int_equal(sim_virtual(&v, 1, 0), HAL_EINVAL);
    assert_int_equal(sim_virtual(&v, 1025, 1), HAL_EINVAL);
    assert_int_equal(sim_virtual(&v, 1, 1025), HAL_EINVAL);
    assert_string_equal(v.title, "no kit: a glass of 320x200");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_glass_is_found_by_its_panel),
        cmocka_unit_test(a_panel_that_nobody_sells_has_no_glass),
        cmocka_unit_test(a_virtual_board_has_any_size_to_1024),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
