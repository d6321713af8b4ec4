/*
 * Every public function of fx, fx_math, geom, camera, motion and the effects, with any numbers: first with all
 * combinations of 11 extremes an argument (a member of a struct is one; where there are more than six, all combinations
 * for each three of them, or each two of more than twelve, and random ones for the others), then with random ones.
 * UndefinedBehaviorSanitizer and AddressSanitizer look for what is undefined; what the headers promise is compared with
 * 128-bit integers and with doubles. fx.h and fx_math.h have bounds of errors that exhaustive_fx.c and
 * exhaustive_fx_math.c look at; here they need only return.
 *
 * Usage: fuzz_total [quick | long | ROUNDS [SEED]]
 * A round is a call. quick (the default) has two million random ones, long 100 million. tests/tools/test_house.sh looks
 * that no function is missing here.
 */
#include "blur.h"
#include "camera.h"
#include "fx_math.h"
#include "motion.h"
#include "overlay.h"
#include "shadow.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define QUICK     2000000
#define LONG      100000000
#define WORDS_MAX 32
#define EXTREMES  11

struct op {
    const char *name;
    uint32_t words; /* of its arguments */
    bool slow;      /* so it is called in one of 256 of its random rounds, and without combinations of three */
    void (*call)(const int32_t *a);
};

static const int32_t extremes[EXTREMES] = {FX_MIN, FX_MIN + 1, -FX_ONE - 1, -FX_ONE,    -1,    0,
                                           1,      FX_ONE,     FX_ONE + 1,  FX_MAX - 1, FX_MAX};

/* ---- random numbers, and what is told ---------------------------------------------------------------------------- */

static uint64_t state;
static const struct op *now;
static int32_t args[WORDS_MAX];

static uint32_t bits(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(state >> 32);
}

static int32_t any(void)
{
    const uint32_t kind = bits();
    switch (kind >> 30) {
    case 0:
        return extremes[(kind & 0xffff) % EXTREMES];
    case 1: /* near a power of two */
        return (int32_t)((1u << (kind & 31)) + (kind >> 8 & 7) - 3);
    default: /* of any magnitude */
        return (int32_t)bits() >> (kind & 31);
    }
}

static void tell(void)
{
    fprintf(stderr, "fuzz_total: %s(", now != NULL ? now->name : "");
    for (uint32_t i = 0; now != NULL && i < now->words; i++) {
        fprintf(stderr, "%s%" PRId32, i > 0 ? ", " : "", args[i]);
    }
    fprintf(stderr, ")\n");
}

/* Called by UndefinedBehaviorSanitizer and AddressSanitizer when they report. */
void __ubsan_on_report(void);
void __asan_on_error(void);

void __ubsan_on_report(void)
{
    tell();
}

void __asan_on_error(void)
{
    tell();
}

static void check(bool right, const char *what)
{
    if (!right) {
        fprintf(stderr, "fuzz_total: %s\n", what);
        tell();
        exit(1);
    }
}

/* ---- what the headers promise ------------------------------------------------------------------------------------ */

/* floor(sum / 2^shift + 1/2), clamped. */
static int32_t rounded(__int128 sum, int shift)
{
    const __int128 v = (sum + ((__int128)1 << (shift - 1))) >> shift;
    return v > INT32_MAX ? INT32_MAX : v < INT32_MIN ? INT32_MIN : (int32_t)v;
}

static void check_row(int32_t got, const int32_t *row, const int32_t *v, int n, int shift, int32_t more)
{
    __int128 sum = (__int128)more * ((__int128)1 << shift);
    for (int i = 0; i < n; i++) {
        sum += (__int128)row[i] * v[i];
    }
    check(got == rounded(sum, shift), "a sum of products is not rounded once");
}

static bool near(double got, double want, double off)
{
    return fabs(got - want) <= off;
}

static double dot_q30(const int32_t a[3], const int32_t b[3])
{
    return ldexp((double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2], -60);
}

/* Directions are within 2^-27 in each component; so rows that are of length one, and across each other, are within four
 * times as much. */
static void check_rows(const struct ph_xform *m, double off)
{
    for (int i = 0; i < 3; i++) {
        check(near(dot_q30(m->r[i], m->r[i]), 1, 0x1p-25), "a row of a rotation has not length one");
        check(near(dot_q30(m->r[i], m->r[(i + 1) % 3]), 0, off), "two rows of a rotation are not at right angles");
    }
}

static void check_rotation(const struct ph_xform *m)
{
    check_rows(m, 0x1p-25);
}

static void check_unit(struct fx_quat q)
{
    const double length = (double)q.w * q.w + (double)q.x * q.x + (double)q.y * q.y + (double)q.z * q.z;
    check(near(ldexp(length, -60), 1, 0x1p-26), "a quaternion has not length one");
}

