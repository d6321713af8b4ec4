/*
 * What textbooks say about pictures is measured on drawn ones: zoom and dolly, the Hitchcock zoom, straight lines, the
 * vanishing points of parallel lines. The sources are those that camera.h names. Prints what it measured.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "camera.h"
#include "assert_near.h"
#include "ref_random.h"
#include "ref_rig.h"

#include <math.h>
#include <stdio.h>

#define PI     3.14159265358979323846
#define SIZE   240
#define PIXELS (SIZE * SIZE)
#define RED    1 /* colours in wire order, whatever they look like */
#define BLUE   2

static struct rig rig;

static int open_rig(void **state)
{
    (void)state;
    rig_open(&rig, SIZE, SIZE, 60, PH_DEPTH_FIXED16, 16, 64);
    return 0;
}

static int close_rig(void **state)
{
    (void)state;
    rig_close(&rig);
    return 0;
}

static void begin(const struct ph_xform *view, const struct ph_projection *p)
{
    assert_int_equal(ph_frame_begin(&rig.r, view, p, NULL, 0), PH_OK);
}

static struct ph_projection perspective(double fov, double n, double f)
{
    struct ph_projection p;
    assert_int_equal(ph_projection_perspective(&p, ref_q16(fov), FX_ONE, ref_q16(n), ref_q16(f)), PH_OK);
    return p;
}

/* ---- the Hitchcock zoom ------------------------------------------------------------------------------------------ */

/* A square of half a side, facing x, unlit, at x. */
static const uint16_t square[2][3] = {{0, 1, 2}, {0, 2, 3}};

static void draw_square(double x, double half, uint16_t colour)
{
    static struct fx_vec3 corners[2][4];
    static struct ph_material materials[2];
    static const struct ph_part part = {0, 2, 0};
    const int k = colour == BLUE; /* meshes and materials are referred to until the frame is drawn */
    const double at[4][2] = {{-1, 1}, {-1, -1}, {1, -1}, {1, 1}}; /* y up, z: right is -z as seen from +x */
    for (int i = 0; i < 4; i++) {
        corners[k][i] = vec(x, at[i][0] * half, at[i][1] * half);
    }
    materials[k] = (struct ph_material){.shading = PH_SHADE_UNLIT, .two_sided = 1, .colour = colour};
    const struct ph_mesh mesh = {.positions = corners[k],
                                 .triangles = square,
                                 .parts = &part,
                                 .materials = &materials[k],
                                 .vertex_count = 4,
                                 .triangle_count = 2,
                                 .part_count = 1};
    assert_int_equal(ph_draw_mesh(&rig.r, &mesh, &ph_xform_identity), PH_OK);
}

static int rows_of(uint16_t colour, int column)
{
    int rows = 0;
    for (int y = 0; y < SIZE; y++) {
        rows += rig.pixels[y * SIZE + column] == colour;
    }
    return rows;
}

/* The camera on x at `distance`, looking along -x; a red square of side 1 at the origin, a blue one at `other`. */
static void draw_along_x(double distance, double fov, double other, double half)
{
    const struct ph_xform view = ph_view_look_at(vec(distance, 0, 0), vec(distance - 1, 0, 0), vec(0, 1, 0));
    const struct ph_projection p = perspective(fov, .1, 100);
    begin(&view, &p);
    draw_square(0, .5, RED);
    draw_square(other, half, BLUE);
    assert_true(rig_finish(&rig));
}

/* HAW: the field of view changes, the place stays; what is wider is seen smaller, by the tangents. */
static void zoom_changes_the_size_by_the_tangent_of_half_the_angle(void **state)
{
    (void)state;
    for (int fov = 15; fov <= 120; fov += 5) {
        draw_along_x(5, fov, -20, .1);
        assert_near(rows_of(RED, SIZE / 2), SIZE / (10 * tan(fov * PI / 360)), 1);
    }
}

/* HAW: the camera moves along its own z, the angle stays; what was behind it comes into sight, once past the near
 * plane. */
static void dolly_changes_the_size_by_the_distance(void **state)
{
    (void)state;
    for (int i = 0; i <= 32; i++) {
        const double distance = 2 + i / 4.;
        draw_along_x(distance, 40, 7, .01); /* the blue square hides the middle at most */
        assert_near(rows_of(RED, SIZE / 2 + (int)(SIZE / (2 * distance))), SIZE / (2 * distance * tan(20 * PI / 180)),
                    1);
        assert_true((rows_of(BLUE, SIZE / 2) > 0) == (distance > 7.1));
    }
}

/*
 * LMU: fov = 2 atan(1 / distance), camera on x from 1.2 to 20 and back in 1000 frames. The subject at the origin, of
 * height 1, is half the picture's 240 lines; what is behind it grows from nothing to the whole picture.
 */
