/* depth_planes_count: what is counted of pictures that the test draws, and where the sweep ends for a renderer that is
 * right from a known separation on. */
#include "depth_planes_count.h"
#include "depth_separation.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static struct depth_lab lab;
static struct planes_canvas canvas;

static int fresh(void **state)
{
    (void)state;
    lab = (struct depth_lab){.near_z = FX_ONE, .far_z = FX_INT(64), .fov_deg = FX_INT(90), .width = 16, .height = 16};
    return depth_planes_open(&canvas, &lab, PH_DEPTH_FIXED16);
}

static int closed(void **state)
{
    (void)state;
    depth_planes_close(&canvas);
    return 0;
}

/* ---- counting --------------------------------------------------------------------------------------------------- */

/* The plane behind covers pixels 0 to 99, the one in front 50 to 149; where both are, each third shows the one behind.
 */
static void draw_known(struct planes_canvas *c, const struct planes_quad *behind, const struct planes_quad *front)
{
    for (int i = 0; i < 256; i++) {
        const bool has_behind = behind != NULL && i < 100, has_front = front != NULL && i >= 50 && i < 150;
        c->pixels[i] = has_behind && (!has_front || i % 3 == 0) ? PLANES_BEHIND
                       : has_front                              ? PLANES_FRONT
                                                                : PLANES_NONE;
    }
}

static void pixels_that_show_the_farther_plane_are_counted(void **state)
{
    static uint8_t verdicts[256];
    struct planes_pair pair;
    const struct planes_place place = {{8, 0, 0}, 1, -.5, .5, .5, 0, 0};
    (void)state;
    canvas.draw = draw_known;
    assert_true(depth_planes_make(&lab, &place, &pair));
    for (int is_turned = 0; is_turned < 2; is_turned++) {
        const struct planes_pair turned = {pair.front, pair.behind};
        const struct planes_count n = depth_planes_count(&canvas, is_turned ? &turned : &pair, verdicts);
        assert_int_equal(n.samples, 50);
        assert_int_equal(n.wrong, is_turned ? 33 : 17); /* 51, 54 .. 99 */
        for (int i = 0; i < 256; i++) {
            const bool is_both = i >= 50 && i < 100, is_wrong = (i % 3 == 0) != (is_turned == 1);
            assert_int_equal(verdicts[i], !is_both ? PLANES_UNCOUNTED : is_wrong ? PLANES_WRONG : PLANES_RIGHT);
        }
    }
}

/* ---- the sweep -------------------------------------------------------------------------------------------------- */

static double needed_m;
static unsigned whole, small, tiny; /* planes by their width */
static unsigned all, at_edge;       /* ... of one tilt; those near the edge of the picture at which they are nearest */
static struct planes_lean leaning;

/* The middle of the farther edge of a plane that leans as `leaning` lies beyond 6/10 of the picture, and in it, and is
 * as far away as was asked for. The picture's half is 1. */
static bool is_at_edge(const struct planes_quad *quad)
{
    const bool is_upper = leaning.tilt_deg > 0;
    const double z = -(double)(quad->a.z + (is_upper ? quad->vz : 0));
    const double along = (quad->a.y + (is_upper ? quad->vy : 0)) / z, across = (quad->a.x + quad->ux / 2) / z;
    const double a = depth_radians(leaning.azimuth_deg), right = across * cos(a) + along * sin(a),
                 up = along * cos(a) - across * sin(a);
    return (is_upper ? -along : along) > 0.6 && fabs(right) < 1 && fabs(up) < 1 &&
           fabs(z / 65536 - leaning.at_m) < leaning.at_m / 16;
}

/* Everything is covered; the plane in front shows where it is far enough from the other one. */
static void draw_above(struct planes_canvas *c, const struct planes_quad *behind, const struct planes_quad *front)
{
    uint16_t colour = behind != NULL ? PLANES_BEHIND : PLANES_FRONT;
    if (behind != NULL && front != NULL) {
        const struct planes_pair pair = {*behind, *front};
        colour = depth_planes_separation_m(&pair) >= needed_m ? PLANES_FRONT : PLANES_BEHIND;
        whole += behind->ux > FX_INT(8);
        small += behind->ux > FX_INT(3) && behind->ux <= FX_INT(8);
        tiny += behind->ux <= FX_INT(3);
        all++;
        at_edge += is_at_edge(behind);
    }
    for (int i = 0; i < c->lab->width * c->lab->height; i++) {
        c->pixels[i] = colour;
    }
}

static void the_sweep_finds_the_separation_that_is_needed(void **state)
{
    static const double tilts[] = {0, 40, -40}, azimuths[] = {0, NAN};
    (void)state;
    canvas.draw = draw_above;
    for (int i = 0; i < 6; i++) {
        const struct planes_lean lean = {8, tilts[i % 3], azimuths[i / 3]};
        for (needed_m = .003; needed_m < .4; needed_m *= 3.7) {
            const struct planes_sweep sweep = depth_planes_sweep(&canvas, PH_DEPTH_FIXED16, lean);
            assert_true(sweep.measured_m >= needed_m);
            assert_true(sweep.measured_m <= needed_m * exp2(1 / 16.) + 3 / 65536.);
        }
    }
}

