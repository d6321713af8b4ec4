/* Vectors, quaternions, transforms, look-at and projections are compared with double arithmetic and the textbooks. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "geom.h"
#include "geom_sum.h"
#include "status.h"

#include <math.h>
#include <stdlib.h>

#define PI  3.14159265358979323846
#define LSB (1.0 / 65536)
#define Q30 (1.0 / (1 << 30))

static uint32_t seed = 12345;

static uint32_t next_random(void)
{
    seed ^= seed << 13;
    seed ^= seed >> 17;
    seed ^= seed << 5;
    return seed;
}

/* Any size: a random number of random low bits, either sign. */
static fx_t random_fx(void)
{
    const uint32_t bits = next_random() % 31 + 1;
    const fx_t v = (fx_t)(next_random() >> (32 - bits));
    return next_random() & 1 ? v : -v;
}

static struct fx_vec3 random_vec(void)
{
    return (struct fx_vec3){random_fx(), random_fx(), random_fx()};
}

static double real(fx_t v)
{
    return v * LSB;
}

static double saturated(double v)
{
    return v > FX_MAX * LSB ? FX_MAX * LSB : v < FX_MIN * LSB ? FX_MIN * LSB : v;
}

static void near(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance)) {
        fail_msg("got %.12g, want %.12g, off by %.3g, allowed %.3g", got, want, fabs(got - want), tolerance);
    }
}

static struct fx_vec3 vec(double x, double y, double z)
{
    return (struct fx_vec3){(fx_t)lrint(x * 65536), (fx_t)lrint(y * 65536), (fx_t)lrint(z * 65536)};
}

/* floor(sum / 2^bits + 1/2), clamped. */
static fx_t rounded_sum(__int128 sum, int bits)
{
    const __int128 v = (sum + ((__int128)1 << (bits - 1))) >> bits;
    return v > FX_MAX ? FX_MAX : v < FX_MIN ? FX_MIN : (fx_t)v;
}

static __int128 exact_dot(struct fx_vec3 a, struct fx_vec3 b)
{
    return (__int128)a.x * b.x + (__int128)a.y * b.y + (__int128)a.z * b.z;
}

/* Bit for bit: a product that is truncated before the sum is off by an LSB in 18 of a million. */
static void products_are_rounded_once(void **state)
{
    const struct fx_vec3 least = {FX_MIN, FX_MIN, FX_MIN}, most = {FX_MAX, FX_MAX, FX_MAX};
    (void)state;
    for (int i = 0; i < 1000000; i++) {
        const struct fx_vec3 a = random_vec(), b = random_vec(), c = fx_vec3_cross_sat(a, b);
        assert_int_equal(fx_vec3_dot_sat(a, b), rounded_sum(exact_dot(a, b), 16));
        assert_int_equal(c.x, rounded_sum((__int128)a.y * b.z - (__int128)a.z * b.y, 16));
        assert_int_equal(c.z, rounded_sum((__int128)a.x * b.y - (__int128)a.y * b.x, 16));
    }
    assert_int_equal(fx_vec3_dot_sat(least, least), FX_MAX);
    assert_int_equal(fx_vec3_dot_sat(least, most), FX_MIN);
    assert_int_equal(fx_vec3_cross_sat((struct fx_vec3){0, FX_MIN, FX_MAX}, least).x, FX_MAX);
}

/* Ties, and sums next to them: x is made for the row so that the sum is near the middle between two results. */
static void transforms_are_rounded_once(void **state)
{
    (void)state;
    for (int i = 0; i < 300000; i++) {
        struct ph_xform m = ph_xform_identity;
        const struct fx_vec3 p = random_vec();
        m.r[0][0] = 1 << (random_fx() & 15);
        m.r[0][1] = random_fx();
        m.r[0][2] = random_fx();
        const __int128 others = (__int128)m.r[0][1] * p.y + (__int128)m.r[0][2] * p.z;
        const __int128 middle = ((others >> 30) * 2 + 1) * (1 << 29);
        const __int128 x = (middle - others) / m.r[0][0];
        const struct fx_vec3 q = {x >= FX_MIN && x <= FX_MAX ? (fx_t)x : p.x, p.y, p.z};
        assert_int_equal(ph_xform_point(&m, q).x, rounded_sum((__int128)m.r[0][0] * q.x + others, 30));
    }
}

