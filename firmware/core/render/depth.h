/*
 * depth: from a vertex's distance to the codes in the depth buffer. Larger is nearer; 0 is empty.
 *
 * Depth is complementary: d = N/w - N/f, n and f being the near and the far plane. It is 0 at the far plane and linear
 * in screen space, so it is interpolated there. (Orthographic: d = (1 - 2^-9) (f - z) / (f - n).)
 *   fixed formats:  N = (1 - 2^-9) n f / (f - n), at most 8 n: d is 1 - 2^-9 at the near plane, and so it takes every
 *                   code between any planes from f = 8/7 n on
 *   the others:     N = (1 - 2^-9) n. With 5 or 6 bits of exponent (below) 2^-8 or 2^-7 stands for 2^-9: 16 codes
 * N/w is kept as a quotient q and an exponent s: N/w = q 2^-(30 + s), q in 2^30 .. 2^31. It comes from a reciprocal
 * that is exact to one unit in 2^30 and monotone over every w. No constant of a projection matrix is rounded on the
 * way; N is cut off to 2^-31 of itself, which scales all depths of a frame alike.
 *
 * A triangle holds d as a 32-bit plane in units of 2^-(32 + block). For the fixed formats block is 0. For the floats it
 * is the largest block with which the nearest vertex fits with a bit to spare, so that far triangles keep their
 * precision.
 *
 * The rasterizer steps 32 bits; the code is their high 16 (16 guard bits) or 24 (8 guard bits). With an exact d:
 *   fixed16:  code = floor(2^16 d + 16 1/4)      fixed24: floor(2^24 d + 4160)
 *   float16:  code = floor(F(d) + 8)             float24: floor(256 (F(d) + 8))
 *             F is an unsigned float with e = 3 .. 6 bits of exponent and m = 16 - e of mantissa, in full precision:
 *             F = 2^(m + 1) d + (2^e - 2) 2^m in 1/2 .. 1, and twice as steep with each octave towards 0, down to
 *             2^(1 - 2^e). F is continuous and piecewise linear: inside one octave a float span is a fixed span with
 *             another slope. All that "float" costs is to split spans where d crosses a power of two.
 *   linear-w: code = floor(65408 (f - w) / (f - n) + 16). N/w is stepped, below 2^29 in the triangle, and each pixel
 *             takes a reciprocal and a product of it: 40 to 90 instructions more. Orthographic: as fixed16.
 * d of a corner is off by at most 13 units of 2^-32, in the fixed formats 21 (from f = 2 n down to 8/7 n up to 81); a
 * gradient by at most 9 units of its last bit (make proof).
 * The biases and the 2^-9 are head room: planes overshoot their triangle by less, so nothing wraps. The quarter evens
 * out the last two codes before the far plane, where fixed16 is coarsest.
 *
 * What they resolve: the longest distance between near and far plane over which the code stays the same, in metres,
 * through vertices, set-up and spans (tests/core/test_depth.c). A step of Q16.16 itself is 0.000015.
 *                  n = .1 f = 1000    n = .5 f = 100    n = 1 f = 1000    best if
 *   fixed16        108                .302              14.7              f / n is small: it is the cheapest
 *   float16        .0746              .0060             .061              16 bits and any f / n
 *   fixed24        .597               .0012             .0597             f / n is moderate; twice the memory
 *   float24        .000305            .000031           .000244           everywhere; twice the memory
 *   linear-w       .0153              .00153            .0153             far away; near by it is the coarsest
 * AUTO takes fixed16 up to f = 64 n. Its relative step is largest at the far plane, (f - n) / (65408 n): 1/1000 there,
 * from which on surfaces begin to fight for pixels (T. Ulrich). A float's relative step is at most 2^-m; its longest
 * step is f 2^(-2 - m), near f / 2, or that of its lowest octave at the far plane, f^2 / n 2^(1 - 2^e - m). So
 * ph_depth_choose_exponent() takes 3 bits up to f = 64 n, 4 up to 16384 n, else 5; 6 are better above 2^30 n alone
 * (Lapidous and Jiao, 1999: complementary z, the width of its exponent fitted to f / n). At n = .1 f = 10000 the
 * longest step is 7.5 m with 4 bits and 1.1 m with 5.
 *
 * Limits. Screen positions have 8 sub-pixel bits. They move a leaning surface by up to sqrt(2)/256 of the change of its
 * distance from pixel to pixel; with 24 bits this is the larger part (measured by the same test). The 8 guard
 * bits of the 24-bit formats drift by up to 1 code in 512 pixels.
 *
 * A triangle has one depth: at one pixel it has one code in every shading. Inside the triangle a code is off the exact
 * plane through the projected corners by at most this, at every slope up to edge-on (tests/core/test_depth_slopes.c;
 * the 40,000 triangles of exhaustive_depth_slopes.c):
 *   fixed16, float16: 3    fixed24: 2    float24: 8    linear-w: 1
 * (with 3 bits of exponent, whose codes are half as wide, twice as many; where a float's codes are finer than the 13
 * units of d, near the far plane, by those as well). A pixel is drawn if its centre is inside the
 * edges, and these are rounded: by 2^-16 px a row, and up to 64 px by 2^-15 px a column as well. At a centre outside
 * the corners by that much the code may leave their range, by 4 of 16 bits at most; a plane that could leave it by more
 * is clamped to the range. A plane that 32 bits cannot hold, because it is too steep or because it crosses more octaves
 * than the format has bits for, has 64 bits (exact.h).
 */
