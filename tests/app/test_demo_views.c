/* What a user may choose for a demo: its view, buttons, memory for its blur. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "demo.h"
#include "hal.h"
#include "demo_stage.h"
#include "overlay.h"

#include <math.h>
#include <stdlib.h>

static void views_have_names_and_differ(void **state)
{
    (void)state;
    for (uint32_t d = 0; d < demo_count; d++) {
        struct demo_stage s = demo_stage_open(demo_list[d], 120, 100);
        const uint32_t first = demo_stage_frame(&s, 9);
        uint32_t before = 0;
        for (size_t v = 0; s.demo->views && s.demo->views[v]; v++) {
            assert_true(demo_has_view(s.demo, s.demo->views[v]));
            s.context.view = s.demo->views[v];
            const uint32_t now = demo_stage_frame(&s, 9);
            assert_true(v == 0 ? now == first : now != before);
            before = now;
        }
        assert_false(demo_has_view(s.demo, "none"));
        demo_stage_close(&s);
    }
}

static void buttons_walk_around_and_come_back(void **state)
{
    (void)state;
    static const char *const names[] = {"turntable", "wireframe", "solar", "ball", "shadow"};
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
        struct demo_stage s = demo_stage_open(demo_find(names[i]), 120, 100);
        const uint32_t own = demo_stage_frame(&s, 5);
        demo_input(&s.context, HAL_BUTTON_LEFT);
        const uint32_t left = demo_stage_frame(&s, 5);
        demo_input(&s.context, HAL_BUTTON_RIGHT);
        assert_int_equal(demo_stage_frame(&s, 5), own);
        demo_input(&s.context, HAL_BUTTON_RIGHT);
        assert_true(left != own && demo_stage_frame(&s, 5) != own && demo_stage_frame(&s, 5) != left);
        for (int k = 1; k < 256; k++) { /* a whole turn */
            demo_input(&s.context, HAL_BUTTON_RIGHT);
        }
        assert_int_equal(demo_stage_frame(&s, 5), own);
        demo_input(&s.context, HAL_BUTTON_UP);
        assert_true(demo_stage_frame(&s, 5) != own);
        demo_input(&s.context, HAL_BUTTON_DOWN);
        assert_int_equal(demo_stage_frame(&s, 5), own);
        demo_stage_close(&s);
    }
}

/* sin of the camera's elevation, and its distance from where its axis is nearest to the origin. */
static double elevation(const struct demo_stage *s, double *distance)
{
    *distance = -s->rig.r.view.t.z / 65536.;
    return asin(ldexp(s->rig.r.view.r[2][1], -30)) * 180 / acos(-1);
}

/* The camera tilts by what is asked for, at the same distance, and stays between 3 and 87 degrees. */
static void the_camera_tilts_around_the_scene_and_stays_above_the_ground(void **state)
{
    (void)state;
    static const char *const names[] = {"turntable", "wireframe", "solar", "ball", "shadow", "materials"};
    static const double asked[] = {10, -10, 80, -80};
    for (size_t i = 0; i < 24; i++) {
        struct demo_stage s = demo_stage_open(demo_find(names[i / 4]), 120, 100);
        double before, after;
        demo_stage_frame(&s, 5);
        const double own = elevation(&s, &before), want = fmin(fmax(own + asked[i % 4], fmin(own, 3)), fmax(own, 87));
        s.context.tilt = (int32_t)lrint(asked[i % 4] / 360 * 4294967296.);
        demo_stage_frame(&s, 5);
        if (fabs(elevation(&s, &after) - want) > .05 || before != after || s.rig.r.stats.triangles_dropped != 0) {
            fail_msg("%s: from %.2f degrees to %.2f, not %.2f; %u triangles are left out", names[i / 4], own,
                     elevation(&s, &after), want, s.rig.r.stats.triangles_dropped);
        }
        demo_stage_close(&s);
    }
}

