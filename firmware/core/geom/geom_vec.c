/* Vectors and quaternions: see geom.h. */
#include "geom.h"
#include "geom_sum.h"

struct fx_vec3 fx_vec3_add_sat(struct fx_vec3 a, struct fx_vec3 b)
{
    return (struct fx_vec3){fx_add_sat(a.x, b.x), fx_add_sat(a.y, b.y), fx_add_sat(a.z, b.z)};
}

struct fx_vec3 fx_vec3_sub_sat(struct fx_vec3 a, struct fx_vec3 b)
{
    return (struct fx_vec3){fx_sub_sat(a.x, b.x), fx_sub_sat(a.y, b.y), fx_sub_sat(a.z, b.z)};
}

struct fx_vec3 fx_vec3_scale_sat(struct fx_vec3 a, fx_t s)
{
    return (struct fx_vec3){fx_mul_sat(a.x, s), fx_mul_sat(a.y, s), fx_mul_sat(a.z, s)};
}

struct fx_vec3 fx_vec3_lerp_sat(struct fx_vec3 a, struct fx_vec3 b, fx_t t)
{
    return (struct fx_vec3){fx_lerp_sat(a.x, b.x, t), fx_lerp_sat(a.y, b.y, t), fx_lerp_sat(a.z, b.z, t)};
}

/* a b - c d of Q16.16 numbers, rounded once. */
static fx_t cross_term(fx_t a, fx_t b, fx_t c, fx_t d)
{
    return fx_sat64(geom_sum_rounded((const int64_t[]){fx_mul_wide(a, b), -fx_mul_wide(c, d)}, 2, 16));
}

struct fx_vec3 fx_vec3_cross_sat(struct fx_vec3 a, struct fx_vec3 b)
{
    return (struct fx_vec3){cross_term(a.y, b.z, a.z, b.y), cross_term(a.z, b.x, a.x, b.z),
                            cross_term(a.x, b.y, a.y, b.x)};
}

fx_t fx_vec3_dot_sat(struct fx_vec3 a, struct fx_vec3 b)
{
    const int64_t products[] = {fx_mul_wide(a.x, b.x), fx_mul_wide(a.y, b.y), fx_mul_wide(a.z, b.z)};
    return fx_sat64(geom_sum_rounded(products, 3, 16));
}

fx_t fx_vec3_length_sat(struct fx_vec3 a)
{
    const uint32_t x = fx_magnitude(a.x), y = fx_magnitude(a.y), z = fx_magnitude(a.z);
    const uint64_t sum = fx_mul_wide_u(x, x) + fx_mul_wide_u(y, y) + fx_mul_wide_u(z, z); /* <= 3 * 2^62 */
    const uint32_t root = fx_sqrt_u64(sum);
    const bool up = sum - fx_mul_wide_u(root, root) > root; /* nearer to root + 1 */
    return root >= (uint32_t)FX_MAX ? FX_MAX : (fx_t)(root + up);
}

/* Scales n components by a power of two, so that the largest is in 2^28 .. 2^29. Returns false for the zero vector. */
static bool normalise_shift(const int64_t *in, int32_t *out, int n)
{
    uint64_t largest = 0;
    for (int i = 0; i < n; i++) {
        const uint64_t m = in[i] < 0 ? 0u - (uint64_t)in[i] : (uint64_t)in[i];
        largest = m > largest ? m : largest;
    }
    if (largest == 0) {
        return false;
    }
    const uint32_t high = (uint32_t)(largest >> 32);
    const int bits = high != 0 ? 64 - fx_clz32(high) : 32 - fx_clz32((uint32_t)largest);
    for (int i = 0; i < n; i++) {
        out[i] = (int32_t)(bits > 29 ? in[i] >> (bits - 29) : (int64_t)((uint64_t)in[i] << (29 - bits)));
    }
    return true;
}

