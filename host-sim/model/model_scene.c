#include "model_scene.h"

#include "complain.h"
#include "scene_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One block of memory: this, the arena of the meshes, the bytes of the file. */
struct scene {
    struct model model;
    struct demo_arena arena;
};

#define ROUND16(n) (((n) + 15) & ~(size_t)15)

/* Reads the whole file behind `before` bytes. NULL, after complaining. */
static uint8_t *read_behind(const char *path, size_t before, size_t *n)
{
    FILE *file = fopen(path, "rb");
    const long size = file != NULL && fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    if (size < 0 || size > (long)MODEL_FILE_MAX) {
        complain("model %s: %s", path, size < 0 ? strerror(errno) : "is too large");
        if (file != NULL) {
            fclose(file);
        }
        return NULL;
    }
    uint8_t *memory = calloc(1, before + (size_t)size);
    const bool is_whole = memory != NULL && fseek(file, 0, SEEK_SET) == 0 &&
                          fread(memory + before, 1, (size_t)size, file) == (size_t)size;
    fclose(file);
    if (!is_whole) {
        complain("model %s: cannot be read, or not enough memory", path);
        free(memory);
        return NULL;
    }
    *n = (size_t)size;
    return memory;
}

int model_scene_open(struct model **model, const char *path)
{
    const size_t meshes_most =
        SCENE_FILE_MESHES * (sizeof(struct ph_mesh) + sizeof(struct ph_part) + sizeof(struct ph_material) +
                             sizeof(struct ph_blend) + 2 * sizeof(struct ph_texture) + 16);
    const size_t head = ROUND16(sizeof(struct scene)), before = head + ROUND16(meshes_most);
    size_t n = 0;
    uint8_t *memory = read_behind(path, before, &n);
    const char *why = memory != NULL ? scene_file_wrong(memory + before, n) : NULL;
    if (memory == NULL || why != NULL) {
        free(memory);
        return memory == NULL ? COMPLAINED : complain("model %s: %s", path, why);
    }
    struct scene *scene = (struct scene *)(void *)memory;
    const struct scene_file_head *file = (const void *)(memory + before);
    scene->arena = (struct demo_arena){.base = memory + head, .size = before - head};
    scene->model = (struct model){.meshes = scene_file_meshes(file, &scene->arena),
                                  .mesh_count = file->mesh_count,
                                  .has_camera = (file->flags & SCENE_FILE_CAMERA) != 0,
                                  .camera = scene_file_eye(file),
                                  .scene = file};
    for (uint32_t m = 0; m < file->mesh_count; m++) {
        const struct ph_mesh *mesh = &scene->model.meshes[m];
        scene->model.triangle_count += mesh->triangle_count;
        if (mesh->vertex_count > scene->model.vertex_max) {
            scene->model.vertex_max = mesh->vertex_count;
        }
    }
    *model = &scene->model;
    return 0;
}
