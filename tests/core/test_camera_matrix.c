/*
 * The matrices of the four conventions have the depths of the table in camera.h, and each element is rounded once.
 * Arguments that make no camera are refused and change nothing.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "camera.h"
#include "assert_near.h"
#include "ref_random.h"

#include <math.h>
#include <string.h>

#define LSB   (1. / 65536)
#define CASES 2000

/* ---- conventions -------------------------------------------------------------------------------------------- */

/* NDC z at near and far plane: the table of camera.h. */
static const double planes[4][2] = {[PH_GL] = {-1, 1}, [PH_D3D] = {0, 1}, [PH_LMU] = {1, -1}, [PH_REVERSED] = {1, 0}};

/* NDC z of a point at `distance`, from the matrix, and how much half an LSB in each element moves it. */
static double ndc_z(const struct ph_projection *p, enum ph_convention convention, double distance, double *moved)
{
    struct ph_mat4 m;
    assert_int_equal(ph_matrix_projection(&m, p, convention), PH_OK);
    const double z = convention == PH_D3D ? distance : -distance;
    const double w = real(m.m[3][2]) * z + real(m.m[3][3]);
    *moved = (distance + 1) * LSB / 2 / fabs(w);
    return (real(m.m[2][2]) * z + real(m.m[2][3])) / w;
}

/* Each element is rounded once: NDC z is as far off as half an LSB of both elements makes it, no further. */
static void near_and_far_planes_have_the_depths_of_the_table(void **state)
{
    (void)state;
    ref_seed(4);
    for (int i = 0; i < CASES; i++) {
        const double n = real(ref_q16(exp(ref_uniform(log(.05), log(20))))),
                     f = real(ref_q16(n * (1 + exp(ref_uniform(log(.05), log(100))))));
        struct ph_projection p[2];
        assert_int_equal(ph_projection_perspective(&p[0], FX_INT(60), FX_ONE, ref_q16(n), ref_q16(f)), PH_OK);
        assert_int_equal(ph_projection_ortho(&p[1], -FX_ONE, FX_ONE, -FX_ONE, FX_ONE, ref_q16(n), ref_q16(f)), PH_OK);
        for (int k = 0; k < 16; k++) {
            const enum ph_convention convention = (enum ph_convention)(k / 4);
            double moved;
            const double z = ndc_z(&p[k % 2], convention, k % 4 < 2 ? n : f, &moved);
            assert_near(z, planes[convention][k % 4 / 2], 1.0001 * moved);
        }
    }
}

/* What is nearer stays nearer: depth order in every convention, over the whole range. */
static void depth_runs_one_way_between_the_planes(void **state)
{
    (void)state;
    struct ph_projection p;
    double moved;
    assert_int_equal(ph_projection_perspective(&p, FX_INT(60), FX_ONE, FX_HALF, FX_INT(50)), PH_OK);
    for (int convention = PH_GL; convention <= PH_REVERSED; convention++) {
        const double direction = planes[convention][1] - planes[convention][0];
        double last = ndc_z(&p, (enum ph_convention)convention, .5, &moved);
        for (int i = 1; i <= 495; i++) {
            const double z = ndc_z(&p, (enum ph_convention)convention, .5 + i / 10., &moved);
            assert_true((z - last) * direction > 0);
            last = z;
        }
    }
}

/* The scales of every field of view from 1 degree on: cot(fov / 2) and the same by the aspect, which is rounded in
 * Q12.20. */
static void scales_of_narrow_and_wide_views_are_within_0_6_LSB(void **state)
{
    struct ph_projection p;
    struct ph_mat4 m;
    (void)state;
    for (fx_t fov = FX_ONE; fov < FX_INT(180); fov += fov < FX_INT(10) ? 7 : 1009) {
        const double cot = 65536 / tan(real(fov) * acos(-1) / 360);
        assert_int_equal(ph_projection_perspective(&p, fov, FX_ONE / 4 * 3, FX_ONE, FX_INT(100)), PH_OK);
        assert_int_equal(ph_matrix_projection(&m, &p, PH_GL), PH_OK);
        assert_near(m.m[1][1], cot, .5 + .501 / 16);
        assert_near(m.m[0][0], cot * 4 / 3, .6);
    }
}

static void products_of_matrices_are_rounded_once(void **state)
{
    (void)state;
    ref_seed(5);
    for (int i = 0; i < 100000; i++) {
        struct ph_mat4 a = {{{0}}};
        struct ph_vec4 v;
        fx_t *const row = a.m[i % 4], *const column[4] = {&v.x, &v.y, &v.z, &v.w};
        __int128 sum = 1 << 15;
        for (int k = 0; k < 4; k++) {
            row[k] = (fx_t)(ref_uniform(-1, 1) * FX_INT(300));
            *column[k] = (fx_t)(ref_uniform(-1, 1) * FX_INT(20));
            sum += (__int128)row[k] * *column[k];
        }
        const struct ph_vec4 product = ph_mat4_apply(&a, v);
        const fx_t got[4] = {product.x, product.y, product.z, product.w};
        assert_int_equal(got[i % 4], (fx_t)(sum >> 16));
    }
}

