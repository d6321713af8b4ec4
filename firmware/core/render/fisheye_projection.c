/* The projection that names the fisheye: a program that calls ph_projection_fisheye links it. See geom.h, fisheye.h. */
#include "fisheye.h"
#include "sphere.h"

static const struct ph_curved_lens fisheye = {.set_lens = ph_fisheye_lens,
                                              .place_curved = ph_fisheye_vertex,
                                              .is_straight = ph_fisheye_is_small,
                                              .misses_picture = ph_fisheye_misses,
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

/*
 * Whether a sphere lies off the picture. All that is in the picture lies in a cone around the view direction,
 * which goes through the corner that is the farthest from the centre; if its angle t is over a quarter turn, all behind
 * the cone's other side. Either way a point (across, w), off the axis and along it, is at least across cos t - w sin t
 * away from what is seen. See bounds.h.
 */
#define BLIND 195297 /* 2.98 radian, Q16.16: a little more than the 170 degrees behind which nothing is drawn */

/* The angle of the cone, Q16.16 turns. Pieces of curves are straight lines: less than 1/64 and 4 px inside of them. */
static fx_t cone_of(const struct ph_renderer *r)
{
    const struct ph_lens *const lens = &r->lens;
    const int32_t right = r->config.width * 256 - lens->centre_x, below = r->config.height * 256 - lens->centre_y;
    const uint32_t corner = ph_hypot_above((uint32_t)(right > lens->centre_x ? right : lens->centre_x),
                                           (uint32_t)(below > lens->centre_y ? below : lens->centre_y));
    const fx_t radians = fx_div_sat((fx_t)((corner + corner / 64 + 4 * 256) * 256), lens->radian_px);
    return (fx_t)((uint32_t)(radians < BLIND ? radians : BLIND) * 10431 >> 16) + 2; /* 10431 > 65536 / (2 pi) */
}

bool ph_fisheye_misses_sphere(const struct ph_renderer *r, int32_t x, int32_t y, int32_t w, int32_t radius)
{
    const uint32_t a = fx_magnitude(x), b = fx_magnitude(y), c = fx_magnitude(w), most = a > b ? a : b;
    if (a + b + c + (uint32_t)radius < (uint32_t)r->lens.near_z ||
        (most > c ? most : c) > (uint32_t)r->lens.far_z + (uint32_t)radius) {
        return true;
    }
    const fx_t cone = cone_of(r), cosine = fx_cos(cone), sine = fx_sin(cone);
    const uint32_t mean = ((a + b) >> 8) * 181; /* 181/256 < sqrt 1/2 */
    const uint32_t across = cosine < 0 ? ph_hypot_above(a, b) : mean > most ? mean : most;
    const int64_t apart = (fx_mul_wide((int32_t)across, cosine) - fx_mul_wide(w, sine)) >> 16;
    return apart > (int64_t)radius + ((a + b + c) >> 16) + 2;
}
