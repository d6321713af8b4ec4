/* sim_factors: the products of what is printed, in fractions of the test's own, against the documents' matrices. */
#define _XOPEN_SOURCE 700 /* open_memstream */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_random.h"
#include "sim_factors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- fractions of the test's own: over / under, in lowest terms ------------------------------------------------- */

struct ratio {
    __int128 over, under;
};

static struct ratio ratio(int64_t over, int64_t under)
{
    return (struct ratio){over, under};
}

static __int128 divisor(__int128 x, __int128 y)
{
    while (x != 0) {
        const __int128 rest = y % x;
        y = x, x = rest;
    }
    return y < 0 ? -y : y;
}

static struct ratio sum_of_product(struct ratio sum, struct ratio a, struct ratio b)
{
    const struct ratio r = {a.over * b.over, a.under * b.under};
    const __int128 common = divisor(sum.under, r.under), left = r.under / common, right = sum.under / common;
    const __int128 over = sum.over * left + r.over * right, by = divisor(over, right * r.under);
    return (struct ratio){over / by, right * r.under / by};
}

struct matrix {
    struct ratio m[4][4];
};

static struct matrix unit(void)
{
    struct matrix u;
    for (int i = 0; i < 16; i++) {
        u.m[i / 4][i % 4] = ratio(i % 5 == 0, 1);
    }
    return u;
}

static struct matrix product(const struct matrix *a, const struct matrix *b)
{
    struct matrix p;
    for (int i = 0; i < 16; i++) {
        p.m[i / 4][i % 4] = ratio(0, 1);
        for (int k = 0; k < 4; k++) {
            p.m[i / 4][i % 4] = sum_of_product(p.m[i / 4][i % 4], a->m[i / 4][k], b->m[k][i % 4]);
        }
    }
    return p;
}

static double real(struct ratio r)
{
    return (double)r.over / (double)r.under;
}

static void expect(struct ratio got, int64_t over, int64_t under)
{
    if (got.over * under != got.under * over) {
        fail_msg("%.9g is not %lld/%lld", real(got), (long long)over, (long long)under);
    }
}

/* ---- what was printed ----------------------------------------------------------------------------------------- */

static char *printed;

static void print(const struct ph_xform *view, const struct ph_projection *p, struct sim_matrix_writing writing)
{
    size_t length;
    free(printed);
    FILE *const file = open_memstream(&printed, &length);
    assert_non_null(file);
    sim_factors_print(file, view, p, writing);
    fclose(file);
}

/* The element on a line of that name, its decimal and its error held to its fraction. False: there is no such line. */
static bool element(const char *name, struct ratio *out, double most)
{
    long long a, b = 1;
    double decimal, error;
    long code;
    for (const char *line = printed; line != NULL && *line != '\0'; line = strchr(line, '\n') + 1) {
        if (strncmp(line, name, strlen(name)) != 0 || line[strlen(name)] != ' ') {
            continue;
        }
        line += strlen(name);
        if (sscanf(line, "%lld/%lld %lf %ld %lf", &a, &b, &decimal, &code, &error) != 5) {
            b = 1;
            assert_int_equal(sscanf(line, "%lld %lf %ld %lf", &a, &decimal, &code, &error), 4);
        }
        *out = ratio(a, b);
        assert_true(b > 0 && fabs(decimal - real(*out)) <= 1e-11 * fmax(1, fabs(decimal)));
        assert_true(fabs((double)code - real(*out) * 65536 - error) < 1e-3 && fabs(error) <= most);
        return true;
    }
    return false;
}

/* A factor: the unit matrix with the elements that have lines. most: error of the codes in steps. */
static struct matrix factor(const char *name, int lines, double most)
{
    struct matrix m = unit();
    int found = 0;
    for (int i = 0; i < 16; i++) {
        char label[32];
        snprintf(label, sizeof label, "%s.%d.%d", name, i / 4, i % 4);
        found += element(label, &m.m[i / 4][i % 4], most);
    }
    assert_int_equal(found, lines);
    return m;
}

/* ---- tests ---------------------------------------------------------------------------------------------------- */

static const struct ph_xform somewhere = {{{1 << 30, 0, 0}, {0, 1 << 30, 0}, {0, 0, 1 << 30}}, {0, 0, 0}};

