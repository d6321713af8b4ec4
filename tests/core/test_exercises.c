/*
 * The exercises and worked matrices of five courses, with their own numbers. Errata are noted at the test. The courses:
 *   HAW    K. Juenemann, HAW Hamburg, chapter 9, camera models and the view pipeline (three.js)
 *   KAIST  S.-E. Yoon, Rendering, KAIST, chapter 4, camera setting
 *   EECE   EECE 478, viewing and projection (OpenGL, PHIGS)
 *   4600   course 4600, notes 4.1, virtual cameras
 *   LMU    LMU Munich, computer graphics, summer 2020, tutorial 4, camera
 * The numbers are chosen so that every element is a fraction of few bits. So the comparison is exact, where nothing
 * else is said.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "camera.h"
#include "assert_near.h"
#include "ref_random.h"

#include <math.h>

#define LSB (1. / 65536)

static fx_t fx(double v)
{
    return ref_q16(v);
}

static void check_matrix(const struct ph_mat4 *got, const double want[4][4])
{
    for (int i = 0; i < 16; i++) {
        if (got->m[i / 4][i % 4] != fx(want[i / 4][i % 4])) {
            fail_msg("row %d column %d: got %.9g, want %.9g", i / 4, i % 4, real(got->m[i / 4][i % 4]),
                     want[i / 4][i % 4]);
        }
    }
}

static void check_projection(const struct ph_projection *p, enum ph_convention convention, const double want[4][4])
{
    struct ph_mat4 m;
    assert_int_equal(ph_matrix_projection(&m, p, convention), PH_OK);
    check_matrix(&m, want);
}

/* The point (x, y, z, 1) goes to the clip coordinates `want`. */
static void check_clip(const struct ph_projection *p, enum ph_convention convention, const double point[3],
                       const double want[4])
{
    struct ph_mat4 m;
    assert_int_equal(ph_matrix_projection(&m, p, convention), PH_OK);
    const struct ph_vec4 got = ph_mat4_apply(&m, (struct ph_vec4){fx(point[0]), fx(point[1]), fx(point[2]), FX_ONE});
    const fx_t all[4] = {got.x, got.y, got.z, got.w};
    for (int i = 0; i < 4; i++) {
        if (all[i] != fx(want[i])) {
            fail_msg("clip coordinate %d: got %.9g, want %.9g", i, real(all[i]), want[i]);
        }
    }
}

static struct ph_projection perspective(double fov, double aspect, double n, double f)
{
    struct ph_projection p;
    assert_int_equal(ph_projection_perspective(&p, fx(fov), fx(aspect), fx(n), fx(f)), PH_OK);
    return p;
}

/* ---- projections -------------------------------------------------------------------------------------------- */

/*
 * KAIST 4.8 is this matrix when its n and f are the coordinates -1 and -5. Erratum: EECE's slide has + signs in the
 * last column, where l would go to 1 - 1 = 0 here; KAIST 4.9 shows that it must be -1.
 */
static void orthographic_camera_sends_left_to_minus_one(void **state)
{
    (void)state;
    struct ph_projection p;
    assert_int_equal(ph_projection_ortho(&p, FX_INT(-1), FX_INT(3), FX_INT(-2), FX_INT(2), FX_INT(1), FX_INT(5)),
                     PH_OK);
    const double n = -1, f = -5; /* KAIST's */
    check_projection(
        &p, PH_GL,
        (const double[4][4]){
            {2. / 4, 0, 0, -(3. - 1) / 4}, {0, 2. / 4, 0, 0}, {0, 0, 2 / (f - n), -(f + n) / (f - n)}, {0, 0, 0, 1}});
    check_clip(&p, PH_GL, (const double[3]){-1, -2, -1}, (const double[4]){-1, -1, -1, 1}); /* 4.9 */
    check_clip(&p, PH_GL, (const double[3]){3, 2, -5}, (const double[4]){1, 1, 1, 1});
    check_clip(&p, PH_D3D, (const double[3]){-1, -2, 1}, (const double[4]){-1, -1, 0, 1});
    check_clip(&p, PH_D3D, (const double[3]){3, 2, 5}, (const double[4]){1, 1, 1, 1});
    check_clip(&p, PH_LMU, (const double[3]){-1, -2, -1}, (const double[4]){-1, -1, 1, 1});
    check_clip(&p, PH_LMU, (const double[3]){3, 2, -5}, (const double[4]){1, 1, -1, 1});
    check_clip(&p, PH_REVERSED, (const double[3]){-1, -2, -1}, (const double[4]){-1, -1, 1, 1});
    check_clip(&p, PH_REVERSED, (const double[3]){3, 2, -5}, (const double[4]){1, 1, 0, 1});
}

