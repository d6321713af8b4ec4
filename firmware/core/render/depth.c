/* See depth.h. */
#include "depth.h"

unsigned ph_depth_choose_exponent(const struct ph_projection *projection)
{
    const int64_t near_z = projection->near_z;
    if (projection->kind == PH_ORTHOGRAPHIC || projection->far_z <= near_z * PH_DEPTH_EXPONENT3_RATIO) {
        return 3;
    }
    return projection->far_z <= near_z * PH_DEPTH_EXPONENT4_RATIO ? 4 : 5;
}

/* (f - z) / (f - n) as a quotient with s = 0, q = 0 .. 2^30 less the head room. */
PH_TIER(mesh) static struct ph_quotient ortho_quotient(const struct ph_lens *lens, fx_t z)
{
    const uint32_t behind_far = (uint32_t)lens->far_z - (uint32_t)z; /* z is between near and far */
    const uint32_t d = fx_mulhi_u32(behind_far << lens->near_shift, lens->depth_scale);
    return (struct ph_quotient){d - (d >> ph_depth_head(lens)), 0};
}

PH_TIER(mesh) struct ph_quotient ph_depth_quotient(const struct ph_lens *lens, fx_t w)
{
    if (lens->kind == PH_ORTHOGRAPHIC) {
        return ortho_quotient(lens, w);
    }
    int shift;
    const uint32_t reciprocal = fx_rcp_norm((uint32_t)w, &shift);
    return ph_depth_quotient_of(lens, reciprocal, shift);
}

uint32_t ph_depth_at(const struct ph_lens *lens, struct ph_quotient quotient, int block)
{
    return ph_depth_before(quotient, ph_depth_far(lens, block), block);
}

uint32_t ph_lens_near(const struct ph_projection *p, int *shift)
{
    const uint32_t n = (uint32_t)p->near_z, f = (uint32_t)p->far_z, least = f / 8 + 1;
    const int up = fx_clz32(n);
    const uint64_t scaled = fx_quotient_u64(fx_mul_wide_u(n << up, f), f - n > least ? f - n : least);
    const int down = 32 - fx_clz32((uint32_t)(scaled >> 32)); /* at most 3 */
    *shift = up - down;
    return (uint32_t)(scaled >> down);
}

/* w of a quotient. Its unit is the one in which w at the far plane is the plain reciprocal of the far plane's q. */
static uint32_t w_of(struct ph_quotient quotient, int far_down)
{
    int shift;
    const uint32_t reciprocal = fx_rcp_norm(quotient.q >> 2, &shift);
    const int down = far_down - quotient.s - shift;
    return down > 31 ? 0 : reciprocal >> down;
}

struct ph_linear ph_depth_linear_of(const struct ph_lens *lens)
{
    int shift, up;
    const uint32_t far =
        fx_rcp_norm(lens->far_q >> 2, &shift); /* shift is 3, or 4 if N / f falls just below a power of two */
    const int far_down = lens->far_s + shift;
    const uint32_t scale = fx_rcp_norm(far - w_of(ph_depth_quotient(lens, lens->near_z), far_down), &up);
    return (struct ph_linear){far, scale - (scale >> 9), (uint8_t)up, PH_DEPTH_BIAS_FIXED16 >> 16, (int8_t)far_down};
}

PH_TIER(seldom) uint32_t ph_depth_linear_code(const struct ph_linear *linear, uint32_t over_w)
{
    return ph_depth_linear(linear, over_w);
}
