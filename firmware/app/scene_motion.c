/* See scene_motion.h. Clips, skins and morph targets of a scene are checked here, and then used where they lie. */
#include "scene_motion.h"

#include <string.h>

#define ROUND8(n) (((n) + 7) & ~(size_t)7)

#define NODES_MAX   INT16_MAX
#define JOINTS_MAX  256u
#define TARGETS_MAX 256u

/* The structs of motion.h lie in a scene as they are in memory. */
_Static_assert(sizeof(struct ph_rig_node) == 44, "a node has another size in a binary scene");
_Static_assert(sizeof(struct ph_xform) == 48, "a matrix has another size in a binary scene");
_Static_assert(sizeof(struct ph_influence) == 12, "an influence has another size in a binary scene");

/* ---- is it right? ----------------------------------------------------------------------------------------------- */

static bool is_track_right(const struct scene_file_head *head, const struct scene_file_motion *motion,
                           const struct scene_file_track *t)
{
    static const uint8_t widths[] = {
        [PH_PATH_TRANSLATION] = 3, [PH_PATH_ROTATION] = 4, [PH_PATH_SCALE] = 3, [PH_PATH_WEIGHTS] = 0};
    const uint32_t parts = t->interpolation == PH_KEYS_CUBIC ? 3 : 1;
    return t->path <= PH_PATH_WEIGHTS && t->interpolation <= PH_KEYS_CUBIC && t->frac >= 8 && t->frac <= 24 &&
           (t->path == PH_PATH_WEIGHTS ? (uint32_t)t->node + t->width <= motion->weight_count
                                       : t->node < motion->node_count && t->width == widths[t->path]) &&
           scene_file_inside(head, t->times, t->key_count, sizeof(fx_t)) &&
           scene_file_inside(head, t->keys, t->key_count * parts * t->width, sizeof(int16_t));
}

static bool is_clip_right(const struct scene_file_head *head, const struct scene_file_motion *motion,
                          const struct scene_file_clip *clip)
{
    const struct scene_file_track *const tracks = scene_file_at(head, clip->tracks);
    bool right = clip->name[SCENE_FILE_NAME - 1] == '\0' && clip->duration >= 0 &&
                 scene_file_inside(head, clip->tracks, clip->track_count, sizeof(*tracks));
    for (uint32_t i = 0; right && i < clip->track_count; i++) {
        right = is_track_right(head, motion, &tracks[i]);
    }
    return right;
}

static bool are_nodes_right(const struct scene_file_head *head, const struct scene_file_motion *motion)
{
    const struct ph_rig_node *const nodes = scene_file_at(head, motion->nodes);
    bool right = motion->node_count <= NODES_MAX &&
                 scene_file_inside(head, motion->nodes, motion->node_count, sizeof(*nodes)) &&
                 scene_file_inside(head, motion->rest_weights, motion->weight_count, sizeof(int32_t));
    for (uint32_t i = 0; right && i < motion->node_count; i++) {
        right = nodes[i].parent >= -1 && nodes[i].parent < (int32_t)i;
    }
    return right;
}

static bool are_joints_right(const struct scene_file_head *head, const struct scene_file_motion *motion,
                             const struct scene_file_mesh *mesh, const struct scene_file_moving *moving)
{
    const uint16_t *const joints = scene_file_at(head, moving->joints);
    const struct ph_influence *const influences = scene_file_at(head, moving->influences);
    bool right = moving->joint_count > 0 && moving->joint_count <= JOINTS_MAX &&
                 scene_file_inside(head, moving->joints, moving->joint_count, sizeof(*joints)) &&
                 scene_file_inside(head, moving->inverse_bind, moving->joint_count, sizeof(struct ph_xform)) &&
                 (!influences || scene_file_inside(head, moving->influences, mesh->vertex_count, sizeof(*influences)));
    for (uint32_t i = 0; right && i < moving->joint_count; i++) {
        right = joints[i] < motion->node_count;
    }
    for (uint32_t i = 0; right && influences && i < mesh->vertex_count; i++) {
        const uint8_t *const j = influences[i].joints;
        right = j[0] < moving->joint_count && j[1] < moving->joint_count && j[2] < moving->joint_count &&
                j[3] < moving->joint_count;
    }
    return right;
}