/* The focus is read from the depth buffer. With scratch memory the picture differs by the blur alone. */
static void without_scratch_memory_the_focus_is_sharp(void **state)
{
    (void)state;
    struct demo_stage s = demo_stage_open(demo_find("focus"), 240, 240);
    const uint32_t blurred = demo_stage_frame(&s, 7);
    const size_t bytes = s.context.scratch_bytes;
    assert_true(bytes > 0);
    s.context.scratch_bytes = bytes - 1;
    const uint32_t sharp = demo_stage_frame(&s, 7);
    assert_true(sharp != blurred);
    assert_int_equal(demo_stage_frame(&s, 7), sharp);
    s.context.scratch_bytes = bytes;
    assert_int_equal(demo_stage_frame(&s, 7), blurred);
    demo_stage_close(&s);
}

static void the_four_conventions_draw_the_same_quarter(void **state)
{
    (void)state;
    const struct demo *const demo = demo_find("conventions");
    struct demo plain = *demo; /* without the labels */
    plain.band = NULL;
    struct demo_stage s = demo_stage_open(demo, 240, 240);
    s.demo = &plain;
    int drawn = 0;
    demo_stage_frame(&s, 33);
    for (int y = 0; y < 120; y++) {
        for (int x = 0; x < 120;
             x++) { /* six sixteenths of the picture for a pot, and a strip for labels between them */
            const uint16_t gl = pixel(&s, x, y);
            drawn += gl != s.rig.r.background;
            assert_true(y < 90 || gl == s.rig.r.background);
            assert_int_equal(pixel(&s, x + 120, y), gl);
            assert_int_equal(pixel(&s, x, y < 90 ? y + 150 : y + 30), gl);
            assert_int_equal(pixel(&s, x + 120, y < 90 ? y + 150 : y + 30), gl);
        }
    }
    assert_true(drawn > 1500);
    demo_stage_close(&s);
}

/* The table of camera.h: looks along, clip w, depth from near to far. */
static void each_quarter_says_what_its_convention_does(void **state)
{
    (void)state;
    static const char *const texts[4][3] = {{"GL", "-Z W>0", "-1..1"},
                                            {"D3D", "+Z W>0", "0..1"},
                                            {"LMU", "-Z W<0", "1..-1"},
                                            {"REVERSED", "-Z W>0", "1..0"}};
    const struct ph_overlay_style style = {ph_rgb565(255, 255, 255), 0, 1};
    struct demo plain = *demo_find("conventions");
    plain.band = NULL;
    struct demo_stage s = demo_stage_open(demo_find("conventions"), 240, 320), want = demo_stage_open(s.demo, 240, 320);
    want.demo = &plain;
    demo_stage_frame(&s, 5);
    demo_stage_frame(&want, 5);
    const struct ph_overlay_band whole = {want.rig.pixels, 240, 0, 320};
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) { /* at both sides of the middle of the picture */
            const int x = (i % 2 ? 180 : 60) - ph_overlay_width(texts[i][k], 1) / 2;
            ph_overlay_text(&whole, x, (i < 2 ? 160 - 3 * 9 : 162) + 9 * k, texts[i][k], &style);
        }
    }
    assert_memory_equal(s.rig.pixels, want.rig.pixels, 240 * 320 * 2);
    demo_stage_close(&s);
    demo_stage_close(&want);
}

/* Up comes nearer: the pot grows. Down makes it smaller than at first. At both ends of the way it stops. */
static void up_and_down_change_the_pot_s_size_within_limits(void **state)
{
    (void)state;
    struct demo_stage s = demo_stage_open(demo_find("wireframe"), 240, 240);
    int height, near_height, far_height;
    demo_stage_frame(&s, 0);
    const int own = drawn_width(&s, &height);
    for (int k = 0; k < 1000; k++) {
        demo_input(&s.context, HAL_BUTTON_DOWN);
    }
    demo_stage_frame(&s, 0);
    assert_true(drawn_width(&s, &far_height) < own * 3 / 4 && drawn_width(&s, &far_height) > own / 2);
    for (int k = 0; k < 32; k++) {
        demo_input(&s.context, HAL_BUTTON_UP);
    }
    demo_stage_frame(&s, 0);
    assert_int_equal(drawn_width(&s, &near_height), own);
    demo_input(&s.context, HAL_BUTTON_UP);
    demo_stage_frame(&s, 0);
    drawn_width(&s, &near_height);
    assert_true(near_height >= height && far_height < height);
    demo_stage_close(&s);
}

