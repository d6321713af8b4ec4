/*
 * Whether a sphere lies off a fisheye's picture. All that is in the picture lies in a cone around the view direction,
 * which goes through the corner that is the farthest from the centre; if its angle t is over a quarter turn, all behind
 * the cone's other side. Either way a point (across, w), off the axis and along it, is at least across cos t - w sin t
 * away from what is seen. See bounds.h, fisheye.h.
 */
#include "fisheye.h"
#include "sphere.h"

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