/* A placement that only scales and moves takes a way of its own: one product an element. */
static void scaled_placements_are_rounded_once(void **state)
{
    (void)state;
    for (int i = 0; i < 100000; i++) {
        struct ph_xform a, b = ph_xform_identity;
        for (int k = 0; k < 9; k++) {
            a.r[k / 3][k % 3] = random_fx();
        }
        a.t = b.t = (struct fx_vec3){0, 0, 0};
        for (int k = 0; k < 3; k++) {
            b.r[k][k] = random_fx();
        }
        const struct ph_xform m = ph_xform_mul(&a, &b);
        for (int k = 0; k < 9; k++) {
            assert_int_equal(m.r[k / 3][k % 3], rounded_sum((__int128)a.r[k / 3][k % 3] * b.r[k % 3][k % 3], 30));
        }
    }
}

/* One of the two ends of a range, or any number within. */
static int32_t within(int32_t least, int32_t most)
{
    const uint32_t at = next_random() % 5;
    return at == 0 ? least : at == 1 ? most : (int32_t)(least + (int64_t)next_random() % ((int64_t)most - least + 1));
}

/* What ARMv6-M does in products of 32 bits, within the range that it takes; one step outside it is refused. */
static void near_rows_are_rounded_once(void **state)
{
    (void)state;
    for (int i = 0; i < 300000; i++) {
        int32_t row[3], p[3], c = within(-(1 << 30), (1 << 30) - 1);
        for (int k = 0; k < 3; k++) {
            row[k] = within(1 - (1 << 30), 1 << 30);
            p[k] = within(-(1 << 19), (1 << 19) - 1);
        }
        __int128 sum = (__int128)c * (1 << 30);
        for (int k = 0; k < 3; k++) {
            sum += (__int128)row[k] * p[k];
        }
        assert_true(geom_row_is_near(row, p[0], p[1], p[2], c));
        assert_int_equal(geom_near_row(row, p[0], p[1], p[2], c), rounded_sum(sum, 30));
        int32_t *const outside[] = {&row[0], &row[1], &row[2], &p[0], &p[1], &p[2], &c};
        const int which = i % 7;
        const bool over = next_random() & 1;
        *outside[which] = which < 3   ? (over ? (1 << 30) + 1 : -(1 << 30))
                          : which < 6 ? (over ? 1 << 19 : -(1 << 19) - 1)
                                      : (over ? 1 << 30 : -(1 << 30) - 1);
        assert_false(geom_row_is_near(row, p[0], p[1], p[2], c));
    }
}

static void lengths_are_correctly_rounded(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        const struct fx_vec3 a = random_vec();
        const long double square =
            (long double)a.x * a.x + (long double)a.y * a.y + (long double)a.z * a.z; /* exact to 64 bits */
        near(real(fx_vec3_length_sat(a)), saturated((double)sqrtl(square) * LSB), .50001 * LSB);
    }
    assert_int_equal(fx_vec3_length_sat((struct fx_vec3){FX_MIN, FX_MIN, FX_MIN}), FX_MAX);
}

static void directions_have_length_one(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        const struct fx_vec3 a = random_vec();
        struct fx_vec3 unit;
        if (!fx_vec3_direction_q30(a, &unit)) {
            assert_true(a.x == 0 && a.y == 0 && a.z == 0);
            continue;
        }
        const double length = sqrt((double)a.x * a.x + (double)a.y * a.y + (double)a.z * a.z);
        near(unit.x * Q30, a.x / length, 8 * Q30);
        near(unit.y * Q30, a.y / length, 8 * Q30);
        near(unit.z * Q30, a.z / length, 8 * Q30);
    }
}