/* Scales n components to length one, in Q2.30. Returns false for the zero vector. */
static bool unit_q30(const int64_t *in, int32_t *out, int n)
{
    if (!normalise_shift(in, out, n)) {
        return false;
    }
    uint64_t sum = 0;
    for (int i = 0; i < n; i++) {
        sum += fx_mul_wide_u(fx_magnitude(out[i]), fx_magnitude(out[i])); /* <= 4 * 2^58 */
    }
    sum -= sum >> 60; /* four components of -2^29: their sum, 2^60, would leave no bit after the shift below */
    /* The root has 32 bits: it is the length in 2^-2 units of the components. */
    const int64_t length = fx_sqrt_u64(sum << 4);
    for (int i = 0; i < n; i++) {
        const int64_t scaled = (int64_t)((uint64_t)(int64_t)out[i] << 33);
        out[i] = (int32_t)((scaled / length + 1) >> 1);
    }
    return true;
}

bool fx_vec3_direction_q30(struct fx_vec3 a, struct fx_vec3 *unit)
{
    const int64_t in[3] = {a.x, a.y, a.z};
    int32_t out[3] = {0, 0, 0};
    const bool has_direction = unit_q30(in, out, 3);
    *unit = (struct fx_vec3){out[0], out[1], out[2]};
    return has_direction;
}

const struct fx_quat fx_quat_identity = {FX_Q30_ONE, 0, 0, 0};

/* Product of two Q2.30 numbers below one, in Q2.30. */
static int32_t mul_q30(int32_t a, int32_t b)
{
    return (int32_t)((fx_mul_wide(a, b) + (1 << 29)) >> 30);
}

struct fx_quat fx_quat_axis(struct fx_vec3 axis, uint32_t turn32)
{
    struct fx_vec3 unit;
    if (!fx_vec3_direction_q30(axis, &unit)) {
        return fx_quat_identity;
    }
    int32_t s, c;
    fx_sincos_q30(turn32 >> 1, &s, &c);
    return (struct fx_quat){c, mul_q30(unit.x, s), mul_q30(unit.y, s), mul_q30(unit.z, s)};
}

/* The quaternion of length one in the direction of in; the identity for zero. */
static struct fx_quat unit_quat(const int64_t in[4])
{
    int32_t out[4];
    return unit_q30(in, out, 4) ? (struct fx_quat){out[0], out[1], out[2], out[3]} : fx_quat_identity;
}

struct fx_quat fx_quat_normalise(struct fx_quat q)
{
    return unit_quat((const int64_t[4]){q.w, q.x, q.y, q.z});
}

/* A component of a quaternion product, divided by 4, as the sum of four whole products may not fit. */
static int64_t quat_term(const int32_t a[4], const int32_t b[4])
{
    int64_t sum = 0;
    for (int i = 0; i < 4; i++) {
        sum += fx_mul_wide(a[i], b[i]) >> 2;
    }
    return sum;
}

struct fx_quat fx_quat_mul(struct fx_quat a, struct fx_quat b)
{
    const int32_t left[4] = {a.w, a.x, a.y, a.z};
    return unit_quat((const int64_t[4]){
        quat_term(left, (const int32_t[4]){b.w, fx_neg_sat(b.x), fx_neg_sat(b.y), fx_neg_sat(b.z)}),
        quat_term(left, (const int32_t[4]){b.x, b.w, b.z, fx_neg_sat(b.y)}),
        quat_term(left, (const int32_t[4]){b.y, fx_neg_sat(b.z), b.w, b.x}),
        quat_term(left, (const int32_t[4]){b.z, b.y, fx_neg_sat(b.x), b.w}),
    });
}

struct fx_quat fx_quat_nlerp(struct fx_quat a, struct fx_quat b, fx_t t)
{
    const int64_t dot = quat_term((const int32_t[4]){a.w, a.x, a.y, a.z}, (const int32_t[4]){b.w, b.x, b.y, b.z});
    if (dot < 0) { /* -b is the same rotation and nearer */
        b = (struct fx_quat){fx_neg_sat(b.w), fx_neg_sat(b.x), fx_neg_sat(b.y), fx_neg_sat(b.z)};
    }
    return fx_quat_normalise((struct fx_quat){fx_lerp_sat(a.w, b.w, t), fx_lerp_sat(a.x, b.x, t),
                                              fx_lerp_sat(a.y, b.y, t), fx_lerp_sat(a.z, b.z, t)});
}
