/* parts: the demos' cameras, waves, halves and text, against trigonometry and numbers worked out by hand. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "demo_scene.h"
#include "hal.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

static struct demo_context of_size(uint16_t width, uint16_t height)
{
    return (struct demo_context){.width = width, .height = height};
}

static void an_arena_gives_multiples_of_eight_until_it_is_full(void **state)
{
    static uint8_t memory[64] __attribute__((aligned(8)));
    struct demo_arena arena = {.base = memory, .size = 41};
    (void)state;
    assert_ptr_equal(demo_alloc(&arena, 1), memory);
    assert_ptr_equal(demo_alloc(&arena, 17), memory + 8);
    assert_null(demo_alloc(&arena, 10));
    assert_ptr_equal(demo_alloc(&arena, 9), memory + 32);
    assert_int_equal(arena.used, 41);
    assert_null(demo_alloc(&arena, 0)); /* the next multiple is behind the end */
    assert_null(demo_alloc(&arena, SIZE_MAX));
}

static void the_smaller_side_has_the_angle(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        const struct demo_context c = of_size(i == 0 ? 320 : 240, i == 2 ? 320 : 240);
        const struct ph_projection p = demo_perspective(&c, 1000003, 5, 6);
        assert_int_equal(p.scale_x_q20, i == 0 ? 750002 : 1000003);
        assert_int_equal(p.scale_y_q20, i == 2 ? 750002 : 1000003);
        assert_true(p.kind == PH_PERSPECTIVE && p.near_z == 5 && p.far_z == 6 && p.shift_x == 0);
    }
}

static void halves_lie_beside_or_below_each_other(void **state)
{
    (void)state;
    struct demo_context c = of_size(320, 240), half = demo_half(&c);
    assert_true(half.width == 160 && half.height == 240);
    struct ph_projection p = demo_in_half(&c, (struct ph_projection){.scale_x_q20 = 40, .scale_y_q20 = 60}, false);
    assert_true(p.scale_x_q20 == 20 && p.scale_y_q20 == 60 && p.shift_x == FX_HALF && p.shift_y == 0);
    p = demo_in_half(&c, (struct ph_projection){.scale_x_q20 = 40, .scale_y_q20 = 60}, true);
    assert_true(p.shift_x == -FX_HALF);
    c = of_size(240, 320), half = demo_half(&c);
    assert_true(half.width == 240 && half.height == 160);
    p = demo_in_half(&c, (struct ph_projection){.scale_x_q20 = 40, .scale_y_q20 = 60, .shift_y = 100}, true);
    assert_true(p.scale_x_q20 == 40 && p.scale_y_q20 == 30 && p.shift_x == 0 && p.shift_y == 50 + FX_HALF);
    c = of_size(240, 240), half = demo_half(&c); /* square: beside each other */
    assert_true(half.width == 120 && half.height == 240);
    c = of_size(1, 1), half = demo_half(&c);
    assert_true(half.width == 1 && half.height == 1);
}

/* A strip of 60 of 240 rows: the scene is three quarters as high and wide, and its middle an eighth lower. */
static void the_scene_below_a_strip_is_smaller_and_lower(void **state)
{
    (void)state;
    const struct ph_projection lens = {.scale_x_q20 = 40, .scale_y_q20 = 80, .shift_x = 7, .shift_y = FX_HALF};
    struct ph_projection p = demo_below(lens, 240, 60);
    assert_true(p.scale_x_q20 == 30 && p.scale_y_q20 == 60 && p.shift_x == 7);
    assert_int_equal(p.shift_y, FX_ONE * 3 / 8 + FX_ONE / 4);
    p = demo_below(lens, 8, 9); /* no room */
    assert_true(p.scale_x_q20 == 40 && p.scale_y_q20 == 80 && p.shift_y == FX_HALF);
}

static void small_pictures_have_a_black_sky_dark_tiles_and_bright_figures(void **state)
{
    (void)state;
    const struct demo_context low = of_size(128, 64), narrow = of_size(64, 128), large = of_size(65, 65);
    assert_true(demo_is_small(&low) && demo_is_small(&narrow) && !demo_is_small(&large));
    assert_true(demo_sky(&low, 99, 99, 99) == 0 && demo_sky(&large, 99, 98, 97) == ph_rgb565(99, 98, 97));
    assert_int_equal(demo_tile(&low, 200, 100, 40).colour, ph_rgb565(50, 25, 10));
    assert_int_equal(demo_tile(&large, 200, 100, 40).colour, ph_rgb565(200, 100, 40));
    uint16_t ramp[PH_RAMP_SIZE], want[PH_RAMP_SIZE];
    demo_figure(&low, ramp, 0, 255, 30);
    demo_lit(want, PH_SHADE_GOURAUD, 170, 255, 180);
    assert_memory_equal(ramp, want, sizeof ramp);
    demo_figure(&large, ramp, 0, 255, 30);
    demo_lit(want, PH_SHADE_GOURAUD, 0, 255, 30);
    assert_memory_equal(ramp, want, sizeof ramp);
}