static void the_zero_vector_has_no_direction(void **state)
{
    (void)state;
    struct fx_vec3 unit = {1, 2, 3};
    assert_false(fx_vec3_direction_q30((struct fx_vec3){0, 0, 0}, &unit));
    assert_int_equal(unit.x, 0);
    assert_int_equal(unit.y, 0);
    assert_int_equal(unit.z, 0);
    const struct fx_quat q = fx_quat_axis((struct fx_vec3){0, 0, 0}, 12345);
    assert_int_equal(q.w, FX_Q30_ONE);
    const struct fx_quat z = fx_quat_normalise((struct fx_quat){0, 0, 0, 0});
    assert_int_equal(z.w, FX_Q30_ONE);
}

/* All quaternions of 11 extremes a component. Their length in double is one, to the rounding of four components. */
static void every_quaternion_gets_length_one(void **state)
{
    static const int32_t extremes[] = {INT32_MIN, INT32_MIN + 1, INT32_MIN / 2, -FX_ONE,       -1,       0,
                                       1,         FX_ONE,        INT32_MAX / 2, INT32_MAX - 1, INT32_MAX};
    enum { N = sizeof extremes / sizeof *extremes };
    (void)state;
    for (uint32_t i = 0; i < N * N * N * N; i++) {
        const struct fx_quat q = fx_quat_normalise(
            (struct fx_quat){extremes[i % N], extremes[i / N % N], extremes[i / N / N % N], extremes[i / N / N / N]});
        const double length = sqrt((double)q.w * q.w + (double)q.x * q.x + (double)q.y * q.y + (double)q.z * q.z);
        assert_true(fabs(length / FX_Q30_ONE - 1) < 4e-9);
    }
}

/* Rodrigues' formula in double, which takes no quaternions. */
static void rodrigues(const double k[3], double angle, double m[3][3])
{
    const double c = cos(angle), s = sin(angle);
    const double cross[3][3] = {{0, -k[2], k[1]}, {k[2], 0, -k[0]}, {-k[1], k[0], 0}};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            m[i][j] = (i == j) * c + s * cross[i][j] + (1 - c) * k[i] * k[j];
        }
    }
}

static void quaternions_rotate_as_rodrigues_says(void **state)
{
    (void)state;
    for (int i = 0; i < 5000; i++) {
        const struct fx_vec3 axis = random_vec();
        const double length = sqrt((double)axis.x * axis.x + (double)axis.y * axis.y + (double)axis.z * axis.z);
        if (length == 0) {
            continue;
        }
        const uint32_t turn = next_random();
        const double k[3] = {axis.x / length, axis.y / length, axis.z / length};
        double want[3][3];
        rodrigues(k, 2 * PI * turn / 4294967296.0, want);
        const struct ph_xform got = ph_xform_quat(fx_quat_axis(axis, turn), (struct fx_vec3){0, 0, 0});
        for (int e = 0; e < 9; e++) {
            near(got.r[e / 3][e % 3] * Q30, want[e / 3][e % 3], 40 * Q30);
        }
    }
}

static void quaternion_product_is_one_rotation_after_the_other(void **state)
{
    (void)state;
    for (int i = 0; i < 2000; i++) {
        const struct fx_quat a = fx_quat_axis(random_vec(), next_random());
        const struct fx_quat b = fx_quat_axis(random_vec(), next_random());
        const struct fx_vec3 none = {0, 0, 0};
        const struct ph_xform ma = ph_xform_quat(a, none), mb = ph_xform_quat(b, none);
        const struct ph_xform both = ph_xform_mul(&ma, &mb), product = ph_xform_quat(fx_quat_mul(a, b), none);
        for (int e = 0; e < 9; e++) {
            near(product.r[e / 3][e % 3] * Q30, both.r[e / 3][e % 3] * Q30, 80 * Q30);
        }
    }
}