static void check_volume(const struct ph_projection *p, int status)
{
    static const struct ph_projection before = {.kind = PH_ORTHOGRAPHIC, .scale_x_q20 = 77};
    if (status != PH_OK) {
        check(status == PH_ERR_INVAL && memcmp(p, &before, sizeof before) == 0, "a refused volume was written");
        return;
    }
    check(p->far_z > p->near_z && (p->kind == PH_ORTHOGRAPHIC || p->near_z > 0), "its planes are impossible");
    check(p->scale_x_q20 > 0 && p->scale_y_q20 > 0, "its scales are not positive");
}

/* ---- arguments --------------------------------------------------------------------------------------------------- */

static struct fx_vec3 vec(const int32_t *a)
{
    return (struct fx_vec3){a[0], a[1], a[2]};
}

static struct fx_quat quat(const int32_t *a)
{
    return (struct fx_quat){a[0], a[1], a[2], a[3]};
}

static struct ph_xform xform(const int32_t *a)
{
    return (struct ph_xform){{{a[0], a[1], a[2]}, {a[3], a[4], a[5]}, {a[6], a[7], a[8]}}, vec(a + 9)};
}

static enum ph_convention convention(int32_t a)
{
    return (enum ph_convention)(a & 3);
}

static struct ph_projection volume(const int32_t *a)
{
    return (struct ph_projection){
        (enum ph_projection_kind)((uint32_t)a[0] % 3), a[1], a[2], a[3], a[4], a[5], a[6], NULL};
}

static struct ph_mat4 matrix(const int32_t *a)
{
    struct ph_mat4 m;
    memcpy(m.m, a, sizeof m.m);
    return m;
}

static int16_t half(int32_t a)
{
    return (int16_t)(a >> 16);
}

/* Keeps a result. */
static volatile int32_t kept;

/* ---- fx.h and fx_math.h ------------------------------------------------------------------------------------------ */

static void unary(const int32_t *a)
{
    static fx_t (*const f[])(fx_t) = {
        fx_neg_sat,  fx_abs_sat,   fx_rcp_sat,  fx_sqrt,           fx_rsqrt_sat,          fx_sin,          fx_cos,
        fx_tan_sat,  fx_exp2_sat,  fx_exp_sat,  fx_sinh_sat,       fx_cosh_sat,           fx_tanh,         fx_log2_sat,
        fx_log_sat,  fx_asin,      fx_acos,     fx_turns_from_rad, fx_rad_from_turns_sat, fx_cot_half_q20, fx_floor,
        fx_ceil_sat, fx_round_sat, fx_from_q30, fx_to_q30_sat};
    for (size_t i = 0; i < sizeof f / sizeof f[0]; i++) {
        kept = f[i](*a);
    }
    kept = (int32_t)(fx_turn32_from_deg(*a) ^ fx_turn32_from_rad(*a) ^ fx_magnitude(*a));
    kept = fx_clz32((uint32_t)*a);
    kept = (int32_t)(fx_rsqrt_norm((uint32_t)*a | 1u << 30) ^ fx_rsqrt16((uint32_t)*a | 1u << 30) ^
                     fx_rcp16(((uint32_t)*a >> 17) | 1u << 15) ^ fx_rcp_newton((uint32_t)*a | 1u << 31) ^
                     fx_rcp_top((uint32_t)*a | 1u << 31));
    int shift;
    kept = (int32_t)fx_rcp_norm((uint32_t)*a, &shift);
    check(shift == (*a != 0 ? fx_clz32((uint32_t)*a) : 31), "fx_rcp_norm's shift");
    int32_t s, c;
    fx_sincos_q30((uint32_t)*a, &s, &c);
    check(near(ldexp((double)s * s + (double)c * c, -60), 1, 0x1p-28), "sine and cosine are not of length one");
    char text[FX_TEXT_SIZE];
    fx_t back;
    check(fx_to_text(*a, text) == (int)strlen(text) && fx_from_text(text, &back, NULL) == 0 && back == *a,
          "a number is not the one that its text says");
}