static void subject_keeps_its_height_over_the_hitchcock_zoom(void **state)
{
    (void)state;
    int low = SIZE, high = 0, behind_low = SIZE, behind_high = 0;
    for (int frame = 0; frame < 1000; frame++) {
        const double path = frame < 500 ? frame / 500. : (1000 - frame) / 500., distance = 1.2 + 18.8 * path;
        const struct ph_xform view = ph_view_look_at(vec(distance, 0, 0), vec(0, 0, 0), vec(0, 1, 0));
        struct ph_projection p;
        assert_int_equal(
            ph_projection_perspective(&p, ph_fov_of(FX_INT(2), ref_q16(distance)), FX_ONE, FX_ONE / 10, FX_INT(100)),
            PH_OK);
        begin(&view, &p);
        draw_square(0, .5, RED);
        draw_square(-8, 2, BLUE);
        assert_true(rig_finish(&rig));
        const int rows = rows_of(RED, SIZE / 2);
        low = rows < low ? rows : low;
        high = rows > high ? rows : high;
        const int across = rows_of(BLUE, SIZE / 2) + rows;
        behind_low = across < behind_low ? across : behind_low;
        behind_high = across > behind_high ? across : behind_high;
    }
    printf("Hitchcock: subject %d to %d lines high in 1000 frames, with what is behind it %d to %d\n", low, high,
           behind_low, behind_high);
    assert_in_range(low, 119, 120);
    assert_in_range(high, 120, 121);
    assert_true(high - low <= 1);
    assert_int_equal(behind_low, 120); /* hidden by the subject */
    assert_int_equal(behind_high, SIZE);
}

/* LMU: distance = 1 / tan(fov / 2) for a height of 2, and back. */
static void the_distance_of_a_field_of_view_is_the_inverse(void **state)
{
    (void)state;
    for (int tenths = 10; tenths < 1790; tenths += 3) {
        const fx_t fov = ref_q16(tenths / 10.);
        for (int height = 1; height < 100; height += 7) {
            const double half = fov / 65536. / 360 * acos(-1), exact = height / 2. / tan(half);
            const fx_t distance = ph_distance_of(FX_INT(height), fov);
            assert_true(fabs(ldexp(distance, -16) - exact) <= ldexp(.51, -16) + ldexp(height, -21));
            /* one LSB of the distance changes the angle by at most 2 / height rad */
            assert_true(fabs(ldexp(ph_fov_of(FX_INT(height), distance) - fov, -16)) <
                        ldexp(180 * 2. / height, -16) + 1e-4);
        }
    }
    assert_int_equal(ph_distance_of(FX_INT(2), FX_INT(90)), FX_ONE);
    assert_int_equal(ph_distance_of(FX_MAX, FX_ONE), FX_MAX);
    assert_int_equal(ph_distance_of(FX_ONE, 0), 0);
    assert_int_equal(ph_distance_of(FX_ONE, FX_INT(180)), 0);
}

/* ---- lines ------------------------------------------------------------------------------------------------------ */

struct fit {
    int count;
    double x, y, dx, dy; /* through (x, y) along the unit vector (dx, dy) */
};

/* Least squares of what was drawn. */
static struct fit fit_pixels(void)
{
    struct fit f = {0};
    double xx = 0, xy = 0, yy = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < PIXELS; i++) {
            if (rig.depth[i] == 0) {
                continue;
            }
            const double x = i % SIZE + .5, y = (double)(i / SIZE) + .5, u = x - f.x, v = y - f.y;
            if (pass == 0) {
                f.count++;
                f.x += (x - f.x) / f.count;
                f.y += (y - f.y) / f.count;
            } else {
                xx += u * u;
                xy += u * v;
                yy += v * v;
            }
        }
        const double angle = atan2(2 * xy, xx - yy) / 2;
        f.dx = cos(angle);
        f.dy = sin(angle);
    }
    return f;
}

static struct fit draw_line(const struct ph_projection *p, struct fx_vec3 a, struct fx_vec3 b)
{
    static const struct ph_material white = {.shading = PH_SHADE_WIRE, .colour = 0xffff};
    begin(&ph_xform_identity, p);
    ph_draw_line(&rig.r, a, b, &white);
    assert_true(rig_finish(&rig));
    return fit_pixels();
}

/* How far pixel centres lie from the straight line between two points of the screen, aside or (flat lines) up. */
static double off_line(const double a[2], const double b[2])
{
    const int along = fabs(b[0] - a[0]) > fabs(b[1] - a[1]) ? 0 : 1, aside = 1 - along;
    double worst = 0;
    for (int i = 0; i < PIXELS; i++) {
        const double at[2] = {i % SIZE + .5, (double)(i / SIZE) + .5};
        if (rig.depth[i] != 0) {
            const double line = a[aside] + (at[along] - a[along]) * (b[aside] - a[aside]) / (b[along] - a[along]);
            worst = fmax(worst, fabs(at[aside] - line));
        }
    }
    return worst;
}

