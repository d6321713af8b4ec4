/* 4 x 4 matrices as the textbooks write them: see camera.h. */
#include "camera.h"
#include "fx_math.h"
#include "geom_sum.h"
#include "tier.h"

/* A row times a vector, rounded once. */
PH_TIER(seldom) static fx_t row_times(const fx_t row[4], fx_t x, fx_t y, fx_t z, fx_t w)
{
    const int64_t products[] = {fx_mul_wide(row[0], x), fx_mul_wide(row[1], y), fx_mul_wide(row[2], z),
                                fx_mul_wide(row[3], w)};
    return fx_sat64(geom_sum_rounded(products, 4, 16));
}

PH_TIER(seldom) struct ph_mat4 ph_mat4_mul(const struct ph_mat4 *a, const struct ph_mat4 *b)
{
    struct ph_mat4 m;
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            m.m[i][j] = row_times(a->m[i], b->m[0][j], b->m[1][j], b->m[2][j], b->m[3][j]);
        }
    }
    return m;
}

PH_TIER(seldom) struct ph_vec4 ph_mat4_apply(const struct ph_mat4 *a, struct ph_vec4 v)
{
    return (struct ph_vec4){row_times(a->m[0], v.x, v.y, v.z, v.w), row_times(a->m[1], v.x, v.y, v.z, v.w),
                            row_times(a->m[2], v.x, v.y, v.z, v.w), row_times(a->m[3], v.x, v.y, v.z, v.w)};
}

PH_TIER(seldom) struct ph_mat4 ph_mat4_xform(const struct ph_xform *a)
{
    const fx_t t[3] = {a->t.x, a->t.y, a->t.z};
    struct ph_mat4 m = {{{0}}};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            m.m[i][j] = fx_from_q30(a->r[i][j]);
        }
        m.m[i][3] = t[i];
    }
    m.m[3][3] = FX_ONE;
    return m;
}

PH_TIER(seldom) struct ph_mat4 ph_matrix_view(const struct ph_xform *view, enum ph_convention convention)
{
    struct ph_mat4 m = ph_mat4_xform(view);
    for (int j = 0; j < 4 && convention == PH_D3D; j++) {
        m.m[2][j] = fx_neg_sat(m.m[2][j]);
    }
    return m;
}

/* a / b in Q16.16, rounded to nearest; b > 0, |a| < 2^46. */
PH_TIER(seldom) static int64_t quotient(int64_t a, int64_t b)
{
    const int64_t scaled = a * FX_ONE;
    return (scaled >= 0 ? scaled + b / 2 : scaled - b / 2) / b;
}

/* times f n / (f - n) in Q16.16, computed as n + n^2 / (f - n), which stays in range. */
PH_TIER(seldom) static int64_t product_quotient(int64_t n, int64_t f, int64_t times)
{
    const int64_t square = times * n * n, range = f - n;
    return times * n + (square + range / 2) / range;
}

/* The third row of a projection matrix: its factors of z and of 1. */
PH_TIER(seldom)
static void depth_row(const struct ph_projection *p, enum ph_convention convention, int64_t *z, int64_t *one)
{
    const int64_t n = p->near_z, f = p->far_z, range = f - n;
    if (p->kind == PH_PERSPECTIVE) {
        const bool full = convention == PH_GL || convention == PH_LMU; /* NDC z from -1 to 1 */
        *one = product_quotient(n, f, full ? 2 : 1) * (convention == PH_REVERSED ? 1 : -1);
        *z = convention == PH_D3D        ? quotient(f, range)
             : convention == PH_REVERSED ? quotient(n, range)
                                         : -quotient(f + n, range);
        return;
    }
    const int64_t unit = quotient(FX_ONE, range), twice = quotient(2 * (int64_t)FX_ONE, range);
    const int64_t middle = quotient(f + n, range);
    *z = convention == PH_D3D || convention == PH_REVERSED ? unit : convention == PH_LMU ? twice : -twice;
    *one = convention == PH_D3D        ? -quotient(n, range)
           : convention == PH_REVERSED ? quotient(f, range)
           : convention == PH_LMU      ? middle
                                       : -middle;
}

PH_TIER(seldom) static fx_t from_q20(int32_t v)
{
    return (v >> 4) + ((v >> 3) & 1);
}

PH_TIER(seldom) static bool fits(int64_t v)
{
    return v <= FX_MAX && v >= FX_MIN;
}

PH_TIER(seldom)
int ph_matrix_projection(struct ph_mat4 *out, const struct ph_projection *p, enum ph_convention convention)
{
    int64_t z, one;
    if (p->far_z <= p->near_z || (p->near_z <= 0 && p->kind == PH_PERSPECTIVE) ||
        p->kind == PH_FISHEYE) { /* no matrix */
        return PH_ERR_INVAL;
    }
    depth_row(p, convention, &z, &one);
    if (!fits(z) || !fits(one)) {
        return PH_ERR_RANGE;
    }
    const fx_t sx = from_q20(p->scale_x_q20), sy = from_q20(p->scale_y_q20);
    const fx_t left = fx_neg_sat(p->shift_x), down = fx_neg_sat(p->shift_y);
    struct ph_mat4 m = {{{sx, 0, 0, 0}, {0, sy, 0, 0}, {0, 0, (fx_t)z, (fx_t)one}, {0, 0, 0, 0}}};
    if (p->kind == PH_ORTHOGRAPHIC) {
        m.m[0][3] = left;
        m.m[1][3] = down;
        m.m[3][3] = FX_ONE;
        *out = m;
        return PH_OK;
    }
    const bool forward = convention == PH_D3D || convention == PH_LMU; /* w = z */
    m.m[0][2] = forward ? left : p->shift_x;
    m.m[1][2] = forward ? down : p->shift_y;
    m.m[3][2] = forward ? FX_ONE : -FX_ONE;
    if (convention == PH_LMU) { /* w is negative for visible points: x and y change their sign, too */
        m.m[0][0] = -sx;
        m.m[1][1] = -sy;
    }
    *out = m;
    return PH_OK;
}

PH_TIER(seldom) struct ph_mat4 ph_matrix_viewport(uint16_t width, uint16_t height, enum ph_convention convention)
{
    const fx_t x = (fx_t)width * FX_HALF, y = (fx_t)height * FX_HALF;
    return (struct ph_mat4){
        {{x, 0, 0, x}, {0, convention == PH_LMU ? y : -y, 0, y}, {0, 0, FX_ONE, 0}, {0, 0, 0, FX_ONE}}};
}

PH_TIER(seldom) struct ph_mat4 ph_matrix_plane(struct fx_vec3 normal, fx_t d)
{
    return (struct ph_mat4){{{d, 0, 0, 0},
                             {0, d, 0, 0},
                             {0, 0, d, 0},
                             {-fx_from_q30(normal.x), -fx_from_q30(normal.y), -fx_from_q30(normal.z), 0}}};
}
