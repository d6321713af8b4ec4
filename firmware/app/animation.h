/*
 * animation: the meshes of a scene follow a clip of a rig, with skins and morph targets (motion.h). All data are const
 * and may lie in flash; what a frame changes is in the arena.
 */
#ifndef ANIMATION_H
#define ANIMATION_H

#include "demo.h"
#include "motion.h"

#define ANIMATION_FRAMES_A_SECOND 30
#define ANIMATION_CROSS_FADE      (FX_ONE / 4) /* seconds, where nobody says others */
#define ANIMATION_LAYERS          3            /* clips that a pose is made of, at most */

/* A mesh that moves. */
struct animation_mesh {
    uint32_t mesh; /* its number in the scene */
    struct ph_bound bound;
    struct ph_skin skin;
    struct ph_morph morph; /* target_count 0: none */
    uint32_t first_weight; /* of the morph targets */
};

struct animation {
    struct ph_rig rig;
    struct ph_xform root;        /* the rig's origin and directions in the scene, t in Q8.24 */
    const struct ph_clip *clip;  /* with which it begins; clips repeat; NULL: the rest pose */
    const struct ph_clip *clips; /* those that the select button goes through, of which `clip` is one; or NULL */
    uint32_t clip_count;
    fx_t cross_fade; /* seconds that the way from one clip to the next takes, 0 or more */
    bool in_turn;    /* the clips play by themselves: see animation_round() */
    /* Samples one of `clips` in place of ph_clip_sample(); or NULL. */
    void (*sample)(const struct animation *a, const struct ph_clip *clip, fx_t time, struct ph_pose *pose,
                   int32_t *weights);
    const struct animation_mesh *meshes;
    uint32_t mesh_count, weight_count;
    const int32_t *rest_weights;
    const struct fx_vec3 *outline; /* points around all that the clips show while it is turned about y */
    uint32_t outline_count;        /* 0: the vertices in the bind pose have to do */
};

/* A clip, and when it began to play. */
struct animation_layer {
    const struct ph_clip *clip;
    struct demo_clock since;
};

/* A scene that moves; it lies in an arena. */
struct animation_stage {
    const struct animation *animation;
    struct ph_mesh *meshes; /* those of the scene; those that move have positions and normals of their own here */
    struct ph_pose *pose, *next_pose; /* next_pose, next_weights: of a clip that fades in, where there are several */
    struct ph_xform *places, *matrices;
    int32_t *weights, *next_weights;
    int16_t (*morphed)[3], (*morphed_normals)[3];
    void *view;                                      /* the state of the demo that draws it */
    struct animation_layer layers[ANIMATION_LAYERS]; /* each fades in over those before it */
    uint8_t layer_count;
    bool starts; /* the last layer plays since the next frame */
    bool is_still;
    uint8_t quarter; /* of 2^32, in which the last frame's number was */
    uint8_t wraps;   /* how often the number of frames has begun again at 0 */
};

/* What the stage needs for meshes that move; starts with zeros. */
struct animation_need {
    uint32_t joints, morphed, morphed_normals; /* of the mesh with most of them */
    size_t vertex_bytes;
};

void animation_add(struct animation_need *need, const struct animation_mesh *mesh);

/* What animation_begin() takes of an arena, here or on a 32-bit target; the animation's meshes are those added. */
size_t animation_bytes(const struct animation_need *need, const struct animation *animation, uint32_t mesh_count,
                       bool on_32);
struct animation_need animation_need(const struct animation *animation);

/* Copies the table of the meshes; the positions of a mesh that moves may be NULL. The vertices are in the bind pose.
 * NULL: the arena is full. */
struct animation_stage *animation_begin(struct demo_arena *arena, const struct animation *animation,
                                        const struct ph_mesh *meshes, uint32_t mesh_count);

/* Moves the vertices to where the clip has them in a frame (below 2^36) of 1/30 s, by all cores that a renderer has; r
 * may be NULL. */
void animation_move(const struct animation_stage *stage, const struct ph_renderer *r, uint64_t frame);

/* animation_move for a time; clips repeat without a seam. */
void animation_move_at(const struct animation_stage *stage, const struct ph_renderer *r, struct demo_clock clock);

/* Makes a demo of an animation, before an eye of its own, or (NULL) on the turntable; see demo_still_init(),
 * demo_turntable_init(). The turntable's camera is that for the outline. */
int animation_init(struct demo_context *context, const struct animation *animation, const struct ph_mesh *meshes,
                   uint32_t mesh_count, const struct demo_eye *eye);
int animation_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame);

/* Seconds that a round of clips takes which play in turn. Each of them plays once, from its beginning, and the next one
 * fades in while it ends; the first one comes after the last. A clip that is shorter than two cross-fades goes on until
 * the next one has faded in. A round ends after 32,768 s at the latest. */
fx_t animation_round(const struct animation *animation);

/* Takes the next clip, which plays from its beginning and fades in from the next frame on. False: the scene has shown
 * all of them, or shows them by itself. With a third clip within the time of one cross-fade the first is gone at once.
 */
bool animation_select(struct demo_context *context);

#endif
