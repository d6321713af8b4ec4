/* See sim_fisheye.h. */
#include "sim_fisheye.h"

#include "lens.h"

bool sim_fisheye_place(const struct ph_projection *p, uint16_t width, uint16_t height, struct fx_vec3 camera,
                       struct sim_fisheye *out)
{
    struct ph_lens lens;
    struct ph_vertex v = {.code = 0};
    if (ph_lens_of(&lens, p, width, height, PH_DEPTH_FIXED16, 0) != PH_OK) {
        return false;
    }
    p->curved->place_curved(&lens, camera.x, fx_neg_sat(camera.y), fx_neg_sat(camera.z), &v);
    if (v.code != 0) {
        return false;
    }
    *out = (struct sim_fisheye){v.x * 256, v.y * 256, lens.centre_x * 256, lens.centre_y * 256, lens.radian_px};
    return true;
}
