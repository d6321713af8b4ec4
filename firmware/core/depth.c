/* Depth of a vertex: see depth.h. */
#include "depth.h"

size_t ph_depth_bytes(unsigned format)
{
    return format == PH_DEPTH_FIXED24 || format == PH_DEPTH_FLOAT24 ? sizeof(uint32_t) : sizeof(uint16_t);
}

enum ph_depth_format ph_depth_choose(const struct ph_projection *projection)
{
    if (projection->kind == PH_ORTHOGRAPHIC ||
        projection->far_z <= (int64_t)projection->near_z * PH_DEPTH_FIXED16_RATIO) {
        return PH_DEPTH_FIXED16;
    }
    return PH_DEPTH_FLOAT16;
}

/* (f - z) / (f - n) as a quotient with s = 0, q = 0 .. 2^30 (1 - 2^-9). */
static struct ph_quotient ortho_quotient(const struct ph_lens *lens, fx_t z)
{
    const uint32_t behind_far = (uint32_t)lens->far_z - (uint32_t)z; /* z is between near and far */
    const uint32_t d = fx_mulhi_u32(behind_far << lens->near_shift, lens->depth_scale);
    return (struct ph_quotient){d - (d >> 9), 0};
}

struct ph_quotient ph_depth_quotient(const struct ph_lens *lens, fx_t w)
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
    const int up = 2 + block - quotient.s, far_up = 2 + block - lens->far_s;
    const uint32_t at = up >= 0 ? quotient.q << up : quotient.q >> -up;
    const uint32_t far = far_up >= 0 ? lens->far_q << far_up : far_up > -32 ? lens->far_q >> -far_up : 0;
    return at > far ? at - far : 0;
}

int ph_depth_octave(uint32_t d, int block)
{
    const int zeros = fx_clz32(d);
    return zeros + block < 14 ? zeros : 14 - block;
}
