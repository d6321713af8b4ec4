/* Transforms, the look-at camera and projections: see geom.h. */
#include "geom.h"
#include "fx_math.h"
#include "geom_sum.h"
#include "status.h"
#include "tier.h"

const struct ph_xform ph_xform_identity = {{{FX_Q30_ONE, 0, 0}, {0, FX_Q30_ONE, 0}, {0, 0, FX_Q30_ONE}}, {0, 0, 0}};

/* A product of which the second factor is often 0: for CPUs to which a product of 64 bits is dear. */
static inline int64_t product(int32_t a, int32_t b)
{
    return !FX_MULTIPLIES && b == 0 ? 0 : fx_mul_wide(a, b);
}

/* A row in Q2.30 times (x, y, z), plus c, rounded once: as geom_sum_rounded, but without a loop. The three products fit
 * 64 bits together if x, y and z are above -2^30 and not above 2^30: the signs of 2^30 - x and so on say so. */
PH_TIER(seldom) static int32_t wide_row_times(const int32_t row[3], int32_t x, int32_t y, int32_t z, int32_t c)
{
    const int64_t px = product(row[0], x), py = product(row[1], y), pz = product(row[2], z);
    const uint32_t one = FX_Q30_ONE, below = one - 1, half = one / 2;
    if (((one - (uint32_t)x) | (one - (uint32_t)y) | (one - (uint32_t)z)) >> 31 == 0) {
        return fx_sat64(((px + py + pz + half) >> 30) + c);
    }
    const uint32_t low = ((uint32_t)px & below) + ((uint32_t)py & below) + ((uint32_t)pz & below) + half;
    return fx_sat64((px >> 30) + (py >> 30) + (pz >> 30) + (low >> 30) + c);
}

/* wide_row_times, by products of 32 bits where that is exact. */
PH_TIER(mesh) static int32_t row_times(const int32_t row[3], int32_t x, int32_t y, int32_t z, int32_t c)
{
    return !FX_MULTIPLIES && geom_row_is_near(row, x, y, z, c) ? geom_near_row(row, x, y, z, c)
                                                               : wide_row_times(row, x, y, z, c);
}

struct ph_xform ph_xform_rotate_x(uint32_t turn32)
{
    int32_t s, c;
    fx_sincos_q30(turn32, &s, &c);
    return (struct ph_xform){{{FX_Q30_ONE, 0, 0}, {0, c, -s}, {0, s, c}}, {0, 0, 0}};
}

struct ph_xform ph_xform_rotate_y(uint32_t turn32)
{
    int32_t s, c;
    fx_sincos_q30(turn32, &s, &c);
    return (struct ph_xform){{{c, 0, s}, {0, FX_Q30_ONE, 0}, {-s, 0, c}}, {0, 0, 0}};
}

struct ph_xform ph_xform_rotate_z(uint32_t turn32)
{
    int32_t s, c;
    fx_sincos_q30(turn32, &s, &c);
    return (struct ph_xform){{{c, -s, 0}, {s, c, 0}, {0, 0, FX_Q30_ONE}}, {0, 0, 0}};
}

struct ph_xform ph_xform_translate(fx_t x, fx_t y, fx_t z)
{
    struct ph_xform m = ph_xform_identity;
    m.t = (struct fx_vec3){x, y, z};
    return m;
}

struct ph_xform ph_xform_scale(fx_t s)
{
    const int32_t k = fx_sat64((int64_t)s * (1 << 14));
    return (struct ph_xform){{{k, 0, 0}, {0, k, 0}, {0, 0, k}}, {0, 0, 0}};
}

/* 2 (a b + c d) of Q2.30 numbers, in Q2.30, rounded once. */
static int32_t twice_sum(int32_t a, int32_t b, int32_t c, int32_t d)
{
    return fx_sat64(geom_sum_rounded((const int64_t[]){fx_mul_wide(a, b), fx_mul_wide(c, d)}, 2, 29));
}

struct ph_xform ph_xform_quat(struct fx_quat q, struct fx_vec3 t)
{
    const int32_t one = FX_Q30_ONE, nw = fx_neg_sat(q.w);
    struct ph_xform m = {
        {
            {fx_sub_sat(one, twice_sum(q.y, q.y, q.z, q.z)), twice_sum(q.x, q.y, nw, q.z),
             twice_sum(q.x, q.z, q.w, q.y)},
            {twice_sum(q.x, q.y, q.w, q.z), fx_sub_sat(one, twice_sum(q.x, q.x, q.z, q.z)),
             twice_sum(q.y, q.z, nw, q.x)},
            {twice_sum(q.x, q.z, nw, q.y), twice_sum(q.y, q.z, q.w, q.x),
             fx_sub_sat(one, twice_sum(q.x, q.x, q.y, q.y))},
        },
        t,
    };
    return m;
}