/* ---- refusals ------------------------------------------------------------------------------------------------ */

static void impossible_cameras_are_refused_and_change_nothing(void **state)
{
    (void)state;
    const fx_t one = FX_ONE, ten = FX_INT(10), wide = FX_INT(180);
    struct ph_projection p;
    memset(&p, 0x5a, sizeof(p));
    const struct ph_projection before = p;
    const int refused[] = {
        ph_projection_perspective(&p, 0, one, one, ten),
        ph_projection_perspective(&p, wide, one, one, ten),
        ph_projection_perspective(&p, -one, one, one, ten),
        ph_projection_perspective(&p, FX_MAX, one, one, ten),
        ph_projection_perspective(&p, ten, 0, one, ten),
        ph_projection_perspective(&p, ten, -one, one, ten),
        ph_projection_perspective(&p, ten, one, 0, ten),
        ph_projection_perspective(&p, ten, one, -one, ten),
        ph_projection_perspective(&p, ten, one, ten, ten),
        ph_projection_perspective(&p, ten, one, ten, one),
        ph_projection_pinhole(&p, 0, one, one, one, ten),
        ph_projection_pinhole(&p, -one, one, one, one, ten),
        ph_projection_pinhole(&p, one, 0, one, one, ten),
        ph_projection_pinhole(&p, one, one, 0, one, ten),
        ph_projection_pinhole(&p, one, -one, one, one, ten),
        ph_projection_pinhole(&p, one, one, -one, one, ten),
        ph_projection_pinhole(&p, one, one, one, 0, ten),
        ph_projection_pinhole(&p, one, one, one, ten, ten),
        ph_projection_pinhole(&p, one, one, one, ten, -one),
        ph_projection_pinhole(&p, FX_MAX, 1, one, one, ten), /* more than Q12.20 */
        ph_projection_pinhole(&p, 1, one, FX_MAX, one, ten), /* less */
        ph_projection_resize(&p, 0),
        ph_projection_resize(&p, -one),
        ph_projection_resize(&p, 1),
        ph_projection_fit(&p, one, 0),
        ph_projection_fit(&p, 1, FX_MAX),
    };
    for (size_t i = 0; i < sizeof(refused) / sizeof(refused[0]); i++) {
        if (refused[i] != PH_ERR_INVAL) {
            fail_msg("number %zu gives %d", i, refused[i]);
        }
    }
    assert_memory_equal(&p, &before, sizeof(p));
}

static void a_fisheye_has_no_aspect(void **state)
{
    (void)state;
    struct ph_projection p;
    assert_int_equal(ph_projection_fisheye(&p, FX_INT(180), FX_ONE, FX_INT(10)), PH_OK);
    const struct ph_projection before = p;
    assert_int_equal(ph_projection_resize(&p, FX_ONE), PH_ERR_INVAL);
    assert_memory_equal(&p, &before, sizeof(p));
}

static void matrices_without_room_in_Q16_16_are_refused_and_change_nothing(void **state)
{
    (void)state;
    struct ph_projection p;
    struct ph_mat4 m;
    memset(&m, 0x5a, sizeof(m));
    const struct ph_mat4 before = m;
    for (int convention = PH_GL; convention <= PH_REVERSED; convention++) {
        assert_int_equal(ph_projection_perspective(&p, FX_INT(60), FX_ONE, FX_INT(10), FX_INT(10) + 1), PH_OK);
        assert_int_equal(ph_matrix_projection(&m, &p, (enum ph_convention)convention), PH_ERR_RANGE);
        assert_int_equal(ph_projection_perspective(&p, FX_INT(60), FX_ONE, FX_MAX - 1, FX_MAX), PH_OK);
        assert_int_equal(ph_matrix_projection(&m, &p, (enum ph_convention)convention), PH_ERR_RANGE);
        assert_int_equal(ph_projection_ortho(&p, -FX_ONE, FX_ONE, -FX_ONE, FX_ONE, FX_INT(10), FX_INT(10) + 1), PH_OK);
        assert_int_equal(ph_matrix_projection(&m, &p, (enum ph_convention)convention), PH_ERR_RANGE);
        p.far_z = p.near_z;
        assert_int_equal(ph_matrix_projection(&m, &p, (enum ph_convention)convention), PH_ERR_INVAL);
        assert_int_equal(ph_projection_perspective(&p, FX_INT(60), FX_ONE, 1, FX_MAX), PH_OK); /* the longest fits */
        p.kind = PH_FISHEYE;                                                                   /* has no matrix */
        assert_int_equal(ph_matrix_projection(&m, &p, (enum ph_convention)convention), PH_ERR_INVAL);
        p.kind = PH_PERSPECTIVE;
        struct ph_mat4 fits;
        assert_int_equal(ph_matrix_projection(&fits, &p, (enum ph_convention)convention), PH_OK);
    }
    assert_memory_equal(&m, &before, sizeof(m));
}

