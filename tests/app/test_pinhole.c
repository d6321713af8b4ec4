/*
 * pinhole: the images of the house, and the lines in normalized device coordinates, from similar triangles in double
 * precision. A point at (x, y, z) before the hole is seen on the wall 1.5 behind it at 1.5 / z (x, y), upside down, and
 * on the plane before the hole at -1.5 / z (x, y). (K. Juenemann, HAW Hamburg, chapter 9; course 4600, notes 4.1.)
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "demo_stage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIZE 480

/* Whether a pixel within 1 px of where the point is seen has the colour. */
static bool shows(const struct demo_stage *s, const double p[3], uint16_t colour, double *row)
{
    double v[3];
    for (int i = 0; i < 3; i++) {
        const fx_t t = i == 0 ? s->rig.r.view.t.x : i == 1 ? s->rig.r.view.t.y : s->rig.r.view.t.z;
        v[i] = t / 65536.;
        for (int k = 0; k < 3; k++) {
            v[i] += ldexp(s->rig.r.view.r[i][k], -30) * p[k];
        }
    }
    const double focal = ldexp(s->rig.r.projection.scale_y_q20, -20) * SIZE / 2;
    const int x = (int)(SIZE / 2. + focal * v[0] / -v[2]), y = (int)(SIZE / 2. - focal * v[1] / -v[2]);
    *row = y;
    for (int i = 0; i < 9; i++) {
        if (pixel(s, x + i % 3 - 1, y + i / 3 - 1) == colour) {
            return true;
        }
    }
    return false;
}

/* The house turns about its axis at z = -3.2 by up to 22.5 degrees. A point of the roof and one of the door. */
static void the_image_is_upside_down_behind_the_hole_and_upright_before_it(void **state)
{
    (void)state;
    static const double points[2][2] = {{0, .6}, {-.34, -.5}};
    const uint16_t colours[2] = {ph_rgb565(225, 70, 50), ph_rgb565(60, 110, 200)};
    struct demo_stage s = demo_stage_open(demo_find("pinhole"), SIZE, SIZE);
    for (uint32_t frame = 0; frame < 256; frame += 16) {
        const double sway = 2 * acos(-1) / 16 * sin(2 * acos(-1) * (frame + 32) / 256);
        double rows[2][2];
        demo_stage_frame(&s, frame);
        for (int k = 0; k < 4; k++) {
            const int i = k / 2, behind = k % 2;
            const double at[3] = {points[i][0] * cos(sway), points[i][1], -3.2 - points[i][0] * sin(sway)};
            const double share = (behind ? 1.5 : -1.5) / at[2];
            const double image[3] = {at[0] * share, at[1] * share, at[2] * share};
            if (!shows(&s, image, colours[i], &rows[behind][i])) {
                fail_msg("frame %u: point %d %s the hole is not at row %.0f", frame, i, behind ? "behind" : "before",
                         rows[behind][i]);
            }
        }
        assert_true(rows[0][0] < rows[0][1] && rows[1][0] > rows[1][1]); /* before: roof above door; behind: below */
    }
    demo_stage_close(&s);
}

/* How far the highest and the lowest pixel of a colour in columns x0 .. x1 - 1 are off the line between its ends. */
static double bend(const struct demo_stage *s, uint16_t colour, int x0, int x1)
{
    double first[2] = {-1, 0}, last[2] = {0, 0}, most = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (int x = x0; x < x1; x++) {
            for (int y = 0; y < s->rig.height; y++) {
                if (pixel(s, x, y) != colour) {
                    continue;
                }
                if (pass == 1) {
                    const double on = first[1] + (last[1] - first[1]) * (x - first[0]) / (last[0] - first[0]);
                    most = fmax(most, fabs(y - on));
                } else if (first[0] < 0) {
                    first[0] = x;
                    first[1] = y;
                } else {
                    last[0] = x;
                    last[1] = y;
                }
            }
        }
    }
    if (last[0] - first[0] < 100) {
        fail_msg("%04X from %.0f to %.0f in %d..%d", colour, first[0], last[0], x0, x1);
    }
    return most;
}

/* y goes from y0 at the near plane (1) to y1 at the far plane (8): with z kept, y / z is off the chord by this much. */
static double curve(double y0, double y1)
{
    double most = 0;
    for (int i = 0; i <= 100; i++) {
        const double t = i / 100.;
        most = fmax(most, fabs((y0 + (y1 - y0) * t) / (1 + 7 * t) - (y0 + (y1 / 8 - y0) * t)));
    }
    return most;
}