/* Whether it only scales and moves, as most of what places a mesh does. */
static bool only_scales(const struct ph_xform *m)
{
    return (m->r[0][1] | m->r[0][2] | m->r[1][0] | m->r[1][2] | m->r[2][0] | m->r[2][1]) == 0;
}

/* The rotation of a product. */
PH_TIER(figure) static void mul_rows(const struct ph_xform *a, const struct ph_xform *b, struct ph_xform *m)
{
    const bool scales = only_scales(b);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const int32_t k = b->r[j][j];
            m->r[i][j] = !scales           ? wide_row_times(a->r[i], b->r[0][j], b->r[1][j], b->r[2][j], 0)
                         : k == FX_Q30_ONE ? a->r[i][j]
                                           : fx_sat64((fx_mul_wide(a->r[i][j], k) + FX_Q30_ONE / 2) >> 30);
        }
    }
}

PH_TIER(figure) struct ph_xform ph_xform_mul(const struct ph_xform *a, const struct ph_xform *b)
{
    struct ph_xform m;
    mul_rows(a, b, &m);
    m.t = (struct fx_vec3){wide_row_times(a->r[0], b->t.x, b->t.y, b->t.z, a->t.x),
                           wide_row_times(a->r[1], b->t.x, b->t.y, b->t.z, a->t.y),
                           wide_row_times(a->r[2], b->t.x, b->t.y, b->t.z, a->t.z)};
    return m;
}

PH_TIER(figure) struct ph_xform ph_xform_mul_near(const struct ph_xform *a, const struct ph_xform *b)
{
    struct ph_xform m;
    mul_rows(a, b, &m);
    m.t = ph_xform_point(a, b->t);
    return m;
}

struct ph_xform ph_xform_inverse_rigid(const struct ph_xform *a)
{
    struct ph_xform m;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            m.r[i][j] = a->r[j][i];
        }
    }
    m.t = (struct fx_vec3){0, 0, 0};
    const struct fx_vec3 t = ph_xform_point(&m, a->t);
    m.t = (struct fx_vec3){fx_neg_sat(t.x), fx_neg_sat(t.y), fx_neg_sat(t.z)};
    return m;
}

PH_TIER(mesh) struct fx_vec3 ph_xform_point(const struct ph_xform *a, struct fx_vec3 p)
{
    return (struct fx_vec3){row_times(a->r[0], p.x, p.y, p.z, a->t.x), row_times(a->r[1], p.x, p.y, p.z, a->t.y),
                            row_times(a->r[2], p.x, p.y, p.z, a->t.z)};
}

struct fx_vec3 ph_xform_direction_q30(const struct ph_xform *a, struct fx_vec3 d)
{
    return (struct fx_vec3){row_times(a->r[0], d.x, d.y, d.z, 0), row_times(a->r[1], d.x, d.y, d.z, 0),
                            row_times(a->r[2], d.x, d.y, d.z, 0)};
}

/* Cross product of two Q2.30 vectors, in Q2.30. */
static struct fx_vec3 cross_q30(struct fx_vec3 a, struct fx_vec3 b)
{
    const int32_t m[3][3] = {{0, -a.z, a.y}, {a.z, 0, -a.x}, {-a.y, a.x, 0}};
    return (struct fx_vec3){row_times(m[0], b.x, b.y, b.z, 0), row_times(m[1], b.x, b.y, b.z, 0),
                            row_times(m[2], b.x, b.y, b.z, 0)};
}

/* The direction to the right of a camera. Returns false if up is zero or within 2^-14 of the view direction. */
static bool right_of(struct fx_vec3 forward, struct fx_vec3 up, struct fx_vec3 *right)
{
    struct fx_vec3 unit_up;
    if (!fx_vec3_direction_q30(up, &unit_up)) {
        return false;
    }
    const struct fx_vec3 side = cross_q30(forward, unit_up);
    const int32_t limit = FX_Q30_ONE >> 14;
    if (fx_abs_sat(side.x) < limit && fx_abs_sat(side.y) < limit && fx_abs_sat(side.z) < limit) {
        return false;
    }
    return fx_vec3_direction_q30(side, right);
}