/* HAW exercise 6. Its picture shows the corners of near and far plane at A, B and those of the cube at A', B'. */
static void perspective_camera_of_exercise_6_has_its_matrix(void **state)
{
    (void)state;
    const struct ph_projection p = perspective(90, 2, 2, 10);
    check_projection(&p, PH_GL, (const double[4][4]){{.5, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1.5, -5}, {0, 0, -1, 0}});
    check_clip(&p, PH_GL, (const double[3]){4, 2, -2}, (const double[4]){2, 2, -2, 2});
    check_clip(&p, PH_GL, (const double[3]){-20, 10, -10}, (const double[4]){-10, 10, 10, 10});
}

/*
 * EECE, glFrustum. Erratum: its second example feeds (r, t, -f), which is inside the volume; the far corner is
 * (r f/n, t f/n, -f), and the result is (f, f, f, f).
 */
static void corner_of_the_frustum_maps_to_the_corner_of_clip_space(void **state)
{
    (void)state;
    struct ph_projection p;
    const double l = -1, r = 3, b = -2, t = 6, n = 2, f = 10;
    assert_int_equal(ph_projection_frustum(&p, fx(l), fx(r), fx(b), fx(t), fx(n), fx(f)), PH_OK);
    check_projection(&p, PH_GL,
                     (const double[4][4]){{2 * n / (r - l), 0, (r + l) / (r - l), 0},
                                          {0, 2 * n / (t - b), (t + b) / (t - b), 0},
                                          {0, 0, -(f + n) / (f - n), -2 * f * n / (f - n)},
                                          {0, 0, -1, 0}});
    check_clip(&p, PH_GL, (const double[3]){l, b, -n}, (const double[4]){-n, -n, -n, n});
    check_clip(&p, PH_GL, (const double[3]){r * f / n, t * f / n, -f}, (const double[4]){f, f, f, f});
    check_clip(&p, PH_D3D, (const double[3]){r * f / n, t * f / n, f}, (const double[4]){f, f, f, f});
    check_clip(&p, PH_LMU, (const double[3]){l, b, -n}, (const double[4]){n, n, -n, -n});
    check_clip(&p, PH_REVERSED, (const double[3]){l, b, -n}, (const double[4]){-n, -n, n, n});
}

/* 4600: P = f / (f - n), Q = -f n / (f - n), w = z. */
static void matrix_of_4600_maps_near_to_0_and_far_to_1(void **state)
{
    (void)state;
    const struct ph_projection p = perspective(90, 2, 2, 10);
    check_projection(&p, PH_D3D, (const double[4][4]){{.5, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1.25, -2.5}, {0, 0, 1, 0}});
    check_clip(&p, PH_D3D, (const double[3]){0, 0, 2}, (const double[4]){0, 0, 0, 2});
    check_clip(&p, PH_D3D, (const double[3]){0, 0, 10}, (const double[4]){0, 0, 10, 10});
}

