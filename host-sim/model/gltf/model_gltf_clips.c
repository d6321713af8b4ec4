/* See model_gltf_clips.h. */
#include "model_gltf_clips.h"

#include "model_gltf_rig.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define KEYS_MAX 65535
#define PI       3.14159265358979323846

/* A channel's sampler: `keys` times, and numbers in the model's units. */
struct channel {
    float *times, *numbers;
    uint32_t keys, width;
    struct ph_track track;
};

/* Tangents are multiplied by the time between their keys. */
static void prepare(struct channel *c, double factor)
{
    const bool is_cubic = c->track.interpolation == PH_KEYS_CUBIC;
    for (uint32_t k = 0; k < c->keys; k++) {
        const double before = k > 0 ? (double)c->times[k] - (double)c->times[k - 1] : 0,
                     behind = k + 1 < c->keys ? (double)c->times[k + 1] - (double)c->times[k] : 0;
        const uint32_t parts = is_cubic ? 3 : 1;
        for (uint32_t i = 0; i < parts * c->width; i++) {
            const double times = !is_cubic || i / c->width == 1 ? 1 : i / c->width == 0 ? before : behind;
            float *number = &c->numbers[(size_t)k * parts * c->width + i];
            *number = (float)model_gltf_clamp(*number * factor * times, 120);
        }
    }
}

/* Notes how far the keys are from the numbers. */
static void compare(const struct channel *c, const int16_t *keys, struct model_rounding *r)
{
    double *const errors[] = {&r->translation, &r->rotation, &r->scale, &r->weight};
    const uint32_t w = c->width, parts = c->track.interpolation == PH_KEYS_CUBIC ? 3 : 1;
    for (uint32_t k = 0; k < c->keys; k++) {
        const size_t at = ((size_t)k * parts + parts / 2) * w; /* behind the tangent before it */
        double own = 0, other = 0, dot = 0;
        for (uint32_t i = 0; i < w; i++) {
            const double number = (double)c->numbers[at + i], key = keys[at + i];
            own += number * number, other += key * key, dot += number * key;
            if (c->track.path != PH_PATH_ROTATION) {
                model_gltf_note(errors[c->track.path], number - ldexp(key, -c->track.frac));
            }
        }
        if (c->track.path == PH_PATH_ROTATION && own > 0 && other > 0) {
            model_gltf_note(&r->rotation, 2 * acos(fmin(1, dot / sqrt(own * other))) * 180 / PI);
        }
    }
}

/* Numbers as 16 bits with as many bits of fraction as they have room for. */
static bool pack(struct model_shared *shared, struct channel *c, uint8_t time_shift)
{
    const size_t n = (size_t)c->keys * c->width * (c->track.interpolation == PH_KEYS_CUBIC ? 3 : 1);
    uint16_t *times = demo_alloc(&shared->arena, sizeof *times * c->keys);
    int16_t *keys = demo_alloc(&shared->arena, sizeof *keys * n);
    double most = 0;
    int frac = 24;
    if (times == NULL || keys == NULL) {
        return false;
    }
    for (size_t i = 0; i < n; i++) {
        most = fmax(most, fabs((double)c->numbers[i]));
    }
    while (frac > 8 && ldexp(most, frac) > 32767) {
        frac--;
    }
    for (size_t i = 0; i < n; i++) {
        keys[i] =
            (int16_t)lround(model_gltf_clamp(c->track.path == PH_PATH_ROTATION ? (double)c->numbers[i] / most * 32767
                                                                               : ldexp((double)c->numbers[i], frac),
                                             32767));
    }
    for (uint32_t k = 0; k < c->keys; k++) {
        times[k] = (uint16_t)fmin(65535, fmax(0, rint((double)c->times[k] * 65536 / (1 << time_shift))));
        model_gltf_note(&shared->model.motion->rounding.time, (double)c->times[k] - ldexp(times[k], time_shift - 16));
    }
    c->track.frac = (uint8_t)frac;
    c->track.times = times;
    c->track.keys = keys;
    compare(c, keys, &shared->model.motion->rounding);
    return true;
}

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
static bool read_channel(struct model_gltf_motion *motion, const struct gltf_json *animation,
                         const struct gltf_json *from, double unit, struct channel *c)
{
    static const char *const paths[] = {"translation", "rotation", "scale", "weights", NULL};
    static const char *const ways[] = {"STEP", "LINEAR", "CUBICSPLINE", NULL};
    struct gltf_file *file = motion->file;
    const struct gltf_json *target = gltf_json_get(from, "target");
    const struct gltf_json *samplers = gltf_json_get(animation, "samplers");
    const uint32_t number = gltf_file_whole(target, "node", GLTF_NONE),
                   at = gltf_file_whole(from, "sampler", GLTF_NONE);
    const struct gltf_json *sampler = at < 1000000 ? gltf_json_at(samplers, at) : NULL;
    *c = (struct channel){.track = {.path = 255, .interpolation = PH_KEYS_LINEAR}};
    if (sampler == NULL || !find_word(sampler, "interpolation", ways, &c->track.interpolation)) {
        return gltf_file_failed(file, "an animation has a sampler that is not there, or of another kind");
    }
    if (!find_word(target, "path", paths, &c->track.path) || c->track.path > PH_PATH_WEIGHTS ||
        number >= file->lists[GLTF_NODES].count || motion->nodes[number].drawn == NULL) {
        return true;
    }
    const struct model_gltf_node *node = &motion->nodes[number];
    const uint32_t kinds[] = {3, 4, 3, node->weight_count}, parts = c->track.interpolation == PH_KEYS_CUBIC ? 3 : 1;
    uint32_t keys = 0, count = 0;
    c->width = kinds[c->track.path];
    c->times = gltf_file_numbers(file, gltf_file_whole(sampler, "input", GLTF_NONE), 1, &keys);
    c->numbers = gltf_file_numbers(file, gltf_file_whole(sampler, "output", GLTF_NONE),
                                   c->track.path == PH_PATH_WEIGHTS ? 1 : c->width, &count);
    if (c->times == NULL || c->numbers == NULL || keys > KEYS_MAX ||
        count != (uint64_t)keys * parts * (c->track.path == PH_PATH_WEIGHTS ? c->width : 1)) {
        return gltf_file_failed(file, "an animation has more than %d keys, or not a value for each", KEYS_MAX);
    }
    const double above = node->parent < 0 ? unit : motion->nodes[node->parent].length;
    c->keys = c->width > 0 ? keys : 0;
    prepare(c, c->track.path == PH_PATH_TRANSLATION ? above
               : c->track.path == PH_PATH_SCALE     ? above / node->length
                                                    : 1);
    c->track.key_count = (uint16_t)keys;
    c->track.width = (uint8_t)c->width;
    c->track.node = (uint16_t)(c->track.path == PH_PATH_WEIGHTS ? node->first_weight : node->number);
    return true;
}