static void text_of_a_half_keeps_to_its_rows(void **state)
{
    const int row = PH_FONT_HEIGHT + 1;
    (void)state;
    const struct demo_context wide = of_size(320, 240), tall = of_size(240, 320), square = of_size(240, 240);
    for (int line = 0; line < 3; line++) {
        assert_int_equal(demo_half_text_y(&wide, false, line), 2 + line * row);
        assert_int_equal(demo_half_text_y(&wide, true, line), 2 + line * row);
        assert_int_equal(demo_half_text_y(&tall, false, line), 2 + line * row);
        assert_int_equal(demo_half_text_y(&tall, true, line), 162 + line * row);
        assert_int_equal(demo_half_text_y(&square, false, line), 32 + line * row); /* a round glass is narrow above */
        assert_int_equal(demo_strip(&square, line), 32 + line * row);
    }
    const struct demo_context little = of_size(128, 128);
    assert_true(demo_may_be_round(&square) && !demo_may_be_round(&little) && !demo_may_be_round(&wide));
}

/* (1 - cos t) / 2, whatever the number of the loop. */
static void a_swing_is_a_cosine(void **state)
{
    (void)state;
    for (uint32_t frame = 0; frame < 300; frame++) {
        const double expected = (1 - cos(2 * PI * frame / 128)) / 2 * 65536;
        assert_true(fabs(demo_swing(frame, 128) - expected) <= 1);
    }
    assert_true(demo_swing(0, 64) == 0 && demo_swing(32, 64) == FX_ONE);
}

static void views_are_found_by_their_names(void **state)
{
    static const char *const views[] = {"one", "two", NULL};
    const struct demo demo = {.views = views}, none = {.views = NULL};
    struct demo_context c = {.view = NULL};
    (void)state;
    assert_true(demo_has_view(&demo, "one") && demo_has_view(&demo, "two") && !demo_has_view(&demo, "tw"));
    assert_false(demo_has_view(&none, "one"));
    assert_true(demo_view_is(&c, &demo, 0) && !demo_view_is(&c, &demo, 1));
    c.view = "two";
    assert_true(!demo_view_is(&c, &demo, 0) && demo_view_is(&c, &demo, 1));
}

static void buttons_turn_by_256ths_and_come_nearer_by_64ths(void **state)
{
    struct demo_context c = {.orbit = 0};
    (void)state;
    demo_input(&c, HAL_BUTTON_RIGHT | HAL_BUTTON_DOWN);
    assert_true(c.orbit == 1u << 24 && c.dolly == 1024 && c.buttons == (HAL_BUTTON_RIGHT | HAL_BUTTON_DOWN));
    demo_input(&c, HAL_BUTTON_LEFT);
    demo_input(&c, HAL_BUTTON_LEFT | HAL_BUTTON_UP);
    assert_true(c.orbit == 0u - (1u << 24) && c.dolly == 0);
    demo_input(&c, HAL_BUTTON_LEFT | HAL_BUTTON_RIGHT | HAL_BUTTON_UP | HAL_BUTTON_DOWN);
    assert_true(c.orbit == 0u - (1u << 24) && c.dolly == 0);
    for (int i = 0; i < 100; i++) {
        demo_input(&c, HAL_BUTTON_UP);
    }
    assert_int_equal(c.dolly, -FX_HALF);
    for (int i = 0; i < 100; i++) {
        demo_input(&c, HAL_BUTTON_DOWN);
    }
    assert_int_equal(c.dolly, FX_HALF);
}

/* Where the camera is, from its view: -R^T t. */
static void eye_of(const struct ph_xform *view, double eye[3])
{
    const double t[3] = {view->t.x / 65536., view->t.y / 65536., view->t.z / 65536.};
    for (int k = 0; k < 3; k++) {
        eye[k] = -(view->r[0][k] * t[0] + view->r[1][k] * t[1] + view->r[2][k] * t[2]) / (1 << 30);
    }
}

