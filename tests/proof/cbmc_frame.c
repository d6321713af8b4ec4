/* The lens of a frame: no overflow and no bad shift from any projection, and the ranges that later stages count on. */
#include "proof_render.h"

#include "../../firmware/core/render/frame.c"

void proof_camera(void)
{
    struct ph_renderer r;
    struct ph_projection p;
    struct ph_xform view;
    r.config.width = (uint16_t)u32_between(1, 1024);
    r.config.height = (uint16_t)u32_between(1, 1024);
    r.stats.depth_exponent = (uint8_t)u32_between(0, 6);
    ASSUME(r.stats.depth_exponent == 0 || r.stats.depth_exponent >= 3);
    r.stats.depth_format = ph_depth_formats[u32_between(1, PH_DEPTH_FORMATS - 1)];
    p.kind = u32_between(PH_PERSPECTIVE, PH_ORTHOGRAPHIC);
    if (ph_frame_camera(&r, &view, &p) == PH_OK) {
        const struct ph_lens *lens = &r.lens;
        CLAIM(lens->focal_log2 >= 0 && lens->focal_log2 <= 18);
        CLAIM(lens->guard_up == (lens->focal_log2 > 8 ? lens->focal_log2 - 8 : 0));
        CLAIM(lens->centre_x >= -512 * 256 && lens->centre_x <= 1536 * 256);
        CLAIM(lens->centre_y >= -512 * 256 && lens->centre_y <= 1536 * 256);
        CLAIM(lens->focal_x >= 0 && lens->focal_y >= 0);
        CLAIM(lens->float_down >= 2 && lens->float_down <= 5);
        CLAIM(lens->near_z < lens->far_z);
    }
}