/* LMU: n and f are the coordinates -2 and -10; l = a n tan, b = n tan; clip w = z. */
static void matrix_of_LMU_is_its_product_of_two(void **state)
{
    (void)state;
    const double n = -2, f = -10;
    const struct ph_projection p = perspective(90, 2, 2, 10);
    const double want[4][4] = {
        {-.5, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, (n + f) / (n - f), 2 * n * f / (f - n)}, {0, 0, 1, 0}};
    check_projection(&p, PH_LMU, want);
    const struct ph_mat4 persp_to_ortho = {
        {{fx(n), 0, 0, 0}, {0, fx(n), 0, 0}, {0, 0, fx(n + f), fx(-n * f)}, {0, 0, FX_ONE, 0}}};
    struct ph_projection box;
    assert_int_equal(ph_projection_ortho(&box, FX_INT(-4), FX_INT(4), FX_INT(-2), FX_INT(2), FX_INT(2), FX_INT(10)),
                     PH_OK);
    struct ph_mat4 ortho;
    assert_int_equal(ph_matrix_projection(&ortho, &box, PH_LMU), PH_OK);
    check_matrix(&ortho, (const double[4][4]){
                             {.25, 0, 0, 0}, {0, .5, 0, 0}, {0, 0, 2 / (n - f), (f + n) / (f - n)}, {0, 0, 0, 1}});
    const struct ph_mat4 product = ph_mat4_mul(&ortho, &persp_to_ortho);
    check_matrix(&product, want);
    check_clip(&p, PH_LMU, (const double[3]){0, 0, -2}, (const double[4]){0, 0, -2, -2});   /* n to +1 */
    check_clip(&p, PH_LMU, (const double[3]){0, 0, -10}, (const double[4]){0, 0, 10, -10}); /* f to -1 */
}

/*
 * The whole curve of each document, at 200 distances of four lenses: HAW z_ndc = (f+n)/(f-n) + 2fn/(f-n)/z for z from
 * -n to -f, so -1 .. 1; LMU (n+f)/(n-f) + 2nf/(f-n)/z with coordinates n and f, so 1 .. -1; 4600 f/(f-n) - fn/(f-n)/z
 * for z from n to f, so 0 .. 1. Reversed is 1 minus that of 4600. Matrix and product round by half an LSB each.
 */
static void depth_of_each_convention_is_its_document_s_curve(void **state)
{
    (void)state;
    static const double lenses[][2] = {{.5, 10}, {1, 10}, {1, 3}, {2, 100}};
    for (int i = 0; i < 4 * 200; i++) {
        const double n = lenses[i / 200][0], f = lenses[i / 200][1], z = real(fx(n + (f - n) * (i % 200) / 199));
        const double want[] = {[PH_GL] = (f + n) / (f - n) - 2 * f * n / (f - n) / z,
                               [PH_D3D] = f / (f - n) - f * n / (f - n) / z,
                               [PH_LMU] = (-n - f) / (f - n) - 2 * n * f / (n - f) / z,
                               [PH_REVERSED] = f * n / (f - n) / z - n / (f - n)};
        const struct ph_projection p = perspective(90, 1, n, f);
        for (int convention = PH_GL; convention <= PH_REVERSED; convention++) {
            struct ph_mat4 m;
            assert_int_equal(ph_matrix_projection(&m, &p, (enum ph_convention)convention), PH_OK);
            const fx_t along = convention == PH_D3D ? fx(z) : -fx(z);
            const struct ph_vec4 clip = ph_mat4_apply(&m, (struct ph_vec4){0, 0, along, FX_ONE});
            assert_int_equal(clip.w < 0, convention == PH_LMU);
            assert_near(real(clip.z) / real(clip.w), want[convention], (.5 * z + 1) * LSB / z);
        }
    }
}

/* EECE: w = z / d. KAIST 4.10: y_s = d y / z. 4600: y' = y f / z. Here the image is 6 x 4, z the distance. */
static void pinhole_projects_y_to_d_y_over_z(void **state)
{
    (void)state;
    struct ph_projection p;
    assert_int_equal(ph_projection_pinhole(&p, FX_INT(3), FX_INT(6), FX_INT(4), FX_INT(1), FX_INT(64)), PH_OK);
    struct ph_mat4 m;
    assert_int_equal(ph_matrix_projection(&m, &p, PH_GL), PH_OK);
    ref_seed(6);
    for (int i = 0; i < 1000; i++) {
        const double x = real(fx(ref_uniform(-20, 20))), y = real(fx(ref_uniform(-20, 20))),
                     z = real(fx(ref_uniform(1, 64)));
        const struct ph_vec4 clip = ph_mat4_apply(&m, (struct ph_vec4){fx(x), fx(y), fx(-z), FX_ONE});
        assert_near(real(clip.x) / real(clip.w), 3 * x / z / 3, LSB);
        assert_near(real(clip.y) / real(clip.w), 3 * y / z / 2, LSB);
    }
}