static void nlerp_goes_the_short_way_from_a_to_b(void **state)
{
    (void)state;
    const struct fx_vec3 y = {0, FX_ONE, 0};
    const struct fx_quat a = fx_quat_axis(y, 0x10000000), b = fx_quat_axis(y, 0x30000000);
    const struct fx_quat minus_b = {-b.w, -b.x, -b.y, -b.z};
    const struct fx_quat half = fx_quat_axis(y, 0x20000000);
    const struct fx_quat got = fx_quat_nlerp(a, minus_b, FX_HALF);
    near(got.w * Q30, half.w * Q30, 8 * Q30);
    near(got.y * Q30, half.y * Q30, 8 * Q30);
    const struct fx_quat start = fx_quat_nlerp(a, b, 0);
    near(start.y * Q30, a.y * Q30, 4 * Q30);
}

static void rotations_about_the_axes_turn_the_right_way(void **state)
{
    (void)state;
    const uint32_t quarter = 0x40000000;
    const struct ph_xform x = ph_xform_rotate_x(quarter), y = ph_xform_rotate_y(quarter),
                          z = ph_xform_rotate_z(quarter);
    const struct fx_vec3 from_y = ph_xform_point(&x, vec(0, 1, 0)), from_z = ph_xform_point(&y, vec(0, 0, 1)),
                         from_x = ph_xform_point(&z, vec(1, 0, 0));
    assert_int_equal(from_y.z, FX_ONE); /* y to z */
    assert_int_equal(from_z.x, FX_ONE); /* z to x */
    assert_int_equal(from_x.y, FX_ONE); /* x to y */
}

static void points_are_transformed_within_half_an_lsb(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        struct ph_xform m = ph_xform_quat(fx_quat_axis(random_vec(), next_random()), random_vec());
        const struct fx_vec3 p = random_vec(), got = ph_xform_point(&m, p);
        const __int128 sum = (__int128)m.r[1][0] * p.x + (__int128)m.r[1][1] * p.y + (__int128)m.r[1][2] * p.z +
                             (__int128)m.t.y * (1 << 30);
        near(real(got.y), saturated((double)sum * Q30 * LSB), .5001 * LSB);
    }
}

static void inverse_undoes_a_rigid_transform(void **state)
{
    (void)state;
    for (int i = 0; i < 2000; i++) {
        const struct fx_vec3 t = vec((int)(next_random() % 200) - 100, 3.25, -7.5);
        const struct ph_xform m = ph_xform_quat(fx_quat_axis(random_vec(), next_random()), t);
        const struct ph_xform inverse = ph_xform_inverse_rigid(&m);
        const struct fx_vec3 p = vec(1.5, -20.25, 60.125);
        const struct fx_vec3 there = ph_xform_point(&m, p), back = ph_xform_point(&inverse, there);
        near(real(back.x), real(p.x), 2 * LSB);
        near(real(back.y), real(p.y), 2 * LSB);
        near(real(back.z), real(p.z), 2 * LSB);
    }
}

/*
 * K. Juenemann, HAW Hamburg, chapter 9, exercise 2: a camera at (5, 0, 0) that looks at the origin has the axes
 * x = (0, 0, -1), y = (0, 1, 0), z = (1, 0, 0).
 */
static void camera_on_the_x_axis_has_the_axes_of_the_exercise(void **state)
{
    (void)state;
    const struct ph_xform view = ph_view_look_at(vec(5, 0, 0), vec(0, 0, 0), vec(0, 1, 0));
    const struct ph_xform camera = ph_xform_inverse_rigid(&view);
    static const int want[3][3] = {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}; /* columns x, y, z */
    for (int e = 0; e < 9; e++) {
        assert_int_equal(camera.r[e / 3][e % 3], want[e / 3][e % 3] * FX_Q30_ONE);
    }
    assert_int_equal(camera.t.x, FX_INT(5));
    assert_int_equal(camera.t.y, 0);
    assert_int_equal(camera.t.z, 0);
}

static void check_rigid(const struct ph_xform *m)
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            double dot = 0;
            for (int k = 0; k < 3; k++) {
                dot += m->r[i][k] * Q30 * m->r[j][k] * Q30;
            }
            near(dot, i == j, 1e-7);
        }
    }
}

