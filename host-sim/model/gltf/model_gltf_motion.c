/* See model_gltf_motion.h. */
#include "model_gltf_motion.h"

#include <stdlib.h>
#include <string.h>

#define JOINTS_MAX 256
#define KEYS_MAX   65535

/* ---- skins ------------------------------------------------------------------------------------------------------- */

static bool read_joints(struct gltf_file *file, const struct model_scene *scene, const struct gltf_json *from,
                        struct model_skin *to)
{
    const struct gltf_json *item, *list = gltf_json_get(from, "joints");
    to->joints = calloc(JOINTS_MAX, sizeof *to->joints);
    if (to->joints == NULL) {
        return gltf_file_failed(file, "it needs too much memory");
    }
    GLTF_JSON_EACH(item, list)
    {
        const double i = gltf_json_is(item, GLTF_JSON_NUMBER) ? item->number : -1;
        if (!(i >= 0 && i < scene->node_count) || to->count == JOINTS_MAX || !scene->nodes[(uint32_t)i].is_shown) {
            return gltf_file_failed(file, "a skin has a joint that is not in the scene, or more than %d", JOINTS_MAX);
        }
        to->joints[to->count++] = (uint32_t)i;
    }
    return to->count > 0 || gltf_file_failed(file, "a skin has no joints");
}

static bool read_skin(struct gltf_file *file, const struct model_scene *scene, const struct gltf_json *from,
                      struct model_skin *to)
{
    const uint32_t accessor = gltf_file_whole(from, "inverseBindMatrices", GLTF_NONE);
    uint32_t count = 0;
    if (to->joints != NULL) {
        return true; /* another node has it, too */
    }
    if (!read_joints(file, scene, from, to)) {
        return false;
    }
    to->bind = accessor != GLTF_NONE ? gltf_file_numbers(file, accessor, 16, &count) : NULL;
    if (accessor == GLTF_NONE || (to->bind != NULL && count >= to->count)) {
        return true;
    }
    return gltf_file_failed(file, "a skin has %u joints and %u matrices", to->count, count);
}

static bool read_weights(struct gltf_file *file, const struct gltf_json *from, const struct model_scene *scene,
                         struct model_node *to)
{
    const struct gltf_json *mesh = gltf_file_item(file, GLTF_MESHES, gltf_file_whole(from, "mesh", GLTF_NONE));
    const struct gltf_json *own = gltf_json_get(from, "weights");
    const struct gltf_json *item = own != NULL ? own : gltf_json_get(mesh, "weights");
    to->weight_count = to->mesh_count > 0 ? scene->meshes[to->first_mesh].moved.target_count : 0;
    to->weights = calloc((size_t)to->weight_count + 1, sizeof *to->weights);
    item = item != NULL ? item->child : NULL;
    for (uint32_t i = 0; to->weights != NULL && i < to->weight_count && item != NULL; i++, item = item->next) {
        to->weights[i] = item->number;
    }
    return to->weights != NULL || gltf_file_failed(file, "it needs too much memory");
}

bool model_gltf_skins_read(struct gltf_file *file, struct model_scene *scene)
{
    scene->skin_count = file->lists[GLTF_SKINS].count;
    scene->skins = calloc((size_t)scene->skin_count + 1, sizeof *scene->skins);
    if (scene->skins == NULL) {
        return gltf_file_failed(file, "it needs too much memory");
    }
    for (uint32_t i = scene->first_node; i != MODEL_NONE; i = model_scene_next(scene, i)) {
        const struct gltf_json *from = gltf_file_item(file, GLTF_NODES, i);
        const uint32_t skin = gltf_file_whole(from, "skin", GLTF_NONE);
        struct model_node *node = &scene->nodes[i];
        if (gltf_json_get(from, "skin") != NULL && skin >= scene->skin_count) {
            return gltf_file_failed(file, "node %u has a skin that is not there", i);
        }
        node->skin = skin < scene->skin_count ? skin : MODEL_NONE;
        if (!read_weights(file, from, scene, node) ||
            (node->mesh_count > 0 && skin < scene->skin_count &&
             !read_skin(file, scene, gltf_file_item(file, GLTF_SKINS, skin), &scene->skins[skin]))) {
            return false;
        }
    }
    return true;
}