static bool is_moving_right(const struct scene_file_head *head, const struct scene_file_motion *motion,
                            const struct scene_file_mesh *mesh)
{
    const struct scene_file_moving *const moving = scene_file_at(head, mesh->moving);
    if (!motion || !scene_file_inside(head, mesh->moving, 1, sizeof(*moving)) || moving->frac < 12 ||
        moving->frac > 24 || moving->scales_axes > 1 || moving->spare != 0 || moving->target_count > TARGETS_MAX ||
        moving->first_weight > motion->weight_count ||
        moving->target_count > motion->weight_count - moving->first_weight) {
        return false;
    }
    const uint32_t n = moving->target_count * mesh->vertex_count; /* at most 2^8 2^16 */
    return are_joints_right(head, motion, mesh, moving) &&
           (n == 0 || scene_file_inside(head, moving->targets, n, sizeof(int16_t[3]))) &&
           (moving->target_normals == 0 || scene_file_inside(head, moving->target_normals, n, sizeof(int16_t[3])));
}

bool scene_motion_right(const struct scene_file_head *head)
{
    const struct scene_file_motion *const motion = scene_file_at(head, head->motion);
    if (motion && (!scene_file_inside(head, head->motion, 1, sizeof(*motion)) || !are_nodes_right(head, motion) ||
                   !scene_file_inside(head, motion->clips, motion->clip_count, sizeof(struct scene_file_clip)) ||
                   !scene_file_inside(head, motion->outline, motion->outline_count, sizeof(struct fx_vec3)) ||
                   (motion->clip_count > 0 && motion->playing >= motion->clip_count) || motion->cross_fade < 0)) {
        return false;
    }
    for (uint32_t i = 0; motion && i < motion->clip_count; i++) {
        if (!is_clip_right(head, motion, (const struct scene_file_clip *)scene_file_at(head, motion->clips) + i)) {
            return false;
        }
    }
    for (uint32_t i = 0; i < head->mesh_count; i++) {
        const struct scene_file_mesh *const mesh = &scene_file_table(head)[i];
        if (mesh->moving != 0 && !is_moving_right(head, motion, mesh)) {
            return false;
        }
    }
    return true;
}

/* ---- can it be meant? -------------------------------------------------------------------------------------------- */

static bool do_times_rise(const struct scene_file_head *head, const struct scene_file_clip *clip)
{
    const struct scene_file_track *const tracks = scene_file_at(head, clip->tracks);
    for (uint32_t i = 0; i < clip->track_count; i++) {
        const fx_t *const times = scene_file_at(head, tracks[i].times);
        for (uint32_t k = 1; k < tracks[i].key_count; k++) {
            if (times[k] < times[k - 1]) {
                return false;
            }
        }
    }
    return true;
}

/* Whether a quaternion has length one, to 1/64. */
static bool has_length_one(const struct fx_quat *q)
{
    const int32_t parts[4] = {q->w, q->x, q->y, q->z};
    const int64_t one = (int64_t)1 << 32;
    int64_t sum = 0;
    for (uint32_t i = 0; i < 4; i++) {
        sum += (int64_t)(parts[i] >> 14) * (parts[i] >> 14);
    }
    return sum >= one - (one >> 6) && sum <= one + (one >> 6);
}