#ifndef PH_DEPTH_H
#define PH_DEPTH_H

#include "render.h"
#include "tier.h"

#define PH_DEPTH_BIAS_FIXED16 ((uint32_t)65 << 14)
#define PH_DEPTH_BIAS_FLOAT16 ((uint32_t)8 << 16)

/* How the codes of a frame are made. Under an orthographic projection the distance is linear in d, so d is the code. */
static inline enum ph_depth_coding ph_depth_coding(const struct ph_renderer *r)
{
    const unsigned coding = r->stats.depth_format->coding;
    return coding == PH_DEPTH_IS_LINEAR && r->lens.kind == PH_ORTHOGRAPHIC ? PH_DEPTH_IS_FIXED
                                                                           : (enum ph_depth_coding)coding;
}

/* The head room of d is 2^-this: 2^-9, or what 16 codes take where a float has more bits of exponent. */
static inline int ph_depth_head(const struct ph_lens *lens)
{
    return lens->float_down > 3 ? 12 - lens->float_down : 9;
}

/* The highest d that depth_bias_slope lifts a corner to: its head room is left. */
static inline uint32_t ph_depth_top(const struct ph_lens *lens)
{
    return UINT32_MAX << (32 - ph_depth_head(lens));
}

/* The material's bias, within its range: all ways to draw a triangle take it from here. */
static inline uint32_t ph_depth_bias(const struct ph_material *material)
{
    return material->depth_bias < 56 ? material->depth_bias : 56;
}

/* The quotient N/w for a view distance, in the form that the head of this file describes. */
struct ph_quotient {
    uint32_t q;
    int8_t s;
};

struct ph_quotient ph_depth_quotient(const struct ph_lens *lens, fx_t w);

/* ph_depth_quotient under a perspective, from fx_rcp_norm(w): two products fewer if the reciprocal is there already. */
static inline struct ph_quotient ph_depth_quotient_of(const struct ph_lens *lens, uint32_t reciprocal, int shift)
{
    const uint32_t q = fx_mulhi_u32(lens->depth_scale, reciprocal);
    const int s = lens->near_shift - shift;
    return q < (uint32_t)1 << 30 ? (struct ph_quotient){q << 1, (int8_t)(s + 1)} : (struct ph_quotient){q, (int8_t)s};
}

/* N/f in units of 2^-(32 + block), modulo 2^32. block is 0 or below far_s - 1. */
static inline uint32_t ph_depth_far(const struct ph_lens *lens, int block)
{
    const int up = 2 + block - lens->far_s;
    return up >= 0 ? lens->far_q << up : up > -32 ? lens->far_q >> -up : 0;
}

