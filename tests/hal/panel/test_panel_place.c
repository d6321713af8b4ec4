/* panel_place: where glasses lie in the memory of their controllers in each rotation, against what drivers in use send,
 * and what a frame costs, in bits counted here. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panels.h"

#include <string.h>

static void panels_are_found_by_their_whole_name(void **state)
{
    (void)state;
    assert_ptr_equal(panel_find("st7789-135x240"), &panel_st7789_135x240);
    for (uint32_t i = 0; i < panel_count; i++) {
        assert_ptr_equal(panel_find(panel_list[i]->name), panel_list[i]);
    }
    assert_null(panel_find("st7789-135x24"));
    assert_null(panel_find("ST7789-135x240"));
    assert_null(panel_find(""));
}

/* Start columns and rows that other drivers publish, and MADCTL (MY 80h, MX 40h, MV 20h, BGR 08h) or the OLEDs' remap
 * byte, for turns of 90 degrees clockwise on the glass. */
static const struct {
    const struct panel *panel;
    struct {
        unsigned column, row, byte;
    } turned[4];
} published[] = {
    {&panel_st7789_135x240, {{52, 40, 0x00}, {40, 53, 0x60}, {53, 40, 0xc0}, {40, 52, 0xa0}}},
    {&panel_st7789_240x240, {{0, 0, 0x00}, {0, 0, 0x60}, {0, 80, 0xc0}, {80, 0, 0xa0}}},
    {&panel_st7789_240x320, {{0, 0, 0x00}, {0, 0, 0x60}, {0, 0, 0xc0}, {0, 0, 0xa0}}},
    {&panel_st7789_170x320, {{35, 0, 0x00}, {0, 35, 0x60}, {35, 0, 0xc0}, {0, 35, 0xa0}}},
    {&panel_st7789_240x280, {{0, 20, 0x00}, {20, 0, 0x60}, {0, 20, 0xc0}, {20, 0, 0xa0}}},
    {&panel_st7735s_128x128, {{2, 1, 0x08}, {1, 2, 0x68}, {2, 3, 0xc8}, {3, 2, 0xa8}}},
    {&panel_st7735s_80x160, {{26, 1, 0x08}, {1, 26, 0x68}, {26, 1, 0xc8}, {1, 26, 0xa8}}},
    {&panel_ili9341_240x320, {{0, 0, 0x48}, {0, 0, 0x28}, {0, 0, 0x88}, {0, 0, 0xe8}}},
    {&panel_ssd1351_128x128, {{0, 0, 0x74}, {0, 0, 0x77}, {0, 0, 0x66}, {0, 0, 0x65}}},
};

static void places_are_those_that_drivers_in_use_send(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof published / sizeof published[0] * 4; i++) {
        const struct panel_place place = panel_place(published[i / 4].panel, (unsigned)(i % 4));
        assert_int_equal(place.column, published[i / 4].turned[i % 4].column);
        assert_int_equal(place.row, published[i / 4].turned[i % 4].row);
        assert_int_equal(place.rotation_byte, published[i / 4].turned[i % 4].byte);
    }
}

/* A glass of 10x20 with 3 columns and 5 rows before it, 7 and 15 behind it. */
static struct panel_controller made_controller = {.address_bytes = 2,
                                                  .column_pixels = 1,
                                                  .window_turns = true,
                                                  .rotation_bit_mx = 0x02,
                                                  .rotation_bit_my = 0x10,
                                                  .rotation_bit_mv = 0x04,
                                                  .rotation_bit_mx_pair = 0x40};
static struct panel made = {
    .controller = &made_controller, .width = 10, .height = 20, .ram_width = 20, .ram_height = 40, .x0 = 3, .y0 = 5};