/* Text and blur too. */
static void no_picture_depends_on_the_height_of_bands(void **state)
{
    (void)state;
    for (uint32_t d = 0; d < demo_count; d++) {
        const struct demo *const demo = demo_list[d];
        struct demo_stage s = demo_stage_open(demo, 121, 99);
        const uint32_t whole = demo_stage_frame(&s, 40);
        rig_close(&s.rig);
        rig_open(&s.rig, 121, 99, 7, PH_DEPTH_FIXED16, (int)demo->vertex_max, (int)demo->triangle_max);
        assert_int_equal(demo_stage_frame(&s, 40), whole);
        demo_stage_close(&s);
    }
}

/* ---- the snake's buttons --------------------------------------------------------------------------------------- */

static uint32_t press(struct demo_stage *s, uint32_t frame, uint32_t buttons)
{
    s->context.buttons = 0;
    demo_input(&s->context, buttons);
    return demo_stage_frame(s, frame);
}

/* What the camera is set to: its place in the world and its direction, from the renderer's view. */
struct eye {
    fx_t x, z, forward_x, forward_z;
};

static struct eye eye_of(const struct demo_stage *s)
{
    const struct ph_xform camera = ph_xform_inverse_rigid(&s->rig.r.view);
    return (struct eye){camera.t.x, camera.t.z, -(camera.r[0][2] >> 14), -(camera.r[2][2] >> 14)};
}

static void the_snake_plays_itself_until_left_or_right(void **state)
{
    (void)state;
    struct demo_stage own = demo_stage_open(demo_find("snake"), 80, 60);
    struct demo_stage other = demo_stage_open(demo_find("snake"), 80, 60);
    for (uint32_t frame = 0; frame < 600; frame += 3) {
        const uint32_t crc = demo_stage_frame(&own, frame);
        assert_int_equal(press(&other, frame, frame % 2 ? HAL_BUTTON_UP : HAL_BUTTON_DOWN), crc);
    }
    other.context.view = "outside";
    other.context.dolly = 0;
    own.context.view = "outside";
    press(&other, 601, HAL_BUTTON_LEFT); /* orbits, does not steer */
    other.context.orbit = 0;
    assert_int_equal(demo_stage_frame(&other, 640), demo_stage_frame(&own, 640));
    demo_stage_close(&own);
    demo_stage_close(&other);
}

/* A cell takes 16 frames, the first one from the first press on. A held button counts once. */
static void left_and_right_turn_the_snake_by_a_quarter(void **state)
{
    (void)state;
    for (int side = 0; side < 2; side++) {
        const uint32_t button = side ? HAL_BUTTON_RIGHT : HAL_BUTTON_LEFT;
        struct demo_stage own = demo_stage_open(demo_find("snake"), 80, 60);
        struct demo_stage s = demo_stage_open(demo_find("snake"), 80, 60);
        for (uint32_t frame = 0; frame < 20; frame++) {
            assert_int_equal(press(&s, frame, 0), demo_stage_frame(&own, frame));
        }
        const struct eye path = eye_of(&s);
        for (uint32_t frame = 20; frame <= 36; frame++) {
            const uint32_t crc = press(&s, frame, button);
            assert_true(frame == 20 || crc != demo_stage_frame(&own, frame));
        }
        const struct eye first = eye_of(&s);
        const int sign = side ? -1 : 1;
        /* left of (x, z), seen from above, is (z, -x) */
        assert_true(sign * (fx_mul_sat(first.forward_x, path.forward_z) - fx_mul_sat(first.forward_z, path.forward_x)) >
                    FX_HALF);
        press(&s, 37, 0);
        press(&s, 38, button);
        for (uint32_t frame = 39; frame < 68; frame++) {
            press(&s, frame, button);
        }
        press(&s, 68, button);
        const struct eye second = eye_of(&s);
        assert_true(abs(second.forward_x - sign * first.forward_z) < 200);
        assert_true(abs(second.forward_z + sign * first.forward_x) < 200);
        assert_true(abs(first.forward_x) < 200 || abs(first.forward_z) < 200);
        demo_stage_close(&own);
        demo_stage_close(&s);
    }
}

