/* See model_rig_pose.h. Interpolates as appendix C of the glTF 2.0 specification says. */
#include "model_rig_pose.h"

#include "model_matrix.h"

#include <stdlib.h>
#include <string.h>

#define KEYS_MOST 512 /* moments at keys of a clip */
#define STEPS     64  /* moments at even distances */

/* ---- a track ----------------------------------------------------------------------------------------------------- */

/* Quaternions a and b, a share of the way along the shorter arc. */
static void slerp(const float *a, const float *b, double share, double *to)
{
    double dot = 0, size = 0;
    for (int i = 0; i < 4; i++) {
        dot += (double)a[i] * (double)b[i];
        size += (double)a[i] * (double)a[i];
    }
    const double cosine = size > 0 ? fmin(fabs(dot) / size, 1) : 1, arc = acos(cosine);
    const double near = arc < 1e-6 ? 1 - share : sin((1 - share) * arc) / sin(arc);
    const double far = arc < 1e-6 ? share : sin(share * arc) / sin(arc);
    for (int i = 0; i < 4; i++) {
        to[i] = near * (double)a[i] + (dot < 0 ? -far : far) * (double)b[i];
    }
}

/* The value between key k and the next, `span` seconds later. */
static void between(const struct model_track *c, uint32_t k, double share, double span, double *to)
{
    const uint32_t w = c->width;
    if (c->interpolation != PH_KEYS_CUBIC) {
        const float *a = c->numbers + (size_t)k * w;
        if (c->path == PH_PATH_ROTATION) {
            slerp(a, a + w, share, to);
            return;
        }
        for (uint32_t i = 0; i < w; i++) {
            to[i] = (1 - share) * (double)a[i] + share * (double)a[w + i];
        }
        return;
    }
    const float *a = c->numbers + (3 * (size_t)k + 1) * w;
    const double u = share, u2 = u * u, u3 = u2 * u;
    for (uint32_t i = 0; i < w; i++) {
        to[i] = (2 * u3 - 3 * u2 + 1) * (double)a[i] + (u3 - 2 * u2 + u) * span * (double)a[w + i] +
                (3 * u2 - 2 * u3) * (double)a[3 * w + i] + (u3 - u2) * span * (double)a[2 * w + i];
    }
}

static void sample(const struct model_track *c, double time, double *to)
{
    uint32_t low = 0, high = c->keys; /* the first key behind the time is in low .. high */
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if ((double)c->times[middle] <= time) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    const uint32_t k = low > 0 ? low - 1 : 0;
    if (low > 0 && low < c->keys && c->interpolation != PH_KEYS_STEP) {
        const double from = (double)c->times[k], span = (double)c->times[low] - from;
        between(c, k, (time - from) / span, span, to);
        return;
    }
    const size_t at = c->interpolation == PH_KEYS_CUBIC ? (3 * (size_t)k + 1) * c->width : (size_t)k * c->width;
    for (uint32_t i = 0; i < c->width; i++) {
        to[i] = (double)c->numbers[at + i];
    }
}

/* ---- the pose ---------------------------------------------------------------------------------------------------- */

void model_rig_pose(struct model_rig *rig, const struct model_rig_moment *moment)
{
    for (uint32_t k = 0; k < rig->node_count; k++) {
        const struct model_node *from = &rig->scene->nodes[rig->order[k]];
        struct model_rig_node *to = &rig->nodes[rig->order[k]];
        memcpy(to->t, from->t, sizeof to->t);
        memcpy(to->q, from->q, sizeof to->q);
        memcpy(to->s, from->s, sizeof to->s);
        for (uint32_t i = 0; i < from->weight_count; i++) {
            to->weights[i] = from->weights != NULL ? from->weights[i] : 0;
        }
    }
    for (uint32_t i = 0; moment->clip != NULL && i < moment->clip->count; i++) {
        const struct model_track *c = &moment->clip->tracks[i];
        struct model_rig_node *node = &rig->nodes[c->node];
        double *const to[] = {node->t, node->q, node->s, node->weights};
        if (node->number != MODEL_NONE) {
            sample(c, moment->time, to[c->path]);
        }
    }
    for (uint32_t k = 0; k < rig->node_count; k++) {
        struct model_rig_node *node = &rig->nodes[rig->order[k]];
        const uint32_t parent = rig->scene->nodes[rig->order[k]].parent;
        model_matrix local;
        model_matrix_compose(local, node->t, node->q, node->s);
        model_matrix_multiply(
            node->world, parent == MODEL_NONE ? model_matrix_identity : (const double(*)[4])rig->nodes[parent].world,
            (const double(*)[4])local);
    }
}

/* ---- moments ----------------------------------------------------------------------------------------------------- */

static int compare(const void *a, const void *b)
{
    const float *x = a, *y = b;
    return *x < *y ? -1 : *x > *y;
}

/* The times of all keys of a clip, sorted, each once. free() the list; NULL: no memory. */
static float *key_times(const struct model_clip *clip, size_t *count)
{
    size_t n = 0, kept = 0;
    for (uint32_t i = 0; i < clip->count; i++) {
        n += clip->tracks[i].keys;
    }
    float *list = calloc(n + 1, sizeof *list);
    for (uint32_t i = 0; list != NULL && i < clip->count; i++) {
        memcpy(list + kept, clip->tracks[i].times, clip->tracks[i].keys * sizeof *list);
        kept += clip->tracks[i].keys;
    }
    *count = 0;
    if (list != NULL) {
        qsort(list, n, sizeof *list, compare);
    }
    for (size_t i = 0; list != NULL && i < n; i++) {
        if (*count == 0 || list[i] != list[*count - 1]) {
            list[(*count)++] = list[i];
        }
    }
    return list;
}

static bool add_clip(struct model_rig *rig, const struct model_clip *clip)
{
    size_t count;
    float *times = key_times(clip, &count);
    const size_t step = count / KEYS_MOST + 1;
    for (size_t i = 0; times != NULL && i < count; i += step) {
        rig->moments[rig->moment_count++] = (struct model_rig_moment){clip, (double)times[i]};
    }
    for (int i = 0; times != NULL && count > 0 && i <= STEPS; i++) {
        rig->moments[rig->moment_count++] = (struct model_rig_moment){clip, (double)times[count - 1] * i / STEPS};
    }
    free(times);
    return times != NULL;
}

bool model_rig_moments_find(struct model_rig *rig)
{
    const struct model_scene *scene = rig->scene;
    rig->moments = calloc(1 + (size_t)scene->clip_count * (KEYS_MOST + STEPS + 1), sizeof *rig->moments);
    if (rig->moments == NULL) {
        return false;
    }
    rig->moment_count = 1;
    for (uint32_t i = 0; i < scene->clip_count; i++) {
        if (!add_clip(rig, &scene->clips[i])) {
            return false;
        }
    }
    return true;
}