static bool do_shares_sum_to_one(const struct scene_file_head *head, const struct scene_file_mesh *mesh)
{
    const struct scene_file_moving *const moving = scene_file_at(head, mesh->moving);
    const struct ph_influence *const influences = moving ? scene_file_at(head, moving->influences) : NULL;
    for (uint32_t i = 0; influences && i < mesh->vertex_count; i++) {
        const uint16_t *const w = influences[i].weights;
        if ((uint32_t)w[0] + w[1] + w[2] + w[3] != PH_INFLUENCE_ONE) {
            return false;
        }
    }
    return true;
}

bool scene_motion_can_move(const struct scene_file_head *head)
{
    const struct scene_file_motion *const motion = scene_file_at(head, head->motion);
    const struct ph_rig_node *const nodes = motion ? scene_file_at(head, motion->nodes) : NULL;
    const struct scene_file_clip *const clips = motion ? scene_file_at(head, motion->clips) : NULL;
    bool right = true;
    for (uint32_t i = 0; motion && right && i < motion->node_count; i++) {
        right = has_length_one(&nodes[i].rest.r);
    }
    for (uint32_t i = 0; motion && right && i < motion->clip_count; i++) {
        right = do_times_rise(head, &clips[i]);
    }
    for (uint32_t i = 0; right && i < head->mesh_count; i++) {
        right = do_shares_sum_to_one(head, &scene_file_table(head)[i]);
    }
    return right;
}

/* ---- what motion.h takes ---------------------------------------------------------------------------------------- */

static struct animation_mesh moving_of(const struct scene_file_head *head, uint32_t i)
{
    const struct scene_file_mesh *const m = &scene_file_table(head)[i];
    const struct scene_file_moving *const from = scene_file_at(head, m->moving);
    const struct ph_bound bound = {.positions = scene_file_at(head, m->positions),
                                   .normals = scene_file_at(head, m->normals),
                                   .influences = scene_file_at(head, from->influences),
                                   .vertex_count = m->vertex_count,
                                   .frac = from->frac,
                                   .scales_axes = from->scales_axes};
    return (struct animation_mesh){
        .mesh = i,
        .bound = bound,
        .skin = {scene_file_at(head, from->joints), scene_file_at(head, from->inverse_bind), from->joint_count},
        .morph = {bound.positions, bound.normals, scene_file_at(head, from->targets),
                  scene_file_at(head, from->target_normals), m->vertex_count, from->target_count},
        .first_weight = from->first_weight};
}

struct ph_track scene_motion_track(const struct scene_file_head *head, const struct scene_file_clip *clip, uint32_t i)
{
    const struct scene_file_track *const t = (const struct scene_file_track *)scene_file_at(head, clip->tracks) + i;
    return (struct ph_track){t->node,
                             t->path,
                             t->interpolation,
                             t->width,
                             t->frac,
                             t->key_count,
                             scene_file_at(head, t->times),
                             scene_file_at(head, t->keys)};
}

void scene_motion_play(struct scene_file_head *head, uint32_t i)
{
    ((struct scene_file_motion *)(void *)((uint8_t *)head + head->motion))->playing = i;
}

static struct animation animation_of(const struct scene_file_head *head, const struct scene_file_motion *motion)
{
    struct animation a = {.rig = {scene_file_at(head, motion->nodes), motion->node_count},
                          .root = {.t = {motion->t[0], motion->t[1], motion->t[2]}},
                          .weight_count = motion->weight_count,
                          .rest_weights = scene_file_at(head, motion->rest_weights),
                          .outline = scene_file_at(head, motion->outline),
                          .outline_count = motion->outline_count,
                          .clip_count = motion->clip_count,
                          .cross_fade = motion->cross_fade,
                          .in_turn = (head->flags & SCENE_FILE_IN_TURN) != 0};
    memcpy(a.root.r, motion->r, sizeof(a.root.r));
    for (uint32_t i = 0; i < head->mesh_count; i++) {
        a.mesh_count += scene_file_table(head)[i].moving != 0;
    }
    return a;
}

/* What scene_motion_make() makes in an arena. */
struct tables {
    struct animation animation;
    const struct scene_file_head *head;
};