/* After four turns to the left it runs into itself, and plays by itself as if nothing had happened. */
static void a_snake_that_bites_itself_plays_by_itself_again(void **state)
{
    (void)state;
    struct demo_stage own = demo_stage_open(demo_find("snake"), 80, 60);
    struct demo_stage s = demo_stage_open(demo_find("snake"), 80, 60);
    uint32_t back = 0;
    for (uint32_t frame = 40; frame < 200; frame++) {
        const bool down = frame == 40 || (frame < 104 && frame % 16 == 0);
        const bool same = press(&s, frame, down ? HAL_BUTTON_LEFT : 0) == demo_stage_frame(&own, frame);
        back = back == 0 && same && frame > 40 ? frame : back;
        assert_true(back == 0 || same);
    }
    assert_int_equal(back, 40 + 4 * 16);
    demo_stage_close(&own);
    demo_stage_close(&s);
}

static void a_steered_snake_stays_in_its_field_and_its_budget_and_repeats_itself(void **state)
{
    (void)state;
    struct demo_stage s[2] = {demo_stage_open(demo_find("snake"), 96, 96), demo_stage_open(demo_find("snake"), 96, 96)};
    const size_t used = s[0].context.arena.used;
    const fx_t border_x = FX_ONE * 45 / 8;
    const fx_t border_z = FX_ONE * 35 / 8;
    uint32_t seed = 1;
    uint32_t most = 0;
    for (uint32_t frame = 0; frame < 3000; frame++) {
        seed = seed * 1664525u + 1013904223u;
        const uint32_t buttons = (seed >> 24) < 12 ? HAL_BUTTON_LEFT : (seed >> 24) < 24 ? HAL_BUTTON_RIGHT : 0;
        const uint32_t crc = press(&s[0], frame, buttons);
        const struct ph_stats *const stats = &s[0].rig.r.stats;
        assert_int_equal(press(&s[1], frame, buttons), crc);
        assert_int_equal(stats->triangles_dropped, 0);
        assert_int_equal(stats->vertices_dropped, 0);
        most = stats->triangles_drawn > most ? stats->triangles_drawn : most;
        const struct eye e = eye_of(&s[0]);
        assert_true(e.x < border_x && e.x > -border_x && e.z < border_z && e.z > -border_z);
        assert_int_equal(demo_stage_frame(&s[0], frame), crc); /* drawn again: it does not move on */
        s[0].context.buttons ^= HAL_BUTTON_LEFT;               /* with other buttons, and again with the first ones */
        demo_stage_frame(&s[0], frame);
        s[0].context.buttons ^= HAL_BUTTON_LEFT;
        assert_int_equal(demo_stage_frame(&s[0], frame), crc);
        s[0].context.view = "outside";
        demo_stage_frame(&s[0], frame);
        assert_int_equal(stats->triangles_dropped, 0);
        s[0].context.view = NULL; /* drawn from the head again, it is steered as it was */
        assert_int_equal(demo_stage_frame(&s[0], frame), crc);
    }
    assert_int_equal(s[0].context.arena.used, used);
    assert_true(most > 200);
    demo_stage_close(&s[0]);
    demo_stage_close(&s[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(views_have_names_and_differ),
        cmocka_unit_test(buttons_walk_around_and_come_back),
        cmocka_unit_test(the_camera_tilts_around_the_scene_and_stays_above_the_ground),
        cmocka_unit_test(up_and_down_change_the_pot_s_size_within_limits),
        cmocka_unit_test(without_scratch_memory_the_focus_is_sharp),
        cmocka_unit_test(no_picture_depends_on_the_height_of_bands),
        cmocka_unit_test(the_four_conventions_draw_the_same_quarter),
        cmocka_unit_test(each_quarter_says_what_its_convention_does),
        cmocka_unit_test(the_snake_plays_itself_until_left_or_right),
        cmocka_unit_test(left_and_right_turn_the_snake_by_a_quarter),
        cmocka_unit_test(a_snake_that_bites_itself_plays_by_itself_again),
        cmocka_unit_test(a_steered_snake_stays_in_its_field_and_its_budget_and_repeats_itself),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