/* Any 32 bits, small numbers as often as large ones. */
static fx_t any_fx(void)
{
    const double v = ldexp(ref_uniform(-1, 1), (int)ref_uniform(1, 32));
    return (fx_t)v;
}

/* What the depth row of GL's matrices must be; long double, so that the rounding under test is the only one. */
static void check_depth_row(const struct ph_projection *p, const struct ph_mat4 *m)
{
    const long double n = p->near_z, f = p->far_z, range = f - n, scale = p->kind == PH_PERSPECTIVE ? 1 : 65536;
    const long double z = p->kind == PH_PERSPECTIVE ? -(f + n) / range * 65536 : -2 / range * scale * 65536,
                      one = p->kind == PH_PERSPECTIVE ? -2 * f / range * n : -(f + n) / range * 65536;
    assert_near(m->m[2][2], (double)z, .5001);
    assert_near(m->m[2][3], (double)one, .5001);
}

/* No input overflows (the sanitizers see it); each element of the depth row is rounded once; the rest saturates. */
static void matrices_of_extreme_cameras_are_rounded_once(void **state)
{
    (void)state;
    struct ph_projection p;
    struct ph_mat4 m;
    int made = 0;
    ref_seed(77);
    for (int i = 0; i < 20000; i++) {
        const fx_t l = any_fx(), r = any_fx(), b = any_fx(), t = any_fx(), n = any_fx(), f = any_fx();
        const int status = i % 3 == 0   ? ph_projection_ortho(&p, l, r, b, t, n, f)
                           : i % 3 == 1 ? ph_projection_frustum(&p, l, r, b, t, n, f)
                                        : ph_projection_pinhole(&p, l, r, b, n, f);
        for (int convention = PH_GL; status == PH_OK && convention <= PH_REVERSED; convention++) {
            if (ph_matrix_projection(&m, &p, (enum ph_convention)convention) == PH_OK && convention == PH_GL) {
                check_depth_row(&p, &m);
                made++;
            }
        }
    }
    assert_true(made > 500);
    assert_int_equal(ph_projection_ortho(&p, FX_MIN, FX_MIN + 200, FX_MIN, FX_MIN + 200, FX_ONE, FX_INT(2)), PH_OK);
    for (int convention = PH_GL; convention <= PH_REVERSED; convention++) {
        assert_int_equal(ph_matrix_projection(&m, &p, (enum ph_convention)convention), PH_OK);
        assert_int_equal(m.m[0][3], FX_MAX);
        assert_int_equal(m.m[1][3], FX_MAX);
    }
    /* the largest scale there is, 2048 - 2^-19 */
    assert_int_equal(ph_projection_frustum(&p, 0, 1 << 20, 0, 1 << 20, (1 << 30) - 1, FX_MAX), PH_OK);
    assert_int_equal(p.scale_x_q20, INT32_MAX - 1);
    assert_int_equal(ph_matrix_projection(&m, &p, PH_REVERSED), PH_OK);
    assert_int_equal(m.m[0][0], FX_INT(2048));
}

static void impossible_volumes_of_a_convention_are_refused_and_change_nothing(void **state)
{
    (void)state;
    static const fx_t distances[][2] = {{0, FX_ONE}, {-FX_ONE, FX_ONE}, {FX_ONE, FX_ONE}, {FX_ONE, FX_HALF}};
    for (int k = 0; k < 16; k++) {
        const enum ph_convention convention = (enum ph_convention)(k / 4);
        const fx_t sign = convention == PH_LMU ? -1 : 1, near_z = sign * distances[k % 4][0],
                   far_z = sign * distances[k % 4][1];
        struct ph_xform view = ph_xform_rotate_y(12345);
        const struct ph_xform before = view;
        fx_t n = near_z, f = far_z;
        assert_int_equal(ph_camera_from(convention, &view, &n, &f), PH_ERR_INVAL);
        assert_memory_equal(&view, &before, sizeof(view));
        assert_true(n == near_z && f == far_z);
    }
    struct ph_xform view = ph_xform_identity;
    fx_t n = FX_ONE, f = FX_INT(10); /* distances given for LMU's coordinates */
    assert_int_equal(ph_camera_from(PH_LMU, &view, &n, &f), PH_ERR_INVAL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(near_and_far_planes_have_the_depths_of_the_table),
        cmocka_unit_test(depth_runs_one_way_between_the_planes),
        cmocka_unit_test(scales_of_narrow_and_wide_views_are_within_0_6_LSB),
        cmocka_unit_test(products_of_matrices_are_rounded_once),
        cmocka_unit_test(impossible_cameras_are_refused_and_change_nothing),
        cmocka_unit_test(a_fisheye_has_no_aspect),
        cmocka_unit_test(matrices_without_room_in_Q16_16_are_refused_and_change_nothing),
        cmocka_unit_test(matrices_of_extreme_cameras_are_rounded_once),
        cmocka_unit_test(impossible_volumes_of_a_convention_are_refused_and_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
