/* fit: the camera that just sees all that turns, against points that are turned and projected in doubles. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "demo_scene.h"

#include <math.h>

#define PI 3.14159265358979323846

/* What a camera sees of points at all angles: the most of each side, and the nearest and farthest depth. */
struct seen {
    double left, right, top, bottom, nearest, farthest;
};

static struct seen look(const struct demo_fit *fit, const struct fx_vec3 *points, uint32_t count, struct fx_vec3 centre)
{
    struct seen s = {9, -9, -9, 9, 1e9, -1e9};
    const double scale_x = fit->projection.scale_x_q20 / 1048576., scale_y = fit->projection.scale_y_q20 / 1048576.,
                 shift = fit->projection.shift_y / 65536.;
    for (uint32_t i = 0; i < count * 256; i++) {
        const struct fx_vec3 q = points[i / 256];
        const double angle = i % 256 * PI / 128, x = (q.x - centre.x) / 65536., z = (q.z - centre.z) / 65536.;
        const double p[3] = {x * cos(angle) + z * sin(angle), (q.y - centre.y) / 65536.,
                             z * cos(angle) - x * sin(angle)};
        const int32_t *const t = &fit->view.t.x;
        double v[3];
        for (int row = 0; row < 3; row++) {
            const int32_t *const r = fit->view.r[row];
            v[row] = (r[0] * p[0] + r[1] * p[1] + r[2] * p[2]) / (1 << 30) + t[row] / 65536.;
        }
        const double depth = -v[2], right = v[0] * scale_x / depth, up = v[1] * scale_y / depth - shift;
        s.left = fmin(s.left, right), s.right = fmax(s.right, right);
        s.bottom = fmin(s.bottom, up), s.top = fmax(s.top, up);
        s.nearest = fmin(s.nearest, depth), s.farthest = fmax(s.farthest, depth);
    }
    return s;
}

static struct demo_fit fit_of(uint16_t width, uint16_t height, const struct fx_vec3 *points, uint32_t count,
                              struct fx_vec3 centre)
{
    const struct ph_mesh mesh = {.positions = points, .vertex_count = count};
    const struct demo_context context = {.width = width, .height = height};
    return demo_fit(&context, &mesh, 1, centre);
}

static const struct fx_vec3 box[] = {{-FX_ONE, -FX_ONE, -FX_ONE}, {FX_ONE, FX_ONE, FX_ONE}},
                            disc[] = {{FX_INT(3), 0, 0}, {0, FX_ONE / 8, FX_INT(2)}},
                            hat[] = {{FX_INT(3), FX_INT(3), 0}, {0, FX_INT(3), FX_INT(2)}},
                            bowl[] = {{FX_INT(3), FX_INT(-3), 0}, {0, FX_INT(-3), FX_INT(3)}},
                            pole[] = {{0, FX_INT(-4), 0}, {FX_ONE / 4, FX_INT(4), 0}}, origin = {0, 0, 0};

/* In the picture with its shift all lies within the borders; a sixteenth and what 20 degrees make of it is to spare. */
static void everything_is_seen_at_every_angle_and_nothing_smaller_is_needed(void **state)
{
    static const struct {
        const struct fx_vec3 *points;
        uint16_t width, height;
    } cases[] = {{box, 240, 240}, {box, 320, 240},  {box, 135, 240},  {disc, 240, 240}, {disc, 320, 170},
                 {disc, 80, 160}, {pole, 240, 240}, {pole, 320, 240}, {pole, 135, 240}, {hat, 240, 240},
                 {hat, 320, 240}, {hat, 80, 160},   {bowl, 240, 240}, {bowl, 320, 120}, {bowl, 80, 160}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct demo_fit fit = fit_of(cases[i].width, cases[i].height, cases[i].points, 2, origin);
        const struct seen s = look(&fit, cases[i].points, 2, origin);
        assert_true(s.left > -1 && s.right < 1 && s.top < 1);
        const double shift = fit.projection.shift_y / 65536.; /* without which the centre is in the middle */
        const double most = fmax(fmax(s.right, -s.left), fmax(s.top + shift, -s.bottom - shift));
        assert_true(most > .6);
        assert_true(s.nearest > fit.projection.near_z / 65536. && s.farthest < fit.projection.far_z / 65536.);
        assert_true(fit.projection.near_z > 0);
        assert_int_equal(fit.projection.kind, PH_PERSPECTIVE);
    }
}

/* Looking down from 20 degrees at the origin: the third row of the view is 0, sin, cos. */
static void the_camera_looks_down_from_20_degrees(void **state)
{
    (void)state;
    const struct demo_fit fit = fit_of(240, 240, box, 2, origin);
    assert_true(fabs(fit.view.r[2][1] / 1073741824. - sin(PI / 9)) < 1e-4 && fit.view.r[2][0] == 0);
    assert_true(fit.view.t.x == 0 && fit.view.t.z < 0);
    assert_true(fabs(fit.projection.scale_y_q20 / 1048576. - 1 / tan(PI / 9)) < 1e-4);
}

static void radius_and_bottom_are_those_of_the_points(void **state)
{
    static const struct fx_vec3 points[] = {{FX_INT(6), FX_INT(5), FX_INT(7)}, {FX_INT(2), FX_INT(9), FX_INT(3)}},
                                centre = {FX_INT(2), FX_INT(6), FX_INT(4)};
    (void)state;
    const struct demo_fit fit = fit_of(240, 240, points, 2, centre);
    assert_true(fabs(fit.radius / 65536. - 5) < 1e-3); /* 4 and 3 from the axis */
    assert_int_equal(fit.bottom, -FX_ONE);
    const struct seen s = look(&fit, points, 2, centre);
    assert_true(s.left > -1 && s.right < 1 && s.top < 1);
    const struct demo_fit high = fit_of(240, 240, &points[1], 1, centre); /* above the centre: the bottom is 0 */
    assert_int_equal(high.bottom, 0);
}

/* A flat thing leaves room above: the picture moves, until the margins are the same or the sixteenth above is reached.
 */
static void the_picture_moves_up_into_the_room_above(void **state)
{
    (void)state;
    const struct demo_fit fit = fit_of(240, 240, disc, 2, origin);
    const struct seen s = look(&fit, disc, 2, origin);
    assert_true(fit.projection.shift_y <= 0);
    assert_true(s.top <= 1 - 1 / 16. + .01 || fit.projection.shift_y == 0);
    assert_true(fabs(s.top + s.bottom) < .2 || fit.projection.shift_y == 0);
}

static void a_point_and_what_is_very_large_give_a_camera(void **state)
{
    static const struct fx_vec3 huge[] = {{FX_MAX, FX_MAX, FX_MAX}, {FX_MIN, FX_MIN, FX_MIN}};
    (void)state;
    struct demo_fit fit = fit_of(240, 240, &origin, 1, origin);
    assert_true(fit.projection.near_z > 0 && fit.projection.far_z > fit.projection.near_z && fit.radius == 0);
    fit = fit_of(240, 240, huge, 2, origin);
    assert_true(fit.projection.near_z > 0 && fit.projection.far_z > fit.projection.near_z);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everything_is_seen_at_every_angle_and_nothing_smaller_is_needed),
        cmocka_unit_test(the_camera_looks_down_from_20_degrees),
        cmocka_unit_test(radius_and_bottom_are_those_of_the_points),
        cmocka_unit_test(the_picture_moves_up_into_the_room_above),
        cmocka_unit_test(a_point_and_what_is_very_large_give_a_camera),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
