/* model_polygon: areas of random and odd polygons against the shoelace formula. */
#include "model_polygon.h"

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <cmocka.h>

#define MOST 256

/* Twice the area along an axis. */
static double area(float (*p)[3], int axis, uint32_t a, uint32_t b, uint32_t c)
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    return ((double)p[b][u] - (double)p[a][u]) * ((double)p[c][v] - (double)p[a][v]) -
           ((double)p[b][v] - (double)p[a][v]) * ((double)p[c][u] - (double)p[a][u]);
}

/* All triangles turn as the polygon does, and their areas sum up to its own: so they do not overlap. */
static void assert_whole(float (*p)[3], uint32_t n, int axis)
{
    uint32_t(*triangles)[3] = calloc(n, sizeof *triangles);
    double whole = 0, sum = 0;
    assert_true(model_polygon_cut(p, n, triangles));
    for (uint32_t i = 1; i + 1 < n; i++) {
        whole += area(p, axis, 0, i, i + 1);
    }
    for (uint32_t t = 0; t < n - 2; t++) {
        const double one = area(p, axis, triangles[t][0], triangles[t][1], triangles[t][2]);
        assert_true(one * whole >= 0);
        sum += one;
    }
    assert_true(fabs(sum - whole) <= 1e-9 * fabs(whole));
    free(triangles);
}

/* A star: corners at growing angles, at random distances from a point that sees them all. */
static void make_star(float (*p)[3], uint32_t n, int axis, bool turns_back)
{
    for (uint32_t i = 0; i < n; i++) {
        const double angle = 6.283185307179586 * (turns_back ? n - i : i) / n, r = 1 + rand() % 64;
        p[i][axis] = (float)(3 * r * cos(angle));
        p[i][(axis + 1) % 3] = (float)rint(r * cos(angle) * 256) / 256;
        p[i][(axis + 2) % 3] = (float)rint(r * sin(angle) * 256) / 256;
    }
}

static void stars_are_covered_once(void **state)
{
    static float p[MOST][3];
    (void)state;
    srand(1);
    for (int i = 0; i < 3000; i++) {
        const int axis = i % 3;
        const uint32_t n = 3 + (uint32_t)rand() % (i % 10 == 0 ? MOST - 2 : 9);
        make_star(p, n, axis, i % 2 != 0);
        for (uint32_t k = 0; k < n; k++) {
            p[k][axis] = 0;
        }
        assert_whole(p, n, axis);
    }
}

static void combs_and_spirals_are_covered_once(void **state)
{
    static float comb[42][3], spiral[80][3];
    (void)state;
    for (int i = 0; i < 40; i++) {
        comb[i][0] = (float)i;
        comb[i][1] = i % 2 != 0 ? 1 : 20;
        const double angle = i * .7, r = 2 + angle;
        spiral[i][0] = (float)(r * cos(angle));
        spiral[i][1] = (float)(r * sin(angle));
        spiral[79 - i][0] = (float)((r + 1) * cos(angle));
        spiral[79 - i][1] = (float)((r + 1) * sin(angle));
    }
    comb[40][0] = 39, comb[40][1] = -1, comb[41][1] = -1;
    assert_whole(comb, 42, 2);
    assert_whole(spiral, 80, 2);
}

static void a_convex_polygon_is_a_fan(void **state)
{
    float p[6][3];
    uint32_t triangles[6][3];
    (void)state;
    for (int i = 0; i < 6; i++) {
        memcpy(p[i], (float[3]){cosf((float)i), sinf((float)i), 0}, sizeof p[i]);
    }
    for (uint32_t n = 3; n <= 6; n++) {
        assert_true(model_polygon_cut(p, n, triangles));
        for (uint32_t t = 0; t < n - 2; t++) {
            assert_true(triangles[t][0] == 0 && triangles[t][1] == t + 1 && triangles[t][2] == t + 2);
        }
    }
}

static void four_corners_are_cut_from_the_one_that_turns_back(void **state)
{
    (void)state;
    for (uint32_t back = 0; back < 4; back++) {
        float p[4][3] = {{0}};
        static const float arrow[4][3] = {{1, 1, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}};
        uint32_t triangles[2][3];
        for (uint32_t i = 0; i < 4; i++) {
            memcpy(p[(back + i) % 4], arrow[i], sizeof p[0]);
        }
        assert_true(model_polygon_cut(p, 4, triangles));
        assert_int_equal(triangles[0][0], back);
        assert_int_equal(triangles[1][0], back);
        assert_whole(p, 4, 2);
    }
}

/* What has no inside gives some triangles of its corners all the same. */
static void what_crosses_itself_is_cut_somehow(void **state)
{
    static float p[MOST][3];
    static uint32_t triangles[MOST][3];
    (void)state;
    srand(2);
    for (int i = 0; i < 2000; i++) {
        const uint32_t n = 3 + (uint32_t)rand() % 20;
        for (uint32_t k = 0; k < 3 * n; k++) {
            p[k / 3][k % 3] = i % 4 == 0 ? NAN : i % 4 == 1 ? 0 : (float)(rand() % 5);
        }
        assert_true(model_polygon_cut(p, n, triangles));
        for (uint32_t t = 0; t < 3 * (n - 2); t++) {
            assert_true(triangles[t / 3][t % 3] < n);
        }
    }
}

static void too_many_corners_are_refused_where_they_are_not_convex(void **state)
{
    const uint32_t n = MODEL_POLYGON_MAX + 1;
    float(*p)[3] = calloc(n, sizeof *p);
    uint32_t(*triangles)[3] = calloc(n, sizeof *triangles);
    (void)state;
    make_star(p, n, 2, false);
    assert_false(model_polygon_cut(p, n, triangles));
    for (uint32_t i = 0; i < n; i++) {
        memcpy(p[i], (float[3]){(float)i, (float)i * (float)i, 0}, sizeof p[i]);
    }
    assert_true(model_polygon_cut(p, n, triangles));
    free(p);
    free(triangles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stars_are_covered_once),
        cmocka_unit_test(combs_and_spirals_are_covered_once),
        cmocka_unit_test(a_convex_polygon_is_a_fan),
        cmocka_unit_test(four_corners_are_cut_from_the_one_that_turns_back),
        cmocka_unit_test(what_crosses_itself_is_cut_somehow),
        cmocka_unit_test(too_many_corners_are_refused_where_they_are_not_convex),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
