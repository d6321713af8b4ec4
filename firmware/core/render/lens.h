/*
 * lens: a projection in the form that vertices need. Private to firmware/core. Its functions are inline, so that a
 * renderer with one depth format has no code for others.
 */
#ifndef PH_LENS_H
#define PH_LENS_H

#include "depth_ways.h"
#include "edge.h"
#include "fisheye.h"

/* Principal point in 1/256 px: half the size, moved by shift halves; y counts downwards. */
static inline int32_t ph_lens_centre(int32_t size, fx_t shift)
{
    return (int32_t)((fx_mul_wide(size, FX_ONE + shift) + 256) >> 9);
}

/* Focal lengths as fractions of 2^focal_log2 px. That power also makes the guard band reach over the picture. */
static inline int ph_lens_focal(struct ph_lens *lens, const struct ph_projection *p, int32_t width, int32_t height)
{
    const int64_t fx = fx_mul_wide(p->scale_x_q20, width), fy = fx_mul_wide(p->scale_y_q20, height); /* px, Q21 */
    const int32_t guard = 2 * ph_max(width, height); /* px; with |shift| <= 2 no pixel is further away than 1.5 sizes */
    const int64_t longest = fx > fy ? fx : fy;
    int log2 = 0;
    int64_t most = (int64_t)1 << 21;
    for (int32_t reach = 4; log2 <= 18 && (most < longest || reach < guard); reach *= 2) {
        most *= 2;
        log2++;
    }
    if (log2 > 18) {
        return PH_ERR_RANGE;
    }
    lens->focal_log2 = (int8_t)log2;
    lens->guard_up = (uint8_t)(log2 > 8 ? log2 - 8 : 0);
    lens->focal_x = (int32_t)(fx * 512 >> log2);
    lens->focal_y = (int32_t)(fy * 512 >> log2);
    return PH_OK;
}

static inline void ph_lens_depth(struct ph_lens *lens, const struct ph_projection *p,
                                 const struct ph_depth_format *format)
{
    lens->near_z = p->near_z;
    lens->far_z = p->far_z;
    int shift = fx_clz32((uint32_t)p->near_z);
    if (p->kind == PH_ORTHOGRAPHIC) {
        lens->depth_scale = fx_rcp_norm((uint32_t)p->far_z - (uint32_t)p->near_z, &shift);
        lens->near_shift = (int8_t)shift;
        return; /* far_q stays 0: d is 0 at the far plane already */
    }
    const struct ph_depth_ways *const ways = format->ways;
    const uint32_t norm = ways->set_near != NULL ? ways->set_near(p, &shift) : (uint32_t)p->near_z << shift;
    lens->near_shift = (int8_t)shift;
    lens->depth_scale = norm - (norm >> ph_depth_head(lens));
    const struct ph_quotient far = ph_depth_quotient(lens, p->far_z);
    lens->far_q = far.q;
    lens->far_s = far.s;
    if (ways->linear_of != NULL) {
        lens->linear = ways->linear_of(lens);
    }
}

/* The lens of a projection for a picture of width x height pixels. format, exponent: as in ph_stats. Errors are those
 * of ph_frame_begin; then the lens is not to be used. */
static inline int ph_lens_of(struct ph_lens *lens, const struct ph_projection *p, int32_t width, int32_t height,
                             const struct ph_depth_format *format, unsigned exponent)
{
    if ((p->kind == PH_FISHEYE && p->curved == NULL) || p->far_z <= p->near_z ||
        (p->kind != PH_ORTHOGRAPHIC && p->near_z <= 0) || p->scale_x_q20 <= 0 || p->scale_y_q20 <= 0) {
        return PH_ERR_INVAL;
    }
    if (p->shift_x > 2 * FX_ONE || p->shift_x < -2 * FX_ONE || p->shift_y > 2 * FX_ONE || p->shift_y < -2 * FX_ONE) {
        return PH_ERR_RANGE;
    }
    *lens = (struct ph_lens){.kind = (uint8_t)p->kind, .float_down = (uint8_t)(exponent != 0 ? exponent - 1 : 3)};
    if (p->kind == PH_FISHEYE) {
        p->curved->set_lens(lens, p, height);
    } else if (ph_lens_focal(lens, p, width, height) != PH_OK) {
        return PH_ERR_RANGE;
    }
    lens->centre_x = ph_lens_centre(width, -p->shift_x);
    lens->centre_y = ph_lens_centre(height, p->shift_y);
    ph_lens_depth(lens, p, format);
    return PH_OK;
}

#endif
