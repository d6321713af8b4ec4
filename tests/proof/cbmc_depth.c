/* The depth code: no overflow and no bad shift, from the lens to the code of any distance. See proof.h. */
#include "proof_render.h"

#include "triangle.h"

#include "../../firmware/core/render/depth.c"

/* A distance between near and far plane. */
static fx_t any_distance(const struct ph_lens *lens)
{
    return i32_between(lens->near_z, lens->far_z);
}

void proof_quotient(void)
{
    const struct ph_lens lens = lens_of(PH_PERSPECTIVE);
    const struct ph_quotient q = ph_depth_quotient(&lens, any_distance(&lens));
    CLAIM(q.s >= LEAST_S && q.s <= 31);
}

void proof_quotient_ortho(void)
{
    struct ph_lens lens = lens_of(PH_ORTHOGRAPHIC);
    lens.near_shift = (int8_t)fx_clz32((uint32_t)lens.far_z - (uint32_t)lens.near_z);
    ph_depth_quotient(&lens, any_distance(&lens));
}

void proof_codes(void)
{
    const struct ph_lens lens = any_lens();
    const struct ph_quotient q = {nondet_u32(), (int8_t)i32_between(LEAST_S, 31)};
    const int block = i32_between(0, q.s > 2 ? q.s - 2 : 0), down = i32_between(2, 5);
    ASSUME(lens.far_s >= 0 || block == 0);                                          /* floats have N/f below 1 */
    ASSUME(q.s <= lens.far_s && (uint64_t)q.q << (lens.far_s - q.s) >= lens.far_q); /* not behind the far plane */
    const uint32_t d = ph_depth_at(&lens, q, block);
    CLAIM(block == 0 || q.q >> 31 != 0 || d >> 31 == 0); /* a bit to spare */
    const int lowest = ph_depth_lowest(block, down), octave = ph_depth_octave(d, lowest);
    ph_depth_in_octave(d, octave, lowest);
    ph_depth_float16_value(d, octave - down);
    ph_depth_float16_slope(nondet_u32(), octave - down);
    ph_depth_float16_offset(octave, block, down);
    const uint8_t both = ph_block_of(block, down);
    CLAIM(ph_block_exponent(both) == block && ph_block_down(both) == down && both < PH_BLOCK_EXACT);
    ph_block_rounded(d, both);
}

/* The near plane's quotient is not below that of the far plane: exhaustive_depth.c. */
void proof_w_of(void)
{
    const struct ph_quotient near = {u32_between(LEAST_Q, UINT32_MAX >> 1), (int8_t)i32_between(0, 31)};
    const struct ph_quotient far = {u32_between(LEAST_Q, UINT32_MAX >> 1), (int8_t)i32_between(near.s, 31)};
    ASSUME(near.s < far.s || near.q >= far.q);
    int shift;
    fx_rcp_norm(far.q >> 2, &shift);
    w_of(near, far.s + shift);
}

void proof_linear_of(void)
{
    const struct ph_lens lens = lens_of(PH_PERSPECTIVE);
    ph_depth_linear_of(&lens);
}

void proof_linear(void)
{
    struct ph_linear linear;
    linear.up = (uint8_t)u32_between(0, 31);
    linear.down = (int8_t)i32_between(-64, 64);
    ph_depth_linear(&linear, nondet_u32());
}
