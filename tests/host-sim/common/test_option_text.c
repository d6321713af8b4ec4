/* option_text: what each reader takes, at its limits, and that *out stays as it was where it takes nothing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "option_text.h"
#include "render.h"

#include <string.h>

static void expect_u32(const char *text, uint32_t min, uint32_t max, int64_t value)
{
    uint32_t out = 4711;
    assert_int_equal(option_text_u32(text, min, max, &out), value >= 0);
    assert_int_equal(out, value >= 0 ? value : 4711);
}

static void a_whole_number_is_digits_within_its_range(void **state)
{
    (void)state;
    expect_u32("0", 0, 9, 0);
    expect_u32("007", 0, 9, 7);
    expect_u32("1", 1, 1, 1);
    expect_u32("5", 6, 9, -1);
    expect_u32("6", 6, 9, 6);
    expect_u32("9", 6, 9, 9);
    expect_u32("10", 6, 9, -1);
    expect_u32("1234567890", 0, UINT32_MAX, 1234567890);
    expect_u32("4294967295", 0, UINT32_MAX, UINT32_MAX);
    expect_u32("4294967296", 0, UINT32_MAX, -1);
    expect_u32("99999999999999999999999999", 0, UINT32_MAX, -1);
    static const char *const none[] = {"", " 1", "1 ", "+1", "-1", "1.0", "0x1", "a", "/", ":"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        expect_u32(none[i], 0, UINT32_MAX, -1);
    }
}

static void expect_size(const char *text, uint16_t max, int width, int height)
{
    uint16_t w = 11, h = 22;
    assert_int_equal(option_text_size(text, max, &w, &h), width > 0);
    assert_int_equal(w, width > 0 ? width : 11);
    assert_int_equal(h, width > 0 ? height : 22);
}

static void a_size_is_two_numbers_from_1(void **state)
{
    (void)state;
    expect_size("320x240", 1000, 320, 240);
    expect_size("1x1", 1, 1, 1);
    expect_size("7x8", 8, 7, 8);
    expect_size("8x7", 7, 0, 0);
    expect_size("7x8", 7, 0, 0);
    expect_size("65535x1", 65535, 65535, 1);
    expect_size("65536x1", 65535, 0, 0);
    static const char *const none[] = {"", "0x1", "1x0", "1", "1x", "x1", "1X1", "1x1x1", "1x1 ", "1,1", "-1x1"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        expect_size(none[i], 1000, 0, 0);
    }
}

static void a_decimal_number_is_q16_16_and_says_where_it_ends(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int32_t value; /* times 2^16 */
        const char *rest;
    } good[] = {{"1", 65536, ""},
                {"-0.5,2", -32768, ",2"},
                {"+3x", 196608, "x"},
                {".25 ", 16384, " "},
                {"-32768", INT32_MIN, ""},
                {"0", 0, ""},
                {"32767.5", 2147450880, ""},
                {"9a", 589824, "a"}};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        fx_t out = 4711;
        const char *rest = NULL;
        assert_true(option_text_fx(good[i].text, &out, &rest));
        assert_int_equal(out, good[i].value);
        assert_string_equal(rest, good[i].rest);
    }
    static const char *const none[] = {"", " 1", "a", "\t1", "\n1", "32768", "-32769", "inf", "nan", "-", "."};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        fx_t out = 4711;
        const char *rest = NULL;
        assert_false(option_text_fx(none[i], &out, &rest));
        assert_int_equal(out, 4711);
    }
}

static void a_list_has_as_many_numbers_as_were_asked_for(void **state)
{
    (void)state;
    fx_t out[5] = {1, 2, 3, 4, 5};
    const char *rest = "as it was";
    assert_true(option_text_fx_list("4,3,2,1,eye", out, 4, &rest));
    assert_string_equal(rest, ",eye");
    for (int i = 0; i < 4; i++) {
        assert_int_equal(out[i], FX_INT(4 - i));
    }
    assert_int_equal(out[4], 5);
    out[1] = 42;
    assert_true(option_text_fx_list("7,8", out, 1, &rest));
    assert_string_equal(rest, ",8");
    assert_int_equal(out[0], FX_INT(7));
    assert_int_equal(out[1], 42);
    rest = "as it was";
    static const char *const none[] = {"", "1,2", "1,2,", "1;2,3", "1,2 ,3", ",1,2", "1,,3", "1,2,x"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        assert_false(option_text_fx_list(none[i], out, 3, &rest));
        assert_string_equal(rest, "as it was");
        assert_int_equal(out[0], FX_INT(7));
    }
}

