/*
 * skin: what a model that moves costs before it is drawn: one line a row, `NAME - frame COUNT INSTRUCTIONS`, for so
 * many vertices or nodes (run.sh with PROGRAM=skin, skin.sh). The pose is that of the figure that walks (figure.h).
 */
#include "bench.h"
#include "figure.h"
#include "motion.h"

#define VERTICES 992 /* rings of 31, as the walker of 4,774 triangles has them */
#define RING     31
#define JOINTS   4

static int16_t positions[VERTICES][3], normals[VERTICES][3], skinned_normals[VERTICES][3];
static struct ph_influence influences[VERTICES];
static struct fx_vec3 skinned[VERTICES];
static struct ph_xform places[FIGURE_NODES];

/* Each ring follows two joints by shares of its own; `every`: so many vertices have the same. */
static void set_influences(uint32_t every, uint32_t joints)
{
    for (uint32_t i = 0; i < VERTICES; i++) {
        const uint32_t n = i / every;
        const uint16_t share = joints == 1 ? PH_INFLUENCE_ONE : (uint16_t)(16384 + n * 97 % 16000);
        influences[i] = (struct ph_influence){{(uint8_t)(n % JOINTS), (uint8_t)((n + 1) % JOINTS)},
                                              {share, (uint16_t)(PH_INFLUENCE_ONE - share)}};
    }
}

static void pose(const struct figure_gait *gait)
{
    struct ph_pose pose[FIGURE_NODES];
    ph_rig_rest(&figure_rig, pose);
    ph_clip_sample(&gait->clip, FX_ONE / 3, pose, NULL);
    ph_rig_places(&figure_rig, pose, &ph_xform_identity, places);
}

static void skin(const char *name, uint32_t every, uint32_t joints, bool scales_axes)
{
    const struct ph_bound bound = {positions, normals, influences, VERTICES, 14, scales_axes};
    const char *const what[3] = {name, "-", "frame"};
    set_influences(every, joints);
    machine_start();
    ph_skin_mesh(NULL, &bound, places, skinned, skinned_normals);
    machine_stop(what, VERTICES);
}

int main(void)
{
    static const char *const loop[3] = {"known-loop", "-", "-"}, *const nodes[3] = {"pose", "-", "frame"};
    static struct figure_gait gait;
    machine_start();
    machine_known_loop();
    machine_stop(loop, 0);
    for (uint32_t i = 0; i < 3 * VERTICES; i++) {
        positions[i / 3][i % 3] = (int16_t)(i * 5113);
        normals[i / 3][i % 3] = (int16_t)(i * 4001 % 9459);
    }
    figure_make_gait(&gait, 0);
    machine_start();
    pose(&gait);
    machine_stop(nodes, FIGURE_NODES);
    skin("one", RING, 1, false);
    skin("two", RING, 2, false);
    skin("two-each", 1, 2, false);
    skin("axes", RING, 2, true);
    return 0;
}
