/* Animation: an arm plays a clip, goes over into another one, and its hand follows the program. */
#include "example.h"
#include "shapes.h"

#include <pinhole/fx_math.h>
#include <pinhole/motion.h>

enum { JOINTS = 4, HAND = JOINTS - 1 };

#define ONE PH_MOTION_ONE
#define NODE(parent, up)                                                                                               \
    {                                                                                                                  \
        parent,                                                                                                        \
        {                                                                                                              \
            {FX_Q30_ONE, 0, 0, 0}, {0, up, 0},                                                                         \
            {                                                                                                          \
                ONE, ONE, ONE                                                                                          \
            }                                                                                                          \
        }                                                                                                              \
    }
#define TRACK(node, keys)                                                                                              \
    {                                                                                                                  \
        node, PH_PATH_ROTATION, PH_KEYS_LINEAR, 4, 15, 3, times, keys[0]                                               \
    }

static const struct ph_rig_node nodes[JOINTS] = {NODE(-1, 0), NODE(0, ONE), NODE(1, ONE), NODE(2, ONE)};
static const struct ph_rig rig = {nodes, JOINTS};
static const fx_t times[] = {0, FX_INT(1), FX_INT(2)}; /* seconds */
static const int16_t bends[][4] = {{0, 0, 12000, 30000}, {0, 0, -12000, 30000}, {0, 0, 12000, 30000}},
                     nods[][4] = {{0, 0, 0, 32767}, {16000, 0, 0, 28000}, {0, 0, 0, 32767}};
static const struct ph_track waving[] = {TRACK(0, bends), TRACK(1, bends), TRACK(2, bends)},
                             bowing[] = {TRACK(0, nods), TRACK(2, nods)};
static const struct ph_clip wave = {"wave", waving, 3, FX_INT(2)}, bow = {"bow", bowing, 2, FX_INT(2)};

/* Finds where the joints are at a time: the arm waves, and between 0.5 s and 1.5 s it begins to bow. */
static void move(fx_t time, struct ph_xform places[JOINTS])
{
    struct ph_pose pose[JOINTS], other[JOINTS];

    ph_rig_rest(&rig, pose); /* what the clip does not move */
    ph_clip_sample(&wave, ph_clip_loop(&wave, time), pose, NULL);

    ph_rig_rest(&rig, other);
    ph_clip_sample(&bow, ph_clip_loop(&bow, time), other, NULL);
    ph_pose_blend(pose, other, JOINTS, fx_clamp(time - FX_HALF, 0, FX_ONE));

    const struct fx_vec3 up = {0, FX_ONE, 0};
    pose[HAND].r = fx_quat_axis(up, (uint32_t)time << 15); /* turns once in 2 s, whatever the clips say */
    pose[HAND].s = (struct fx_vec3){2 * ONE, ONE / 2, ONE};

    ph_rig_places(&rig, pose, &ph_xform_identity, places); /* positions in Q8.24 */
}

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape cube;
    static uint16_t ramp[PH_RAMP_SIZE];
    struct ph_xform places[JOINTS];
    move(FX_ONE * (fx_t)(frame % 1024) / 30, places);

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