/* d of a vertex that is not behind the far plane, in units of 2^-(32 + block); far: the result of ph_depth_far. block
 * is 0 or below s - 1. N/w may be 1 and more, d is less. */
static inline uint32_t ph_depth_before(struct ph_quotient quotient, uint32_t far, int block)
{
    const int up = 2 + block - quotient.s;
    const uint32_t at = up >= 0 ? quotient.q << up : quotient.q >> -up;
    return at - far;
}

/* d of a quotient in units of 2^-(32 + block): ph_depth_before with the far plane of the lens. */
uint32_t ph_depth_at(const struct ph_lens *lens, struct ph_quotient quotient, int block);

/* The lowest octave of a float in units of 2^-(32 + block): e bits of exponent count all that is below 2^-(2^e - 2) as
 * one. It is negative if the whole block lies below. down: e - 1. */
static inline int ph_depth_lowest(int block, int down)
{
    const int lowest = (2 << down) - 2 - block;
    return lowest < 31 ? lowest : 31;
}

/* Octave of a d in units of 2^-(32 + block): its leading zeros. */
static inline int ph_depth_octave(uint32_t d, int lowest)
{
    const int zeros = fx_clz32(d);
    return zeros < lowest ? zeros : lowest;
}

/* Whether d lies in an octave. This is cheaper than ph_depth_octave, which computes the octave of d. */
static inline bool ph_depth_in_octave(uint32_t d, int octave, int lowest)
{
    return (d >> (octave > 0 ? 31 - octave : 31) | (uint32_t)(octave >= lowest)) == 1;
}

/* Converts a d of an octave to a 16.16 code of a float, without the octave's constant. up: octave - down. */
static inline uint32_t ph_depth_float16_value(uint32_t d, int up)
{
    return up >= 0 ? d << up : d >> -up;
}

/* Converts a gradient of d to a gradient of 16.16 codes in an octave. up: octave - down. */
PH_TIER(scenery) static inline uint32_t ph_depth_float16_slope(uint32_t gradient, int up)
{
    return up >= 0 ? gradient << up : (uint32_t)((int32_t)gradient >> -up) + (gradient >> (-up - 1) & 1);
}

/* The constant of an octave in 16.16 codes of a float, plus PH_DEPTH_BIAS_FLOAT16. */
static inline uint32_t ph_depth_float16_offset(int octave, int block, int down)
{
    return ((uint32_t)((2 << down) - 2 - octave - block) << (31 - down)) + PH_DEPTH_BIAS_FLOAT16;
}

/* N of the fixed formats but for the head room: n f / (f - n), but less than 8 n; from 2^31 on, times 2^-*shift. */
uint32_t ph_lens_near(const struct ph_projection *p, int *shift);

/* The struct ph_linear of a camera, for the lowest exponent `least` = 0. */
struct ph_linear ph_depth_linear_of(const struct ph_lens *lens);

/* 16.16 code of linear-w from N/w in units of 2^-(28 + least). */
static inline uint32_t ph_depth_linear(const struct ph_linear *linear, uint32_t over_w)
{
    const uint32_t nearest = ((uint32_t)1 << 30) - ((uint32_t)1 << 21), most = UINT32_MAX >> linear->up;
    int shift;
    const uint32_t reciprocal = fx_rcp_norm(over_w, &shift);
    const int down = linear->down - shift;
    const uint32_t w = down < 0 ? linear->far : down > 31 ? 0 : reciprocal >> down;
    const uint32_t before = w < linear->far ? linear->far - w : 0;
    const uint32_t d = fx_mulhi_u32((before < most ? before : most) << linear->up, linear->scale);
    return ((d < nearest ? d : nearest) << 2) + ((uint32_t)linear->bias << 16);
}

/* ph_depth_linear as a function of its own, for what is rare. */
uint32_t ph_depth_linear_code(const struct ph_linear *linear, uint32_t over_w);

#endif