/* EECE ("even to infinity"), HAW: the pinhole moves away and its focal length grows with the distance. */
static void focal_length_to_infinity_is_a_parallel_projection(void **state)
{
    (void)state;
    struct ph_projection p, box;
    struct ph_mat4 m, parallel;
    const double point[3] = {1.5, -1.25, 1}; /* one in front of the image plane */
    assert_int_equal(ph_projection_ortho(&box, FX_INT(-3), FX_INT(3), FX_INT(-2), FX_INT(2), FX_INT(1), FX_INT(5)),
                     PH_OK);
    assert_int_equal(ph_matrix_projection(&parallel, &box, PH_GL), PH_OK);
    const struct ph_vec4 flat = ph_mat4_apply(&parallel, (struct ph_vec4){fx(point[0]), fx(point[1]), 0, FX_ONE});
    for (int i = 1; i <= 5; i++) {
        const double d = pow(4, i);
        assert_int_equal(ph_projection_pinhole(&p, fx(d), FX_INT(6), FX_INT(4), FX_INT(1), fx(d + 2)), PH_OK);
        assert_int_equal(ph_matrix_projection(&m, &p, PH_GL), PH_OK);
        const struct ph_vec4 clip =
            ph_mat4_apply(&m, (struct ph_vec4){fx(point[0]), fx(point[1]), fx(point[2] - d), FX_ONE});
        const double ratio = d / (d - point[2]); /* to 1 */
        assert_near(real(clip.x) / real(clip.w), real(flat.x) * ratio, 2 * LSB);
        assert_near(real(clip.y) / real(clip.w), real(flat.y) * ratio, 2 * LSB);
    }
}

/* HAW exercise 4: the line through (1, 0) and (0, -1) is n.p + d = 0 with n = (-1, 1) / sqrt 2, d = 1 / sqrt 2. */
static void projection_onto_the_line_of_exercise_4(void **state)
{
    (void)state;
    const double half = sqrt(.5);
    const struct ph_mat4 q = ph_matrix_plane((struct fx_vec3){ref_q30(-half), ref_q30(half), 0}, fx(half));
    const double point[3][2] = {{1, 0}, {2, -2}, {1, 1}}, want[2][2] = {{1, 0}, {.5, -.5}};
    for (int i = 0; i < 3; i++) {
        const struct ph_vec4 to = ph_mat4_apply(&q, (struct ph_vec4){fx(point[i][0]), fx(point[i][1]), 0, FX_ONE});
        if (i == 2) { /* R goes to infinity */
            assert_int_equal(to.w, 0);
            assert_true(to.x != 0 && to.y != 0);
            continue;
        }
        assert_int_equal(fx_div_sat(to.x, to.w), fx(want[i][0]));
        assert_int_equal(fx_div_sat(to.y, to.w), fx(want[i][1]));
    }
}

/* HAW's remark: projecting twice is projecting once. Each element of Q Q is within 1 LSB of d Q. */
static void projecting_twice_is_projecting_once(void **state)
{
    (void)state;
    ref_seed(7);
    for (int i = 0; i < 1000; i++) {
        double n[3];
        ref_direction(n);
        const fx_t d = fx(ref_uniform(-100, 100));
        const struct ph_mat4 q = ph_matrix_plane((struct fx_vec3){ref_q30(n[0]), ref_q30(n[1]), ref_q30(n[2])}, d);
        const struct ph_mat4 twice = ph_mat4_mul(&q, &q);
        for (int e = 0; e < 16; e++) {
            assert_near(real(twice.m[e / 4][e % 4]), real(d) * real(q.m[e / 4][e % 4]), .51 * LSB);
        }
        for (int k = 0; k < 3; k++) { /* the centre of the shadow is the origin; the normal is Q2.30's */
            assert_near(real(q.m[3][k]), -n[k], .51 * LSB);
        }
    }
}