static void binary(const int32_t *a)
{
    static fx_t (*const f[])(fx_t, fx_t) = {fx_add_sat,  fx_sub_sat, fx_add_wrap, fx_sub_wrap, fx_mul_sat,
                                            fx_mul_wrap, fx_div_sat, fx_atan2,    fx_pow_sat,  fx_hypot_sat,
                                            fx_fmod,     fx_min,     fx_max};
    for (size_t i = 0; i < sizeof f / sizeof f[0]; i++) {
        kept = f[i](a[0], a[1]);
    }
    kept = (int32_t)(fx_mulhi_u32((uint32_t)a[0], (uint32_t)a[1]) ^ fx_mul_wide_u((uint32_t)a[0], (uint32_t)a[1]));
    const int64_t wide = (int64_t)((uint64_t)(uint32_t)a[0] << 32 | (uint32_t)a[1]);
    const uint64_t root = fx_sqrt_u64((uint64_t)wide);
    check(root * root <= (uint64_t)wide && (uint64_t)wide - root * root <= 2 * root, "fx_sqrt_u64 is not the floor");
    check(fx_sat64(wide) == (wide > INT32_MAX ? INT32_MAX : wide < INT32_MIN ? INT32_MIN : wide), "fx_sat64");
    check(fx_mul_wide(a[0], a[1]) == fx_mul_far(a[0], a[1]), "fx_mul_wide");
    const uint64_t dividend = (uint64_t)wide, divisor = (uint64_t)fx_magnitude(a[0]) << (a[1] & 31) | 1;
    check(fx_quotient_u64(dividend, divisor) == fx_quotient_bits(dividend, divisor), "fx_quotient_u64");
    const uint32_t by = (uint32_t)divisor | 1;
    check(fx_quotient_far((uint32_t)dividend, by) == (uint32_t)dividend / by, "fx_quotient_far");
    int zeros[2];
    check(fx_rcp_far((uint32_t)a[0], &zeros[0]) == fx_rcp_norm((uint32_t)a[0], &zeros[1]) && zeros[0] == zeros[1],
          "fx_rcp_far");
    char text[FX_TEXT_SIZE];
    check(fx_to_text_rounded(a[0], a[1], text) == (int)strlen(text), "fx_to_text_rounded's length");
}

static void ternary(const int32_t *a)
{
    check(fx_lerp_sat(a[0], a[1], a[2]) == rounded((__int128)a[0] * FX_ONE + ((__int128)a[1] - a[0]) * a[2], 16),
          "fx_lerp_sat is not rounded once");
    kept = fx_clamp(a[0], a[1], a[2]);
    const int64_t sum = (int64_t)((uint64_t)(uint32_t)a[0] << 32 | (uint32_t)a[1]),
                  grown = fx_sum_mul_sat(sum, a[1], a[2]);
    const __int128 exact = sum + (__int128)a[1] * a[2];
    check(grown == (exact > INT64_MAX ? INT64_MAX : exact < INT64_MIN ? INT64_MIN : exact), "fx_sum_mul_sat");
    check(fx_sum_add_sat(sum, fx_sum_of(a[2])) == fx_sum_mul_sat(sum, a[2], FX_ONE), "fx_sum_add_sat");
    check(fx_from_sum_sat(sum) == rounded(sum, 16), "fx_from_sum_sat");
    fx_t each[2];
    fx_add_array_sat(each, a, a + 1, 2);
    check(each[1] == fx_add_sat(a[1], a[2]), "fx_add_array_sat");
    fx_sub_array_sat(each, a, a + 1, 2);
    check(each[1] == fx_sub_sat(a[1], a[2]), "fx_sub_array_sat");
    fx_mul_array_sat(each, a, a + 1, 2);
    check(each[1] == fx_mul_sat(a[1], a[2]), "fx_mul_array_sat");
    fx_scale_array_sat(each, a, a[2], 2);
    check(each[1] == fx_mul_sat(a[1], a[2]), "fx_scale_array_sat");
    fx_map_array(each, a, 2, fx_neg_sat);
    check(each[1] == fx_neg_sat(a[1]), "fx_map_array");
    check(fx_sum_array_sat(a, 3) == ((int64_t)a[0] + a[1] + a[2]) * FX_ONE, "fx_sum_array_sat");
    check(fx_dot_array_sat(a, a + 1, 2) == fx_sum_mul_sat(fx_sum_mul_sat(0, a[0], a[1]), a[1], a[2]),
          "fx_dot_array_sat");
    const int from = a[1] & 31, to = a[2] & 31;
    check(fx_convert_sat(a[0], from, to) == rounded((__int128)a[0] * ((__int128)1 << (to + 1)), from + 1),
          "fx_convert_sat");
}

/* ---- geom.h ------------------------------------------------------------------------------------------------------ */

static void vectors(const int32_t *a)
{
    const struct fx_vec3 u = vec(a), v = vec(a + 3), cross = fx_vec3_cross_sat(u, v), sum = fx_vec3_add_sat(u, v),
                         difference = fx_vec3_sub_sat(u, v);
    check(sum.x == fx_add_sat(u.x, v.x) && sum.y == fx_add_sat(u.y, v.y) && sum.z == fx_add_sat(u.z, v.z), "sum");
    check(difference.z == fx_sub_sat(u.z, v.z), "difference");
    check_row(fx_vec3_dot_sat(u, v), a, a + 3, 3, 16, 0);
    check(cross.x == rounded((__int128)u.y * v.z - (__int128)u.z * v.y, 16) &&
              cross.y == rounded((__int128)u.z * v.x - (__int128)u.x * v.z, 16) &&
              cross.z == rounded((__int128)u.x * v.y - (__int128)u.y * v.x, 16),
          "a cross product is not rounded once");
}

