/* Keys, poses and places: see motion.h. */
#include "fx_math.h"
#include "geom_sum.h"
#include "motion.h"
#include "tier.h"

#define NEARLY_ONE (FX_Q30_ONE - (FX_Q30_ONE >> 11)) /* cosine of 1.8 degrees: there nlerp is as good as slerp */

PH_TIER(seldom) static int32_t mul_q30(int32_t a, int32_t b)
{
    return (int32_t)((fx_mul_wide(a, b) + (1 << 29)) >> 30);
}

/* 2 asin(sqrt z) in turn32, z <= 1/2 in Q2.30, as sqrt z times a polynomial in z. Error 2e-7 of it (interpolation at
 * the zeros of the Chebyshev polynomial of degree 7). */
PH_TIER(seldom) static uint32_t arc_of(int32_t z)
{
    static const int32_t terms[] = {136586056, -73199565, 82197737, 53336947, 103205699, 227833644, 1367130661};
    int32_t sum = 0;
    for (uint32_t i = 0; i < sizeof terms / sizeof terms[0]; i++) {
        sum = mul_q30(sum, z) + terms[i];
    }
    return (uint32_t)mul_q30((int32_t)fx_sqrt_u64((uint64_t)z << 30), sum);
}

PH_TIER(seldom) static struct fx_quat quat_of(const int64_t q[4])
{
    return fx_quat_normalise((struct fx_quat){(int32_t)q[0], (int32_t)q[1], (int32_t)q[2], (int32_t)q[3]});
}

PH_TIER(seldom) struct fx_quat ph_quat_slerp(struct fx_quat a, struct fx_quat b, fx_t t)
{
    const int64_t sum = (fx_mul_wide(a.w, b.w) >> 2) + (fx_mul_wide(a.x, b.x) >> 2) + (fx_mul_wide(a.y, b.y) >> 2) +
                        (fx_mul_wide(a.z, b.z) >> 2);
    const int64_t size = (sum < 0 ? -sum : sum) >> 28;
    const int32_t dot = size < FX_Q30_ONE ? (int32_t)size : FX_Q30_ONE;
    if (dot > NEARLY_ONE) {
        return fx_quat_nlerp(a, b, t);
    }
    const uint32_t arc = arc_of((FX_Q30_ONE - dot) >> 1), part = (uint32_t)(((uint64_t)arc * (uint32_t)t) >> 16);
    int32_t from, to, cos;
    fx_sincos_q30(arc - part, &from, &cos);
    fx_sincos_q30(part, &to, &cos);
    to = sum < 0 ? -to : to;
    return quat_of((int64_t[]){
        (fx_mul_wide(a.w, from) + fx_mul_wide(b.w, to)) >> 30, (fx_mul_wide(a.x, from) + fx_mul_wide(b.x, to)) >> 30,
        (fx_mul_wide(a.y, from) + fx_mul_wide(b.y, to)) >> 30, (fx_mul_wide(a.z, from) + fx_mul_wide(b.z, to)) >> 30});
}

/* ---- keys ------------------------------------------------------------------------------------------------------- */

/* Where a time falls: key i, and the share of the way to key i + 1. */
struct moment {
    uint32_t key;
    fx_t share;
};

PH_TIER(seldom) static struct moment find_key(const struct ph_track *track, fx_t time)
{
    const fx_t at = fx_max(time, 0);
    uint32_t low = 0, high = track->key_count; /* the first key behind the time is in low .. high */
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if (track->times[middle] <= at) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    if (low == 0 || low == track->key_count) {
        return (struct moment){low == 0 ? 0 : low - 1, 0};
    }
    const fx_t from = fx_max(track->times[low - 1], 0), to = track->times[low];
    return (struct moment){low - 1, track->interpolation == PH_KEYS_STEP ? 0 : fx_div_sat(at - from, to - from)};
}

/* The value between key m.key and the next, in units of the keys times 2^16. */
PH_TIER(seldom) static int64_t number_at(const struct ph_track *track, struct moment m, uint32_t i)
{
    const uint32_t width = track->width;
    const bool is_cubic = track->interpolation == PH_KEYS_CUBIC;
    const int16_t *const key = track->keys + (is_cubic ? (3 * m.key + 1) * width : m.key * width) + i;
    if (m.share == 0) {
        return (int64_t)key[0] * FX_ONE;
    }
    if (!is_cubic) {
        return (int64_t)key[0] * FX_ONE + fx_mul_wide(key[width] - key[0], m.share);
    }
    const int16_t out = key[width], in = key[2 * width], to = key[3 * width];
    const int64_t u = m.share, u2 = u * u, u3 = u2 * u;                                          /* Q16, Q32, Q48 */
    const int64_t h01 = 3 * u2 - (u3 >> 15), h11 = (u3 >> 16) - u2, h10 = h11 - u2 + u * FX_ONE; /* Q32 */
    return ((int64_t)key[0] * FX_ONE) + ((h01 * (to - key[0]) + h10 * out + h11 * in) >> 16);
}

