/* asset: makes the animation of an asset (asset_mesh.h), and counts its bytes (asset.h). */
#include "asset_mesh.h"

#include <string.h>

/* Bytes of the tables, on a 32-bit target. */
#define ANIMATION_BYTES      100
#define ANIMATION_MESH_BYTES 64
#define CLIP_BYTES           16
#define TRACK_BYTES          16

#define ROUND4(n) (((n) + 3) & ~(uint64_t)3)

/* Bytes of a vertex that moves, in flash. */
static size_t vertex_bytes(const struct animation_mesh *moving)
{
    const struct ph_morph *morph = &moving->morph;
    return sizeof(int16_t[3]) * (2 + morph->target_count * (morph->d_normals != NULL ? 2 : 1)) +
           (moving->bound.influences != NULL ? sizeof *moving->bound.influences : 0);
}

size_t asset_motion_room(const struct model *model, uint32_t triangles)
{
    const struct animation *a = model->motion != NULL ? &model->motion->animation : NULL;
    size_t most = 0, bytes = 0;
    for (uint32_t i = 0; a != NULL && i < a->mesh_count; i++) {
        const size_t n = vertex_bytes(&a->meshes[i]);
        most = n > most ? n : most;
        bytes += sizeof *a->meshes + 64;
    }
    return a != NULL ? bytes + sizeof *model->motion + 64 + most * 3 * triangles : 0;
}

bool asset_motion_begin(struct demo_arena *arena, const struct model *model, struct model *to)
{
    if (model->motion == NULL) {
        return true;
    }
    struct animation_mesh *meshes =
        demo_alloc(arena, sizeof *model->motion->animation.meshes * model->motion->animation.mesh_count);
    to->motion = demo_alloc(arena, sizeof *to->motion);
    if (meshes == NULL || to->motion == NULL) {
        return false;
    }
    *to->motion = *model->motion;
    to->motion->animation.meshes = meshes;
    to->motion->animation.mesh_count = 0;
    return true;
}

/* Things of `size` bytes: of each of `parts` lists of old_count those that the sources name. NULL: the arena is full.
 */
static void *pick(struct demo_arena *arena, const void *from, size_t size, const unsigned *sources, uint32_t count,
                  uint32_t parts, uint32_t old_count)
{
    uint8_t *to = demo_alloc(arena, size * count * parts);
    for (size_t i = 0; to != NULL && i < (size_t)count * parts; i++) {
        memcpy(to + i * size, (const uint8_t *)from + (i / count * old_count + sources[i % count]) * size, size);
    }
    return to;
}

bool asset_motion_add(struct demo_arena *arena, const struct animation_mesh *from, const unsigned *sources,
                      struct model *to, uint32_t mesh)
{
    struct animation *a = &to->motion->animation;
    struct animation_mesh *moving = (struct animation_mesh *)(uintptr_t)a->meshes + a->mesh_count;
    const uint32_t n = to->meshes[mesh].vertex_count, old = from->bound.vertex_count,
                   targets = from->morph.target_count;
    const void *influences = from->bound.influences, *d = from->morph.d_positions, *d_normals = from->morph.d_normals;
    *moving = *from;
    moving->mesh = mesh;
    moving->bound.vertex_count = moving->morph.vertex_count = n;
    moving->bound.positions = pick(arena, from->bound.positions, sizeof(int16_t[3]), sources, n, 1, old);
    moving->bound.normals = to->meshes[mesh].normals;
    moving->bound.influences =
        influences != NULL ? pick(arena, influences, sizeof(struct ph_influence), sources, n, 1, old) : NULL;
    moving->morph.positions = moving->bound.positions;
    moving->morph.normals = moving->bound.normals;
    moving->morph.d_positions = targets > 0 ? pick(arena, d, sizeof(int16_t[3]), sources, n, targets, old) : NULL;
    moving->morph.d_normals =
        d_normals != NULL ? pick(arena, d_normals, sizeof(int16_t[3]), sources, n, targets, old) : NULL;
    a->mesh_count++;
    return moving->bound.positions != NULL && (influences == NULL || moving->bound.influences != NULL) &&
           (targets == 0 || moving->morph.d_positions != NULL) &&
           (d_normals == NULL || moving->morph.d_normals != NULL);
}

uint32_t asset_first_skin(const struct animation *a, uint32_t i)
{
    const struct ph_skin *skin = &a->meshes[i].skin;
    uint32_t first = 0;
    while (a->meshes[first].skin.joint_count != skin->joint_count ||
           memcmp(a->meshes[first].skin.nodes, skin->nodes, skin->joint_count * sizeof *skin->nodes) != 0 ||
           memcmp(a->meshes[first].skin.inverse_bind, skin->inverse_bind,
                  skin->joint_count * sizeof *skin->inverse_bind) != 0) {
        first++;
    }
    return first;
}

uint32_t asset_first_times(const struct ph_clip *clip, uint32_t i)
{
    uint32_t first = 0;
    while (clip->tracks[first].times != clip->tracks[i].times ||
           clip->tracks[first].key_count != clip->tracks[i].key_count) {
        first++;
    }
    return first;
}

size_t asset_key_numbers(const struct ph_track *track)
{
    return (size_t)track->key_count * track->width * (track->interpolation == PH_KEYS_CUBIC ? 3 : 1);
}

uint64_t asset_motion_bytes(const struct model *model)
{
    const struct model_motion *m = model->motion;
    if (m == NULL) {
        return 0;
    }
    const struct animation *a = &m->animation;
    uint64_t bytes = ANIMATION_BYTES + a->rig.node_count * sizeof(struct ph_rig_node) +
                     (a->weight_count + 1) * sizeof(int32_t) + a->outline_count * sizeof(struct fx_vec3);
    for (uint32_t i = 0; i < a->mesh_count; i++) {
        const uint32_t joints = asset_first_skin(a, i) == i ? a->meshes[i].skin.joint_count : 0;
        bytes += ANIMATION_MESH_BYTES + ROUND4(joints * sizeof(uint16_t)) + joints * sizeof(struct ph_xform) +
                 (vertex_bytes(&a->meshes[i]) - 2 * sizeof(int16_t[3])) * a->meshes[i].bound.vertex_count;
    }
    for (uint32_t i = 0; i < m->animation.clip_count; i++) {
        const struct ph_clip *clip = &m->animation.clips[i];
        bytes += CLIP_BYTES + ROUND4(strlen(clip->name) + 1);
        for (uint32_t k = 0; k < clip->track_count; k++) {
            const struct ph_track *t = &clip->tracks[k];
            bytes += TRACK_BYTES + ROUND4(2 * asset_key_numbers(t)) +
                     (asset_first_times(clip, k) == k ? t->key_count * sizeof *t->times : 0);
        }
    }
    return bytes;
}
