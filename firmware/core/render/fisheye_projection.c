/* The projection that names the fisheye: a program that calls ph_projection_fisheye links it. See geom.h, fisheye.h. */
#include "fisheye.h"

static const struct ph_curved_lens fisheye = {.set_lens = ph_fisheye_lens,
                                              .place_curved = ph_fisheye_vertex,
                                              .is_straight = ph_fisheye_is_small,
                                              .misses_picture = ph_fisheye_misses,
                                              .misses_sphere = ph_fisheye_misses_sphere,
                                              .draw_curved = ph_fisheye_triangle,
                                              .draw_curved_line = ph_fisheye_line};

int ph_projection_fisheye(struct ph_projection *p, fx_t fov_deg, fx_t near_z, fx_t far_z)
{
    if (fov_deg < FX_INT(10) || fov_deg > FX_INT(240) || near_z <= 0 || far_z <= near_z) {
        return PH_ERR_INVAL;
    }
    /* 360 / pi in Q16.16: half heights per radian are 2 / fov; rounded to nearest */
    const int32_t scale = (int32_t)((((int64_t)7509872 << 20) + fov_deg / 2) / fov_deg);
    *p = (struct ph_projection){PH_FISHEYE, scale, scale, 0, 0, near_z, far_z, &fisheye};
    return PH_OK;
}
