/*
 * Physical checks of the demos hitchcock, ball and parallel: sizes and vanishing points are measured in rendered
 * pixels, and the ball's places are compared with the laws of reflection in double precision.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "demo_scene.h"
#include "demo_stage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Hitchcock's zoom -------------------------------------------------------------------------------------------- */

/* Red and blue of a pixel, 0 .. 31. */
static int red(uint16_t wire)
{
    uint8_t bytes[2];
    memcpy(bytes, &wire, 2);
    return bytes[0] >> 3;
}

static int blue(uint16_t wire)
{
    uint8_t bytes[2];
    memcpy(bytes, &wire, 2);
    return bytes[1] & 31;
}

/* The first and the last row in which two pictures differ. */
static int rows_that_differ(const uint16_t *a, const uint16_t *b, int width, int height, int *first)
{
    int last = -1;
    *first = -1;
    for (int i = 0; i < width * height; i++) {
        if (a[i] != b[i]) {
            *first = *first < 0 ? i / width : *first;
            last = i / width;
        }
    }
    return last;
}

/*
 * The top is what changes when it spins: the same place of the camera at frame f and at loop - f, the top turned
 * differently. Its stripes look the same every 8 frames, so odd frames do. The tips are a pixel wide: one may be
 * missed.
 */
static void the_subject_keeps_its_height_within_a_pixel_over_the_whole_path(void **state)
{
    (void)state;
    const struct demo *const demo = demo_find("hitchcock");
    struct demo_stage s = demo_stage_open(demo, 240, 240);
    uint16_t *const other = malloc(sizeof(*other) * 240 * 240);
    assert_non_null(other);
    int low = 1000, high = 0, tops = 1000, bottoms = 0;
    for (uint32_t frame = 3; frame < demo->loop_frames / 2; frame += 2) {
        int first;
        demo_stage_frame(&s, demo->loop_frames - frame);
        memcpy(other, s.rig.pixels, sizeof(*other) * 240 * 240);
        demo_stage_frame(&s, frame);
        const int last = rows_that_differ(s.rig.pixels, other, 240, 240, &first);
        const int height = last - first + 1;
        low = height < low ? height : low;
        high = height > high ? height : high;
        tops = first < tops ? first : tops;
        bottoms = last > bottoms ? last : bottoms;
    }
    if (high - low > 1 || bottoms - tops + 1 - low > 1) {
        fail_msg("the top is %d .. %d rows high, rows %d .. %d", low, high, tops, bottoms);
    }
    assert_in_range(low, 240 * 24 / 35 - 3, 240 * 24 / 35 + 1); /* 2.4 of the 3.5 units that are seen */
    free(other);
    demo_stage_close(&s);
}

static int sky_pixels(struct demo_stage *s, uint32_t frame)
{
    int count = 0;
    demo_stage_frame(s, frame);
    for (int i = 0; i < s->rig.width * s->rig.height; i++) {
        count += s->rig.pixels[i] == s->rig.r.background;
    }
    return count;
}

/* Meanwhile the background grows: the columns hide the sky. */
static void the_background_does_not_keep_its_size(void **state)
{
    (void)state;
    struct demo_stage s = demo_stage_open(demo_find("hitchcock"), 240, 240);
    assert_true(sky_pixels(&s, 1024) < sky_pixels(&s, 0) * 3 / 4);
    demo_stage_close(&s);
}

/* LMU: 1000 equal steps from 2.5 to 18 units, and 1000 back. */
static void the_camera_takes_1000_equal_steps_forth_and_back(void **state)
{
    (void)state;
    struct demo_stage s = demo_stage_open(demo_find("hitchcock"), 32, 32);
    for (int frame = 0; frame < 2048; frame++) {
        const int step = frame < 1000 ? frame : frame < 1048 ? 1000 : 2048 - frame;
        demo_stage_frame(&s, (uint32_t)frame);
        assert_true(fabs(ldexp(-s.rig.r.view.t.z, -16) - (2.5 + 15.5 * step / 1000)) < 2e-5);
    }
    demo_stage_close(&s);
}

/* ---- zoom and dolly ---------------------------------------------------------------------------------------------- */

/* The row of the top's upper tip in column x: above it there is nothing but sky and the label's 8 rows. */
static int tip_row(const struct demo_stage *s, int x, int from)
{
    while (pixel(s, x, from) == s->rig.r.background) {
        from++;
    }
    return from;
}

