/* asset_quadric: values against distances from planes that are worked out another way, in 3, 8 and 11 dimensions. */
#include "asset_quadric.h"
#include "ref_random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = ASSET_DIMENSIONS_MAX, NUMBERS = MOST * (MOST + 1) / 2 + MOST + 1 };

static double dot(const double *a, const double *b, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

/* The square of x's distance from the plane through three points: what is left of it by least squares, whose two
 * normal equations are solved by Cramer's rule. */
static double distance_2(double (*p)[MOST], const double *x, int n)
{
    double u[MOST], v[MOST], d[MOST];
    for (int i = 0; i < n; i++) {
        u[i] = p[1][i] - p[0][i], v[i] = p[2][i] - p[0][i], d[i] = x[i] - p[0][i];
    }
    const double uu = dot(u, u, n), uv = dot(u, v, n), vv = dot(v, v, n), ud = dot(u, d, n), vd = dot(v, d, n);
    const double all = uu * vv - uv * uv, s = (ud * vv - vd * uv) / all, t = (vd * uu - ud * uv) / all;
    for (int i = 0; i < n; i++) {
        d[i] -= s * u[i] + t * v[i];
    }
    return dot(d, d, n);
}

static void fill(double *x, int n)
{
    for (int i = 0; i < n; i++) {
        x[i] = ref_uniform(-2, 2);
    }
}

static void triangles_sum_up_their_distances(void **state)
{
    static const int sizes[] = {3, 8, 11};
    (void)state;
    ref_seed(1);
    for (int k = 0; k < 3; k++) {
        const int n = sizes[k];
        double q[NUMBERS] = {0}, triangles[3][3][MOST], weights[3] = {1, .25, 7};
        assert_int_equal(asset_quadric_numbers(n), n * (n + 1) / 2 + n + 1);
        for (int t = 0; t < 3; t++) {
            for (int i = 0; i < 3; i++) {
                fill(triangles[t][i], n);
            }
            asset_quadric_triangle(q, n, (const double *const[3]){triangles[t][0], triangles[t][1], triangles[t][2]},
                                   weights[t]);
        }
        for (int i = 0; i < 100; i++) {
            double x[MOST], expected = 0;
            fill(x, n);
            for (int t = 0; t < 3; t++) {
                expected += weights[t] * distance_2(triangles[t], x, n);
            }
            assert_true(fabs(asset_quadric_at(q, n, x) - expected) < 1e-9);
        }
    }
}

static void a_plane_counts_for_the_place_alone(void **state)
{
    const double normal[3] = {.6, 0, -.8};
    (void)state;
    ref_seed(2);
    for (int n = 3; n <= MOST; n += 4) {
        double q[NUMBERS] = {0}, x[MOST];
        asset_quadric_plane(q, n, normal, .5, 3);
        for (int i = 0; i < 100; i++) {
            fill(x, n);
            const double off = .6 * x[0] - .8 * x[2] - .5;
            assert_true(fabs(asset_quadric_at(q, n, x) - 3 * off * off) < 1e-9);
        }
    }
}

/* A triangle that is a line or a point counts by the distance from that, and a sum that rounding made negative is 0. */
static void triangles_without_an_area_do_no_harm(void **state)
{
    (void)state;
    const double a[3] = {1, 0, 0}, b[3] = {3, 0, 0}, c[3] = {2, 0, 0}, x[3] = {7, 3, 4}, far[3] = {1e6, 1e-3, 0};
    double line[NUMBERS] = {0}, point[NUMBERS] = {0};
    asset_quadric_triangle(line, 3, (const double *const[3]){a, b, c}, 1);
    assert_true(fabs(asset_quadric_at(line, 3, x) - 25) < 1e-9);
    assert_true(asset_quadric_at(line, 3, far) >= 0);
    asset_quadric_triangle(point, 3, (const double *const[3]){a, a, a}, 1);
    assert_true(fabs(asset_quadric_at(point, 3, x) - 61) < 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_sum_up_their_distances),
        cmocka_unit_test(a_plane_counts_for_the_place_alone),
        cmocka_unit_test(triangles_without_an_area_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