/* The target lies on -z at its distance, up stays in the y-z plane, for any camera. */
static void look_at_puts_the_target_on_minus_z(void **state)
{
    (void)state;
    for (int i = 0; i < 5000; i++) {
        const struct fx_vec3 eye = vec((int)(next_random() % 2000) / 10.0 - 100, (int)(next_random() % 50), 3),
                             target = vec(-4, 2, (int)(next_random() % 1000) / 7.0), up = vec(.1, 1, -.2);
        const struct ph_xform view = ph_view_look_at(eye, target, up);
        check_rigid(&view);
        const struct fx_vec3 t = ph_xform_point(&view, target);
        const double distance = sqrt(pow(real(eye.x) - real(target.x), 2) + pow(real(eye.y) - real(target.y), 2) +
                                     pow(real(eye.z) - real(target.z), 2));
        near(real(t.x), 0, 3 * LSB);
        near(real(t.y), 0, 3 * LSB);
        near(real(t.z), -distance, 3 * LSB);
        const struct fx_vec3 above = {eye.x + up.x, eye.y + up.y, eye.z + up.z}, v = ph_xform_point(&view, above);
        near(real(v.x), 0, 3 * LSB);
        assert_true(v.y > 0);
    }
}

static void cameras_without_a_direction_have_a_stated_view(void **state)
{
    (void)state;
    const struct fx_vec3 here = vec(1, 2, 3), up = vec(0, 1, 0);
    const struct ph_xform itself = ph_view_look_at(here, here, up);
    check_rigid(&itself);
    assert_int_equal(itself.r[2][2], FX_Q30_ONE); /* along -z */
    assert_int_equal(itself.t.z, FX_INT(-3));
    static const struct fx_vec3 targets[] = {{FX_INT(1), FX_INT(9), FX_INT(3)}, {FX_INT(1), FX_INT(-9), FX_INT(3)}};
    for (int i = 0; i < 2; i++) { /* straight up and down: up is replaced by z */
        const struct ph_xform view = ph_view_look_at(here, targets[i], up);
        check_rigid(&view);
        assert_int_equal(view.r[1][2], FX_Q30_ONE);
    }
    const struct ph_xform no_up = ph_view_look_at(here, vec(1, 2, -9), vec(0, 0, 0)); /* replaced by y */
    assert_int_equal(no_up.r[1][1], FX_Q30_ONE);
    const struct ph_xform far =
        ph_view_look_at((struct fx_vec3){FX_MIN, FX_MIN, FX_MIN}, (struct fx_vec3){FX_MAX, FX_MAX, FX_MAX}, up);
    check_rigid(&far);
}

static void perspective_has_the_elements_of_the_opengl_matrix(void **state)
{
    (void)state;
    struct ph_projection p;
    /* Juenemann's exercise 6: (90 degrees, 2, 2, 10) has .5 and 1 */
    assert_int_equal(ph_projection_perspective(&p, FX_INT(90), FX_INT(2), FX_INT(2), FX_INT(10)), PH_OK);
    assert_int_equal(p.scale_x_q20, 1 << 19);
    assert_int_equal(p.scale_y_q20, 1 << 20);
    for (int fov = 1; fov < 180; fov++) {
        assert_int_equal(ph_projection_perspective(&p, FX_INT(fov), 98304, FX_HALF, FX_INT(100)), PH_OK);
        const double cot = 1 / tan(fov * PI / 360);
        near(p.scale_y_q20, cot * 1048576, .501);
        near(p.scale_x_q20, cot / 1.5 * 1048576, .5 + .501 / 1.5);
    }
}