static void z_kept_bends_lines_and_a_plus_b_over_z_does_not(void **state)
{
    (void)state;
    const uint16_t colours[4] = {ph_rgb565(255, 150, 60), ph_rgb565(250, 220, 90), ph_rgb565(120, 230, 120),
                                 ph_rgb565(110, 180, 255)};
    struct demo_stage s = demo_stage_open(demo_find("pinhole"), SIZE, SIZE / 2);
    s.context.view = "depth";
    for (uint32_t frame = 0; frame < 256; frame += 32) {
        const double swing = (1 - cos(2 * acos(-1) * frame / 256)) / 2;
        demo_stage_frame(&s, frame);
        for (int i = 0; i < 4; i++) {
            const double y0 = .3 * (2 * i - 3), y1 = y0 * (1 + 5 * swing) - 1;
            const double naive = bend(&s, colours[i], 0, SIZE / 2), right = bend(&s, colours[i], SIZE / 2, SIZE);
            const double want = curve(y0, y1) * .8 * SIZE / 4;
            if (right > 2 || fabs(naive - want) > 2.5) {
                fail_msg("frame %u, line %d: bent by %.1f px, should be %.1f; and %.1f px with a + b/z", frame, i,
                         naive, want, right);
            }
        }
    }
    demo_stage_close(&s);
}

/*
 * The plane through (0, 0, -1.5) is turned by 20 degrees sin(t) about y, and then by 13 degrees sin(2t) about its own
 * x. Where the line from the hole to a point of the house meets it, the image shows that point; the house's own image
 * on the wall stays where it was.
 */
static void the_image_lies_where_the_ray_meets_any_plane(void **state)
{
    (void)state;
    static const double points[2][2] = {{0, .6}, {-.34, -.5}};
    const uint16_t colours[2] = {ph_rgb565(225, 70, 50), ph_rgb565(60, 110, 200)};
    struct demo_stage s = demo_stage_open(demo_find("pinhole"), SIZE, SIZE);
    const double pi = acos(-1);
    double least = 9, most = 0;
    s.context.view = "plane";
    for (uint32_t frame = 0; frame < 256; frame += 8) {
        const double t = 2 * pi * frame / 256, sway = pi / 8 * sin(t + pi / 4);
        const double yaw = 2 * pi * 3640 / 65536 * sin(t), pitch = 2 * pi * 2366 / 65536 * sin(2 * t);
        const double normal[3] = {sin(yaw) * cos(pitch), -sin(pitch), cos(yaw) * cos(pitch)};
        demo_stage_frame(&s, frame);
        for (int i = 0; i < 2; i++) {
            const double at[3] = {points[i][0] * cos(sway), points[i][1], -3.2 - points[i][0] * sin(sway)};
            const double share = -1.5 * normal[2] / (normal[0] * at[0] + normal[1] * at[1] + normal[2] * at[2]);
            const double image[3] = {at[0] * share, at[1] * share, at[2] * share},
                         behind[3] = {-at[0] * 1.5 / -at[2], -at[1] * 1.5 / -at[2], 1.5};
            double row;
            if (!shows(&s, image, colours[i], &row) || !shows(&s, behind, colours[i], &row)) {
                fail_msg("frame %u: point %d is not at row %.0f", frame, i, row);
            }
            least = fmin(least, -image[2]);
            most = fmax(most, -image[2]);
        }
    }
    assert_true(least < 1.45 && most > 1.55); /* it really turns */
    demo_stage_close(&s);
}

/* `all`, which a kit shows, is each of the others in turn. */
static void each_lesson_is_seen_without_naming_its_view(void **state)
{
    (void)state;
    static const struct {
        uint32_t frame;
        const char *view;
    } shown[] = {{64, "plane"}, {300, "camera"}, {512, "depth"}, {700, "camera"}, {900, "plane"}};
    for (int size = 0; size < 2; size++) {
        struct demo_stage s = demo_stage_open(demo_find("pinhole"), size ? 128 : 240, size ? 64 : 240);
        for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) {
            s.context.view = NULL;
            const uint32_t crc = demo_stage_frame(&s, shown[i].frame);
            for (size_t k = 0; k < 3; k++) {
                s.context.view = shown[k].view;
                const bool same = crc == demo_stage_frame(&s, shown[i].frame);
                assert_int_equal(same, strcmp(shown[k].view, shown[i].view) == 0);
            }
        }
        demo_stage_close(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_image_is_upside_down_behind_the_hole_and_upright_before_it),
        cmocka_unit_test(the_image_lies_where_the_ray_meets_any_plane),
        cmocka_unit_test(each_lesson_is_seen_without_naming_its_view),
        cmocka_unit_test(z_kept_bends_lines_and_a_plus_b_over_z_does_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
