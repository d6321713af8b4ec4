#include "model.h"
#include "scene_file.h"

#include <string.h>

bool model_play(struct model *model, const char *name)
{
    struct model_motion *const m = model->motion;
    for (uint32_t i = 0; m != NULL && i < m->clip_count; i++) {
        if (strcmp(m->clips[i].name, name) == 0) {
            m->animation.clip = &m->clips[i];
            if (model->scene != NULL) {
                scene_file_play((void *)(uintptr_t)model->scene, i); /* the model's own copy */
            }
            return true;
        }
    }
    return false;
}

const struct animation_mesh *model_moving(const struct model *model, uint32_t mesh)
{
    const struct model_motion *const m = model->motion;
    for (uint32_t i = 0; m != NULL && i < m->animation.mesh_count; i++) {
        if (m->animation.meshes[i].mesh == mesh) {
            return &m->animation.meshes[i];
        }
    }
    return NULL;
}