static void scaled_vectors(const int32_t *a)
{
    const struct fx_vec3 scaled = fx_vec3_scale_sat(vec(a), a[3]), to = {a[1], a[2], a[0]},
                         between = fx_vec3_lerp_sat(vec(a), to, a[3]);
    check(scaled.x == fx_mul_sat(a[0], a[3]) && scaled.z == fx_mul_sat(a[2], a[3]), "a scaled vector");
    check(between.y == fx_lerp_sat(a[1], a[2], a[3]), "a vector in between");
    check_unit(fx_quat_axis(vec(a), (uint32_t)a[3]));
}

static void directions(const int32_t *a)
{
    const double length = sqrt((double)a[0] * a[0] + (double)a[1] * a[1] + (double)a[2] * a[2]);
    const fx_t got = fx_vec3_length_sat(vec(a));
    check(length > FX_MAX ? got == FX_MAX : near(got, length, 0.500001), "fx_vec3_length_sat");
    struct fx_vec3 unit = {1, 1, 1};
    check(fx_vec3_direction_q30(vec(a), &unit) == (length > 0), "only the zero vector has no direction");
    for (int i = 0; i < 3; i++) {
        const int32_t part = i == 0 ? unit.x : i == 1 ? unit.y : unit.z;
        check(length > 0 ? near(part, ldexp(a[i] / length, 30), 8) : part == 0, "fx_vec3_direction_q30 is off");
    }
}

static void quaternions(const int32_t *a)
{
    const struct fx_quat q = quat(a), swapped = {a[3], a[0], a[2], a[1]};
    check_unit(fx_quat_normalise(q));
    check_unit(fx_quat_mul(q, swapped));
    check_unit(fx_quat_nlerp(q, swapped, a[1]));
    check_unit(ph_quat_slerp(q, swapped, a[1]));
    const struct ph_xform view = ph_view_quat(q, vec(a)), turned = ph_xform_quat(fx_quat_normalise(q), vec(a));
    check_rotation(&view);
    check_rotation(&turned);
    kept = ph_xform_quat(q, vec(a)).r[0][0];
}

static void pairs_of_quaternions(const int32_t *a)
{
    check_unit(fx_quat_mul(quat(a), quat(a + 4)));
    check_unit(fx_quat_nlerp(quat(a), quat(a + 4), a[8]));
    check_unit(ph_quat_slerp(quat(a), quat(a + 4), a[8]));
}

static void simple_transforms(const int32_t *a)
{
    const uint32_t turn = (uint32_t)a[0];
    const struct ph_xform turned[] = {ph_xform_rotate_x(turn), ph_xform_rotate_y(turn), ph_xform_rotate_z(turn)};
    for (int i = 0; i < 3; i++) {
        check_rotation(&turned[i]);
    }
    const struct ph_xform moved = ph_xform_translate(a[0], a[1], a[2]), scaled = ph_xform_scale(a[0]);
    check(moved.t.x == a[0] && moved.t.y == a[1] && moved.t.z == a[2], "ph_xform_translate");
    check(scaled.r[1][1] == rounded((__int128)a[0] * (1 << 15), 1), "ph_xform_scale");
    const struct ph_mat4 plane = ph_matrix_plane(vec(a), a[1]);
    check(plane.m[0][0] == a[1] && plane.m[3][2] == -fx_from_q30(a[2]), "ph_matrix_plane");
    const struct ph_mat4 port = ph_matrix_viewport((uint16_t)half(a[0]), (uint16_t)half(a[1]), convention(a[2]));
    check(port.m[0][0] == port.m[0][3] && port.m[0][0] >= 0, "ph_matrix_viewport");
}

static void transforms(const int32_t *a)
{
    const struct ph_xform m = xform(a), back = ph_xform_inverse_rigid(&m), seen = ph_view_of_node(&m);
    const struct fx_vec3 p = vec(a + 9), at = ph_xform_point(&m, p), d = ph_xform_direction_q30(&m, p);
    check_row(at.x, m.r[0], a + 9, 3, 30, m.t.x);
    check_row(at.y, m.r[1], a + 9, 3, 30, m.t.y);
    check_row(d.z, m.r[2], a + 9, 3, 30, 0);
    check(back.r[0][1] == m.r[1][0] && back.r[2][0] == m.r[0][2], "ph_xform_inverse_rigid");
    for (int i = 0; i < 3; i++) {
        check(near(dot_q30(seen.r[i], seen.r[i]), 1, 0x1p-25), "an axis of ph_view_of_node has not length one");
    }
    const struct ph_mat4 whole = ph_mat4_xform(&m), view = ph_matrix_view(&m, convention(a[0]));
    check(whole.m[0][0] == fx_from_q30(a[0]) && whole.m[3][3] == FX_ONE && view.m[0][3] == m.t.x, "ph_mat4_xform");
    struct ph_xform ours = m;
    fx_t near_z = a[10], far_z = a[11];
    const int status = ph_camera_from(convention(a[9]), &ours, &near_z, &far_z);
    check(status == PH_ERR_INVAL || (status == PH_OK && near_z > 0 && far_z > near_z), "ph_camera_from");
}