/* HAW: w_n / 2n = tan(theta_x / 2), h_n / 2n = tan(theta_y / 2), a = w / h at the near and the far plane. */
static void frustum_has_the_sizes_of_its_angles(void **state)
{
    (void)state;
    const struct ph_projection p = perspective(90, 2, 2, 10);
    fx_t width, height;
    ph_projection_size_at(&p, FX_INT(2), &width, &height);
    assert_int_equal(height, FX_INT(4));
    assert_int_equal(width, FX_INT(8));
    ph_projection_size_at(&p, FX_INT(10), &width, &height);
    assert_int_equal(height, FX_INT(20));
    assert_int_equal(width, FX_INT(40));
    for (int fov = 10; fov <= 150; fov += 7) {
        const struct ph_projection any = perspective(fov, 1.5, .5, 50);
        for (int i = 0; i < 2; i++) {
            const double z = i == 0 ? .5 : 50, tangent = tan(fov * acos(-1) / 360);
            const double accuracy = LSB + 2 * z * tangent * tangent * 1e-6; /* half an LSB of Q12.20 in the scale */
            ph_projection_size_at(&any, fx(z), &width, &height);
            assert_near(real(height) / 2 / z, tangent, accuracy / z);
            assert_near(real(width) / 2 / z, 1.5 * tangent, 2.25 * accuracy / z);
        }
    }
    struct ph_projection box;
    assert_int_equal(ph_projection_ortho(&box, FX_INT(-4), FX_INT(4), FX_INT(-2), FX_INT(2), FX_INT(1), FX_INT(5)),
                     PH_OK);
    ph_projection_size_at(&box, FX_INT(3), &width, &height);
    assert_int_equal(width, FX_INT(8));
    assert_int_equal(height, FX_INT(4));
}

/* HAW: camera.aspect = w / h; camera.updateProjectionMatrix(). */
static void resized_camera_is_the_camera_built_anew(void **state)
{
    (void)state;
    static const double sizes[][2] = {{240, 240}, {135, 240}, {240, 135}, {128, 64}, {320, 240}, {1024, 1}};
    for (int i = 0; i < 6; i++) {
        for (int fov = 20; fov <= 120; fov += 10) {
            const fx_t aspect = fx(sizes[i][0] / sizes[i][1]);
            struct ph_projection p = perspective(fov, 1, .5, 50);
            assert_int_equal(ph_projection_resize(&p, aspect), PH_OK);
            const struct ph_projection anew = perspective(fov, real(aspect), .5, 50);
            assert_int_equal(p.scale_x_q20, anew.scale_x_q20);
            assert_int_equal(p.scale_y_q20, anew.scale_y_q20);
        }
    }
}

/* Width over height in whole pixels. 90 degrees: cot 45 is 1, so that a scale is h / w and a width 2 z w / h, which are
 * held in whole numbers. 60 degrees: cot 30 9/16 is 63850.32 of 65536, within 1/100. */
