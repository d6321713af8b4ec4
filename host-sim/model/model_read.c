/* See model_read.h. Chooses the reader by the file's name, counts triangles, and makes the model of the scene. */
#include "model_read.h"

#include "model_assimp.h"
#include "model_framing.h"
#include "model_gltf.h"
#include "model_meshes.h"
#include "model_obj.h"
#include "model_ply.h"
#include "model_rig.h"
#include "model_stl.h"
#include "model_studio.h"

/* Counts triangles after every node has its own copy of its meshes. */
static uint64_t count_triangles(const struct model_scene *scene)
{
    uint64_t count = 0;
    for (uint32_t i = scene->first_node; i != MODEL_NONE; i = model_scene_next(scene, i)) {
        for (uint32_t m = 0; m < scene->nodes[i].mesh_count; m++) {
            count += scene->meshes[scene->nodes[i].first_mesh + m].triangle_count;
        }
    }
    return count;
}

/* Turns what has z up: the root takes (x, y, z) to (x, z, -y). */
static void turn_up(const struct model_shared *shared, struct model_scene *scene, bool has_z_up)
{
    const char *up = shared->options.up;
    if (up != NULL ? *up == 'z' : has_z_up) {
        scene->root[1][1] = scene->root[2][2] = 0;
        scene->root[1][2] = 1;
        scene->root[2][1] = -1;
    }
}

static bool read_scene(struct model_shared *shared, struct model_scene *scene)
{
    static const struct {
        const char *ending;
        bool (*read)(struct model_shared *shared, struct model_scene *scene);
    } readers[] = {{".gltf", model_gltf_read},
                   {".glb", model_gltf_read},
                   {".obj", model_obj_read},
                   {".stl", model_stl_read},
                   {".ply", model_ply_read}};
    for (size_t i = 0; i < sizeof readers / sizeof readers[0]; i++) {
        if (model_shared_ends(shared, readers[i].ending)) {
            return readers[i].read(shared, scene);
        }
    }
    return model_assimp_read(shared, scene);
}

static bool make_model(struct model_shared *shared, struct model_scene *scene)
{
    const uint64_t count = count_triangles(scene);
    if (count == 0) {
        return model_shared_failed(shared, "has no triangles");
    }
    if (count > MODEL_TRIANGLES_MAX) {
        return model_shared_failed(shared, "has more than %u triangles, the limit", MODEL_TRIANGLES_MAX);
    }
    turn_up(shared, scene, model_shared_ends(shared, ".stl"));
    return model_rig_find(shared, scene) ? model_meshes_read(shared, scene)
                                         : model_shared_failed(shared, "needs too much memory");
}

bool model_read(struct model_shared *shared, const char *path)
{
    struct model_scene scene = {.root = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}, .first_node = MODEL_NONE};
    if (!model_surface_take_texture(shared)) {
        return false;
    }
    shared->folder = (struct model_folder){.model = path, .allow_outside = shared->options.allow_outside};
    const bool is_read = read_scene(shared, &scene) && make_model(shared, &scene);
    if (shared->folder.outside[0] != '\0') { /* the reader went on without it */
        return model_shared_failed(shared, "names %.120s, which is outside of its folder; --allow-outside reads it",
                                   shared->folder.outside);
    }
    if (is_read) {
        model_framing_check(shared);
        model_studio_make(shared);
    }
    return is_read;
}