/* ---- animations -------------------------------------------------------------------------------------------------- */

static bool find_word(const struct gltf_json *object, const char *key, const char *const *words, uint8_t *to)
{
    const char *text = gltf_json_text(gltf_json_get(object, key));
    for (uint8_t i = 0; text != NULL && words[i] != NULL; i++) {
        if (strcmp(text, words[i]) == 0) {
            *to = i;
            return true;
        }
    }
    return text == NULL;
}

/* Reads a channel. keys 0: nothing of the scene moves by it. False: file->error. */
static bool read_channel(struct gltf_file *file, const struct model_scene *scene, const struct gltf_json *animation,
                         const struct gltf_json *from, struct model_track *to)
{
    static const char *const paths[] = {"translation", "rotation", "scale", "weights", NULL};
    static const char *const ways[] = {"STEP", "LINEAR", "CUBICSPLINE", NULL};
    const struct gltf_json *target = gltf_json_get(from, "target");
    const uint32_t at = gltf_file_whole(from, "sampler", GLTF_NONE);
    const struct gltf_json *sampler = at != GLTF_NONE ? gltf_json_at(gltf_json_get(animation, "samplers"), at) : NULL;
    *to = (struct model_track){
        .node = gltf_file_whole(target, "node", GLTF_NONE), .path = 255, .interpolation = PH_KEYS_LINEAR};
    if (sampler == NULL || !find_word(sampler, "interpolation", ways, &to->interpolation)) {
        return gltf_file_failed(file, "an animation has a sampler that is not there, or of another kind");
    }
    if (!find_word(target, "path", paths, &to->path) || to->path > PH_PATH_WEIGHTS || to->node >= scene->node_count ||
        !scene->nodes[to->node].is_shown) {
        return true;
    }
    const uint32_t kinds[] = {3, 4, 3, scene->nodes[to->node].weight_count},
                   parts = to->interpolation == PH_KEYS_CUBIC ? 3 : 1;
    const bool is_weights = to->path == PH_PATH_WEIGHTS;
    uint32_t keys = 0, count = 0;
    to->width = kinds[to->path];
    to->times = gltf_file_numbers(file, gltf_file_whole(sampler, "input", GLTF_NONE), 1, &keys);
    to->numbers =
        gltf_file_numbers(file, gltf_file_whole(sampler, "output", GLTF_NONE), is_weights ? 1 : to->width, &count);
    if (to->times == NULL || to->numbers == NULL || keys > KEYS_MAX ||
        count != (uint64_t)keys * parts * (is_weights ? to->width : 1)) {
        return gltf_file_failed(file, "an animation has more than %d keys, or not a value for each", KEYS_MAX);
    }
    to->keys = to->width > 0 ? keys : 0;
    return true;
}

static bool read_clip(struct gltf_file *file, const struct model_scene *scene, const struct gltf_json *from,
                      struct model_clip *to)
{
    const struct gltf_json *item, *list = gltf_json_get(from, "channels");
    *to = (struct model_clip){.name = gltf_json_text(gltf_json_get(from, "name")),
                              .tracks = calloc(list != NULL ? (size_t)list->count + 1 : 1, sizeof *to->tracks)};
    if (to->tracks == NULL) {
        return gltf_file_failed(file, "it needs too much memory");
    }
    GLTF_JSON_EACH(item, list)
    {
        if (!read_channel(file, scene, from, item, &to->tracks[to->count])) {
            return false;
        }
        to->count += to->tracks[to->count].keys > 0;
    }
    return true;
}

bool model_gltf_clips_read(struct gltf_file *file, struct model_scene *scene)
{
    scene->clip_count = file->lists[GLTF_ANIMATIONS].count;
    scene->clips = calloc((size_t)scene->clip_count + 1, sizeof *scene->clips);
    if (scene->clips == NULL) {
        return gltf_file_failed(file, "it needs too much memory");
    }
    for (uint32_t i = 0; i < scene->clip_count; i++) {
        if (!read_clip(file, scene, gltf_file_item(file, GLTF_ANIMATIONS, i), &scene->clips[i])) {
            return false;
        }
    }
    return true;
}