static bool read_clip(struct model_shared *shared, const struct gltf_json *animation, uint32_t index, double unit,
                      struct ph_clip *clip)
{
    const struct gltf_json *item, *list = gltf_json_get(animation, "channels");
    const size_t n = gltf_json_is(list, GLTF_JSON_ARRAY) ? list->count : 0;
    const char *text = gltf_json_text(gltf_json_get(animation, "name"));
    struct channel *channels = calloc(n + 1, sizeof *channels);
    struct ph_track *tracks = demo_alloc(&shared->arena, sizeof *tracks * (n + 1));
    char *name = demo_alloc(&shared->arena, 64);
    double end = 0;
    if (channels == NULL || tracks == NULL || name == NULL) {
        return gltf_file_failed(shared->motion->file, "it needs too much memory");
    }
    snprintf(name, 64, text != NULL && *text != '\0' ? "%.60s" : "%.0sclip %u", text != NULL ? text : "", index);
    *clip = (struct ph_clip){.name = name, .tracks = tracks};
    size_t count = 0;
    GLTF_JSON_EACH(item, list)
    {
        if (!read_channel(shared->motion, animation, item, unit, &channels[count])) {
            return false;
        }
        for (uint32_t k = 0; k < channels[count].keys; k++) {
            end = fmax(end, (double)channels[count].times[k]);
        }
        count += channels[count].keys > 0;
    }
    end = fmin(end, 32767);
    clip->duration = (fx_t)lround(end * 65536);
    while (clip->duration >> clip->time_shift > UINT16_MAX) {
        clip->time_shift++;
    }
    for (size_t i = 0; i < count; i++) {
        if (!pack(shared, &channels[i], clip->time_shift)) {
            return gltf_file_failed(shared->motion->file, "it needs too much memory");
        }
        tracks[clip->track_count++] = channels[i].track;
    }
    return true;
}

bool model_gltf_clips_read(struct model_shared *shared, struct model_motion *to, double unit)
{
    struct gltf_file *file = shared->motion->file;
    const uint32_t n = file->lists[GLTF_ANIMATIONS].count;
    struct ph_clip *clips = demo_alloc(&shared->arena, sizeof *clips * (n + 1));
    for (uint32_t i = 0; i < n; i++) {
        if (clips == NULL || !read_clip(shared, gltf_file_item(file, GLTF_ANIMATIONS, i), i, unit, &clips[i])) {
            return model_shared_failed(shared, "has an animation that cannot be read: %s",
                                       file->error[0] != '\0' ? file->error : "too little memory");
        }
    }
    to->clips = clips;
    to->animation.clip = n > 0 ? clips : NULL;
    to->clip_count = n;
    return clips != NULL;
}