/* HAW: zooming keeps the place, dollying the field of view. Both see 3.2 to 4.5 units at the distance of the top, whose
 * tip is 1.2 above the eye. Two lines of labels take the upper 20 of 240 rows. Plain: without labels. */
static void zoom_and_dolly_show_the_top_in_one_size_and_the_columns_in_two(void **state)
{
    (void)state;
    struct demo plain = *demo_find("zoom");
    plain.band = NULL;
    struct demo_stage s = demo_stage_open(demo_find("zoom"), 480, 240);
    s.demo = &plain;
    for (int frame = 0; frame < 256; frame += 5) {
        const double swing = (1 - cos(2 * acos(-1) * frame / 256)) / 2, seen = 3.2 + 1.3 * swing;
        demo_stage_frame(&s, (uint32_t)frame);
        const double tip = 130 - 220 / seen * 1.2;
        assert_true(fabs(tip_row(&s, 120, 0) - tip) < 3 && fabs(tip_row(&s, 360, 0) - tip) < 3);
        assert_int_equal(s.rig.r.stats.triangles_dropped, 0);
        /* the camera of the second half, set last, is the one that moves: 60 degrees, seen / (2 tan 30) away */
        assert_true(fabs(ldexp(-s.rig.r.view.t.z, -16) - seen / 2 / tan(acos(-1) / 6)) < 1e-4);
        assert_true(fabs(ldexp(s.rig.r.projection.scale_y_q20, -20) - 220. / 240 / tan(acos(-1) / 6)) < 1e-5);
        /* the nearest column, from 1.4 beside the axis and 2 behind the top: nearer to it from afar */
        int zoomed = 120, dollied = 360;
        while (zoomed > 1 && pixel(&s, zoomed - 1, 130) != s.rig.r.background) {
            zoomed--;
        }
        while (dollied > 241 && pixel(&s, dollied - 1, 130) != s.rig.r.background) {
            dollied--;
        }
        assert_true(120 - zoomed > 360 - dollied);
        assert_true(zoomed > 1 && dollied > 241); /* no half reaches into the other */
    }
    demo_stage_close(&s);
}

/* ---- the ball ---------------------------------------------------------------------------------------------------- */

struct point {
    double x, y, z;
};

static struct point ball(uint32_t frame)
{
    struct demo_ball_way way;
    demo_ball_run(&way);
    const struct fx_vec3 p = demo_ball_position(&way, frame);
    return (struct point){p.x / 65536., p.y / 65536., p.z / 65536.};
}

static struct point minus(struct point a, struct point b)
{
    return (struct point){a.x - b.x, a.y - b.y, a.z - b.z};
}

