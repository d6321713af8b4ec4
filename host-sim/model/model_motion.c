/* model: chooses the clip that --clip names, and finds what moves a mesh (model.h). */
#include "complain.h"
#include "model.h"
#include "nearest.h"
#include "scene_file.h"

#include <stdio.h>
#include <string.h>

static const char *clip_name(const void *from, size_t i)
{
    const struct model_motion *motion = from;
    return motion != NULL && i < motion->animation.clip_count ? motion->animation.clips[i].name : NULL;
}

static int refuse(const struct model_motion *motion, const char *name)
{
    char list[200] = "";
    for (size_t i = 0, used = 0; clip_name(motion, i) != NULL && used < sizeof list; i++) {
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", i > 0 ? ", " : "", clip_name(motion, i));
    }
    return complain_usage("--clip '%s': the model has no such clip; %sit has %s", name,
                          nearest_text(name, clip_name, motion), list[0] != '\0' ? list : "none");
}

uint32_t model_clip_frames(const struct model *model)
{
    const struct ph_clip *clip = model->motion != NULL ? model->motion->animation.clip : NULL;
    return clip != NULL ? (uint32_t)((uint64_t)clip->duration * ANIMATION_FRAMES_A_SECOND >> 16) : 0;
}

int model_play(struct model *model, const char *name)
{
    struct model_motion *const m = model->motion;
    uint32_t i = 0;
    if (name == NULL) {
        return 0;
    }
    while (clip_name(m, i) != NULL && strcmp(clip_name(m, i), name) != 0) {
        i++;
    }
    if (clip_name(m, i) == NULL) {
        return refuse(m, name);
    }
    m->animation.clip = &m->animation.clips[i];
    if (model->scene != NULL) {
        scene_motion_play((void *)(uintptr_t)model->scene, i); /* the model's own copy */
    }
    return 0;
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
