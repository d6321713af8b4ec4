/* depth_planes_scene: where two planes lie, with corners worked out by hand; distances along rays by trigonometry; and
 * the picture and the codes that the renderer makes of them. */
#include "depth_planes_scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static struct depth_lab lab;
static struct planes_canvas canvas;

/* 90 degrees: the slopes at the borders are 1, and 2 to the sides. */
static int fresh(void **state)
{
    (void)state;
    lab = (struct depth_lab){.near_z = FX_ONE, .far_z = FX_INT(64), .fov_deg = FX_INT(90), .width = 32, .height = 16};
    return depth_planes_open(&canvas, &lab, PH_DEPTH_FIXED24);
}

static int closed(void **state)
{
    (void)state;
    depth_planes_close(&canvas);
    return 0;
}

/* At 45 degrees from slope -1/2 to 0: from 8 / (1 + 1/2) to 8 m away, where its middle is 4 m to the right. */
static void planes_lie_where_their_slopes_say(void **state)
{
    const struct planes_place place = {{8, 45, 0}, .5, -.5, 0, .25, .5, 2};
    struct planes_pair pair;
    (void)state;
    assert_true(depth_planes_make(&lab, &place, &pair));
    const struct planes_quad *const b = &pair.behind, *const f = &pair.front;
    assert_true(b->a.x == FX_INT(2) && b->ux == FX_INT(4));
    assert_true(b->a.y == -174763 && b->a.z == -349525); /* -8/3, -16/3 */
    assert_true(b->vy == 174720 && b->vz == -174720);    /* 8/3 in steps of 64 */
    assert_true(f->ux == b->ux && f->vy == b->vy && f->vz == b->vz);
    assert_int_equal(f->a.x, b->a.x + 2 * 262144 / 192);
    assert_int_equal(f->a.y, b->a.y + 23170 + 2 * 2730); /* 1/2 sin 45, and 2 of 64 parts */
    assert_int_equal(f->a.z, b->a.z + 23170 - 2 * 2730);
    assert_true(fabs(depth_planes_separation_m(&pair) - .5) < 2e-5);
    assert_true(depth_planes_front_is_nearer(&pair));
    const struct planes_pair turned = {pair.front, pair.behind};
    assert_false(depth_planes_front_is_nearer(&turned));
    const struct planes_pair same = {pair.front, pair.front};
    assert_false(depth_planes_front_is_nearer(&same));
}

static void planes_outside_of_the_lens_are_refused(void **state)
{
    static const struct {
        struct planes_place place;
        bool is_made;
    } cases[] = {
        {{{8, 0, 0}, 1, -.5, .5, .25, 0, 0}, true},       {{{64, 0, 0}, 1, -.5, .5, .25, 0, 0}, true},
        {{{64.001, 0, 0}, 1, -.5, .5, .25, 0, 0}, false}, {{{2, 0, 0}, 1, -.5, .5, .25, 0, 0}, true},
        {{{2, 0, 0}, 1.001, -.5, .5, .25, 0, 0}, false},  {{{8, 0, 0}, 1, .5, .5, .25, 0, 0}, false},
        {{{8, 0, 0}, 1, -.5, .5, 0, 0, 0}, false},        {{{32, 45, 0}, 1, -.5, .5, .25, 0, 0}, true},
        {{{33, 45, 0}, 1, -.5, .5, .25, 0, 0}, false},    {{{8, 60, 0}, 1, -.5, .6, .25, 0, 0}, false},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct planes_pair pair;
        assert_int_equal(depth_planes_make(&lab, &cases[i].place, &pair), cases[i].is_made);
    }
}

/* Leaning away at the top D is at / (1 - s tan): from 1 m and the separation (and two steps) to 64 m. */
static void the_widest_place_ends_at_the_planes_and_the_borders(void **state)
{
    (void)state;
    struct planes_place p = depth_planes_whole(&lab, (struct planes_lean){8, 0, 0}, .5);
    assert_true(fabs(p.slope_low + 1) < 1e-9 && fabs(p.slope_high - 1) < 1e-9 && fabs(p.slope_side - 2) < 1e-9);
    assert_true(p.separation_m == .5 && p.shift == 0 && p.lean.at_m == 8);
    p = depth_planes_whole(&lab, (struct planes_lean){8, 45, 0}, 1);
    assert_true(fabs(p.slope_low + 1) < 1e-9 && fabs(p.slope_high - (1 - 8 / 64.)) < 1e-9);
    p = depth_planes_whole(&lab, (struct planes_lean){2.5, 45, 0}, 1);
    assert_true(fabs(p.slope_low - (1 - 2.5 / (2 + 2 / 65536.))) < 1e-9);
    p = depth_planes_whole(&lab, (struct planes_lean){8, -45, 0}, 1);
    assert_true(fabs(p.slope_low + (1 - 8 / 64.)) < 1e-9 && fabs(p.slope_high - 1) < 1e-9);
    p = depth_planes_whole(&lab, (struct planes_lean){8, 0, 90}, 1);
    assert_true(fabs(p.slope_high - 2) < 1e-9 && fabs(p.slope_side - 1) < 1e-9);
}

