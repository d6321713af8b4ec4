/* See model_rig_clips.h. */
#include "model_rig_clips.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

/* What becomes of number i of a value: (number - origin) factor. */
struct change {
    double origin, factor;
};

/* Changes numbers to the rig's. Tangents are multiplied by the time between their keys. The greatest number. */
static double prepare(const struct model_track *c, const struct change *changes)
{
    const bool is_cubic = c->interpolation == PH_KEYS_CUBIC;
    double most = 0;
    for (uint32_t k = 0; k < c->keys; k++) {
        const double before = k > 0 ? (double)c->times[k] - (double)c->times[k - 1] : 0,
                     behind = k + 1 < c->keys ? (double)c->times[k + 1] - (double)c->times[k] : 0;
        const uint32_t parts = is_cubic ? 3 : 1;
        for (uint32_t i = 0; i < parts * c->width; i++) {
            const struct change *change = &changes[i % c->width];
            const bool is_value = !is_cubic || i / c->width == 1;
            const double times = is_value ? 1 : i / c->width == 0 ? before : behind;
            float *number = &c->numbers[(size_t)k * parts * c->width + i];
            *number = (float)((*number - (is_value ? change->origin : 0)) * change->factor * times);
            most = fmax(most, fabs((double)*number));
            *number = (float)model_rig_clamp((double)*number, MODEL_RIG_MOST);
        }
    }
    return most;
}

/* Notes how far the keys are from the numbers. */
static void compare(const struct model_track *c, const int16_t *keys, int frac, struct model_rounding *r)
{
    double *const errors[] = {&r->translation, &r->rotation, &r->scale, &r->weight};
    const uint32_t w = c->width, parts = c->interpolation == PH_KEYS_CUBIC ? 3 : 1;
    for (uint32_t k = 0; k < c->keys; k++) {
        const size_t at = ((size_t)k * parts + parts / 2) * w; /* behind the tangent before it */
        double own = 0, other = 0, dot = 0;
        for (uint32_t i = 0; i < w; i++) {
            const double number = (double)c->numbers[at + i], key = keys[at + i];
            own += number * number, other += key * key, dot += number * key;
            if (c->path != PH_PATH_ROTATION) {
                model_rig_note(errors[c->path], number - ldexp(key, -frac));
            }
        }
        if (c->path == PH_PATH_ROTATION && own > 0 && other > 0) {
            model_rig_note(&r->rotation, 2 * acos(fmin(1, dot / sqrt(own * other))) * 180 / PI);
        }
    }
}

/* Times of keys, which are those of an earlier track of the clip where these are the same. NULL: no memory. */
static const fx_t *pack_times(struct model_shared *shared, const struct model_track *c, const struct ph_clip *clip)
{
    const size_t used = shared->arena.used, bytes = sizeof(fx_t) * c->keys;
    fx_t *times = demo_alloc(&shared->arena, bytes);
    for (uint32_t k = 0; times != NULL && k < c->keys; k++) {
        times[k] = (fx_t)fmin(clip->duration, fmax(0, rint((double)c->times[k] * FX_ONE)));
        model_rig_note(&shared->model.motion->rounding.time, (double)c->times[k] - ldexp(times[k], -16));
    }
    for (uint32_t i = 0; times != NULL && i < clip->track_count; i++) {
        const struct ph_track *other = &clip->tracks[i];
        if (other->key_count == c->keys && memcmp(other->times, times, bytes) == 0) {
            shared->arena.used = used;
            return other->times;
        }
    }
    return times;
}

/* Numbers as 16 bits with as many bits of fraction as they have room for, in the next track of a clip. */
static bool pack(struct model_shared *shared, const struct model_track *c, const struct ph_clip *clip,
                 struct ph_track *to)
{
    const size_t n = (size_t)c->keys * c->width * (c->interpolation == PH_KEYS_CUBIC ? 3 : 1);
    const fx_t *times = pack_times(shared, c, clip);
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
        keys[i] = (int16_t)lround(model_rig_clamp(c->path == PH_PATH_ROTATION ? (double)c->numbers[i] / most * 32767
                                                                              : ldexp((double)c->numbers[i], frac),
                                                  32767));
    }
    *to = (struct ph_track){.path = c->path,
                            .interpolation = c->interpolation,
                            .key_count = (uint16_t)c->keys,
                            .width = (uint8_t)c->width,
                            .frac = (uint8_t)frac,
                            .times = times,
                            .keys = keys};
    compare(c, keys, frac, &shared->model.motion->rounding);
    return true;
}

