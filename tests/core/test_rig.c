/* Clips, poses, skins and morph targets are compared with the formulas of glTF 2.0 in double arithmetic. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "assert_near.h"
#include "motion.h"

#include <math.h>
#include <string.h>

#define LSB  (1.0 / 65536)
#define Q24  (1.0 / (1 << 24))
#define Q30  (1.0 / (1 << 30))
#define LONG 24 /* joints of a chain */

static uint32_t seed = 2463534242u;

/* -1 .. 1 */
static double any(void)
{
    seed ^= seed << 13;
    seed ^= seed >> 17;
    seed ^= seed << 5;
    return seed / 2147483648.0 - 1;
}

static int32_t q24(double v)
{
    return (int32_t)lrint(v / Q24);
}

/* ---- the reference ---------------------------------------------------------------------------------------------- */

struct quat {
    double v[4]; /* x, y, z, w, as glTF has them */
};

static struct quat unit(struct quat q)
{
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        sum += q.v[i] * q.v[i];
    }
    for (int i = 0; i < 4; i++) {
        q.v[i] /= sqrt(sum);
    }
    return q;
}

static struct quat quat_real(struct fx_quat q)
{
    return (struct quat){{q.x * Q30, q.y * Q30, q.z * Q30, q.w * Q30}};
}

static struct fx_quat quat_fixed(struct quat q)
{
    return (struct fx_quat){(int32_t)lrint(q.v[3] * (FX_Q30_ONE - 1)), (int32_t)lrint(q.v[0] * (FX_Q30_ONE - 1)),
                            (int32_t)lrint(q.v[1] * (FX_Q30_ONE - 1)), (int32_t)lrint(q.v[2] * (FX_Q30_ONE - 1))};
}

static struct quat slerp(struct quat a, struct quat b, double t)
{
    double dot = 0;
    for (int i = 0; i < 4; i++) {
        dot += a.v[i] * b.v[i];
    }
    const double sign = dot < 0 ? -1 : 1, arc = acos(fmin(fabs(dot), 1));
    const double from = arc > 1e-9 ? sin((1 - t) * arc) / sin(arc) : 1 - t,
                 to = sign * (arc > 1e-9 ? sin(t * arc) / sin(arc) : t);
    for (int i = 0; i < 4; i++) {
        a.v[i] = from * a.v[i] + to * b.v[i];
    }
    return unit(a);
}

static double hermite(double a, double out, double in, double b, double t)
{
    const double t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * out + (3 * t2 - 2 * t3) * b + (t3 - t2) * in;
}

struct matrix {
    double r[3][3], t[3];
};

