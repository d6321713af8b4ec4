/* model: chooses the clip or the clips that --clip names, and finds what moves a mesh (model.h). */
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
    const struct animation *a = model->motion != NULL ? &model->motion->animation : NULL;
    const fx_t duration = a == NULL || a->clip == NULL ? 0 : a->in_turn ? animation_round(a) : a->clip->duration;
    return (uint32_t)((uint64_t)duration * ANIMATION_FRAMES_A_SECOND >> 16);
}

/* The number of the clip of that name, which ends after so many letters, of those from `first` on; UINT32_MAX: none. */
static uint32_t clip_find(const struct model_motion *m, uint32_t first, const char *name, size_t letters)
{
    for (uint32_t i = first; clip_name(m, i) != NULL; i++) {
        if (strncmp(clip_name(m, i), name, letters) == 0 && clip_name(m, i)[letters] == '\0') {
            return i;
        }
    }
    return UINT32_MAX;
}

/* Exchanges two clips of a model, and of a binary scene in its bytes. */
static void exchange(const struct model *model, uint32_t i, uint32_t k)
{
    struct ph_clip *clips = (struct ph_clip *)(uintptr_t)model->motion->animation.clips; /* the model's own */
    const struct ph_clip clip = clips[i];
    clips[i] = clips[k];
    clips[k] = clip;
    const struct scene_file_head *head = model->scene;
    if (head != NULL) {
        const struct scene_file_motion *motion = scene_file_at(head, head->motion);
        struct scene_file_clip *of_scene = (void *)(uintptr_t)scene_file_at(head, motion->clips);
        const struct scene_file_clip first = of_scene[i];
        of_scene[i] = of_scene[k];
        of_scene[k] = first;
        clips[i].name = of_scene[i].name; /* names lie in the scene's bytes */
        clips[k].name = of_scene[k].name;
    }
}

/* Tells the bytes of a binary scene, which are the model's own copy, which clips play. */
static void tell_scene(const struct model *model)
{
    const struct animation *a = &model->motion->animation;
    struct scene_file_head *head = (void *)(uintptr_t)model->scene;
    if (head != NULL) {
        struct scene_file_motion *motion = (void *)(uintptr_t)scene_file_at(head, head->motion);
        head->flags &= ~(uint32_t)SCENE_FILE_IN_TURN;
        head->flags |= a->in_turn ? (uint32_t)SCENE_FILE_IN_TURN : 0;
        motion->clip_count = a->clip_count;
        scene_motion_play(head, (uint32_t)(a->clip - a->clips));
    }
}

/* Plays the clips of a list of names with commas between them in turn. 0, or after complaining PH_ERR_INVAL. */
static int play_in_turn(struct model *model, const char *names)
{
    char name[200];
    uint32_t count = 0;
    for (const char *from = names; from != NULL; count++) {
        const char *comma = strchr(from, ',');
        const size_t letters = comma != NULL ? (size_t)(comma - from) : strlen(from);
        const uint32_t i = clip_find(model->motion, count, from, letters);
        if (i == UINT32_MAX) {
            snprintf(name, sizeof name, "%.*s", (int)letters, from);
            return clip_find(model->motion, 0, from, letters) != UINT32_MAX
                       ? complain_usage("--clip '%s': names '%s' twice", names, name)
                       : refuse(model->motion, name);
        }
        exchange(model, count, i);
        from = comma != NULL ? comma + 1 : NULL;
    }
    struct animation *a = &model->motion->animation;
    a->clip = a->clips;
    a->clip_count = count;
    a->in_turn = true;
    tell_scene(model);
    return 0;
}

int model_play(struct model *model, const char *name)
{
    struct model_motion *const m = model->motion;
    const uint32_t i = name != NULL ? clip_find(m, 0, name, strlen(name)) : 0;
    if (name == NULL) {
        return 0;
    }
    if (i == UINT32_MAX) {
        return strchr(name, ',') != NULL ? play_in_turn(model, name) : refuse(m, name);
    }
    m->animation.clip = &m->animation.clips[i];
    m->animation.in_turn = false;
    tell_scene(model);
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
