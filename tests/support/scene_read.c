/* See scene_read.h. */
#include "scene_read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool scene_read(scene_reader reader, const char *path, struct model_shared **shared, struct model_scene **scene)
{
    static uint8_t arena[1 << 24];
    static struct model_shared a_shared;
    static struct model_scene a_scene;
    a_shared = (struct model_shared){.arena = {.base = arena, .size = sizeof arena}, .folder = {.model = path}};
    a_scene = (struct model_scene){.first_node = MODEL_NONE};
    memset(arena, 0, sizeof arena);
    *shared = &a_shared;
    *scene = &a_scene;
    return reader(&a_shared, &a_scene);
}

struct model_scene *scene_read_good(scene_reader reader, const char *path)
{
    struct model_shared *shared;
    struct model_scene *scene;
    if (!scene_read(reader, path, &shared, &scene) || shared->note[0] != '\0') {
        fail_msg("%s: %s%s", path, shared->error, shared->note);
    }
    return scene;
}

void scene_refuse(scene_reader reader, const char *path, const char *reason)
{
    struct model_shared *shared;
    struct model_scene *scene;
    if (scene_read(reader, path, &shared, &scene) || strstr(shared->error, reason) == NULL) {
        fail_msg("%s: wanted '%s', got '%s'", path, reason, shared->error);
    }
}

double scene_area_z(const struct model_mesh *mesh)
{
    double sum = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        const float *a = mesh->positions[mesh->triangles[t][0]], *b = mesh->positions[mesh->triangles[t][1]],
                    *c = mesh->positions[mesh->triangles[t][2]];
        sum += (double)((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
    }
    return sum;
}
