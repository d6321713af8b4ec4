/* The animation of an asset, see asset_mesh.h; its size, see asset.h. */
#include "asset_mesh.h"

#include <string.h>

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