/* HAW: straight lines map to straight lines. One pixel in each column (row), its centre within .5 px of the line. */
static void lines_are_drawn_straight(void **state)
{
    (void)state;
    struct ph_projection p[2] = {perspective(60, .5, 1000)};
    const double focal = SIZE / 2 * sqrt(3);
    double worst = 0, pixels = 0;
    assert_int_equal(ph_projection_ortho(&p[1], FX_INT(-4), FX_INT(4), FX_INT(-4), FX_INT(4), FX_HALF, FX_INT(1000)),
                     PH_OK);
    ref_seed(37);
    for (int i = 0; i < 300; i++) {
        struct fx_vec3 ends[2];
        double at[2][2];
        for (int k = 0; k < 2; k++) {
            const double z = exp(ref_uniform(log(.6), log(900))), scale = i % 2 == 0 ? focal / z : SIZE / 8;
            at[k][0] = ref_uniform(1, SIZE - 1);
            at[k][1] = ref_uniform(1, SIZE - 1);
            ends[k] = vec((at[k][0] - SIZE / 2) / scale, (SIZE / 2 - at[k][1]) / scale, -z);
        }
        const struct fit f = draw_line(&p[i % 2], ends[0], ends[1]);
        assert_near(f.count, fmax(fabs(at[1][0] - at[0][0]), fabs(at[1][1] - at[0][1])), 1.1);
        worst = fmax(worst, off_line(at[0], at[1]));
        pixels += f.count;
    }
    printf("300 lines, %.0f pixels: at most %.3f px off the straight line\n", pixels, worst);
    assert_true(pixels > 20000);
    assert_true(worst < .52);
}

/*
 * HAW, KAIST: parallel lines meet in one point under a perspective projection. Six lines along one direction, through
 * the straight lines fitted to their pixels; the vanishing point is the direction's own projection.
 */
static void parallel_lines_meet_in_the_vanishing_point(void **state)
{
    (void)state;
    double worst = 0;
    ref_seed(38);
    for (int i = 0; i < 40; i++) {
        const double x = ref_uniform(-.2, .2), y = ref_uniform(-.2, .2); /* direction (x, y, -1) */
        const struct ph_projection p = perspective(60, .5, 1000);
        const double focal = SIZE / 2 * sqrt(3), vanish_x = SIZE / 2 + focal * x, vanish_y = SIZE / 2 - focal * y;
        for (int k = 0; k < 6; k++) {
            const double away = k * PI / 3 + .2, u = 2 * cos(away), v = 2 * sin(away);
            const struct fit f = draw_line(&p, vec(u + 2 * x, v + 2 * y, -2), vec(u + 900 * x, v + 900 * y, -900));
            assert_true(f.count >= 60);
            worst = fmax(worst, fabs((vanish_x - f.x) * f.dy - (vanish_y - f.y) * f.dx));
        }
    }
    printf("vanishing point: the lines pass it within %.3f px\n", worst);
    assert_true(worst < .3);
}

/* HAW, KAIST: under a parallel projection they stay parallel. */
static void parallel_lines_stay_parallel_in_a_parallel_projection(void **state)
{
    (void)state;
    struct ph_projection p;
    double worst = 0;
    assert_int_equal(ph_projection_ortho(&p, FX_INT(-4), FX_INT(4), FX_INT(-4), FX_INT(4), FX_ONE, FX_INT(40)), PH_OK);
    ref_seed(39);
    for (int i = 0; i < 40; i++) {
        const double angle = ref_uniform(-PI, PI), x = 3 * cos(angle), y = 3 * sin(angle);
        for (int k = 0; k < 4; k++) {
            const double u = ref_uniform(-1, 1), v = ref_uniform(-1, 1);
            const struct fit f = draw_line(&p, vec(u - x, v - y, -2 - 5 * k), vec(u + x, v + y, -20 - 5 * k));
            worst = fmax(worst, fabs(f.dx * y + f.dy * x) / 3); /* the screen's y is down: sine of the angle between */
        }
    }
    printf("parallel projection: directions within %.4f degrees\n", asin(worst) * 180 / PI);
    assert_true(worst < .005);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(zoom_changes_the_size_by_the_tangent_of_half_the_angle),
        cmocka_unit_test(dolly_changes_the_size_by_the_distance),
        cmocka_unit_test(subject_keeps_its_height_over_the_hitchcock_zoom),
        cmocka_unit_test(the_distance_of_a_field_of_view_is_the_inverse),
        cmocka_unit_test(lines_are_drawn_straight),
        cmocka_unit_test(parallel_lines_meet_in_the_vanishing_point),
        cmocka_unit_test(parallel_lines_stay_parallel_in_a_parallel_projection),
    };
    return cmocka_run_group_tests(tests, open_rig, close_rig);
}