static double length(struct point a)
{
    return sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

/* HAW: h_c = 2 |z_c| tan(fov / 2), w_c = a h_c; here both are 2 |z|. Distance of the ball's surface from a wall. */
static double clearance(struct point p)
{
    const double radius = DEMO_BALL_RADIUS / 65536.;
    const double side = (-p.z - fmax(fabs(p.x), fabs(p.y))) / sqrt(2);
    return fmin(side, fmin(-p.z - 1, 4 + p.z)) - radius;
}

/* From outside the whole frustum is seen, so that nothing is drawn on the outermost pixels. */
static void the_frustum_of_the_ball_is_whole_in_every_picture(void **state)
{
    (void)state;
    static const uint16_t sizes[][2] = {{240, 240}, {135, 240}, {128, 64}, {80, 160}};
    for (size_t i = 0; i < 4; i++) {
        struct demo_stage s = demo_stage_open(demo_find("ball"), sizes[i][0], sizes[i][1]);
        for (uint32_t frame = 0; frame < 512; frame += 16) {
            demo_stage_frame(&s, frame);
            for (int x = 0; x < sizes[i][0]; x++) {
                assert_int_equal(pixel(&s, x, 0), s.rig.r.background);
                assert_int_equal(pixel(&s, x, sizes[i][1] - 1), s.rig.r.background);
            }
            for (int y = 0; y < sizes[i][1]; y++) {
                assert_int_equal(pixel(&s, 0, y), s.rig.r.background);
                assert_int_equal(pixel(&s, sizes[i][0] - 1, y), s.rig.r.background);
            }
        }
        demo_stage_close(&s);
    }
}

static void the_ball_never_leaves_the_frustum_in_10000_frames(void **state)
{
    (void)state;
    double closest = 1;
    for (uint32_t frame = 0; frame < 10000; frame++) {
        const double now = clearance(ball(frame));
        closest = now < closest ? now : closest;
        if (now < -4 / 65536.) {
            fail_msg("frame %u: %f outside", frame, -now);
        }
    }
    assert_true(closest < .02); /* and it touches the walls */
}

/* In a frame without reflection the ball moves by v. In a frame with one its way has a corner, so the chord is shorter.
 */
static void the_ball_keeps_its_speed_in_10000_frames(void **state)
{
    (void)state;
    const double v = length(minus(ball(2), ball(1)));
    int straight = 0;
    for (uint32_t frame = 0; frame < 10000; frame++) {
        const struct point a = ball(frame), b = ball(frame + 1), c = ball(frame + 2);
        const double step = length(minus(b, a));
        const double turn = length(minus(minus(c, b), minus(b, a)));
        if (step > v + 4 / 65536.) {
            fail_msg("frame %u: moved %f instead of %f", frame, step, v);
        }
        if (turn < 8 / 65536.) {
            assert_true(fabs(step - v) < 4 / 65536.);
            straight++;
        } else {
            assert_true(clearance(b) < v || clearance(a) < v || clearance(c) < v); /* it turns at walls only */
        }
    }
    assert_true(straight > 9000);
}

/* n of the wall that is nearest to p. */
static struct point normal_at(struct point p)
{
    const double half = sqrt(.5);
    const struct point normals[6] = {{-half, 0, -half}, {half, 0, -half}, {0, -half, -half},
                                     {0, half, -half},  {0, 0, -1},       {0, 0, 1}};
    const double distances[6] = {
        (-p.z - p.x) * half, (-p.z + p.x) * half, (-p.z - p.y) * half, (-p.z + p.y) * half, -p.z - 1, 4 + p.z};
    int nearest = 0;
    for (int i = 1; i < 6; i++) {
        nearest = distances[i] < distances[nearest] ? i : nearest;
    }
    return normals[nearest];
}

/* Before and after a reflection: out = in - 2 (in.n) n. */
static void the_ball_is_reflected_by_the_law(void **state)
{
    (void)state;
    int reflections = 0;
    for (uint32_t frame = 0; frame < 512; frame++) {
        const struct point in = minus(ball(frame + 1), ball(frame));
        const struct point out = minus(ball(frame + 3), ball(frame + 2));
        const struct point broken = minus(ball(frame + 2), ball(frame + 1));
        if (length(minus(broken, in)) < .001 || length(minus(broken, out)) < .001) {
            continue;
        }
        const struct point n = normal_at(ball(frame + 1));
        const double along = 2 * (in.x * n.x + in.y * n.y + in.z * n.z);
        const struct point want = {in.x - along * n.x, in.y - along * n.y, in.z - along * n.z};
        assert_true(length(minus(out, want)) < 8 / 65536.);
        reflections++;
    }
    assert_true(reflections >= 6);
}

/* ---- the vanishing point ----------------------------------------------------------------------------------------- */

static bool is_colour(uint16_t wire, uint8_t r, uint8_t g, uint8_t b)
{
    return wire == ph_rgb565(r, g, b);
}

/* A line x = at + slope y through the middles of pixels, least squares. */
struct fit {
    double n, y, x, yy, xy;
};

static void fit_add(struct fit *f, double x, double y)
{
    f->n++;
    f->x += x;
    f->y += y;
    f->yy += y * y;
    f->xy += x * y;
}

static double fit_slope(const struct fit *f)
{
    return (f->n * f->xy - f->x * f->y) / (f->n * f->yy - f->y * f->y);
}

static double fit_at(const struct fit *f, double y)
{
    return f->x / f->n + fit_slope(f) * (y - f->y / f->n);
}

/* The left and the right rail in columns from .. to of the picture. */
static void fit_rails(const struct demo_stage *s, int from, int to, struct fit rails[2])
{
    memset(rails, 0, 2 * sizeof(*rails));
    for (int y = 0; y < s->rig.height; y++) {
        for (int x = from; x < to; x++) {
            if (is_colour(pixel(s, x, y), DEMO_RAIL_COLOUR)) {
                fit_add(&rails[x > (from + to) / 2], x + .5, y + .5);
            }
        }
    }
    assert_true(rails[0].n > 20 && rails[1].n > 20);
}

static void find_cross(const struct demo_stage *s, double *x, double *y)
{
    int x0 = 1000, x1 = 0, y0 = 1000, y1 = 0;
    for (int i = 0; i < s->rig.width * s->rig.height; i++) {
        if (is_colour(s->rig.pixels[i], DEMO_MARK_COLOUR)) {
            const int column = i % s->rig.width, row = i / s->rig.width;
            x0 = column < x0 ? column : x0;
            x1 = column > x1 ? column : x1;
            y0 = row < y0 ? row : y0;
            y1 = row > y1 ? row : y1;
        }
    }
    assert_true(x1 > x0 + 3 && y1 > y0 + 3);
    *x = (x0 + x1 + 1) / 2.;
    *y = (y0 + y1 + 1) / 2.;
}

static void the_rails_meet_in_the_marked_point_within_a_pixel(void **state)
{
    (void)state;
    static const uint16_t sizes[][2] = {{240, 240}, {320, 240}, {480, 320}};
    for (size_t i = 0; i < 3; i++) {
        struct demo_stage s = demo_stage_open(demo_find("parallel"), sizes[i][0], sizes[i][1]);
        struct fit rails[2];
        double x, y;
        demo_stage_frame(&s, 96); /* the car is far away */
        find_cross(&s, &x, &y);
        fit_rails(&s, s.rig.width / 2, s.rig.width, rails);
        const double slopes = fit_slope(&rails[1]) - fit_slope(&rails[0]);
        const double meet_y = y - (fit_at(&rails[1], y) - fit_at(&rails[0], y)) / slopes;
        const double meet_x = fit_at(&rails[0], meet_y);
        if (fabs(meet_x - x) > 1 || fabs(meet_y - y) > 1) {
            fail_msg("the rails meet in %.2f, %.2f, the cross is at %.2f, %.2f", meet_x, meet_y, x, y);
        }
        demo_stage_close(&s);
    }
}

static void the_rails_are_parallel_in_the_orthographic_half(void **state)
{
    (void)state;
    struct demo_stage s = demo_stage_open(demo_find("parallel"), 240, 240);
    struct fit rails[2];
    demo_stage_frame(&s, 96);
    fit_rails(&s, 0, s.rig.width / 2, rails);
    const double apart = fit_at(&rails[1], 0) - fit_at(&rails[0], 0);
    assert_true(fabs(fit_at(&rails[1], 240) - fit_at(&rails[0], 240) - apart) < .5 && apart > 20);
    demo_stage_close(&s);
}

/* Only the orthographic projection shows the far car as large as the near one. */
static int orange_pixels(struct demo_stage *s, uint32_t frame, int from, int to)
{
    int count = 0;
    demo_stage_frame(s, frame);
    for (int y = 0; y < s->rig.height; y++) {
        for (int x = from; x < to; x++) {
            const uint16_t p = pixel(s, x, y);
            count += red(p) > 14 && blue(p) < red(p) / 3;
        }
    }
    return count;
}

static void distance_changes_sizes_under_perspective_only(void **state)
{
    (void)state;
    struct demo_stage s = demo_stage_open(demo_find("parallel"), 240, 240);
    const int near_flat = orange_pixels(&s, 224, 0, 120);
    const int far_flat = orange_pixels(&s, 96, 0, 120);
    const int near_deep = orange_pixels(&s, 224, 120, 240);
    const int far_deep = orange_pixels(&s, 96, 120, 240);
    assert_true(near_flat > 500 && abs(near_flat - far_flat) < near_flat / 20);
    assert_true(far_deep > 20 && far_deep * 4 < near_deep);
    demo_stage_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_subject_keeps_its_height_within_a_pixel_over_the_whole_path),
        cmocka_unit_test(the_background_does_not_keep_its_size),
        cmocka_unit_test(the_camera_takes_1000_equal_steps_forth_and_back),
        cmocka_unit_test(zoom_and_dolly_show_the_top_in_one_size_and_the_columns_in_two),
        cmocka_unit_test(the_frustum_of_the_ball_is_whole_in_every_picture),
        cmocka_unit_test(the_ball_never_leaves_the_frustum_in_10000_frames),
        cmocka_unit_test(the_ball_keeps_its_speed_in_10000_frames),
        cmocka_unit_test(the_ball_is_reflected_by_the_law),
        cmocka_unit_test(the_rails_meet_in_the_marked_point_within_a_pixel),
        cmocka_unit_test(the_rails_are_parallel_in_the_orthographic_half),
        cmocka_unit_test(distance_changes_sizes_under_perspective_only),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