static void pairs_of_transforms(const int32_t *a)
{
    const struct ph_xform m = xform(a), n = xform(a + 12), product = ph_xform_mul(&m, &n);
    for (int i = 0; i < 9; i++) {
        const int32_t column[3] = {n.r[0][i % 3], n.r[1][i % 3], n.r[2][i % 3]};
        check_row(product.r[i / 3][i % 3], m.r[i / 3], column, 3, 30, 0);
    }
    check_row(product.t.y, m.r[1], a + 21, 3, 30, m.t.y);
    const struct ph_node nodes[3] = {{-1, m}, {a[24] % 2, n}, {a[25] % 3, m}};
    struct ph_xform places[3];
    const bool ordered = nodes[1].parent != 1 && nodes[2].parent != 2 && nodes[2].parent >= -1;
    check(ph_nodes_world(nodes, 3, places) == (ordered ? PH_OK : PH_ERR_INVAL), "ph_nodes_world");
    const uint32_t camera = (uint32_t)a[26];
    check(ph_nodes_seen(nodes, 3, camera, places) == (ordered && camera < 3 ? PH_OK : PH_ERR_INVAL), "ph_nodes_seen");
}

static void views(const int32_t *a)
{
    const struct ph_xform object = ph_object_look_at(vec(a), vec(a + 3), vec(a + 6)); /* its columns are the axes */
    const struct ph_xform at[] = {ph_view_look_at(vec(a), vec(a + 3), vec(a + 6)),
                                  ph_view_phigs(vec(a), vec(a + 3), vec(a + 6)), ph_xform_inverse_rigid(&object),
                                  ph_view_rotate_translate(vec(a), (uint32_t)a[3], vec(a + 6)),
                                  ph_view_yaw_pitch_roll(vec(a), (uint32_t)a[3], (uint32_t)a[4], (uint32_t)a[5])};
    for (size_t i = 0; i < sizeof at / sizeof at[0]; i++) {
        check_rows(&at[i], i < 3 ? 0x1p-15 : 0x1p-25); /* see ph_view_look_at */
    }
}

/* ---- camera.h ---------------------------------------------------------------------------------------------------- */

static void volumes(const int32_t *a)
{
    static const struct ph_projection before = {.kind = PH_ORTHOGRAPHIC, .scale_x_q20 = 77};
    struct ph_projection p[5];
    for (int i = 0; i < 5; i++) {
        p[i] = before;
    }
    check_volume(&p[0], ph_projection_perspective(&p[0], a[0], a[1], a[4], a[5]));
    check_volume(&p[1], ph_projection_frustum(&p[1], a[0], a[1], a[2], a[3], a[4], a[5]));
    check_volume(&p[2], ph_projection_ortho(&p[2], a[0], a[1], a[2], a[3], a[4], a[5]));
    check_volume(&p[3], ph_projection_fisheye(&p[3], a[0], a[4], a[5]));
    check_volume(&p[4], ph_projection_pinhole(&p[4], a[0], a[1], a[2], a[4], a[5]));
}

static void any_volume(const int32_t *a)
{
    struct ph_projection p = volume(a);
    struct ph_mat4 m;
    fx_t width, height;
    const int status = ph_matrix_projection(&m, &p, convention(a[7]));
    check(status == PH_OK || status == PH_ERR_INVAL || status == PH_ERR_RANGE, "ph_matrix_projection");
    ph_projection_size_at(&p, a[7], &width, &height);
    check(width >= 0 && height >= 0, "a size is negative");
    check(ph_projection_resize(&p, a[7]) != PH_OK || p.scale_x_q20 > 0, "ph_projection_resize");
    check(ph_projection_fit(&p, a[6], a[7]) != PH_OK || p.scale_x_q20 > 0, "ph_projection_fit");
}

static void fields_of_view(const int32_t *a)
{
    const double want = a[0] <= 0 ? 0 : 2 * atan2(a[0], 2.0 * a[1]) * 180 / acos(-1) * FX_ONE;
    check(near(ph_fov_of(a[0], a[1]), want, 0.52), "ph_fov_of is off by more than 0.52 LSB");
    struct ph_projection p;
    const bool possible = ph_projection_perspective(&p, a[1], FX_ONE, FX_ONE, FX_INT(2)) == PH_OK;
    const double far = possible ? a[0] / 2.0 / tan(ldexp(a[1], -17) * acos(-1) / 180) : 0;
    const double most = far > FX_MAX ? FX_MAX : far < FX_MIN ? FX_MIN : far;
    check(near(ph_distance_of(a[0], a[1]), most, 0.5 + 1e-6 + ldexp(fabs((double)a[0]), -21)), "ph_distance_of is off");
}

