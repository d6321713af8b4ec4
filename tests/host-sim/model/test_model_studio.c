/* model_studio: what the options make of a model's background and lamp. */
#include "model_studio.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static struct model_shared shared;

static const struct demo_studio *made(const char *background, const char *light)
{
    shared = (struct model_shared){.options = {.background = background, .light = light}};
    model_studio_make(&shared);
    return shared.model.studio;
}

static void without_options_there_is_none(void **state)
{
    (void)state;
    assert_null(made(NULL, NULL));
}

static void a_colour_is_six_hexadecimal_digits(void **state)
{
    static const char *const wrong[] = {"", "12345", "1234567", "#12345", "0x1234", "12345g", " 12345", "123456g"};
    (void)state;
    assert_true(model_is_colour("09afAF"));
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_false(model_is_colour(wrong[i]));
    }
}

static void a_background_is_its_colour(void **state)
{
    (void)state;
    const struct demo_studio *const studio = made("ff8041", NULL);
    const uint8_t *const bytes = (const uint8_t *)&studio->background;
    assert_int_equal(studio->has_lamp, 0);
    assert_int_equal(bytes[0] << 8 | bytes[1], 31 << 11 | 32 << 5 | 8); /* ff: 31 of 31, 80: 32 of 63, 41: 8 of 31 */
}

/* Each lamp stands on its side, at a distance of one. */
static void each_lamp_stands_on_its_side(void **state)
{
    (void)state;
    assert_true(made(NULL, "left")->to_lamp_q30.x < -(1 << 29));
    assert_int_equal(shared.studio.background, DEMO_MODEL_BACKGROUND);
    assert_int_equal(shared.studio.has_lamp, 1);
    assert_true(made(NULL, "right")->to_lamp_q30.x > 1 << 29);
    assert_true(made(NULL, "front")->to_lamp_q30.z > 1 << 29);
    assert_true(made(NULL, "above")->to_lamp_q30.y > 1 << 29);
    assert_true(made(NULL, "back")->to_lamp_q30.z < -(1 << 29));
    static const char *const names[] = {"left", "right", "front", "above", "back"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const struct fx_vec3 way = made("000000", names[i])->to_lamp_q30;
        const double x = way.x, y = way.y, z = way.z, one = (double)(1 << 30);
        const double square = (x * x + y * y + z * z) / (one * one);
        assert_true(square > .9999999 && square < 1.0000001);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_options_there_is_none),
        cmocka_unit_test(a_colour_is_six_hexadecimal_digits),
        cmocka_unit_test(a_background_is_its_colour),
        cmocka_unit_test(each_lamp_stands_on_its_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