static void frustum_and_ortho_have_the_elements_of_the_opengl_matrices(void **state)
{
    (void)state;
    struct ph_projection p;
    assert_int_equal(ph_projection_frustum(&p, FX_INT(-1), FX_INT(3), FX_INT(-2), FX_INT(1), FX_INT(2), FX_INT(50)),
                     PH_OK);
    near(p.scale_x_q20 / 1048576.0, 2 * 2 / 4.0, 1e-6);
    near(p.scale_y_q20 / 1048576.0, 2 * 2 / 3.0, 1e-6);
    near(real(p.shift_x), (3 - 1) / 4.0, LSB);
    near(real(p.shift_y), (1 - 2) / 3.0, LSB);
    assert_int_equal(ph_projection_ortho(&p, 0, FX_INT(240), 0, FX_INT(320), FX_INT(-1), FX_INT(1)), PH_OK);
    near(p.scale_x_q20 / 1048576.0, 2 / 240.0, 1e-6);
    near(p.scale_y_q20 / 1048576.0, 2 / 320.0, 1e-6);
    near(real(p.shift_x), 1, 0);
}

static void impossible_volumes_are_refused_and_change_nothing(void **state)
{
    (void)state;
    struct ph_projection p = {.near_z = 42};
    const fx_t one = FX_ONE, ten = FX_INT(10);
    assert_int_equal(ph_projection_perspective(&p, 0, one, one, ten), PH_ERR_INVAL);
    assert_int_equal(ph_projection_perspective(&p, FX_INT(180), one, one, ten), PH_ERR_INVAL);
    assert_int_equal(ph_projection_perspective(&p, FX_INT(-5), one, one, ten), PH_ERR_INVAL);
    assert_int_equal(ph_projection_perspective(&p, FX_INT(60), 0, one, ten), PH_ERR_INVAL);
    assert_int_equal(ph_projection_perspective(&p, FX_INT(60), one, 0, ten), PH_ERR_INVAL);
    assert_int_equal(ph_projection_perspective(&p, FX_INT(60), one, ten, ten), PH_ERR_INVAL);
    assert_int_equal(ph_projection_perspective(&p, 1, one, one, ten), PH_ERR_INVAL); /* 1/65536 degree */
    assert_int_equal(ph_projection_frustum(&p, one, one, -one, one, one, ten), PH_ERR_INVAL);
    assert_int_equal(ph_projection_frustum(&p, -one, one, one, -one, one, ten), PH_ERR_INVAL);
    assert_int_equal(ph_projection_frustum(&p, -one, one, -one, one, -one, ten), PH_ERR_INVAL);
    assert_int_equal(ph_projection_ortho(&p, -one, one, one, one, -one, one), PH_ERR_INVAL);
    assert_int_equal(ph_projection_ortho(&p, -one, one, -one, one, one, one), PH_ERR_INVAL);
    assert_int_equal(p.near_z, 42);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lengths_are_correctly_rounded),
        cmocka_unit_test(directions_have_length_one),
        cmocka_unit_test(the_zero_vector_has_no_direction),
        cmocka_unit_test(every_quaternion_gets_length_one),
        cmocka_unit_test(quaternions_rotate_as_rodrigues_says),
        cmocka_unit_test(quaternion_product_is_one_rotation_after_the_other),
        cmocka_unit_test(nlerp_goes_the_short_way_from_a_to_b),
        cmocka_unit_test(rotations_about_the_axes_turn_the_right_way),
        cmocka_unit_test(points_are_transformed_within_half_an_lsb),
        cmocka_unit_test(inverse_undoes_a_rigid_transform),
        cmocka_unit_test(camera_on_the_x_axis_has_the_axes_of_the_exercise),
        cmocka_unit_test(look_at_puts_the_target_on_minus_z),
        cmocka_unit_test(cameras_without_a_direction_have_a_stated_view),
        cmocka_unit_test(perspective_has_the_elements_of_the_opengl_matrix),
        cmocka_unit_test(frustum_and_ortho_have_the_elements_of_the_opengl_matrices),
        cmocka_unit_test(impossible_volumes_are_refused_and_change_nothing),
        cmocka_unit_test(products_are_rounded_once),
        cmocka_unit_test(transforms_are_rounded_once),
        cmocka_unit_test(scaled_placements_are_rounded_once),
        cmocka_unit_test(near_rows_are_rounded_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