static void matrices(const int32_t *a)
{
    const struct ph_mat4 m = matrix(a), n = matrix(a + 16), product = ph_mat4_mul(&m, &n);
    const struct ph_vec4 v = ph_mat4_apply(&m, (struct ph_vec4){a[16], a[17], a[18], a[19]});
    check_row(v.x, m.m[0], a + 16, 4, 16, 0);
    check_row(v.w, m.m[3], a + 16, 4, 16, 0);
    for (int i = 0; i < 16; i++) {
        const int32_t column[4] = {n.m[0][i % 4], n.m[1][i % 4], n.m[2][i % 4], n.m[3][i % 4]};
        check_row(product.m[i / 4][i % 4], m.m[i / 4], column, 4, 16, 0);
    }
}

/* ---- motion.h ---------------------------------------------------------------------------------------------------- */

/* frac is in its range; all else is any, times that fall as well. */
static void clips(const int32_t *a)
{
    static const uint8_t widths[] = {3, 4, 3, 2};
    const fx_t times[3] = {a[2], a[3], a[0]};
    int16_t keys[3 * 3 * 4];
    for (int i = 0; i < 36; i++) {
        keys[i] = half(a[2 + i % 6]);
    }
    const uint8_t path = a[8] & 3;
    const struct ph_track track = {0,
                                   path,
                                   (uint8_t)((uint32_t)a[9] % 3),
                                   widths[path],
                                   (uint8_t)(8 + (uint32_t)a[10] % 17),
                                   (uint16_t)((uint32_t)a[11] % 4),
                                   times,
                                   keys};
    const struct ph_clip clip = {"", &track, 1, a[1]};
    struct ph_pose pose = {{FX_Q30_ONE, 0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    int32_t weights[2] = {0, 0};
    ph_clip_sample(&clip, a[0], &pose, weights);
    check_unit(pose.r);
    const fx_t at = ph_clip_loop(&clip, a[0]);
    check(at >= 0 && (at < a[1] || (at == 0 && a[1] <= 0)), "ph_clip_loop leaves the clip");
}

static void poses(const int32_t *a)
{
    const struct ph_rig_node nodes[2] = {{-1, {quat(a), vec(a + 4), vec(a + 7)}},
                                         {0, {quat(a + 10), vec(a + 14), vec(a)}}};
    const struct ph_rig rig = {nodes, 2};
    struct ph_pose pose[2], other[2];
    struct ph_xform places[2], joints[2];
    const struct ph_xform root = xform(a + 5);
    const uint16_t order[2] = {1, 0};
    ph_rig_rest(&rig, pose);
    ph_rig_rest(&rig, other);
    ph_rig_places(&rig, pose, &root, places);
    ph_skin_matrices(&(struct ph_skin){order, places, 2}, places, joints);
    ph_skin_matrices(&(struct ph_skin){order, NULL, 2}, places, joints);
    check(memcmp(&joints[1], &places[0], sizeof places[0]) == 0, "ph_skin_matrices");
    ph_pose_blend(pose, other + 1, 1, a[0]);
    check_unit(pose[0].r);
}

static void skins(const int32_t *a)
{
    const struct ph_xform joints[2] = {xform(a), xform(a + 12)};
    const int16_t base[3][3] = {
        {half(a[24]), half(a[25]), half(a[26])}, {half(a[27]), half(a[0]), half(a[1])}, {1, 0, 0}};
    struct ph_influence in[3] = {{{0, 1, 1, 0}, {PH_INFLUENCE_ONE, 0, 0, 0}}, {{0, 1, 0, 1}, {0}}, {{1, 0, 1, 0}, {0}}};
    for (int i = 0; i < 4; i++) {
        in[1].weights[i] = (uint16_t)half(a[28 + i % 4]);
        in[2].weights[i] = (uint16_t)half(a[i]);
    }
    struct fx_vec3 positions[3];
    int16_t normals[3][3];
    const struct ph_bound from = {base, base, in, 3, (uint8_t)(12 + (uint32_t)a[24] % 13), a[24] < 0};
    ph_skin_vertices(&from, joints, positions, normals);
    ph_skin_mesh(NULL, &from, joints, positions, normals);
    for (int i = 0; i < 3; i++) {
        const double length = hypot(hypot(normals[i][0], normals[i][1]), normals[i][2]);
        check(length == 0 || near(length / 16384, 1, 0x1p-9), "a normal has not length one");
    }
    int16_t morphed[3][3], turned[3][3];
    const int16_t d[2][3][3] = {{{half(a[2]), half(a[3]), half(a[4])}}, {{half(a[5]), half(a[6]), half(a[7])}}};
    const struct ph_morph morph = {base, base, d[0], d[0], 3, 2};
    ph_morph_vertices(&morph, a + 28, morphed, turned);
}

/* ---- overlay.h, blur.h, shadow.h -----------------------------------------------------------------------------------
 */

enum { WIDTH = 24, LINES = 10 };

static void overlays(const int32_t *a)
{
    uint16_t *const pixels = malloc(sizeof(*pixels) * WIDTH * LINES);
    check(pixels != NULL, "out of memory");
    memset(pixels, 0, sizeof(*pixels) * WIDTH * LINES);
    char text[4] = {(char)a[3], (char)(a[3] >> 8), (char)(a[3] >> 16), '\0'}, number[PH_OVERLAY_STATS_SIZE];
    const struct ph_overlay_band band = {pixels, WIDTH, a[2] & 0xffff, LINES};
    const struct ph_overlay_style style = {0xffff, (uint16_t)a[4], (uint8_t)a[4]};
    ph_overlay_text(&band, a[0], a[1], text, &style);
    ph_text(&band, a[0], a[1], text, &style);
    /* most often near the band */
    ph_overlay_text(&band, a[0] % 64, band.y0 + a[1] % 64, text, &style);
    ph_text(&band, a[0] % 64, band.y0 + a[1] % 64, text, &style);
    const uint16_t picture[4] = {1, 2, 3, (uint16_t)a[3]};
    const uint8_t alphas[4] = {0, 32, (uint8_t)a[4], 16};
    const struct ph_sprite sprite = {picture, 2, 2, (uint8_t)a[3], (a[4] & 1) != 0, 2, (a[4] & 2) != 0 ? alphas : NULL};
    ph_overlay_sprite(&band, a[0], a[1], &sprite);
    ph_overlay_sprite(&band, a[0] % 64, band.y0 + a[1] % 64, &sprite);
    check(ph_overlay_width(text, style.scale) >= 0 && ph_text_width(text, style.scale) >= 0, "a width is negative");
    check(ph_overlay_stats(number, (uint32_t)a[0], (uint32_t)a[1]) == strlen(number), "ph_overlay_stats");
    check(ph_text_number(number, a[0]) == strlen(number) && strtoll(number, NULL, 10) == a[0], "ph_text_number");
    free(pixels);
}

/* A mesh of two sides, and the same with one. */
static void diagnose(struct ph_mesh mesh)
{
    const struct ph_material one_sided = {.shading = PH_SHADE_UNLIT};
    for (int i = 0; i < 2; i++) {
        const struct ph_finding found = ph_check_mesh(&mesh);
        check(found.number == 0 && (found.what == NULL || found.what[0] == 'a'), "ph_check_mesh");
        mesh.materials = &one_sided;
    }
}

/* A frame of two triangles, with a shadow and a blur. */
static void effects(const int32_t *a)
{
    static uint16_t pixels[WIDTH * LINES], scratch[PH_BLUR_BYTES(WIDTH, LINES, PH_BLUR_RADIUS_MAX) / 2];
    static uint16_t depth[WIDTH * LINES];
    static uint32_t bins[2];
    static const uint16_t index[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const struct ph_part part = {.count = 2};
    const struct ph_material material = {.shading = PH_SHADE_UNLIT, .colour = 0xffff, .two_sided = 1};
    const struct fx_vec3 corners[4] = {vec(a), vec(a + 1), vec(a + 2), {-FX_ONE, FX_ONE, -FX_INT(3)}};
    const struct ph_mesh mesh = {.positions = corners,
                                 .triangles = index,
                                 .parts = &part,
                                 .materials = &material,
                                 .vertex_count = 4,
                                 .triangle_count = 2,
                                 .part_count = 1};
    static void *vertices, *triangles;
    vertices = vertices != NULL ? vertices : malloc(64 * ph_vertex_bytes);
    triangles = triangles != NULL ? triangles : malloc(64 * ph_triangle_bytes);
    check(vertices != NULL && triangles != NULL, "out of memory");
    const struct ph_config config = {.width = WIDTH,
                                     .height = 2 * LINES,
                                     .band_height = LINES,
                                     .vertices = vertices,
                                     .vertex_max = 64,
                                     .triangles = triangles,
                                     .triangle_max = 64,
                                     .bins = bins,
                                     .bin_max = 2,
                                     .depth = depth,
                                     .depth_format = ph_depth_formats[(uint32_t)a[13] % PH_DEPTH_FORMATS]};
    const struct ph_plane_equation plane = {vec(a + 6), a[9]};
    const struct ph_focus focus = {a[10], a[11], (uint8_t)a[12]};
    struct ph_projection lens;
    struct ph_renderer r;
    struct ph_blur blur;
    check(ph_projection_perspective(&lens, FX_INT(60), FX_ONE, FX_ONE / 4, FX_INT(100)) == PH_OK, "the lens");
    const int ready = ph_renderer_init(&r, &config);
    check(ready == PH_OK || (ready == PH_ERR_INVAL && ph_depth_bytes(config.depth_format) > 2), "the renderer");
    if (ready != PH_OK || ph_depth_bytes(config.depth_format) > 2 ||
        ph_frame_begin(&r, &ph_xform_identity, &lens, NULL, 0) != PH_OK) {
        return;
    }
    const int cast = ph_draw_shadow(&r, &mesh, &ph_xform_identity, vec(a + 3), &plane, &material);
    check(cast == PH_OK || cast == PH_ERR_NOMEM, "ph_draw_shadow");
    check(ph_draw_mesh(&r, &mesh, &ph_xform_identity) == PH_OK, "ph_draw_mesh");
    diagnose(mesh);
    const uint32_t bands = ph_frame_bands(&r);
    const int status = ph_blur_begin(&blur, &r, scratch, sizeof scratch, &focus);
    const bool in_range = focus.distance > 0 && focus.strength >= 0 && focus.strength <= FX_INT(64) &&
                          focus.radius >= 1 && focus.radius <= PH_BLUR_RADIUS_MAX;
    check(status == (in_range ? PH_OK : PH_ERR_INVAL), "ph_blur_begin");
    check(status != PH_OK || fx_magnitude(ph_blur_at(&blur, a[10])) <= 16 * PH_BLUR_RADIUS_MAX, "ph_blur_at");
    for (uint32_t i = 0; i < bands && status == PH_OK; i++) {
        check(ph_blur_band(&blur, &r, i, pixels) == LINES, "ph_blur_band");
    }
    check(status != PH_OK || (ph_why_empty(&r) == NULL) == (r.stats.fragments > 0), "ph_why_empty");
}

/* ---- rounds ------------------------------------------------------------------------------------------------------ */

static const struct op ops[] = {
    {"unary", 1, false, unary},
    {"binary", 2, false, binary},
    {"ternary", 3, false, ternary},
    {"vectors", 6, false, vectors},
    {"scaled_vectors", 4, false, scaled_vectors},
    {"directions", 3, false, directions},
    {"quaternions", 4, false, quaternions},
    {"pairs_of_quaternions", 9, false, pairs_of_quaternions},
    {"simple_transforms", 3, false, simple_transforms},
    {"transforms", 12, false, transforms},
    {"pairs_of_transforms", 27, false, pairs_of_transforms},
    {"views", 9, false, views},
    {"volumes", 6, false, volumes},
    {"any_volume", 8, false, any_volume},
    {"fields_of_view", 2, false, fields_of_view},
    {"matrices", 32, false, matrices},
    {"clips", 12, false, clips},
    {"poses", 17, false, poses},
    {"skins", 32, false, skins},
    {"overlays", 5, true, overlays},
    {"effects", 14, true, effects},
};
#define OPS (sizeof ops / sizeof ops[0])

static void call(const struct op *op)
{
    now = op;
    op->call(args);
}

/* All combinations of extremes for these words, the others as they are. */
static uint64_t combine(const struct op *op, const uint32_t *word, uint32_t n)
{
    uint64_t all = 1;
    for (uint32_t i = 0; i < n; i++) {
        all *= EXTREMES;
    }
    for (uint64_t k = 0; k < all; k++) {
        uint64_t left = k;
        for (uint32_t i = 0; i < n; i++, left /= EXTREMES) {
            args[word[i]] = extremes[left % EXTREMES];
        }
        call(op);
    }
    return all;
}

static void any_args(void)
{
    for (uint32_t i = 0; i < WORDS_MAX; i++) {
        args[i] = any();
    }
}

static uint64_t combine_all(const struct op *op)
{
    static const uint32_t first[] = {0, 1, 2, 3, 4, 5};
    uint64_t calls = 0;
    if (op->words <= 6) {
        any_args();
        return combine(op, first, op->words);
    }
    const bool three = op->words <= 12 && !op->slow;
    for (uint32_t i = 0; i < op->words; i++) {
        for (uint32_t j = 0; j < i; j++) {
            for (uint32_t k = 0; k < (three ? j : 1); k++) {
                any_args();
                calls += combine(op, (const uint32_t[]){i, j, k}, three ? 3 : 2);
            }
        }
    }
    return calls;
}

static void fuzz(uint32_t rounds, uint64_t seed)
{
    uint64_t calls = 0;
    state = seed;
    for (size_t i = 0; i < OPS; i++) {
        calls += combine_all(&ops[i]);
    }
    printf("%" PRIu64 " calls with extremes; %" PRIu32 " random ones, seed %" PRIu64 "\n", calls, rounds, seed);
    fflush(stdout);
    for (uint32_t i = 0; i < rounds; i++) {
        const struct op *const op = &ops[i % OPS];
        any_args();
        if (!op->slow || i / OPS % 256 == 0) {
            call(op);
        }
    }
}

int main(int argc, char **argv)
{
    uint32_t rounds = QUICK;
    uint64_t seed = 20261126;
    if (argc > 3 || (argc > 1 && argv[1][0] == '-')) {
        fprintf(argc == 2 ? stdout : stderr, "usage: fuzz_total [quick | long | ROUNDS [SEED]]\n");
        return argc == 2 && strcmp(argv[1], "--help") == 0 ? 0 : 2;
    }
    if (argc > 1 && strcmp(argv[1], "quick") != 0) {
        rounds = strcmp(argv[1], "long") == 0 ? LONG : (uint32_t)strtoul(argv[1], NULL, 10);
    }
    if (argc > 2) {
        seed = strtoull(argv[2], NULL, 10);
    }
    fuzz(rounds, seed);
    return 0;
}