/* l = -1 .. and so on by whole numbers: the elements of glFrustum, of 4600's and LMU's matrix, as fractions. */
static void scale_shift_and_persp_are_the_projection(void **state)
{
    (void)state;
    for (int i = 0; i < 4000; i++) {
        const enum ph_convention convention = (enum ph_convention)(i % 4);
        const int64_t n = (int64_t)ref_uniform(1, 40), f = n + (int64_t)ref_uniform(1, 900);
        const int64_t sx = (int64_t)ref_uniform(1, 4000), sy = (int64_t)ref_uniform(1, 4000); /* in 1/1024 */
        const int64_t ox = (int64_t)ref_uniform(-500, 500), oy = (int64_t)ref_uniform(-500, 500);
        const struct ph_projection lens = {.kind = i % 8 < 4 ? PH_PERSPECTIVE : PH_ORTHOGRAPHIC,
                                           .scale_x_q20 = (int32_t)(sx << 10),
                                           .scale_y_q20 = (int32_t)(sy << 10),
                                           .shift_x = (fx_t)(ox * 64),
                                           .shift_y = (fx_t)(oy * 64),
                                           .near_z = FX_INT(n),
                                           .far_z = FX_INT(f)};
        print(&somewhere, &lens, (struct sim_matrix_writing){convention, false});
        const struct matrix scale = factor("scale", 3, .5), shift = factor("shift", 3, .5);
        struct matrix m = product(&scale, &shift);
        const bool z_up = convention == PH_D3D, half = convention == PH_D3D || convention == PH_REVERSED;
        if (lens.kind == PH_ORTHOGRAPHIC) {
            assert_null(strstr(printed, "persp"));
            const int64_t deep = (half ? 1 : 2) * (z_up || convention == PH_LMU || convention == PH_REVERSED ? 1 : -1);
            expect(m.m[0][0], sx, 1024), expect(m.m[1][1], sy, 1024), expect(m.m[0][3], -ox, 1024);
            expect(m.m[1][3], -oy, 1024), expect(m.m[2][2], deep, f - n), expect(m.m[3][3], 1, 1);
            expect(m.m[2][3], z_up ? -n : convention == PH_GL ? -n - f : convention == PH_LMU ? n + f : f, f - n);
            continue;
        }
        struct matrix persp = factor("persp", 4, .5);
        const int64_t by_z = z_up || convention == PH_LMU ? 1 : -1, side = convention == PH_LMU ? -1 : 1;
        assert_true(element("w1", &persp.m[2][2], .5) && element("w2", &persp.m[2][3], n * f < 32768 ? .5 : 1e12));
        expect(persp.m[0][0], side * n, 1), expect(persp.m[2][2], side * (n + f), 1);
        expect(persp.m[2][3], -by_z * n * f, 1);
        m = product(&m, &persp);
        expect(m.m[0][0], side * sx, 1024), expect(m.m[1][1], side * sy, 1024), expect(m.m[0][1], 0, 1);
        expect(m.m[0][2], -by_z * ox, 1024), expect(m.m[1][2], -by_z * oy, 1024), expect(m.m[0][3], 0, 1);
        expect(m.m[2][2], z_up ? f : convention == PH_REVERSED ? n : -n - f, f - n);
        expect(m.m[2][3], n * f * (half ? 1 : 2) * (convention == PH_REVERSED ? 1 : -1), f - n);
        expect(m.m[3][2], by_z, 1), expect(m.m[3][3], 0, 1);
    }
}

static void near(struct ratio got, double expected, double most)
{
    if (fabs(real(got) - expected) > most) {
        fail_msg("%.12g is not %.12g", real(got), expected);
    }
}

static void r_t_is_the_view_and_camera_its_inverse(void **state)
{
    (void)state;
    const struct ph_projection lens = {
        .scale_x_q20 = 1 << 20, .scale_y_q20 = 1 << 20, .near_z = FX_ONE, .far_z = FX_INT(9)};
    for (int i = 0; i < 2000; i++) {
        const struct sim_matrix_writing writing = {(enum ph_convention)(i % 4), i % 8 == PH_D3D};
        fx_t v[9];
        for (int k = 0; k < 9; k++) {
            v[k] = (fx_t)ref_uniform(-30 * FX_ONE, 30 * FX_ONE);
        }
        const struct fx_vec3 eye = {v[0], v[1], v[2]}, target = {v[3], v[4], v[5]}, up = {v[6], v[7], v[8]};
        const struct ph_xform view = ph_view_look_at(eye, target, up);
        print(&view, &lens, writing);
        const struct matrix r = factor("R", 9, .5), t = factor("T", 3, 2), camera = factor("camera", 12, 2);
        const struct matrix seen = product(&r, &t), back = product(&camera, &seen);
        const struct ph_mat4 matrix = sim_matrix_of_view(&view, writing);
        for (int k = 0; k < 16; k++) {
            const double code = matrix.m[k / 4][k % 4] / 65536.0;
            near(seen.m[k / 4][k % 4], code, k % 4 == 3 ? 1e-6 : .51 / 65536);
            near(back.m[k / 4][k % 4], k % 5 == 0, 1e-6);
        }
        near(camera.m[0][3], v[0] / 65536.0, 4e-5), near(camera.m[1][3], v[1] / 65536.0, 4e-5);
        near(camera.m[2][3], (writing.left_world ? -v[2] : v[2]) / 65536.0, 4e-5);
    }
}

/* HAW, exercise 2: camera.matrix of a camera at (5,0,0) that looks at the origin has the columns -z, y, x, (5,0,0). */
static void exercise_2_has_its_matrix(void **state)
{
    (void)state;
    const struct fx_vec3 eye = {FX_INT(5), 0, 0}, middle = {0, 0, 0}, up = {0, FX_ONE, 0};
    const struct ph_xform view = ph_view_look_at(eye, middle, up);
    const struct ph_projection fisheye = {.kind = PH_FISHEYE};
    print(&view, &fisheye, (struct sim_matrix_writing){PH_GL, false});
    static const int columns[4][3] = {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}, {5, 0, 0}};
    const struct matrix camera = factor("camera", 12, 0), t = factor("T", 3, 0);
    for (int i = 0; i < 12; i++) {
        expect(camera.m[i % 3][i / 3], columns[i / 3][i % 3], 1);
    }
    expect(t.m[0][3], -5, 1);
    assert_null(strstr(printed, "scale"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scale_shift_and_persp_are_the_projection),
        cmocka_unit_test(r_t_is_the_view_and_camera_its_inverse),
        cmocka_unit_test(exercise_2_has_its_matrix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