/* Below S_min the sweep goes on as long as planes can be told apart at all, which is a step of Q16.16. */
static void a_perfect_renderer_needs_next_to_nothing(void **state)
{
    (void)state;
    canvas.draw = draw_above;
    needed_m = 0;
    const struct planes_sweep sweep = depth_planes_sweep(&canvas, PH_DEPTH_FIXED16, (struct planes_lean){8, 0, 0});
    assert_true(sweep.measured_m <= 2 / 65536.);
    lab.near_z = 131; /* 2 mm: S_min is longer than the way to the planes */
    needed_m = .05;
    const struct planes_sweep coarse = depth_planes_sweep(&canvas, PH_DEPTH_FIXED16, (struct planes_lean){60, 0, 0});
    assert_true(2 * coarse.s_min_m > 60 && coarse.measured_m >= .05 && coarse.measured_m < .0525);
    needed_m = HUGE_VAL;
    assert_true(isinf(depth_planes_sweep(&canvas, PH_DEPTH_FIXED16, (struct planes_lean){8, 0, 0}).measured_m));
}

/* 64 x 64 pixels 8 m away are 16 m; 24 pixels are 6 m, and 6 are 1.5 m: of 24 places 12, 9 and 3. */
static void half_of_the_places_are_small_and_an_eighth_tiny(void **state)
{
    (void)state;
    depth_planes_close(&canvas);
    lab.width = lab.height = 64;
    assert_int_equal(depth_planes_open(&canvas, &lab, PH_DEPTH_FIXED16), 0);
    canvas.draw = draw_above;
    needed_m = 0;
    whole = small = tiny = 0;
    depth_planes_sweep(&canvas, PH_DEPTH_FIXED16, (struct planes_lean){8, 0, 0});
    assert_true(tiny > 0);
    assert_in_range(whole, 4 * tiny - 12, 4 * tiny + 12);
    assert_in_range(small, 3 * tiny - 12, 3 * tiny + 12);
}

/* There rays meet the planes most steeply, and a step of depth is longest along their normal. */
static void a_quarter_of_the_places_lie_at_the_edge(void **state)
{
    static const double azimuths[] = {0, 30, 45, 200, -75};
    (void)state;
    depth_planes_close(&canvas);
    lab.width = lab.height = 64;
    assert_int_equal(depth_planes_open(&canvas, &lab, PH_DEPTH_FIXED16), 0);
    canvas.draw = draw_above;
    needed_m = 0;
    for (size_t i = 0; i < 2 * sizeof azimuths / sizeof azimuths[0]; i++) {
        leaning = (struct planes_lean){20, i % 2 == 0 ? 40 : -40, azimuths[i / 2]};
        all = at_edge = 0;
        depth_planes_sweep(&canvas, PH_DEPTH_FIXED16, leaning);
        assert_true(all > 0);
        assert_in_range(4 * at_edge, all - 24, all + 24);
    }
}

/* ---- predictions ------------------------------------------------------------------------------------------------ */

static void predictions_are_steps_along_the_normal(void **state)
{
    (void)state;
    const double step = depth_step_m(PH_DEPTH_FIXED16, &lab, 8);
    assert_true(fabs(depth_planes_predicted_m(&lab, PH_DEPTH_FIXED16, 8, .3, 0) - step) < 1e-12);
    /* a pixel's slope is 1/8, and 1/256 of it 8 m away */
    const double half = sqrt(.5), up = 8 / 8. / 256;
    assert_true(fabs(depth_planes_predicted_m(&lab, PH_DEPTH_FIXED16, 8, -.5, 45) - (step * half * 1.5 + up * half)) <
                1e-12);
    assert_true(fabs(depth_planes_predicted_m(&lab, PH_DEPTH_FIXED16, 8, -.5, -45) - (step * half * .5 + up * half)) <
                1e-12);
}

/* Planes that face the camera: S_min = hypot(s_xy + s_z tan phi, s_z), phi to a corner of the picture. */
static void what_is_predicted_of_facing_planes_is_that_of_their_distance(void **state)
{
    (void)state;
    canvas.draw = draw_above;
    needed_m = .05;
    const struct planes_sweep sweep = depth_planes_sweep(&canvas, PH_DEPTH_FIXED16, (struct planes_lean){8, 0, 0});
    const double s_z = depth_step_m(PH_DEPTH_FIXED16, &lab, 8), s_xy = sqrt(2) * 8 / 8. / 256;
    assert_true(fabs(sweep.s_min_m - hypot(s_xy + s_z * sqrt(2), s_z)) < 1e-12);
    assert_true(fabs(sweep.at_tilt_m - s_z) < 1e-12);
    assert_true(sweep.bound_m == depth_separation_m(PH_DEPTH_FIXED16, &lab, 8, 0, depth_way_px(&lab)));
    const struct planes_sweep tilted = depth_planes_sweep(&canvas, PH_DEPTH_FIXED16, (struct planes_lean){8, 40, 0}),
                              back = depth_planes_sweep(&canvas, PH_DEPTH_FIXED16, (struct planes_lean){8, -40, 0});
    /* at the edge a ray's slope is 1 */
    assert_true(fabs(tilted.at_tilt_m - depth_planes_predicted_m(&lab, PH_DEPTH_FIXED16, 8, -1, 40)) < 1e-12);
    assert_true(tilted.bound_m > tilted.at_tilt_m && tilted.bound_m == back.bound_m && tilted.s_min_m == back.s_min_m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(pixels_that_show_the_farther_plane_are_counted, fresh, closed),
        cmocka_unit_test_setup_teardown(the_sweep_finds_the_separation_that_is_needed, fresh, closed),
        cmocka_unit_test_setup_teardown(a_perfect_renderer_needs_next_to_nothing, fresh, closed),
        cmocka_unit_test_setup_teardown(half_of_the_places_are_small_and_an_eighth_tiny, fresh, closed),
        cmocka_unit_test_setup_teardown(a_quarter_of_the_places_lie_at_the_edge, fresh, closed),
        cmocka_unit_test_setup_teardown(predictions_are_steps_along_the_normal, fresh, closed),
        cmocka_unit_test_setup_teardown(what_is_predicted_of_facing_planes_is_that_of_their_distance, fresh, closed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