static struct matrix matrix_of(struct quat q, const double t[3], const double s[3])
{
    const double x = q.v[0], y = q.v[1], z = q.v[2], w = q.v[3];
    const double r[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                            {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                            {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    struct matrix m;
    for (int i = 0; i < 3; i++) {
        m.t[i] = t[i];
        for (int j = 0; j < 3; j++) {
            m.r[i][j] = r[i][j] * s[j];
        }
    }
    return m;
}

static struct matrix product(const struct matrix *a, const struct matrix *b)
{
    struct matrix m;
    for (int i = 0; i < 3; i++) {
        m.t[i] = a->t[i];
        for (int j = 0; j < 3; j++) {
            m.t[i] += a->r[i][j] * b->t[j];
            m.r[i][j] = a->r[i][0] * b->r[0][j] + a->r[i][1] * b->r[1][j] + a->r[i][2] * b->r[2][j];
        }
    }
    return m;
}

static struct matrix real_matrix(const struct ph_xform *x)
{
    struct matrix m = {.t = {x->t.x * Q24, x->t.y * Q24, x->t.z * Q24}};
    for (int i = 0; i < 9; i++) {
        m.r[i / 3][i % 3] = x->r[i / 3][i % 3] * Q30;
    }
    return m;
}

static void matrices_are_near(const struct ph_xform *got, const struct matrix *want, double r, double t)
{
    const struct matrix m = real_matrix(got);
    for (int i = 0; i < 3; i++) {
        assert_near(m.t[i], want->t[i], t);
        for (int j = 0; j < 3; j++) {
            assert_near(m.r[i][j], want->r[i][j], r);
        }
    }
}

static struct quat any_quat(void)
{
    return unit((struct quat){{any(), any(), any(), any()}});
}

static void quats_are_near(struct fx_quat got, struct quat want, double tolerance)
{
    const struct quat q = quat_real(got);
    for (int i = 0; i < 4; i++) {
        assert_near(q.v[i], want.v[i], tolerance);
    }
}

/* ---- keys ------------------------------------------------------------------------------------------------------- */

static fx_t times[4];

static struct ph_clip clip_of(const struct ph_track *track)
{
    return (struct ph_clip){.name = "clip", .tracks = track, .track_count = 1, .duration = 20000};
}

/* What a track of 4 keys of three numbers says at a time; keys are real numbers already. */
static double track_at(const struct ph_track *track, double time, int i)
{
    const double unit_of = ldexp(1, -track->frac);
    int k = 0;
    while (k < 3 && times[k + 1] <= time) {
        k++;
    }
    const int each = track->interpolation == PH_KEYS_CUBIC ? 9 : 3, value = each == 9 ? 3 : 0;
    const int16_t *key = track->keys + each * k + value + i;
    if (time < times[0] || k == 3 || track->interpolation == PH_KEYS_STEP) {
        return unit_of * key[0];
    }
    const double t = (time - times[k]) / ((double)times[k + 1] - times[k]);
    return unit_of * (each == 3 ? key[0] + t * (key[3] - key[0]) : hermite(key[0], key[3], key[6], key[9], t));
}

/* The times are 1000, 3000, 3500 and 20000 of these units. */
static void check_track(uint8_t interpolation, uint8_t frac, int32_t unit)
{
    memcpy(times, (fx_t[]){1000 * unit, 3000 * unit, 3500 * unit, 20000 * unit}, sizeof times);
    int16_t keys[4 * 9];
    for (int i = 0; i < 36; i++) {
        keys[i] = (int16_t)(any() * 32767);
    }
    const struct ph_track track = {.path = PH_PATH_TRANSLATION,
                                   .interpolation = interpolation,
                                   .width = 3,
                                   .frac = frac,
                                   .key_count = 4,
                                   .times = times,
                                   .keys = keys};
    const struct ph_clip clip = clip_of(&track);
    const double tolerance = LSB / 128 + 65536 * ldexp(1, -frac) * LSB * 1.5;
    for (int32_t tick = -500; tick < 21000; tick += tick < 4000 ? 1 : 97) {
        struct ph_pose pose;
        ph_clip_sample(&clip, tick * unit, &pose, NULL);
        assert_near(pose.t.x * Q24, track_at(&track, (double)tick * unit, 0), tolerance);
        assert_near(pose.t.y * Q24, track_at(&track, (double)tick * unit, 1), tolerance);
        assert_near(pose.t.z * Q24, track_at(&track, (double)tick * unit, 2), tolerance);
    }
}

static void keys_are_interpolated_as_gltf_says(void **state)
{
    (void)state;
    for (unsigned interpolation = PH_KEYS_STEP; interpolation <= PH_KEYS_CUBIC; interpolation++) {
        for (uint8_t frac = 10; frac <= 24; frac += 7) {
            check_track((uint8_t)interpolation, frac, 1);
            check_track((uint8_t)interpolation, frac, 100000);
        }
    }
}

static void a_key_is_met_exactly_and_the_ends_hold(void **state)
{
    static const int16_t keys[] = {5, -7, 32767, 100, 200, -32768};
    static const fx_t two[] = {100, 300};
    (void)state;
    for (unsigned interpolation = PH_KEYS_STEP; interpolation <= PH_KEYS_LINEAR; interpolation++) {
        const struct ph_track track = {.path = PH_PATH_SCALE,
                                       .interpolation = (uint8_t)interpolation,
                                       .width = 3,
                                       .frac = 24,
                                       .key_count = 2,
                                       .times = two,
                                       .keys = keys};
        const struct ph_clip clip = clip_of(&track);
        const fx_t at[] = {FX_MIN, 0, 99, 100, 300, 301, FX_MAX};
        for (int i = 0; i < 7; i++) {
            struct ph_pose pose;
            ph_clip_sample(&clip, at[i], &pose, NULL);
            assert_int_equal(pose.s.x, i < 4 ? 5 : 100);
            assert_int_equal(pose.s.z, i < 4 ? 32767 : -32768);
        }
    }
}

static void rotations_follow_slerp(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        const struct quat a = any_quat();
        struct quat b = any_quat();
        const double nearness = ldexp(1, -(i % 16));
        for (int k = 0; k < 4 && i % 3 != 0; k++) { /* near to a, or to its opposite, which is the same rotation */
            b.v[k] = (i % 3 == 1 ? 1 : -1) * a.v[k] + nearness * b.v[k];
        }
        b = unit(b);
        const fx_t t = (fx_t)((any() + 1) * 32768);
        quats_are_near(ph_quat_slerp(quat_fixed(a), quat_fixed(b), t), slerp(a, b, t * LSB), ldexp(1, -19));
    }
}

static void cubic_rotations_are_normalised(void **state)
{
    (void)state;
    for (int n = 0; n < 2000; n++) {
        int16_t keys[2 * 12];
        static const fx_t two[] = {0, 1024};
        for (int i = 0; i < 24; i++) {
            keys[i] = (int16_t)(any() * 20000);
        }
        const struct ph_track track = {.path = PH_PATH_ROTATION,
                                       .interpolation = PH_KEYS_CUBIC,
                                       .width = 4,
                                       .frac = 15,
                                       .key_count = 2,
                                       .times = two,
                                       .keys = keys};
        const struct ph_clip clip = clip_of(&track);
        const fx_t at = (fx_t)((any() + 1) * 512);
        struct quat want;
        double size = 0;
        for (int i = 0; i < 4; i++) {
            want.v[i] = hermite(keys[4 + i], keys[8 + i], keys[12 + i], keys[16 + i], at / 1024.0);
            size += fabs(want.v[i]);
        }
        struct ph_pose pose;
        ph_clip_sample(&clip, at, &pose, NULL);
        if (size > 2000) {
            quats_are_near(pose.r, unit(want), ldexp(1, -19));
        }
    }
}

static void a_clip_of_one_key_or_of_no_length_stands_still(void **state)
{
    static const int16_t keys[] = {16384, 0, 0, 16384, 11, 12, 13};
    static const fx_t one[] = {700};
    const struct ph_track tracks[] = {
        {.path = PH_PATH_ROTATION,
         .interpolation = PH_KEYS_LINEAR,
         .width = 4,
         .frac = 15,
         .key_count = 1,
         .times = one,
         .keys = keys},
        {.path = PH_PATH_TRANSLATION, .interpolation = PH_KEYS_CUBIC, .width = 1, .frac = 24, .key_count = 0},
        {.path = PH_PATH_WEIGHTS,
         .node = 2,
         .interpolation = PH_KEYS_STEP,
         .width = 3,
         .frac = 24,
         .key_count = 1,
         .times = one,
         .keys = keys + 4}};
    const struct ph_clip clip = {.tracks = tracks, .track_count = 3};
    (void)state;
    for (fx_t time = -2000; time < 2000; time += 100) {
        struct ph_pose pose = {.t = {1, 2, 3}, .s = {4, 5, 6}};
        int32_t weights[6] = {-1, -2, -3, -4, -5, -6};
        assert_int_equal(ph_clip_loop(&clip, time), 0);
        ph_clip_sample(&clip, time, &pose, weights);
        quats_are_near(pose.r, (struct quat){{sqrt(.5), 0, 0, sqrt(.5)}}, ldexp(1, -28));
        assert_true(pose.t.x == 1 && pose.t.y == 2 && pose.t.z == 3 && pose.s.x == 4 && pose.s.z == 6);
        assert_true(weights[1] == -2 && weights[2] == 11 && weights[3] == 12 && weights[4] == 13 && weights[5] == -6);
    }
}

static void a_clip_repeats(void **state)
{
    const struct ph_clip clip = {.duration = 1000};
    (void)state;
    assert_int_equal(ph_clip_loop(&clip, 999), 999);
    assert_int_equal(ph_clip_loop(&clip, 1000), 0);
    assert_int_equal(ph_clip_loop(&clip, 123456), 456);
    assert_int_equal(ph_clip_loop(&clip, -1), 999);
}

/* ---- poses ------------------------------------------------------------------------------------------------------ */

struct chain {
    struct ph_rig_node nodes[LONG];
    struct ph_pose pose[LONG];
    struct ph_xform places[LONG];
    struct matrix want[LONG];
};

static struct ph_pose any_pose(double scale)
{
    return (struct ph_pose){.r = quat_fixed(any_quat()),
                            .t = {q24(any() * .2), q24(any() * .2), q24(any() * .2)},
                            .s = {q24(1 + any() * scale), q24(1 + any() * scale), q24(1 + any() * scale)}};
}

static struct matrix pose_matrix(const struct ph_pose *p)
{
    return matrix_of(unit(quat_real(p->r)), (double[]){p->t.x * Q24, p->t.y * Q24, p->t.z * Q24},
                     (double[]){p->s.x * Q24, p->s.y * Q24, p->s.z * Q24});
}

/* Joints of which every third has its parent two before it, and the first two none. */
static void make_chain(struct chain *c, const struct ph_xform *root, double scale)
{
    const struct matrix base = real_matrix(root);
    for (int i = 0; i < LONG; i++) {
        const int parent = i < 2 ? -1 : i % 3 == 0 ? i - 2 : i - 1;
        c->pose[i] = any_pose(scale);
        c->nodes[i] = (struct ph_rig_node){(int16_t)parent, c->pose[i]};
        const struct matrix own = pose_matrix(&c->pose[i]);
        c->want[i] = product(parent < 0 ? &base : &c->want[parent], &own);
    }
    const struct ph_rig rig = {c->nodes, LONG};
    struct ph_pose rest[LONG];
    ph_rig_rest(&rig, rest);
    assert_memory_equal(rest, c->pose, sizeof rest);
    ph_rig_places(&rig, rest, root, c->places);
}

static void places_of_long_chains_are_right(void **state)
{
    (void)state;
    for (int n = 0; n < 300; n++) {
        struct chain c;
        struct ph_xform root =
            ph_xform_quat(quat_fixed(any_quat()), (struct fx_vec3){q24(any()), q24(any()), q24(any())});
        make_chain(&c, &root, .02);
        for (int i = 0; i < LONG; i++) {
            matrices_are_near(&c.places[i], &c.want[i], (i + 2) * ldexp(1, -27), (i + 2) * LSB / 32);
        }
    }
}

static void a_cross_fade_goes_from_one_pose_to_the_other(void **state)
{
    (void)state;
    for (int n = 0; n < 2000; n++) {
        const struct ph_pose a = any_pose(.5), b = any_pose(.5);
        const fx_t share = n == 0 ? 0 : n == 1 ? FX_ONE : (fx_t)((any() + 1) * 32768);
        const double t = share * LSB;
        struct ph_pose mixed[2] = {a, a};
        ph_pose_blend(mixed, (const struct ph_pose[]){b, a}, 2, share);
        quats_are_near(mixed[0].r, slerp(quat_real(a.r), quat_real(b.r), t), ldexp(1, -19));
        assert_near(mixed[0].t.x * Q24, (a.t.x + t * (b.t.x - a.t.x)) * Q24, Q24);
        assert_near(mixed[0].s.z * Q24, (a.s.z + t * (b.s.z - a.s.z)) * Q24, Q24);
        assert_near(mixed[1].t.y, a.t.y, 0);
    }
}

/* ---- skins ------------------------------------------------------------------------------------------------------ */

static struct ph_influence any_influence(unsigned count, uint32_t sum)
{
    struct ph_influence in = {{0}, {0}};
    double shares[4] = {0}, all = 0;
    for (unsigned k = 0; k < count; k++) {
        in.joints[k] = (uint8_t)((any() + 1) * (LONG / 2 - 1));
        shares[k] = any() + 1.01;
        all += shares[k];
    }
    uint32_t rest = sum;
    for (unsigned k = 0; k < count; k++) {
        in.weights[k] = (uint16_t)(k + 1 < count ? (uint32_t)(shares[k] / all * sum) : rest);
        rest -= in.weights[k];
    }
    return in;
}

/* The vertex and its normal by the sum of matrices. */
static void skin_reference(const struct matrix *m, const struct ph_influence *in, const double p[3], const double n[3],
                           double to[3], double turned[3])
{
    for (int i = 0; i < 3; i++) {
        to[i] = turned[i] = 0;
        for (int k = 0; k < 4; k++) {
            const double w = in->weights[k] / 32768.0;
            const struct matrix *j = &m[in->joints[k]];
            to[i] += w * (j->r[i][0] * p[0] + j->r[i][1] * p[1] + j->r[i][2] * p[2] + j->t[i]);
            turned[i] += w * (j->r[i][0] * n[0] + j->r[i][1] * n[1] + j->r[i][2] * n[2]);
        }
    }
}

static void check_vertex(const struct ph_bound *from, const struct ph_skin *skin, const struct chain *c)
{
    struct ph_xform joints[LONG];
    struct matrix exact[LONG];
    struct fx_vec3 position;
    int16_t normal[1][3];
    double p[3], n[3], to[3], turned[3], length = 0, reach = 0;
    ph_skin_matrices(skin, c->places, joints);
    for (int i = 0; i < LONG; i++) {
        const struct matrix inverse = real_matrix(&skin->inverse_bind[i]),
                            place = real_matrix(&c->places[skin->nodes[i]]);
        exact[i] = product(&place, &inverse);
        matrices_are_near(&joints[i], &exact[i], ldexp(1, -28), LSB / 64);
    }
    ph_skin_vertices(from, joints, &position, normal);
    for (int i = 0; i < 3; i++) {
        p[i] = ldexp(from->positions[0][i], -from->frac);
        n[i] = from->normals[0][i] / 16384.0;
    }
    skin_reference(exact, from->influences, p, n, to, turned);
    for (int i = 0; i < 3; i++) {
        length += turned[i] * turned[i];
        reach += fabs(p[i]);
    }
    const double tolerance = LSB * (.6 + 1. / 64 + (from->influences->weights[0] == PH_INFLUENCE_ONE ? 0 : reach));
    for (int i = 0; i < 3; i++) {
        assert_near((&position.x)[i] * LSB, to[i], tolerance);
        if (length > .02) {
            assert_near(normal[0][i] / 16384.0, turned[i] / sqrt(length), ldexp(1, -10));
        }
    }
}

static void check_skin(double scale, uint32_t sum)
{
    for (int n = 0; n < 3000; n++) {
        struct chain c;
        struct ph_xform inverse[LONG];
        uint16_t nodes[LONG];
        make_chain(&c, &ph_xform_identity, scale);
        for (int i = 0; i < LONG; i++) {
            nodes[i] = (uint16_t)(LONG - 1 - i);
            inverse[i] = ph_xform_quat(quat_fixed(any_quat()), (struct fx_vec3){q24(any()), q24(any()), q24(any())});
        }
        const struct ph_skin skin = {nodes, inverse, LONG};
        const struct ph_influence in = any_influence(1 + (unsigned)n % 4, sum);
        const int16_t p[1][3] = {{(int16_t)(any() * 32767), (int16_t)(any() * 32767), (int16_t)(any() * 32767)}};
        const struct quat q = any_quat();
        const int16_t normal[1][3] = {
            {(int16_t)(q.v[0] * 16384), (int16_t)(q.v[1] * 16384), (int16_t)(q.v[2] * 16384)}};
        const struct ph_bound from = {p, normal, &in, 1, (uint8_t)(12 + n % 7), false};
        check_vertex(&from, &skin, &c);
    }
}

static void vertices_follow_up_to_four_joints(void **state)
{
    (void)state;
    check_skin(0, PH_INFLUENCE_ONE);
}

static void joints_may_scale(void **state)
{
    (void)state;
    check_skin(.04, PH_INFLUENCE_ONE);
}

static void weights_that_do_not_sum_to_one_draw_towards_the_origin(void **state)
{
    (void)state;
    check_skin(0, 9000);
}

static void a_mesh_without_influences_follows_one_joint(void **state)
{
    static const int16_t p[2][3] = {{16384, 0, -32768}, {1, 2, 3}}, n[2][3] = {{0, 16384, 0}, {0, 0, 0}};
    const struct ph_bound from = {p, n, NULL, 2, 15, false};
    struct ph_xform quarter = ph_xform_rotate_z(1u << 30);
    struct fx_vec3 to[2];
    int16_t turned[2][3];
    (void)state;
    quarter.t = (struct fx_vec3){q24(3), 0, q24(-.5)};
    ph_skin_vertices(&from, &quarter, to, turned);
    assert_true(to[0].x == 3 * FX_ONE && to[0].y == FX_HALF && to[0].z == -FX_ONE * 3 / 2);
    assert_near(turned[0][0], -16384, 1);
    assert_true(turned[1][0] == 0 && turned[1][1] == 0 && turned[1][2] == 0);
    ph_skin_vertices(&from, &quarter, to, NULL);
}

/* Values that no file should hold give some vertex, and no undefined arithmetic (the sanitizers look on). */
static void whatever_a_matrix_holds_is_defined(void **state)
{
    static const int32_t ends[] = {INT32_MIN, INT32_MAX, -1, 0, 1 << 30};
    static const int16_t p[1][3] = {{-32768, -32768, 32767}};
    (void)state;
    for (int n = 0; n < 625; n++) {
        const int32_t a = ends[n % 5], b = ends[n / 5 % 5], c = ends[n / 25 % 5], t = ends[n / 125];
        const struct ph_xform m[2] = {{{{a, b, c}, {b, c, a}, {c, a, b}}, {t, t, t}},
                                      {{{c, b, a}, {b, a, c}, {a, c, b}}, {a, b, c}}};
        const struct ph_influence in[] = {
            {{0}, {32768}}, {{0, 1}, {30000, 2768}}, {{0, 1, 1, 0}, {65535, 65535, 65535, 65535}}};
        struct fx_vec3 to;
        int16_t normal[1][3];
        for (int k = 0; k < 3; k++) {
            const struct ph_bound from = {p, p, &in[k], 1, (uint8_t)(n % 2 ? 12 : 24), n % 3 == 0};
            ph_skin_vertices(&from, m, &to, normal);
        }
        struct ph_pose pose = {{a, b, c, t}, {a, b, c}, {c, b, a}};
        const struct ph_rig_node node = {-1, pose};
        struct ph_xform place;
        ph_rig_places(&(struct ph_rig){&node, 1}, &pose, &m[0], &place);
        ph_pose_blend(&pose, &(struct ph_pose){{t, c, b, a}, {t, t, t}, {b, b, b}}, 1, FX_ONE / 3);
    }
}

/* ---- morph targets ---------------------------------------------------------------------------------------------- */

static void targets_are_added_by_their_weights(void **state)
{
    (void)state;
    for (int n = 0; n < 3000; n++) {
        int16_t base[2][3], d[3 * 2][3], out[2][3], flat[2][3];
        const double w[3] = {any() * (n % 5), any() * 1.5, any()};
        const int32_t weights[3] = {q24(w[0]), q24(w[1]), q24(w[2])};
        for (int i = 0; i < 6; i++) {
            base[i / 3][i % 3] = (int16_t)(any() * 32767);
        }
        for (int i = 0; i < 18; i++) {
            d[i / 3][i % 3] = (int16_t)(any() * 9000);
        }
        const struct ph_morph morph = {base, base, d, NULL, 2, 3};
        ph_morph_vertices(&morph, weights, out, flat);
        assert_memory_equal(flat, base, sizeof base);
        for (int i = 0; i < 6; i++) {
            double want = base[i / 3][i % 3];
            for (int k = 0; k < 3; k++) {
                want += w[k] * d[2 * k + i / 3][i % 3];
            }
            const double tolerance = .5 + 3 / 16. + 3 * 9000 / 8192.;
            assert_near(out[i / 3][i % 3], fmax(-32768, fmin(32767, want)), tolerance);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_are_interpolated_as_gltf_says),
        cmocka_unit_test(a_key_is_met_exactly_and_the_ends_hold),
        cmocka_unit_test(rotations_follow_slerp),
        cmocka_unit_test(cubic_rotations_are_normalised),
        cmocka_unit_test(a_clip_of_one_key_or_of_no_length_stands_still),
        cmocka_unit_test(a_clip_repeats),
        cmocka_unit_test(places_of_long_chains_are_right),
        cmocka_unit_test(a_cross_fade_goes_from_one_pose_to_the_other),
        cmocka_unit_test(vertices_follow_up_to_four_joints),
        cmocka_unit_test(joints_may_scale),
        cmocka_unit_test(weights_that_do_not_sum_to_one_draw_towards_the_origin),
        cmocka_unit_test(a_mesh_without_influences_follows_one_joint),
        cmocka_unit_test(whatever_a_matrix_holds_is_defined),
        cmocka_unit_test(targets_are_added_by_their_weights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
