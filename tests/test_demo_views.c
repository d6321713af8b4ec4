/* What a user may do to a demo: choose its view, press buttons, give it memory for its blur. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "demo.h"
#include "hal.h"
#include "show.h"

static void views_have_names_and_differ(void **state)
{
    (void)state;
    for (uint32_t d = 0; d < demo_count; d++) {
        struct show s = show_open(demo_list[d], 120, 100);
        const uint32_t first = show_frame(&s, 9);
        uint32_t before = 0;
        for (size_t v = 0; s.demo->views && s.demo->views[v]; v++) {
            assert_true(demo_has_view(s.demo, s.demo->views[v]));
            s.context.view = s.demo->views[v];
            const uint32_t now = show_frame(&s, 9);
            assert_true(v == 0 ? now == first : now != before);
            before = now;
        }
        assert_false(demo_has_view(s.demo, "none"));
        show_close(&s);
    }
}

static void buttons_walk_around_and_come_back(void **state)
{
    (void)state;
    static const char *const names[] = {"turntable", "wireframe", "solar", "ball", "shadow"};
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
        struct show s = show_open(demo_find(names[i]), 120, 100);
        const uint32_t own = show_frame(&s, 5);
        demo_input(&s.context, HAL_BUTTON_LEFT);
        const uint32_t left = show_frame(&s, 5);
        demo_input(&s.context, HAL_BUTTON_RIGHT);
        assert_int_equal(show_frame(&s, 5), own);
        demo_input(&s.context, HAL_BUTTON_RIGHT);
        assert_true(left != own && show_frame(&s, 5) != own && show_frame(&s, 5) != left);
        for (int k = 1; k < 256; k++) { /* a whole turn */
            demo_input(&s.context, HAL_BUTTON_RIGHT);
        }
        assert_int_equal(show_frame(&s, 5), own);
        demo_input(&s.context, HAL_BUTTON_UP);
        assert_true(show_frame(&s, 5) != own);
        demo_input(&s.context, HAL_BUTTON_DOWN);
        assert_int_equal(show_frame(&s, 5), own);
        show_close(&s);
    }
}

/* The focus is read from the depth buffer: with scratch memory the picture differs, by the blur alone. */
static void without_scratch_memory_the_focus_is_sharp(void **state)
{
    (void)state;
    struct show s = show_open(demo_find("focus"), 240, 240);
    const uint32_t blurred = show_frame(&s, 7);
    const size_t bytes = s.context.scratch_bytes;
    assert_true(bytes > 0);
    s.context.scratch_bytes = bytes - 1;
    const uint32_t sharp = show_frame(&s, 7);
    assert_true(sharp != blurred);
    assert_int_equal(show_frame(&s, 7), sharp);
    s.context.scratch_bytes = bytes;
    assert_int_equal(show_frame(&s, 7), blurred);
    show_close(&s);
}

static void the_four_conventions_draw_the_same_quarter(void **state)
{
    (void)state;
    const struct demo *const demo = demo_find("conventions");
    struct demo plain = *demo; /* without the labels */
    plain.band = NULL;
    struct show s = show_open(demo, 240, 200);
    s.demo = &plain;
    int drawn = 0;
    show_frame(&s, 33);
    for (int y = 0; y < 100; y++) {
        for (int x = 0; x < 120; x++) {
            const uint16_t gl = pixel(&s, x, y);
            drawn += gl != s.rig.r.background;
            assert_int_equal(pixel(&s, x + 120, y), gl);
            assert_int_equal(pixel(&s, x, y + 100), gl);
            assert_int_equal(pixel(&s, x + 120, y + 100), gl);
        }
    }
    assert_true(drawn > 1500);
    show_close(&s);
}

/* Up comes nearer: the pot grows, and shrinks again to less than it was; at the ends of the way it stops. */
static void up_and_down_change_the_pot_s_size_within_limits(void **state)
{
    (void)state;
    struct show s = show_open(demo_find("wireframe"), 240, 240);
    int height, near_height, far_height;
    show_frame(&s, 0);
    const int own = drawn_width(&s, &height);
    for (int k = 0; k < 1000; k++) {
        demo_input(&s.context, HAL_BUTTON_DOWN);
    }
    show_frame(&s, 0);
    assert_true(drawn_width(&s, &far_height) < own * 3 / 4 && drawn_width(&s, &far_height) > own / 2);
    for (int k = 0; k < 32; k++) {
        demo_input(&s.context, HAL_BUTTON_UP);
    }
    show_frame(&s, 0);
    assert_int_equal(drawn_width(&s, &near_height), own);
    demo_input(&s.context, HAL_BUTTON_UP);
    show_frame(&s, 0);
    drawn_width(&s, &near_height);
    assert_true(near_height >= height && far_height < height);
    show_close(&s);
}

/* Text and blur too. */
static void no_picture_depends_on_the_height_of_bands(void **state)
{
    (void)state;
    for (uint32_t d = 0; d < demo_count; d++) {
        const struct demo *const demo = demo_list[d];
        struct show s = show_open(demo, 121, 99);
        const uint32_t whole = show_frame(&s, 40);
        rig_close(&s.rig);
        rig_open(&s.rig, 121, 99, 7, PH_DEPTH_FIXED16, (int)demo->vertex_max, (int)demo->triangle_max);
        assert_int_equal(show_frame(&s, 40), whole);
        show_close(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(views_have_names_and_differ),
        cmocka_unit_test(buttons_walk_around_and_come_back),
        cmocka_unit_test(up_and_down_change_the_pot_s_size_within_limits),
        cmocka_unit_test(without_scratch_memory_the_focus_is_sharp),
        cmocka_unit_test(no_picture_depends_on_the_height_of_bands),
        cmocka_unit_test(the_four_conventions_draw_the_same_quarter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