static void a_made_glass_is_placed_from_the_side_that_is_mirrored(void **state)
{
    static const struct {
        bool turns;
        unsigned base, rotation, column, row, byte;
    } cases[] = {{true, 0x80, PANEL_R0, 3, 5, 0x80},    {true, 0x80, PANEL_R90, 5, 7, 0xc6},
                 {true, 0x80, PANEL_R180, 7, 15, 0xd2}, {true, 0x80, PANEL_R270, 15, 3, 0x94},
                 {false, 0, PANEL_R90, 7, 5, 0x46},     {false, 0, PANEL_R270, 3, 15, 0x14},
                 {true, 0x02, PANEL_R0, 7, 5, 0x02},    {true, 0x12, PANEL_R180, 3, 5, 0x40}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        made_controller.window_turns = cases[i].turns;
        made.rotation_base = (uint8_t)cases[i].base;
        const struct panel_place place = panel_place(&made, cases[i].rotation);
        assert_true(place.column == cases[i].column && place.row == cases[i].row);
        assert_int_equal(place.rotation_byte, cases[i].byte);
        const bool lies = cases[i].rotation == PANEL_R90 || cases[i].rotation == PANEL_R270;
        assert_int_equal(panel_width(&made, cases[i].rotation), lies ? 20 : 10);
        assert_int_equal(panel_height(&made, cases[i].rotation), lies ? 10 : 20);
    }
}

/* Two borders, the write command, and the pixels. Greys: a byte is two columns of the glass; a glass from an odd column
 * on has one more of them. */
static void a_frame_is_its_window_and_its_pixels(void **state)
{
    static const struct {
        unsigned format, width, x0, address_bytes, memory_write, pixels;
        uint32_t bytes;
    } cases[] = {{PANEL_RGB565, 10, 3, 2, 0x2c, 1, 5 + 5 + 1 + 400},
                 {PANEL_RGB666, 10, 3, 2, 0x2c, 1, 11 + 600},
                 {PANEL_RGB444, 10, 3, 2, 0x2c, 1, 11 + 300},
                 {PANEL_RGB444, 9, 3, 2, 0x2c, 1, 11 + 270},
                 {PANEL_GREY4, 10, 0, 1, 0, 2, 3 + 3 + 5 * 20},
                 {PANEL_GREY4, 9, 0, 1, 0, 2, 6 + 5 * 20},
                 {PANEL_GREY4, 10, 3, 1, 0, 2, 6 + 6 * 20},
                 {PANEL_GREY4, 9, 4, 1, 0, 2, 6 + 5 * 20},
                 {PANEL_GREY4, 9, 1, 1, 0, 2, 6 + 5 * 20}};
    (void)state;
    made.rotation_base = 0;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        made.width = (uint16_t)cases[i].width, made.x0 = (uint16_t)cases[i].x0;
        made_controller.address_bytes = (uint8_t)cases[i].address_bytes;
        made_controller.memory_write = (uint8_t)cases[i].memory_write;
        made_controller.column_pixels = (uint8_t)cases[i].pixels;
        assert_int_equal(panel_frame_bytes(&made, cases[i].format, PANEL_R0), cases[i].bytes);
    }
    made_controller.column_pixels = 1, made_controller.address_bytes = 2, made_controller.memory_write = 0x2c;
    made.width = 3, made.height = 5;
    assert_int_equal(panel_frame_bytes(&made, PANEL_RGB444, PANEL_R90), 11 + 23); /* 180 bits, to a byte */
}

static void time_is_that_of_the_bits_rounded_up(void **state)
{
    (void)state;
    made.width = 10, made.height = 20;
    static const struct {
        uint32_t hz, us;
    } cases[] = {{8 * 411, 1000000}, {8 * 411 - 1, 1000305}, {1000000, 3288}, {1000001, 3288},
                 {999999, 3289},     {4000000000U, 1},       {1, 3288000000U}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(panel_frame_us(&made, PANEL_RGB565, PANEL_R0, cases[i].hz), cases[i].us);
    }
    made.height = 30; /* 4888 bits are longer than 2^32 us at 1 Hz */
    assert_int_equal(panel_frame_us(&made, PANEL_RGB565, PANEL_R0, 1), UINT32_MAX);
    (void)state;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(panels_are_found_by_their_whole_name),
        cmocka_unit_test(places_are_those_that_drivers_in_use_send),
        cmocka_unit_test(a_made_glass_is_placed_from_the_side_that_is_mirrored),
        cmocka_unit_test(a_frame_is_its_window_and_its_pixels),
        cmocka_unit_test(time_is_that_of_the_bits_rounded_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
