/* See animation.h. A frame's time picks the keys of the clip; each mesh is then morphed and skinned into its own
 * copy. */
#include "animation.h"

#include <string.h>

#define ROUND8(n) (((n) + 7) & ~(size_t)7)

#define STAGE_BYTES_32 88
#define MESH_BYTES_32  52
_Static_assert(sizeof(void *) > 4 || sizeof(struct animation_stage) == STAGE_BYTES_32, "STAGE_BYTES_32 is wrong");
_Static_assert(sizeof(void *) > 4 || sizeof(struct ph_mesh) == MESH_BYTES_32, "MESH_BYTES_32 is wrong");

static uint32_t larger(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

void animation_add(struct animation_need *need, const struct animation_mesh *mesh)
{
    const size_t n = mesh->bound.vertex_count;
    const uint32_t morphed = mesh->morph.target_count > 0 ? mesh->morph.vertex_count : 0;
    need->joints = larger(need->joints, mesh->skin.joint_count);
    need->morphed = larger(need->morphed, morphed);
    need->morphed_normals = larger(need->morphed_normals, mesh->morph.d_normals ? morphed : 0);
    need->vertex_bytes += ROUND8(n * sizeof(struct fx_vec3)) + ROUND8(n * sizeof(int16_t[3]));
}

struct animation_need animation_need(const struct animation *a)
{
    struct animation_need need = {0};
    for (uint32_t i = 0; i < a->mesh_count; i++) {
        animation_add(&need, &a->meshes[i]);
    }
    return need;
}

/* What only a cross-fade needs. */
static size_t next_bytes(const struct animation *a)
{
    return a->clip_count > 1
               ? ROUND8(a->rig.node_count * sizeof(struct ph_pose)) + ROUND8(a->weight_count * sizeof(int32_t))
               : 0;
}

size_t animation_bytes(const struct animation_need *need, const struct animation *a, uint32_t mesh_count, bool on_32)
{
    return ROUND8(on_32 ? STAGE_BYTES_32 : sizeof(struct animation_stage)) +
           ROUND8(mesh_count * (on_32 ? MESH_BYTES_32 : sizeof(struct ph_mesh))) +
           ROUND8(a->rig.node_count * sizeof(struct ph_pose)) + ROUND8(a->rig.node_count * sizeof(struct ph_xform)) +
           ROUND8(need->joints * sizeof(struct ph_xform)) + ROUND8(a->weight_count * sizeof(int32_t)) +
           ROUND8(need->morphed * sizeof(int16_t[3])) + ROUND8(need->morphed_normals * sizeof(int16_t[3])) +
           next_bytes(a) + need->vertex_bytes;
}

/* Gives a mesh vertices of its own, in the bind pose. */
static bool bind(struct demo_arena *arena, const struct animation_mesh *from, struct ph_mesh *mesh)
{
    const uint32_t n = from->bound.vertex_count;
    const int up = 16 - from->bound.frac;
    struct fx_vec3 *const positions = demo_alloc(arena, n * sizeof(*positions));
    int16_t(*const normals)[3] = demo_alloc(arena, n * sizeof(*normals));
    if (!positions || !normals) {
        return false;
    }
    for (uint32_t i = 0; i < n; i++) {
        const int16_t *const p = from->bound.positions[i];
        positions[i] = up >= 0 ? (struct fx_vec3){p[0] * (1 << up), p[1] * (1 << up), p[2] * (1 << up)}
                               : (struct fx_vec3){p[0] >> -up, p[1] >> -up, p[2] >> -up};
    }
    memcpy(normals, from->bound.normals, n * sizeof(*normals));
    mesh->positions = positions;
    mesh->normals = (const int16_t(*)[3])normals;
    return true;
}

struct animation_stage *animation_begin(struct demo_arena *arena, const struct animation *a,
                                        const struct ph_mesh *meshes, uint32_t mesh_count)
{
    const struct animation_need need = animation_need(a);
    struct animation_stage *const s = demo_alloc(arena, sizeof(*s));
    if (!s) {
        return NULL;
    }
    *s = (struct animation_stage){.animation = a,
                                  .meshes = demo_alloc(arena, mesh_count * sizeof(*meshes)),
                                  .pose = demo_alloc(arena, a->rig.node_count * sizeof(*s->pose)),
                                  .places = demo_alloc(arena, a->rig.node_count * sizeof(*s->places)),
                                  .matrices = demo_alloc(arena, need.joints * sizeof(*s->matrices)),
                                  .weights = demo_alloc(arena, a->weight_count * sizeof(*s->weights)),
                                  .layers = {{.clip = a->clip}},
                                  .layer_count = a->clip ? 1 : 0,
                                  .morphed = demo_alloc(arena, need.morphed * sizeof(*s->morphed)),
                                  .morphed_normals =
                                      demo_alloc(arena, need.morphed_normals * sizeof(*s->morphed_normals))};
    if (!s->meshes || !s->pose || !s->places || !s->matrices || !s->weights || !s->morphed || !s->morphed_normals) {
        return NULL;
    }
    if (a->clip_count > 1) {
        s->next_pose = demo_alloc(arena, a->rig.node_count * sizeof(*s->next_pose));
        s->next_weights = demo_alloc(arena, a->weight_count * sizeof(*s->next_weights));
        if (!s->next_pose || !s->next_weights) {
            return NULL;
        }
    }
    memcpy(s->meshes, meshes, mesh_count * sizeof(*meshes));
    for (uint32_t i = 0; i < a->mesh_count; i++) {
        if (!bind(arena, &a->meshes[i], &s->meshes[a->meshes[i].mesh])) {
            return NULL;
        }
    }
    return s;
}

/* Where something is that repeats after a duration, in Q16.16 seconds, when so many 1/65536 s have passed. */
static fx_t time_of(fx_t repeats_after, uint64_t passed)
{
    const uint32_t duration = repeats_after > 0 ? (uint32_t)repeats_after : 1;
    uint32_t time = (uint32_t)(passed >> 16);
    for (uint32_t bit = 0; bit < 16; bit++) { /* times FX_ONE, which would overflow after 65,536 s */
        time = time % duration * 2;
    }
    return (fx_t)((time % duration + (uint16_t)passed) % duration);
}

/* The time of a frame, rounded down, below 2^32 s. In the 2^32 frames after which a count of 32 bits begins anew pass
 * so many whole seconds, and frames. */
static struct demo_clock clock_of(uint64_t frame, uint32_t fps)
{
    const uint32_t wrap_seconds = UINT32_MAX / fps + (UINT32_MAX % fps == fps - 1);
    const uint32_t wrap_rest = (UINT32_MAX % fps + 1) % fps;
    const uint32_t low = (uint32_t)frame, wraps = (uint32_t)(frame >> 32), rest = low % fps + wraps * wrap_rest;
    return (struct demo_clock){.seconds = low / fps + wraps * wrap_seconds + rest / fps,
                               .part = (uint16_t)(rest % fps * FX_ONE / fps)};
}

void animation_move(const struct animation_stage *s, const struct ph_renderer *r, uint64_t frame)
{
    animation_move_at(s, r, clock_of(frame, ANIMATION_FRAMES_A_SECOND));
}

/* A time in 1/65536 s. */
static uint64_t parts_of(struct demo_clock clock)
{
    return (uint64_t)clock.seconds << 16 | clock.part;
}

static struct demo_clock clock_at(uint64_t parts)
{
    return (struct demo_clock){.seconds = (uint32_t)(parts >> 16), .part = (uint16_t)parts};
}

/* How long a layer has played at a time, in 1/65536 s; 0 before it began. */
static uint64_t played(const struct animation_layer *layer, struct demo_clock clock)
{
    const uint64_t from = parts_of(layer->since), to = parts_of(clock);
    return to > from ? to - from : 0;
}

/* How much of a layer shows, 0 .. FX_ONE. */
static fx_t share_of(const struct animation_stage *s, const struct animation_layer *layer, struct demo_clock clock)
{
    const uint64_t time = played(layer, clock);
    const fx_t fade = s->animation->cross_fade;
    return time >= (uint64_t)fade ? FX_ONE : fx_div_sat((fx_t)time, fade);
}

/* The pose in which a layer (NULL: none) has the rig at a time. */
static void set_pose(const struct animation *a, const struct animation_layer *layer, struct demo_clock clock,
                     struct ph_pose *pose, int32_t *weights)
{
    ph_rig_rest(&a->rig, pose);
    for (uint32_t i = 0; i < a->weight_count; i++) { /* memcpy takes no NULL, not even for 0 bytes */
        weights[i] = a->rest_weights[i];
    }
    if (layer) {
        const fx_t time = time_of(layer->clip->duration, played(layer, clock));
        if (a->sample) {
            a->sample(a, layer->clip, time, pose, weights);
        } else {
            ph_clip_sample(layer->clip, time, pose, weights);
        }
    }
}

/* Fades all layers over each other that show. */
static void blend_layers(const struct animation_stage *s, struct demo_clock clock)
{
    const struct animation *const a = s->animation;
    const struct animation_layer *const end = s->layers + s->layer_count, *layer = s->layer_count > 0 ? end - 1 : NULL;
    while (layer && layer > s->layers && share_of(s, layer, clock) < FX_ONE) {
        layer--;
    }
    set_pose(a, layer, clock, s->pose, s->weights);
    for (; layer && layer + 1 < end; layer++) {
        const fx_t share = share_of(s, layer + 1, clock);
        set_pose(a, layer + 1, clock, s->next_pose, s->next_weights);
        ph_pose_blend(s->pose, s->next_pose, a->rig.node_count, share);
        for (uint32_t i = 0; i < a->weight_count; i++) {
            s->weights[i] = fx_lerp_sat(s->weights[i], s->next_weights[i], share);
        }
    }
}

void animation_move_at(const struct animation_stage *s, const struct ph_renderer *r, struct demo_clock clock)
{
    const struct animation *const a = s->animation;
    blend_layers(s, clock);
    ph_rig_places(&a->rig, s->pose, &a->root, s->places);
    for (uint32_t i = 0; i < a->mesh_count; i++) {
        const struct animation_mesh *const from = &a->meshes[i];
        const struct ph_mesh *const to = &s->meshes[from->mesh];
        struct ph_bound bound = from->bound;
        if (from->morph.target_count > 0) {
            int16_t(*const normals)[3] = from->morph.d_normals ? s->morphed_normals : NULL;
            ph_morph_vertices(&from->morph, s->weights + from->first_weight, s->morphed, normals);
            bound.positions = (const int16_t(*)[3])s->morphed;
            bound.normals = normals ? (const int16_t(*)[3])normals : bound.normals;
        }
        ph_skin_matrices(&from->skin, s->places, s->matrices);
        ph_skin_mesh(r, &bound, s->matrices, (struct fx_vec3 *)(uintptr_t)to->positions,
                     (int16_t(*)[3])(uintptr_t)to->normals); /* its own: bind() */
    }
}

int animation_init(struct demo_context *context, const struct animation *a, const struct ph_mesh *meshes,
                   uint32_t mesh_count, const struct demo_eye *eye)
{
    struct animation_stage *const s = animation_begin(&context->arena, a, meshes, mesh_count);
    if (!s) {
        return PH_ERR_NOMEM;
    }
    const int status = eye ? demo_still_init(context, s->meshes, mesh_count, eye)
                       : a->outline_count > 0
                           ? demo_turntable_around(context, s->meshes, mesh_count, a->outline, a->outline_count)
                           : demo_turntable_init(context, s->meshes, mesh_count, (struct fx_vec3){0, 0, 0});
    s->is_still = eye != NULL;
    s->view = context->state;
    context->state = s;
    return status;
}

/* A count of frames that goes on where the one of 32 bits begins anew, so that the clip does not jump there. It follows
 * steps back over that place, too. The first frame may be any. */
static uint64_t clip_frame(struct animation_stage *s, uint32_t frame)
{
    const uint8_t quarter = (uint8_t)(frame >> 30);
    if (s->quarter == 3 && quarter == 0) {
        s->wraps++;
    } else if (s->quarter == 0 && quarter == 3 && s->wraps > 0) {
        s->wraps--;
    }
    s->quarter = quarter;
    return (uint64_t)s->wraps << 32 | frame;
}

/* How long a clip that plays in turn does so before the next one begins. */
static fx_t turn_of(const struct animation *a, uint32_t i)
{
    const fx_t until_fade = a->clips[i].duration - a->cross_fade;
    return until_fade > a->cross_fade ? until_fade : a->cross_fade;
}

fx_t animation_round(const struct animation *a)
{
    fx_t round = 0;
    for (uint32_t i = 0; i < a->clip_count; i++) {
        round = fx_add_sat(round, turn_of(a, i));
    }
    return round;
}

/* Sets the layers to the clip whose turn it is at a time, and the one before it, which fades out at first. They are
 * found from the time alone, so that a frame looks the same whichever frames were drawn before it. */
static void take_turns(struct animation_stage *s, struct demo_clock clock)
{
    const struct animation *const a = s->animation;
    const uint64_t now = parts_of(clock);
    fx_t time = time_of(animation_round(a), now);
    uint32_t i = 0;
    while (i + 1 < a->clip_count && time >= turn_of(a, i)) {
        time -= turn_of(a, i++);
    }
    const uint32_t before = (i > 0 ? i : a->clip_count) - 1;
    const uint64_t since = now - (uint64_t)time, since_before = since - (uint64_t)turn_of(a, before);
    s->layers[0] = (struct animation_layer){&a->clips[before], clock_at(since_before)};
    s->layers[1] = (struct animation_layer){&a->clips[i], clock_at(since)};
    s->layer_count = 2;
    if (since == 0) { /* before the first of all is none */
        s->layers[0] = s->layers[1];
        s->layer_count = 1;
    }
}

int animation_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    struct animation_stage *const s = context->state;
    const uint32_t fps = context->clip_fps != 0 ? context->clip_fps : ANIMATION_FRAMES_A_SECOND;
    const uint64_t number = clip_frame(s, frame);
    const struct demo_clock clock = fps == DEMO_CLIPS_BY_CLOCK ? context->clock : clock_of(number, fps);
    if (s->starts) {
        s->layers[s->layer_count - 1].since = clock;
        s->starts = false;
    }
    if (s->animation->in_turn && s->animation->clip_count > 1) {
        take_turns(s, clock);
    }
    animation_move_at(s, r, clock);
    context->state = s->view;
    const int status = s->is_still ? demo_still_frame(context, r, frame) : demo_turntable_frame(context, r, frame);
    context->state = s;
    return status;
}

bool animation_select(struct demo_context *context)
{
    struct animation_stage *const s = context->state;
    const struct animation *const a = s->animation;
    if (a->clip_count < 2 || a->in_turn) {
        return false;
    }
    const struct ph_clip *const next = s->layers[s->layer_count - 1].clip + 1;
    const struct ph_clip *const clip = next < a->clips + a->clip_count ? next : a->clips;
    if (clip == a->clip) {
        return false;
    }
    if (!s->starts && s->layer_count < ANIMATION_LAYERS) {
        s->layer_count++;
    } else if (!s->starts) {
        memmove(s->layers, s->layers + 1, sizeof(s->layers) - sizeof(s->layers[0]));
    }
    s->layers[s->layer_count - 1].clip = clip;
    s->starts = true;
    context->clip = clip->name;
    return true;
}