/* A plane that leans by 30 degrees towards an azimuth, at 8 m on the axis. */
static void rays_meet_planes_where_trigonometry_says(void **state)
{
    static const double azimuths[] = {0, 90, 180, 37, -120};
    (void)state;
    for (size_t i = 0; i < sizeof azimuths / sizeof azimuths[0]; i++) {
        const struct planes_place place = {{8, 30, azimuths[i]}, .5, -.7, .7, .5, 0, 0};
        struct planes_pair pair;
        assert_true(depth_planes_make(&lab, &place, &pair));
        depth_planes_turn(&canvas, azimuths[i]);
        for (uint32_t pixel = 0; pixel < 32 * 16; pixel += 7) {
            const double right = (2. * (pixel % 32) + 1 - 32) / 16, up = (15 - 2. * (pixel / 32)) / 16;
            const double turn = azimuths[i] * 3.14159265358979323846 / 180;
            const double s = up * cos(turn) + right * sin(turn);
            const double d = 8 / (1 - s * tan(3.14159265358979323846 / 6));
            if (fabs(s) < 1) {
                assert_true(fabs(depth_planes_distance_m(&canvas, &pair.behind, pixel) / d - 1) < 1e-4);
            }
        }
    }
}

static uint32_t count_of(uint16_t colour)
{
    uint32_t n = 0;
    for (int i = 0; i < 32 * 16; i++) {
        n += canvas.pixels[i] == colour;
    }
    return n;
}

/* Half of the height and an eighth of the width: 8 x 8 pixels in the middle; the one in front 1 m nearer, twice as
 * large in the picture. */
static void the_nearer_plane_hides_the_other(void **state)
{
    struct planes_pair pair;
    const struct planes_place place = {{2.5, 0, 0}, 1.25, -.5, .5, .25, 0, 0};
    (void)state;
    assert_true(depth_planes_make(&lab, &place, &pair));
    depth_planes_draw(&canvas, &pair.behind, NULL);
    assert_true(count_of(PLANES_BEHIND) == 8 * 4 && count_of(PLANES_NONE) == 512 - 32);
    const uint32_t middle = 8 * 32 + 16, code = depth_planes_code(&canvas, middle);
    assert_true(fabs(code - depth_code_at(PH_DEPTH_FIXED24, &lab, 2.5)) <= 2);
    assert_int_equal(depth_planes_code(&canvas, 0), 0);
    depth_planes_draw(&canvas, NULL, &pair.front);
    assert_int_equal(count_of(PLANES_FRONT), 16 * 8);
    assert_true(fabs(depth_planes_code(&canvas, middle) - depth_code_at(PH_DEPTH_FIXED24, &lab, 1.25)) <= 2);
    for (uint8_t shading = 0; shading < DEPTH_SHADINGS; shading++) {
        canvas.shading = shading;
        depth_planes_draw(&canvas, &pair.front, &pair.behind); /* the other one is drawn first and hides it */
        assert_true(count_of(PLANES_BEHIND) == 16 * 8 && count_of(PLANES_FRONT) == 0);
        assert_ptr_equal(depth_planes_paint(&canvas, PLANES_FRONT)->shading, depth_shadings[shading]);
    }
}

static void codes_of_16_bits_are_read_as_such(void **state)
{
    struct planes_pair pair;
    const struct planes_place place = {{2.5, 0, 0}, 1, -1, 1, 2, 0, 0};
    (void)state;
    depth_planes_close(&canvas);
    assert_int_equal(depth_planes_open(&canvas, &lab, PH_DEPTH_FLOAT16), 0);
    assert_true(depth_planes_make(&lab, &place, &pair));
    depth_planes_draw(&canvas, &pair.behind, NULL);
    for (uint32_t i = 0; i < 512; i += 31) {
        assert_true(fabs(depth_planes_code(&canvas, i) - depth_code_at(PH_DEPTH_FLOAT16, &lab, 2.5)) <= 2);
    }
}

static void another_renderer(struct planes_canvas *c, const struct planes_quad *behind, const struct planes_quad *front)
{
    c->pixels[0] = behind == NULL && front != NULL ? 77 : 78;
}

static void another_renderer_may_draw(void **state)
{
    const struct planes_quad quad = {.ux = 1};
    (void)state;
    canvas.draw = another_renderer;
    depth_planes_draw(&canvas, NULL, &quad);
    assert_int_equal(canvas.pixels[0], 77);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(planes_lie_where_their_slopes_say, fresh, closed),
        cmocka_unit_test_setup_teardown(planes_outside_of_the_lens_are_refused, fresh, closed),
        cmocka_unit_test_setup_teardown(the_widest_place_ends_at_the_planes_and_the_borders, fresh, closed),
        cmocka_unit_test_setup_teardown(rays_meet_planes_where_trigonometry_says, fresh, closed),
        cmocka_unit_test_setup_teardown(the_nearer_plane_hides_the_other, fresh, closed),
        cmocka_unit_test_setup_teardown(codes_of_16_bits_are_read_as_such, fresh, closed),
        cmocka_unit_test_setup_teardown(another_renderer_may_draw, fresh, closed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
