/* See model_phs.h. */
#include "model_phs.h"

#include "complain.h"
#include "scene_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One block of memory: this, the bytes of the file, the arena of what is made of them. */
struct scene {
    struct model model;
    struct model_motion motion;
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

/* Makes the clips with their tracks, which the asset tool writes again. False: the arena is full. */
static bool make_clips(const struct scene_file_head *file, struct demo_arena *arena, struct animation *a)
{
    const struct scene_file_motion *motion = scene_file_at(file, file->motion);
    const struct scene_file_clip *from = scene_file_at(file, motion->clips);
    struct ph_clip *clips = demo_alloc(arena, sizeof *clips * a->clip_count);
    for (uint32_t i = 0; clips != NULL && i < a->clip_count; i++) {
        struct ph_track *tracks = demo_alloc(arena, sizeof *tracks * from[i].track_count);
        for (uint32_t k = 0; tracks != NULL && k < from[i].track_count; k++) {
            tracks[k] = scene_motion_track(file, &from[i], k);
        }
        if (tracks == NULL) {
            return false;
        }
        clips[i] = a->clips[i];
        clips[i].tracks = tracks;
    }
    a->clips = clips;
    a->clip = clips != NULL && a->clip_count > 0 ? &clips[motion->playing] : NULL;
    a->sample = NULL;
    return clips != NULL;
}

/* Makes the meshes in their bind pose, and all clips. False: the arena is full. */
static bool make_model(struct scene *scene, const struct scene_file_head *file)
{
    struct model *model = &scene->model;
    *model = (struct model){.meshes = scene_file_meshes(file, &scene->arena),
                            .mesh_count = file->mesh_count,
                            .has_camera = (file->flags & SCENE_FILE_CAMERA) != 0,
                            .camera = scene_file_eye(file),
                            .scene = file};
    if (file->motion == 0 || model->meshes == NULL) {
        return model->meshes != NULL;
    }
    const struct animation *animation = scene_motion_make(file, &scene->arena);
    const struct animation_stage *stage =
        animation != NULL ? animation_begin(&scene->arena, animation, model->meshes, model->mesh_count) : NULL;
    if (stage == NULL) {
        return false;
    }
    scene->motion = (struct model_motion){.animation = *animation};
    model->motion = &scene->motion;
    model->meshes = stage->meshes;
    return make_clips(file, &scene->arena, &scene->motion.animation);
}

int model_phs_open(struct model **model, const char *path)
{
    const size_t head = ROUND16(sizeof(struct scene));
    size_t n = 0;
    uint8_t *memory = read_behind(path, head, &n);
    const char *why = memory != NULL ? scene_file_wrong(memory + head, n) : NULL;
    if (memory == NULL || why != NULL) {
        free(memory);
        return memory == NULL ? COMPLAINED : complain("model %s: %s", path, why);
    }
    const size_t tables =
        8 * n + 4096; /* nothing becomes more than 8 times as long, but where things share their data */
    uint8_t *larger = realloc(memory, head + ROUND16(n) + tables);
    memory = larger != NULL ? larger : memory;
    struct scene *scene = (struct scene *)(void *)memory;
    scene->arena = (struct demo_arena){.base = memory + head + ROUND16(n), .size = larger != NULL ? tables : 0};
    if (!make_model(scene, (const void *)(memory + head))) {
        free(memory);
        return complain("model %s: not enough memory", path);
    }
    for (uint32_t m = 0; m < scene->model.mesh_count; m++) {
        const struct ph_mesh *mesh = &scene->model.meshes[m];
        scene->model.triangle_count += mesh->triangle_count;
        if (mesh->vertex_count > scene->model.vertex_max) {
            scene->model.vertex_max = mesh->vertex_count;
        }
    }
    *model = &scene->model;
    return 0;
}
