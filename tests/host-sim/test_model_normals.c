/* model_normals: smooth below the crease angle, sharp above it, across the rounding of files and for every size. */
#include "model_normals.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <cmocka.h>

/* Two squares' halves that meet along the x axis with this angle between their normals: (0, 0, 1) and one turned about
 * x. */
static void make_fold(float (*p)[3], double degrees, float scale, float gap)
{
    const float y = scale * (float)cos(degrees * 3.141592653589793 / 180),
                z = scale * (float)sin(degrees * 3.141592653589793 / 180);
    const float corners[6][3] = {{0, 0, 0}, {scale, 0, 0}, {0, -scale, 0}, {gap, 0, 0}, {0, y, z}, {scale + gap, 0, 0}};
    memcpy(p, corners, sizeof corners);
    memcpy(p[1], corners[2], sizeof p[1]);
    memcpy(p[2], corners[1], sizeof p[2]);
    memcpy(p[4], corners[5], sizeof p[4]);
    memcpy(p[5], corners[4], sizeof p[5]);
}

/* Normals of `count` triangles. */
static float (*make(float (*p)[3], size_t count))[3]
{
    float(*faces)[3] = calloc(3 * count, sizeof *faces);
    assert_non_null(faces);
    for (size_t i = 0; i < 3 * count; i++) {
        model_normals_face(p[i - i % 3], p[i - i % 3 + 1], p[i - i % 3 + 2], faces[i]);
    }
    float(*normals)[3] = model_normals_make(p, faces, 3 * count);
    free(faces);
    return normals;
}

/* Whether the normal of a corner has this direction in the plane of y and z, in degrees from z towards -y. */
static bool is_turned(const float *n, double degrees)
{
    return n[0] == 0 && fabs(atan2(-(double)n[1], (double)n[2]) * 180 / 3.141592653589793 - degrees) < .01;
}

static void a_fold_is_smooth_up_to_66_degrees(void **state)
{
    static const double angles[] = {0, 10, 65.9, 66.1, 90, 150};
    static const float scales[] = {1, 1e-30f, 1e30f, 12345};
    (void)state;
    for (size_t i = 0; i < sizeof angles / sizeof angles[0] * 4; i++) {
        const double angle = angles[i / 4], mean = angle < 66 ? angle / 2 : 0;
        float p[6][3];
        make_fold(p, angle, scales[i % 4], 0);
        float(*n)[3] = make(p, 2);
        assert_non_null(n);
        assert_true(is_turned(n[0], mean) && is_turned(n[2], mean) && is_turned(n[1], 0));
        assert_true(is_turned(n[3], mean != 0 ? mean : angle) && is_turned(n[5], angle));
        free(n);
    }
}

static void corners_that_a_file_has_rounded_meet(void **state)
{
    static const struct {
        float gap;
        bool meets;
    } cases[] = {{1e-5f, true}, {-1e-5f, true}, {1.2e-4f, true}, {-1.2e-4f, true}, {1e-3f, false}, {-1e-3f, false}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0] * 16; i++) {
        const float gap = cases[i / 16].gap, below = (float)(i % 16) * -5e-5f;
        const bool meets = cases[i / 16].meets;
        float p[9][3];
        make_fold(p, 30, 1, gap);
        for (int k = 6; k < 9; k++) { /* a point that moves the borders of the cells */
            memcpy(p[k], (float[3]){below, -1 + below, below}, sizeof p[k]);
        }
        float(*n)[3] = make(p, 3);
        assert_true(is_turned(n[0], meets ? 15 : 0));
        assert_true(is_turned(n[4], meets ? 15 : 30));
        free(n);
    }
}

static void triangles_without_an_area_count_for_nothing(void **state)
{
    float p[9][3] = {{0}};
    (void)state;
    make_fold(p, 0, 1, 0);
    p[7][0] = 1, p[8][0] = .5f;
    float(*n)[3] = make(p, 3);
    for (int i = 0; i < 9; i++) {
        assert_true(n[i][0] == 0 && n[i][1] == 0 && (i < 6 ? n[i][2] > 0 : n[i][2] == 0));
    }
    free(n);
    for (int i = 0; i < 3; i++) {
        static const float odd[3] = {NAN, INFINITY, 0};
        for (int k = 0; k < 27; k++) {
            p[k / 3][k % 3] = odd[i];
        }
        n = make(p, 3);
        assert_true(n[8][0] == 0 && n[0][2] == 0);
        free(n);
    }
}

/* A disc of many triangles around one corner takes time in proportion to them. */
static void a_large_fan_is_no_hang(void **state)
{
    enum { COUNT = 300000 };
    float(*p)[3] = calloc(3 * (size_t)COUNT, sizeof *p);
    (void)state;
    for (int i = 0; i < COUNT; i++) {
        for (int k = 1; k < 3; k++) {
            p[3 * i + k][0] = (float)cos((i + k) * 6.283185307179586 / COUNT);
            p[3 * i + k][1] = (float)sin((i + k) * 6.283185307179586 / COUNT);
        }
    }
    float(*n)[3] = make(p, COUNT);
    assert_true(n[0][0] == 0 && n[0][1] == 0 && n[0][2] > 0);
    free(n);
    free(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fold_is_smooth_up_to_66_degrees),
        cmocka_unit_test(corners_that_a_file_has_rounded_meet),
        cmocka_unit_test(triangles_without_an_area_count_for_nothing),
        cmocka_unit_test(a_large_fan_is_no_hang),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