/* Units of the keys times 2^16 to Q8.24. */
PH_TIER(seldom) static int32_t scaled(int64_t number, uint8_t frac)
{
    const int down = frac - 8;
    return fx_sat64((number + (((int64_t)1 << down) >> 1)) >> down);
}

PH_TIER(seldom) static struct fx_quat key_rotation(const struct ph_track *track, uint32_t key)
{
    const int16_t *const k = track->keys + 4 * key;
    return quat_of((const int64_t[]){k[3] * (1 << 15), k[0] * (1 << 15), k[1] * (1 << 15), k[2] * (1 << 15)});
}

PH_TIER(seldom) static struct fx_quat rotation_at(const struct ph_track *track, struct moment m)
{
    if (track->interpolation != PH_KEYS_CUBIC) {
        const struct fx_quat from = key_rotation(track, m.key);
        return m.share == 0 ? from : ph_quat_slerp(from, key_rotation(track, m.key + 1), m.share);
    }
    return quat_of((const int64_t[]){number_at(track, m, 3) >> 3, number_at(track, m, 0) >> 3,
                                     number_at(track, m, 1) >> 3, number_at(track, m, 2) >> 3});
}

PH_TIER(seldom) static struct fx_vec3 vector_at(const struct ph_track *track, struct moment m)
{
    return (struct fx_vec3){scaled(number_at(track, m, 0), track->frac), scaled(number_at(track, m, 1), track->frac),
                            scaled(number_at(track, m, 2), track->frac)};
}

PH_TIER(seldom) void ph_clip_sample(const struct ph_clip *clip, fx_t time, struct ph_pose *pose, int32_t *weights)
{
    for (uint32_t i = 0; i < clip->track_count; i++) {
        const struct ph_track *const track = &clip->tracks[i];
        if (track->key_count == 0) {
            continue;
        }
        const struct moment m = find_key(track, time);
        switch (track->path) {
        case PH_PATH_TRANSLATION:
            pose[track->node].t = vector_at(track, m);
            break;
        case PH_PATH_ROTATION:
            pose[track->node].r = rotation_at(track, m);
            break;
        case PH_PATH_SCALE:
            pose[track->node].s = vector_at(track, m);
            break;
        default:
            for (uint32_t k = 0; k < track->width; k++) {
                weights[track->node + k] = scaled(number_at(track, m, k), track->frac);
            }
        }
    }
}

PH_TIER(seldom) fx_t ph_clip_loop(const struct ph_clip *clip, fx_t time)
{
    const fx_t at = clip->duration > 0 ? time % clip->duration : 0;
    return at < 0 ? at + clip->duration : at;
}

/* ---- poses ------------------------------------------------------------------------------------------------------ */

PH_TIER(seldom) void ph_rig_rest(const struct ph_rig *rig, struct ph_pose *pose)
{
    for (uint32_t i = 0; i < rig->node_count; i++) {
        pose[i] = rig->nodes[i].rest;
    }
}

PH_TIER(seldom) void ph_pose_blend(struct ph_pose *a, const struct ph_pose *b, uint32_t node_count, fx_t share)
{
    for (uint32_t i = 0; i < node_count; i++) {
        a[i] = (struct ph_pose){ph_quat_slerp(a[i].r, b[i].r, share), fx_vec3_lerp_sat(a[i].t, b[i].t, share),
                                fx_vec3_lerp_sat(a[i].s, b[i].s, share)};
    }
}

/* Scales the axes of a place by Q8.24; elements saturate. */
PH_TIER(seldom) static void scale_axes(struct ph_xform *place, struct fx_vec3 by)
{
    const int32_t s[3] = {by.x, by.y, by.z};
    for (int i = 0; i < 9; i++) {
        const int64_t product = fx_mul_wide(place->r[i / 3][i % 3], s[i % 3]);
        place->r[i / 3][i % 3] = fx_sat64((product + (1 << 23)) >> 24);
    }
}

/* The scale comes last, so that it may be any as long as what it makes of the parent's place has room. */
PH_TIER(seldom)
void ph_rig_places(const struct ph_rig *rig, const struct ph_pose *pose, const struct ph_xform *root,
                   struct ph_xform *places)
{
    for (uint32_t i = 0; i < rig->node_count; i++) {
        const int16_t parent = rig->nodes[i].parent;
        const struct ph_xform turned = ph_xform_quat(pose[i].r, pose[i].t);
        places[i] = ph_xform_mul_near(parent < 0 ? root : &places[parent], &turned);
        scale_axes(&places[i], pose[i].s);
    }
}