static void a_choice_is_its_place_among_the_names(void **state)
{
    (void)state;
    static const char *const names[] = {"up", "down", "upper"};
    assert_int_equal(option_text_choice("up", names, 3), 0);
    assert_int_equal(option_text_choice("down", names, 3), 1);
    assert_int_equal(option_text_choice("upper", names, 3), 2);
    assert_int_equal(option_text_choice("upper", names, 2), PH_ERR_INVAL);
    assert_int_equal(option_text_choice("Up", names, 3), PH_ERR_INVAL);
    assert_int_equal(option_text_choice("u", names, 3), PH_ERR_INVAL);
    assert_int_equal(option_text_choice("", names, 3), PH_ERR_INVAL);
}

static void degrees_are_quarter_turns(void **state)
{
    (void)state;
    static const char *const degrees[] = {"0", "90", "180", "270"};
    for (int i = 0; i < 4; i++) {
        uint8_t turns = 9;
        assert_true(option_text_turns(degrees[i], &turns));
        assert_int_equal(turns, i);
    }
    uint8_t turns = 9;
    assert_false(option_text_turns("360", &turns));
    assert_false(option_text_turns("45", &turns));
    assert_int_equal(turns, 9);
}

static void a_depth_format_is_a_name_and_for_floats_an_exponent(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        const struct ph_depth_format *format;
        unsigned exponent;
    } good[] = {{"auto", PH_DEPTH_AUTO, 0},          {"fixed16", PH_DEPTH_FIXED16, 0},
                {"fixed24", PH_DEPTH_FIXED24, 0},    {"linear-w", PH_DEPTH_LINEAR_W, 0},
                {"float16", PH_DEPTH_FLOAT16, 0},    {"float24", PH_DEPTH_FLOAT24, 0},
                {"float16-e3", PH_DEPTH_FLOAT16, 3}, {"float24-e6", PH_DEPTH_FLOAT24, 6}};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        struct option_depth out = {NULL, 99};
        char text[OPTION_DEPTH_NAME];
        assert_true(option_text_depth(good[i].text, &out));
        assert_ptr_equal(out.format, good[i].format);
        assert_int_equal(out.exponent, good[i].exponent);
        assert_string_equal(option_text_depth_name(out, text), good[i].text);
    }
    static const char *const none[] = {"",
                                       "float",
                                       "float16-e2",
                                       "float16-e7",
                                       "float16-e",
                                       "float16-e44",
                                       "fixed16-e4",
                                       "linear-w-e4",
                                       "auto-e4",
                                       "-e4",
                                       "float16 -e4",
                                       "float16-f4",
                                       "fixed24-e3",
                                       "a name that is longer than the room for it-e4"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        struct option_depth out = {NULL, 98};
        assert_false(option_text_depth(none[i], &out));
        assert_null(out.format);
        assert_int_equal(out.exponent, 98);
    }
}

static void an_ending_has_something_before_it(void **state)
{
    (void)state;
    assert_true(option_text_ends("a.ppm", ".ppm"));
    assert_false(option_text_ends(".ppm", ".ppm"));
    assert_false(option_text_ends("ppm", ".ppm"));
    assert_false(option_text_ends("a.ppm.png", ".ppm"));
    assert_false(option_text_ends("a.PPM", ".ppm"));
    assert_false(option_text_ends("appm", ".ppm"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_whole_number_is_digits_within_its_range),
        cmocka_unit_test(a_size_is_two_numbers_from_1),
        cmocka_unit_test(a_decimal_number_is_q16_16_and_says_where_it_ends),
        cmocka_unit_test(a_list_has_as_many_numbers_as_were_asked_for),
        cmocka_unit_test(a_choice_is_its_place_among_the_names),
        cmocka_unit_test(degrees_are_quarter_turns),
        cmocka_unit_test(a_depth_format_is_a_name_and_for_floats_an_exponent),
        cmocka_unit_test(an_ending_has_something_before_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