/* Makes the next track of a clip, in the model's units. */
static bool make_track(struct model_shared *shared, const struct model_track *from, const struct model_fit *fit,
                       const struct ph_clip *clip, struct ph_track *to)
{
    static const char *const names[] = {"translation in radii of the model", "rotation", "scale beside the largest",
                                        "weight"};
    const struct model_rig *rig = shared->rig;
    const struct model_rig_node *node = &rig->nodes[from->node];
    const double above = model_rig_above(rig, from->node);
    struct change changes[256];
    double origin[3];
    model_rig_origin(rig, from->node, fit, origin);
    for (uint32_t i = 0; i < from->width; i++) {
        const double most = from->path == PH_PATH_WEIGHTS ? node->most_weights[i] : 1;
        changes[i] = (struct change){.factor = most > 0 ? 1 / most : 0};
        if (from->path == PH_PATH_TRANSLATION) {
            changes[i] = (struct change){origin[i], above * fit->scale};
        } else if (from->path == PH_PATH_SCALE) {
            changes[i].factor = above / node->length[i];
        }
    }
    const double most = prepare(from, changes);
    if (!(most <= MODEL_RIG_MOST)) {
        return model_shared_failed(shared,
                                   "cannot be shown: a clip has a %s of %.4g at node %u, and at most %d is "
                                   "possible",
                                   names[from->path], most, from->node, MODEL_RIG_MOST);
    }
    if (!pack(shared, from, clip, to)) {
        return model_shared_failed(shared, "needs too much memory");
    }
    to->node = (uint16_t)(from->path == PH_PATH_WEIGHTS ? node->first_weight : node->number);
    return true;
}

static bool make_clip(struct model_shared *shared, const struct model_clip *from, uint32_t index,
                      const struct model_fit *fit, struct ph_clip *clip)
{
    struct ph_track *tracks = demo_alloc(&shared->arena, sizeof *tracks * (from->count + 1));
    char *name = demo_alloc(&shared->arena, 64);
    double end = 0;
    if (tracks == NULL || name == NULL) {
        return model_shared_failed(shared, "needs too much memory");
    }
    if (from->name != NULL && from->name[0] != '\0') {
        snprintf(name, 64, "%.60s", from->name);
    } else {
        snprintf(name, 64, "clip %u", index);
    }
    *clip = (struct ph_clip){.name = name, .tracks = tracks};
    for (uint32_t i = 0; i < from->count; i++) {
        for (uint32_t k = 0; k < from->tracks[i].keys; k++) {
            end = fmax(end, (double)from->tracks[i].times[k]);
        }
    }
    end = fmin(end, 32767);
    clip->duration = (fx_t)lround(end * 65536);
    for (uint32_t i = 0; i < from->count; i++) {
        if (shared->rig->nodes[from->tracks[i].node].number == MODEL_NONE) {
            continue;
        }
        if (!make_track(shared, &from->tracks[i], fit, clip, &tracks[clip->track_count])) {
            return false;
        }
        clip->track_count++;
    }
    return true;
}

bool model_rig_clips_make(struct model_shared *shared, struct model_motion *to, const struct model_fit *fit)
{
    const struct model_scene *scene = shared->rig->scene;
    const uint32_t n = scene->clip_count;
    struct ph_clip *clips = demo_alloc(&shared->arena, sizeof *clips * (n + 1));
    if (clips == NULL) {
        return model_shared_failed(shared, "needs too much memory");
    }
    for (uint32_t i = 0; i < n; i++) {
        if (!make_clip(shared, &scene->clips[i], i, fit, &clips[i])) {
            return false;
        }
    }
    to->animation.clips = clips;
    to->animation.clip = n > 0 ? clips : NULL;
    to->animation.clip_count = n;
    to->animation.cross_fade = shared->options.cross_fade_ms != 0
                                   ? (fx_t)(((uint64_t)shared->options.cross_fade_ms << 16) / 1000)
                                   : ANIMATION_CROSS_FADE;
    return true;
}