static void a_picture_of_16_to_9_or_4_to_3_loses_nothing(void **state)
{
    (void)state;
    static const fx_t sizes[][2] = {{4, 3}, {16, 9}, {9, 16}, {320, 240}, {240, 135}, {3, 7}, {1024, 600}};
    for (int i = 0; i < 7; i++) {
        const int64_t w = sizes[i][0], h = sizes[i][1];
        struct ph_projection p = perspective(90, 1, .5, 50);
        assert_int_equal(ph_projection_fit(&p, sizes[i][0], sizes[i][1]), PH_OK);
        const int64_t off = (p.scale_x_q20 * w - (h << 20)) * 2;
        assert_true(off <= w && off >= -w);
        for (fx_t z = FX_ONE / 3; z < FX_INT(100); z += FX_ONE * 7 / 3) {
            fx_t width, height;
            ph_projection_size_at(&p, z, &width, &height);
            assert_int_equal(height, 2 * z);
            const int64_t wrong = ((int64_t)width * p.scale_x_q20 - ((int64_t)z << 21)) * 2;
            assert_true(wrong <= p.scale_x_q20 && wrong >= -p.scale_x_q20);
            const bool exact = w == 4 || w == 320; /* 3/4 fits Q12.20 */
            const int64_t third = ((int64_t)width * 3 - (int64_t)z * 8) * 2;
            assert_true(!exact || (third <= 3 && third >= -3));
        }
    }
    struct ph_projection p = perspective(60, 1, 2, 10);
    struct ph_mat4 m;
    assert_int_equal(ph_projection_fit(&p, FX_MAX, 1), PH_ERR_INVAL); /* a scale below Q12.20 */
    assert_int_equal(ph_projection_fit(&p, 16, 9), PH_OK);
    assert_int_equal(ph_matrix_projection(&m, &p, PH_GL), PH_OK);
    assert_int_equal(m.m[0][0], 63850);
}

/* ---- views -------------------------------------------------------------------------------------------------- */

/* KAIST 4.6 and LMU task 1: rows r, u, -l times the translation by -e; 4600: rows R, U, F. Camera (3, 1, 4) at (0, 1,
 * 0). */
static void look_at_has_the_rows_of_KAIST_LMU_and_4600(void **state)
{
    (void)state;
    const struct ph_xform view = ph_view_look_at(vec(3, 1, 4), vec(0, 1, 0), vec(0, 1, 0));
    const struct ph_mat4 gl = ph_matrix_view(&view, PH_GL), d3d = ph_matrix_view(&view, PH_D3D),
                         lmu = ph_matrix_view(&view, PH_LMU);
    const double want[4][4] = {{.8, 0, -.6, 0}, {0, 1, 0, -1}, {.6, 0, .8, -5}, {0, 0, 0, 1}};
    const double left_handed[4][4] = {{.8, 0, -.6, 0}, {0, 1, 0, -1}, {-.6, 0, -.8, 5}, {0, 0, 0, 1}};
    check_matrix(&gl, want);
    check_matrix(&lmu, want);
    check_matrix(&d3d, left_handed);
    const struct ph_xform at_origin = ph_view_look_at(vec(0, 0, 0), vec(-3, 0, -4), vec(0, 1, 0));
    const struct ph_xform away = ph_xform_translate(FX_INT(-3), FX_INT(-1), FX_INT(-4));
    const struct ph_mat4 r = ph_mat4_xform(&at_origin), t = ph_mat4_xform(&away), product = ph_mat4_mul(&r, &t);
    for (int e = 0; e < 16; e++) { /* R T of matrices rounded to Q16.16 */
        assert_near(real(product.m[e / 4][e % 4]), real(gl.m[e / 4][e % 4]), 4 * LSB);
    }
}

/* HAW exercise 2: camera.matrix has the columns (0, 0, -1), (0, 1, 0), (1, 0, 0), (5, 0, 0). */
static void camera_matrix_of_exercise_2(void **state)
{
    (void)state;
    const struct ph_xform view = ph_view_look_at(vec(5, 0, 0), vec(0, 0, 0), vec(0, 1, 0));
    const struct ph_xform camera = ph_xform_inverse_rigid(&view);
    const struct ph_mat4 m = ph_mat4_xform(&camera);
    check_matrix(&m, (const double[4][4]){{0, 0, 1, 5}, {0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 0, 1}});
}

/* The camera at (1, 2, 3) that looks along -x, stated by EECE's three ways and by LMU's quaternion. */
static const double along_minus_x[4][4] = {{0, 0, -1, 3}, {0, 1, 0, -2}, {1, 0, 0, -1}, {0, 0, 0, 1}};

static void check_view(struct ph_xform view, const double want[4][4])
{
    const struct ph_mat4 m = ph_matrix_view(&view, PH_GL);
    check_matrix(&m, want);
}

