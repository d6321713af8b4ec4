/* Animation: a clip of keys moves the joints of an arm, sampled at any time. */
#include "example.h"
#include "shapes.h"

#include <pinhole/motion.h>

enum { JOINTS = 4 };

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape cube;
    static uint16_t ramp[PH_RAMP_SIZE];
    static const fx_t times[] = {0, FX_INT(1), FX_INT(2)}; /* seconds */
    static const int16_t bends[][4] = {{0, 0, 12000, 30000}, {0, 0, -12000, 30000}, {0, 0, 12000, 30000}};
    static const struct fx_quat upright = {FX_Q30_ONE, 0, 0, 0};
    struct ph_track tracks[JOINTS];
    struct ph_rig_node nodes[JOINTS];
    for (int16_t i = 0; i < JOINTS; i++) {
        const struct ph_pose rest = {
            .r = upright, .t = {0, i == 0 ? 0 : PH_MOTION_ONE, 0}, .s = {PH_MOTION_ONE, PH_MOTION_ONE, PH_MOTION_ONE}};
        nodes[i] = (struct ph_rig_node){.parent = (int16_t)(i - 1), .rest = rest};
        tracks[i] = (struct ph_track){.node = (uint16_t)i,
                                      .path = PH_PATH_ROTATION,
                                      .interpolation = PH_KEYS_LINEAR,
                                      .width = 4,
                                      .frac = 15,
                                      .key_count = 3,
                                      .times = times,
                                      .keys = &bends[0][0]};
    }
    const struct ph_rig rig = {nodes, JOINTS};
    const struct ph_clip clip = {"wave", tracks, JOINTS, FX_INT(2)};
    struct ph_pose pose[JOINTS];
    struct ph_xform places[JOINTS];
    ph_rig_rest(&rig, pose);
    ph_clip_sample(&clip, ph_clip_loop(&clip, FX_ONE * (fx_t)(frame % 1024) / 30), pose, NULL);
    ph_rig_places(&rig, pose, &ph_xform_identity, places);

    const struct ph_material material = shape_lit(ramp, 120, 200, 120);
    const struct ph_mesh mesh = shape_cube(&cube, &material);
    int status = example_look(r, (struct fx_vec3){0, FX_INT(2), FX_INT(5)}, (struct fx_vec3){0, FX_ONE * 3 / 2, 0},
                              &shapes_daylight, ph_rgb565(40, 36, 50));
    for (int i = 0; i < JOINTS && status == 0; i++) {
        const struct ph_xform small = ph_xform_scale(FX_ONE * 2 / 5);
        struct ph_xform place = places[i];
        place.t = (struct fx_vec3){place.t.x >> 8, place.t.y >> 8, place.t.z >> 8}; /* Q8.24 to Q16.16 */
        place = ph_xform_mul(&place, &small);
        status = ph_draw_mesh(r, &mesh, &place);
    }
    return status;
}

int main(int argc, char *argv[])
{
    const struct ph_config config = example_config();
    return example_run(argc, argv, &config, draw);
}