/* From (0, 3, 4), 5 away and 36.87 degrees up. */
static void a_camera_orbits_tilts_and_comes_nearer(void **state)
{
    const struct ph_xform from = demo_look(0, FX_INT(3), FX_INT(4), 0, 0, 0);
    static const struct {
        double turns, tilt_deg, dolly, up_deg, distance;
    } cases[] = {{0, 0, 0, 36.8699, 5},       {.25, 0, 0, 36.8699, 5}, {-.125, 0, .5, 36.8699, 7.5},
                 {0, 0, -.25, 36.8699, 3.75}, {0, 20, 0, 56.8699, 5},  {.25, -20, 0, 16.8699, 5},
                 {0, 80, 0, 87, 5},           {0, -80, 0, 3, 5}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct demo_context c = {.orbit = (uint32_t)(int64_t)(cases[i].turns * 4294967296.),
                                 .tilt = (int32_t)(cases[i].tilt_deg / 360 * 4294967296.),
                                 .dolly = (fx_t)(cases[i].dolly * 65536)};
        struct ph_xform view = from;
        struct ph_projection lens = {.near_z = FX_INT(2), .far_z = FX_INT(9)};
        double eye[3];
        demo_orbit(&c, &view, &lens);
        eye_of(&view, eye);
        const double up = cases[i].up_deg * PI / 180, turn = cases[i].turns * 2 * PI, far_off = cases[i].distance;
        assert_true(fabs(eye[0] - far_off * cos(up) * sin(turn)) < .02);
        assert_true(fabs(eye[1] - far_off * sin(up)) < .02);
        assert_true(fabs(eye[2] - far_off * cos(up) * cos(turn)) < .02);
        /* the planes move with the camera; a camera that tilts gets half of the near plane */
        const double near_z = cases[i].tilt_deg != 0 ? 1 : 2, far_z = cases[i].tilt_deg != 0 ? 10 : 9;
        assert_true(fabs(lens.near_z / 65536. - fmax(near_z + far_off - 5, near_z / 4)) < .001);
        assert_true(fabs(lens.far_z / 65536. - (far_z + far_off - 5)) < .001);
    }
}

static void materials_are_a_quarter_ambient(void **state)
{
    uint16_t ramp[PH_RAMP_SIZE] = {0}, expected[PH_RAMP_SIZE];
    (void)state;
    const struct ph_material lit = demo_lit(ramp, PH_SHADE_FLAT, 10, 200, 30), unlit = demo_unlit(1, 2, 250);
    ph_material_ramp(expected, 10, 200, 30, 0);
    assert_memory_equal(ramp, expected, sizeof ramp);
    assert_true(lit.ambient == FX_ONE / 4 && lit.ambient + lit.diffuse == FX_ONE && lit.specular == 0 &&
                lit.ramp == ramp);
    assert_true(lit.shading == PH_SHADE_FLAT && lit.colour == ph_rgb565(10, 200, 30));
    assert_true(unlit.shading == PH_SHADE_UNLIT && unlit.colour == ph_rgb565(1, 2, 250));
    const struct fx_vec3 to = demo_daylight.lights[0].to_light_q30;
    const double x = to.x / 1073741824., y = to.y / 1073741824., z = to.z / 1073741824.;
    assert_true(fabs(x * x + y * y + z * z - 1) < 1e-8 && x < 0 && y > 0 && z > 0);
    const struct ph_xform place = demo_place(1, 2, 3, 0x40000000); /* a quarter turn takes z to x */
    assert_true(place.t.x == 1 && place.t.y == 2 && place.t.z == 3 && place.r[0][2] == 1 << 30 &&
                place.r[2][0] == -(1 << 30));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_arena_gives_multiples_of_eight_until_it_is_full),
        cmocka_unit_test(the_smaller_side_has_the_angle),
        cmocka_unit_test(halves_lie_beside_or_below_each_other),
        cmocka_unit_test(the_scene_below_a_strip_is_smaller_and_lower),
        cmocka_unit_test(small_pictures_have_a_black_sky_dark_tiles_and_bright_figures),
        cmocka_unit_test(text_of_a_half_keeps_to_its_rows),
        cmocka_unit_test(a_swing_is_a_cosine),
        cmocka_unit_test(views_are_found_by_their_names),
        cmocka_unit_test(buttons_turn_by_256ths_and_come_nearer_by_64ths),
        cmocka_unit_test(a_camera_orbits_tilts_and_comes_nearer),
        cmocka_unit_test(materials_are_a_quarter_ambient),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
