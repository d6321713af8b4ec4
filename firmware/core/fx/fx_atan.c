/* fx_atan: the angle of a vector. See fx.h. */
#include "fx.h"
#include "fx_tangent.h"

/* Entry i is atan((i - 1) / 64) in 2^-32 turn. The first and the last node serve only for differences. */
static const int32_t arctangent[67] = {
    -10679838, 0,         10679838,  21354465,  32018685,  42667331,  53295284,  63897482,  74468939,  85004756,
    95500135,  105950391, 116350962, 126697423, 136985493, 147211045, 157370116, 167458907, 177473799, 187411349,
    197268300, 207041579, 216728303, 226325781, 235831508, 245243172, 254558647, 263775993, 272893455, 281909457,
    290822599, 299631651, 308335554, 316933406, 325424463, 333808132, 342083962, 350251643, 358310992, 366261957,
    374104599, 381839095, 389465727, 396984877, 404397019, 411702716, 418902610, 425997422, 432987938, 439875013,
    446659557, 453342536, 459924966, 466407904, 472792449, 479079736, 485270931, 491367227, 497369841, 503280012,
    509098996, 514828063, 520468494, 526021581, 531488619, 536870912, 542169761,
};

#define DOUBT 1024 /* 2^-16 LSB; the error of the parabola through the nodes is at most 740 */

/* Whether lo / hi is at least the tangent of k 2^-17 turn. */
static int at_least(uint32_t lo, uint32_t hi, uint32_t k)
{
    const struct fx_ratio r = fx_tangent_ratio((uint64_t)k << 49);
    const uint64_t left_low = fx_mul_wide_u(lo, (uint32_t)r.den);
    const uint64_t right_low = fx_mul_wide_u(hi, (uint32_t)r.num);
    const uint64_t left = fx_mul_wide_u(lo, (uint32_t)(r.den >> 32)) + (left_low >> 32);
    const uint64_t right = fx_mul_wide_u(hi, (uint32_t)(r.num >> 32)) + (right_low >> 32);
    return left > right || (left == right && (uint32_t)left_low >= (uint32_t)right_low);
}

/*
 * The angle whose tangent is lo / hi, 0 <= lo <= hi: 0 .. 8192. It is interpolated between the nodes; if that is too
 * near to the middle between two results, an exact comparison decides.
 */
static int32_t octant(uint32_t lo, uint32_t hi)
{
    int shift;
    const uint32_t r = fx_rcp_norm(hi, &shift);
    const uint32_t t = fx_mulhi_u32(lo << shift, r); /* lo / hi in 2^-30 */
    const uint32_t node = (t + ((uint32_t)1 << 23)) >> 24;
    const int32_t p = (int32_t)(t - (node << 24)); /* offset from the node, -1/2 .. 1/2 in 2^-24 */
    const int32_t *f = &arctangent[node + 1];
    const int32_t slope = (f[1] - f[-1]) >> 10;
    const int32_t bend = f[1] - 2 * f[0] + f[-1];
    const int32_t pp = ((p >> 10) * (p >> 10)) >> 13; /* 2^-15 */
    const int32_t angle = f[0] + (((p >> 8) * slope) >> 7) + ((pp * bend) >> 16);
    const int32_t below = angle >> 16;
    const int32_t part = angle & 0xffff;
    if (part > 0x8000 - DOUBT && part < 0x8000 + DOUBT) {
        return below + at_least(lo, hi, 2 * (uint32_t)below + 1);
    }
    return below + (part >> 15);
}

fx_t fx_atan2(fx_t y, fx_t x)
{
    const uint32_t ay = fx_magnitude(y);
    const uint32_t ax = fx_magnitude(x);
    const uint32_t hi = ay > ax ? ay : ax;
    const uint32_t lo = ay > ax ? ax : ay;
    if (hi == 0) {
        return 0;
    }
    int32_t angle = octant(lo, hi);
    if (ay > ax) {
        angle = 16384 - angle;
    }
    if (x < 0) {
        angle = 32768 - angle;
    }
    return y < 0 && angle != 32768 ? -angle : angle;
}