struct ph_xform ph_view_look_at(struct fx_vec3 eye, struct fx_vec3 target, struct fx_vec3 up)
{
    /* The differences of halves cannot saturate; they serve for positions that are far apart. */
    const struct fx_vec3 towards = {(target.x >> 1) - (eye.x >> 1), (target.y >> 1) - (eye.y >> 1),
                                    (target.z >> 1) - (eye.z >> 1)};
    const struct fx_vec3 exact = fx_vec3_sub_sat(target, eye);
    const bool far_apart =
        fx_abs_sat(towards.x) >= (1 << 29) || fx_abs_sat(towards.y) >= (1 << 29) || fx_abs_sat(towards.z) >= (1 << 29);
    struct fx_vec3 forward, right = {FX_Q30_ONE, 0, 0};
    if (!fx_vec3_direction_q30(far_apart ? towards : exact, &forward)) {
        forward = (struct fx_vec3){0, 0, -FX_Q30_ONE};
    }
    if (!right_of(forward, up, &right) && !right_of(forward, (struct fx_vec3){0, FX_ONE, 0}, &right)) {
        right_of(forward, (struct fx_vec3){0, 0, FX_ONE}, &right);
    }
    const struct fx_vec3 above = cross_q30(right, forward);
    struct ph_xform view = {
        {{right.x, right.y, right.z}, {above.x, above.y, above.z}, {-forward.x, -forward.y, -forward.z}}, {0, 0, 0}};
    const struct fx_vec3 t = ph_xform_point(&view, eye);
    view.t = (struct fx_vec3){fx_neg_sat(t.x), fx_neg_sat(t.y), fx_neg_sat(t.z)};
    return view;
}

/* a 2^bits / b, a >= 0, b > 0, rounded to nearest; 0 if it does not fit an int32_t. */
static int32_t ratio(uint64_t a, int bits, uint64_t b)
{
    const uint64_t q = fx_quotient_u64((a << bits) + b / 2, b);
    return q > INT32_MAX ? 0 : (int32_t)q;
}

/* (v1 + v0) / (v1 - v0) in Q16.16, rounded to nearest. The sum of two int32_t times 2^16 fits 64 bits. */
static fx_t shift_of(const fx_t v[2])
{
    const int64_t sum = ((int64_t)v[1] + v[0]) * FX_ONE;
    const uint64_t size = (uint64_t)((int64_t)v[1] - v[0]), magnitude = (uint64_t)(sum >= 0 ? sum : -sum);
    const int64_t shift = (int64_t)fx_quotient_u64(magnitude + size / 2, size);
    return fx_sat64(sum >= 0 ? shift : -shift);
}

int ph_projection_perspective(struct ph_projection *p, fx_t fov_y_deg, fx_t aspect, fx_t near_z, fx_t far_z)
{
    if (fov_y_deg <= 0 || fov_y_deg >= FX_INT(180) || aspect <= 0 || near_z <= 0 || far_z <= near_z) {
        return PH_ERR_INVAL;
    }
    const int32_t scale_y = fx_cot_half_q20(fov_y_deg);
    const int32_t scale_x = ratio((uint32_t)scale_y, 16, (uint32_t)aspect);
    if (scale_x <= 0 || scale_y <= 0 || scale_y == INT32_MAX) {
        return PH_ERR_INVAL;
    }
    *p = (struct ph_projection){PH_PERSPECTIVE, scale_x, scale_y, 0, 0, near_z, far_z, NULL};
    return PH_OK;
}

/* The volume between x[0] and x[1], y[0] and y[1]; a perspective has these sizes at its near plane. */
static int set_volume(struct ph_projection *p, enum ph_projection_kind kind, const fx_t x[2], const fx_t y[2],
                      fx_t near_z, fx_t far_z)
{
    if (x[0] >= x[1] || y[0] >= y[1] || (kind == PH_PERSPECTIVE && near_z <= 0) || far_z <= near_z) {
        return PH_ERR_INVAL;
    }
    const uint64_t twice = 2 * (uint64_t)(kind == PH_PERSPECTIVE ? near_z : FX_ONE);
    const int32_t scale_x = ratio(twice, 20, (uint64_t)((int64_t)x[1] - x[0])),
                  scale_y = ratio(twice, 20, (uint64_t)((int64_t)y[1] - y[0]));
    if (scale_x <= 0 || scale_y <= 0) {
        return PH_ERR_INVAL;
    }
    *p = (struct ph_projection){kind, scale_x, scale_y, shift_of(x), shift_of(y), near_z, far_z, NULL};
    return PH_OK;
}

int ph_projection_frustum(struct ph_projection *p, fx_t left, fx_t right, fx_t bottom, fx_t top, fx_t near_z,
                          fx_t far_z)
{
    return set_volume(p, PH_PERSPECTIVE, (const fx_t[2]){left, right}, (const fx_t[2]){bottom, top}, near_z, far_z);
}

int ph_projection_ortho(struct ph_projection *p, fx_t left, fx_t right, fx_t bottom, fx_t top, fx_t near_z, fx_t far_z)
{
    return set_volume(p, PH_ORTHOGRAPHIC, (const fx_t[2]){left, right}, (const fx_t[2]){bottom, top}, near_z, far_z);
}