/* EECE: glRotate(-theta, axis), glTranslate(-p). */
static void camera_turned_by_90_degrees_about_y(void **state)
{
    (void)state;
    check_view(ph_view_rotate_translate(vec(0, 1, 0), 0x40000000, vec(1, 2, 3)), along_minus_x);
    check_view(ph_view_rotate_translate(vec(0, -20, 0), 0xc0000000, vec(1, 2, 3)), along_minus_x); /* any length */
}

/* EECE: the view plane normal points at the viewer; VUP need not be across it. */
static void view_plane_normal_is_against_the_view(void **state)
{
    (void)state;
    check_view(ph_view_phigs(vec(1, 2, 3), vec(1, 0, 0), vec(0, 1, 0)), along_minus_x);
    check_view(ph_view_phigs(vec(1, 2, 3), vec(7, 0, 0), vec(-5, 2, 0)), along_minus_x);
}

/* EECE's words roll, pitch, yaw: each alone, then yaw before pitch. */
static void yaw_pitch_and_roll_turn_about_y_x_and_z(void **state)
{
    (void)state;
    const uint32_t quarter = 0x40000000;
    const struct fx_vec3 origin = {0, 0, 0};
    const double up[4][4] = {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 0, 0, 1}};
    const double rolled[4][4] = {{0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    const double yawed_up[4][4] = {{0, 0, -1, 0}, {1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, 0, 1}};
    check_view(ph_view_yaw_pitch_roll(vec(1, 2, 3), quarter, 0, 0), along_minus_x);
    check_view(ph_view_yaw_pitch_roll(origin, 0, quarter, 0), up);
    check_view(ph_view_yaw_pitch_roll(origin, 0, 0, quarter), rolled);
    check_view(ph_view_yaw_pitch_roll(origin, quarter, quarter, 0), yawed_up);
}

/* LMU: "how to do it using quaternions?" cos and sin of 45 degrees; its length does not matter, nor its sign. */
static void quaternion_of_90_degrees_about_y(void **state)
{
    (void)state;
    const int32_t h = ref_q30(sqrt(.5)), third = FX_Q30_ONE / 3;
    check_view(ph_view_quat((struct fx_quat){h, 0, h, 0}, vec(1, 2, 3)), along_minus_x);
    check_view(ph_view_quat((struct fx_quat){-third, 0, -third, 0}, vec(1, 2, 3)), along_minus_x);
}

/* ---- from clip space to the screen ---------------------------------------------------------------------------- */

/* HAW: x_s = w/2 x + w/2, y_s = -h/2 y + h/2. 4600: (1 - y) h/2. LMU: y up. A 240 x 135 panel. */
static void viewports_of_HAW_4600_and_LMU(void **state)
{
    (void)state;
    const double down[4][4] = {{120, 0, 0, 120}, {0, -67.5, 0, 67.5}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    const double up[4][4] = {{120, 0, 0, 120}, {0, 67.5, 0, 67.5}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    const struct ph_mat4 gl = ph_matrix_viewport(240, 135, PH_GL), d3d = ph_matrix_viewport(240, 135, PH_D3D),
                         lmu = ph_matrix_viewport(240, 135, PH_LMU), rev = ph_matrix_viewport(240, 135, PH_REVERSED);
    check_matrix(&gl, down);
    check_matrix(&d3d, down);
    check_matrix(&rev, down);
    check_matrix(&lmu, up);
    const struct ph_vec4 corner = ph_mat4_apply(&gl, (struct ph_vec4){-FX_ONE, FX_ONE, 0, FX_ONE});
    assert_int_equal(corner.x, 0);
    assert_int_equal(corner.y, 0);
}

static double ndc_z(const struct ph_projection *p, double z)
{
    struct ph_mat4 m;
    assert_int_equal(ph_matrix_projection(&m, p, PH_GL), PH_OK);
    const struct ph_vec4 clip = ph_mat4_apply(&m, (struct ph_vec4){0, 0, fx(z), FX_ONE});
    return real(clip.z) / real(clip.w);
}

/* HAW exercise 5: g(z) = (f + n) / (f - n) + 2 f n / (f - n) / z for f = 3, n = 1 is 2 + 3 / z. */
static void depth_of_exercise_5_runs_from_minus_1_to_1(void **state)
{
    (void)state;
    const struct ph_projection p = perspective(60, 1, 1, 3);
    assert_true(ndc_z(&p, -1) == -1);
    assert_true(ndc_z(&p, -1.5) == 0);
    assert_true(ndc_z(&p, -2) == .5);
    assert_true(ndc_z(&p, -3) == 1);
}

/* HAW: why g and not z itself. Thirds of a segment in camera space are on one line of NDC space, within 1e-4. */
static void straight_lines_stay_straight(void **state)
{
    (void)state;
    const struct ph_projection p = perspective(60, 1.5, 1, 3);
    struct ph_mat4 m;
    assert_int_equal(ph_matrix_projection(&m, &p, PH_GL), PH_OK);
    ref_seed(5);
    for (int i = 0; i < 1000; i++) {
        double a[3], b[3], at[3][3];
        for (int k = 0; k < 3; k++) {
            a[k] = ref_uniform(-1, 1) - 2 * (k == 2);
            b[k] = ref_uniform(-1, 1) - 2 * (k == 2);
        }
        for (int j = 0; j < 3; j++) {
            const double s = j / 3. + .1;
            const struct ph_vec4 clip =
                ph_mat4_apply(&m, (struct ph_vec4){fx(a[0] + s * (b[0] - a[0])), fx(a[1] + s * (b[1] - a[1])),
                                                   fx(a[2] + s * (b[2] - a[2])), FX_ONE});
            at[j][0] = real(clip.x) / real(clip.w);
            at[j][1] = real(clip.y) / real(clip.w);
            at[j][2] = real(clip.z) / real(clip.w);
        }
        for (int k = 0; k < 3; k++) {
            const int u = k, v = (k + 1) % 3;
            assert_near((at[1][u] - at[0][u]) * (at[2][v] - at[0][v]), (at[1][v] - at[0][v]) * (at[2][u] - at[0][u]),
                        4e-4);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orthographic_camera_sends_left_to_minus_one),
        cmocka_unit_test(perspective_camera_of_exercise_6_has_its_matrix),
        cmocka_unit_test(corner_of_the_frustum_maps_to_the_corner_of_clip_space),
        cmocka_unit_test(matrix_of_4600_maps_near_to_0_and_far_to_1),
        cmocka_unit_test(matrix_of_LMU_is_its_product_of_two),
        cmocka_unit_test(depth_of_each_convention_is_its_document_s_curve),
        cmocka_unit_test(pinhole_projects_y_to_d_y_over_z),
        cmocka_unit_test(focal_length_to_infinity_is_a_parallel_projection),
        cmocka_unit_test(projection_onto_the_line_of_exercise_4),
        cmocka_unit_test(projecting_twice_is_projecting_once),
        cmocka_unit_test(frustum_has_the_sizes_of_its_angles),
        cmocka_unit_test(resized_camera_is_the_camera_built_anew),
        cmocka_unit_test(a_picture_of_16_to_9_or_4_to_3_loses_nothing),
        cmocka_unit_test(look_at_has_the_rows_of_KAIST_LMU_and_4600),
        cmocka_unit_test(camera_matrix_of_exercise_2),
        cmocka_unit_test(camera_turned_by_90_degrees_about_y),
        cmocka_unit_test(view_plane_normal_is_against_the_view),
        cmocka_unit_test(yaw_pitch_and_roll_turn_about_y_x_and_z),
        cmocka_unit_test(quaternion_of_90_degrees_about_y),
        cmocka_unit_test(viewports_of_HAW_4600_and_LMU),
        cmocka_unit_test(depth_of_exercise_5_runs_from_minus_1_to_1),
        cmocka_unit_test(straight_lines_stay_straight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