#define TABLES_BYTES_32 108
#define MESH_BYTES_32   64
#define CLIP_BYTES_32   16
_Static_assert(sizeof(void *) > 4 || sizeof(struct tables) == TABLES_BYTES_32, "TABLES_BYTES_32 is wrong");
_Static_assert(sizeof(void *) > 4 || sizeof(struct animation_mesh) == MESH_BYTES_32, "MESH_BYTES_32 is wrong");
_Static_assert(sizeof(void *) > 4 || sizeof(struct ph_clip) == CLIP_BYTES_32, "CLIP_BYTES_32 is wrong");

/* Samples a clip by tracks that are made one by one: all of a scene's would take more RAM than its triangles. */
static void sample(const struct animation *a, const struct ph_clip *clip, fx_t time, struct ph_pose *pose,
                   int32_t *weights) /* called as sample */
{
    const struct scene_file_head *const head = ((const struct tables *)(const void *)a)->head; /* its first member */
    const struct scene_file_motion *const motion = scene_file_at(head, head->motion);
    const struct scene_file_clip *const clips = scene_file_at(head, motion->clips);
    for (uint32_t i = 0; i < clip->track_count; i++) {
        const struct ph_track track = scene_motion_track(head, &clips[clip - a->clips], i);
        ph_clip_sample(&(const struct ph_clip){.tracks = &track, .track_count = 1}, time, pose, weights);
    }
}

const struct animation *scene_motion_make(const struct scene_file_head *head, struct demo_arena *arena)
{
    const struct scene_file_motion *const motion = scene_file_at(head, head->motion);
    const struct scene_file_clip *const from = scene_file_at(head, motion->clips);
    const struct animation a = animation_of(head, motion);
    struct tables *const tables = demo_alloc(arena, sizeof(*tables));
    struct animation_mesh *const meshes = demo_alloc(arena, a.mesh_count * sizeof(*meshes));
    struct ph_clip *const clips = demo_alloc(arena, a.clip_count * sizeof(*clips));
    if (!tables || !meshes || !clips) {
        return NULL;
    }
    for (uint32_t i = 0; i < a.clip_count; i++) {
        clips[i] =
            (struct ph_clip){.name = from[i].name, .track_count = from[i].track_count, .duration = from[i].duration};
    }
    *tables = (struct tables){a, head};
    tables->animation.clip = a.clip_count > 0 ? &clips[motion->playing] : NULL;
    tables->animation.clips = clips;
    tables->animation.sample = sample;
    tables->animation.meshes = meshes;
    for (uint32_t i = 0, n = 0; i < head->mesh_count; i++) {
        if (scene_file_table(head)[i].moving != 0) {
            meshes[n++] = moving_of(head, i);
        }
    }
    return &tables->animation;
}

size_t scene_motion_table_bytes(uint32_t mesh_count, uint32_t clip_count, bool on_32)
{
    return ROUND8(on_32 ? TABLES_BYTES_32 : sizeof(struct tables)) +
           ROUND8(mesh_count * (on_32 ? MESH_BYTES_32 : sizeof(struct animation_mesh))) +
           ROUND8(clip_count * (on_32 ? CLIP_BYTES_32 : sizeof(struct ph_clip)));
}

size_t scene_motion_bytes(const struct scene_file_head *head, bool on_32)
{
    const struct scene_file_motion *const motion = scene_file_at(head, head->motion);
    if (!motion) {
        return 0;
    }
    const struct animation a = animation_of(head, motion);
    struct animation_need need = {0};
    for (uint32_t i = 0; i < head->mesh_count; i++) {
        if (scene_file_table(head)[i].moving != 0) {
            const struct animation_mesh mesh = moving_of(head, i);
            animation_add(&need, &mesh);
        }
    }
    return scene_motion_table_bytes(a.mesh_count, a.clip_count, on_32) +
           animation_bytes(&need, &a, head->mesh_count, on_32);
}
