/*
 * motion: clips of keys move the nodes of a rig; skins and morph targets move the vertices of a mesh.
 *
 *   ph_clip_sample(&clip, time, pose, weights)           each node's place in its parent, and the morph weights
 *   ph_pose_blend(pose, other, node_count, share)        optional: a cross-fade to another clip's pose
 *   ph_rig_places(&rig, pose, &root, places)             each node's place in the model
 *   ph_morph_vertices(&morph, weights, ..)               optional: the vertices of this moment before they are skinned
 *   ph_skin_matrices(&skin, places, matrices)            each joint's motion from the bind pose
 *   ph_skin_vertices(&from, matrices, positions, normals) what struct ph_mesh draws, or ph_skin_mesh(r, ..) by two
 * cores
 *
 * It is the animation of glTF 2.0, and all of it may lie in flash. Translations, scales and morph weights are Q8.24:
 * -128 .. 127.9999999. So a chain of joints adds no error that Q16.16 shows; make the model about 1 in size. Rotations
 * are Q2.30. Keys and positions have 16 bits, and all of a track or of a mesh has one number of bits of fraction,
 * `frac`.
 *
 * Errors beyond those of the 16-bit numbers given, in LSB of Q16.16 (2^-16), against exact arithmetic:
 *   a sampled translation or scale     2^-7 of an LSB, and 2^-17 of the way between the two keys
 *   a sampled rotation                 each component 2^-19 beside slerp, and 2^-17 of the way between the two keys
 *   a joint matrix                     rotations 2^-27 and translations 2^-5 LSB for each joint above it, and as often
 *                                      more as the scales of the joints below that one multiply it
 *   a vertex of one joint              0.6
 *   a vertex of several joints         0.6, and |x| + |y| + |z| of its position in the bind pose
 *   a normal                           2^-10 in each component, where no joint scales the axes differently, or where
 *                                      scales_axes says so: then by as much more as the axes differ, at most 2^-6 at
 *                                      1 : 64
 * No function takes memory, and none that works on vertices multiplies to 64 bits. Whatever the numbers are, the result
 * is defined: Q8.24 saturates, and so do the elements of matrices (-2 .. 2).
 */
#ifndef PH_MOTION_H
#define PH_MOTION_H

#include "geom.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PH_MOTION_ONE ((int32_t)1 << 24) /* one in Q8.24 */

/* The place of a node in its parent: p -> t + r (s p). */
struct ph_pose {
    struct fx_quat r;    /* of length one */
    struct fx_vec3 t, s; /* Q8.24 */
};

/* A node of a rig. */
struct ph_rig_node {
    int16_t parent; /* a node before it, or -1 */
    struct ph_pose rest;
};

/* A tree of nodes. */
struct ph_rig {
    const struct ph_rig_node *nodes;
    uint32_t node_count;
};

/* ---- clips ------------------------------------------------------------------------------------------------------ */

/* What a track moves. */
enum ph_path { PH_PATH_TRANSLATION, PH_PATH_ROTATION, PH_PATH_SCALE, PH_PATH_WEIGHTS };

/* How a value follows from the keys around it. */
enum ph_interpolation {
    PH_KEYS_STEP,
    PH_KEYS_LINEAR, /* rotations: slerp along the shorter arc */
    PH_KEYS_CUBIC,  /* Hermite splines, as CUBICSPLINE of glTF; rotations are normalised */
};

/*
 * Keys of one property of a node. A key has `width` numbers: x, y, z; of a rotation x, y, z, w; or the weights of the
 * targets. With PH_KEYS_CUBIC it is three times as long: the tangent before it, the value, the tangent behind it. A
 * tangent is multiplied already by the time to its neighbour. A rotation need not have length one.
 */
struct ph_track {
    uint16_t node; /* WEIGHTS: number of the first weight */
    uint8_t path, interpolation;
    uint8_t width;
    uint8_t frac; /* 8 .. 24; of a rotation it says nothing */
    uint16_t key_count;
    const fx_t *times; /* seconds, Q16.16; they rise */
    const int16_t *keys;
};

/* A clip: tracks that move nodes. */
struct ph_clip {
    const char *name;
    const struct ph_track *tracks;
    uint32_t track_count;
    fx_t duration; /* seconds, Q16.16 */
};

/* The time in a clip that repeats: 0 .. duration; 0 for a clip of no length. */
fx_t ph_clip_loop(const struct ph_clip *clip, fx_t time);

/*
 * Sets what the clip has tracks for, and leaves the rest of the pose and of the weights (Q8.24) as it is: start with
 * ph_rig_rest(). Before the first key of a track the first holds, behind the last the last. A time below 0 counts as 0.
 */
void ph_clip_sample(const struct ph_clip *clip, fx_t time, struct ph_pose *pose, int32_t *weights);

/* ---- poses ------------------------------------------------------------------------------------------------------ */

/* The rest pose: where each node is that no clip moves. */
void ph_rig_rest(const struct ph_rig *rig, struct ph_pose *pose);

/* Takes the pose a by `share` (0 .. FX_ONE) of the way to b: lerp, and slerp of rotations. */
void ph_pose_blend(struct ph_pose *a, const struct ph_pose *b, uint32_t node_count, fx_t share);

/* Spherical interpolation along the shorter arc, t = 0 .. FX_ONE; a and b have length one. */
struct fx_quat ph_quat_slerp(struct fx_quat a, struct fx_quat b, fx_t t);

/* Places in the model, whose t is Q8.24; root places the nodes without a parent, and its t is Q8.24, too. */
void ph_rig_places(const struct ph_rig *rig, const struct ph_pose *pose, const struct ph_xform *root,
                   struct ph_xform *places);

/* ---- skins ------------------------------------------------------------------------------------------------------ */

/* The joints of a skin. */
struct ph_skin {
    const uint16_t *nodes;               /* of each joint */
    const struct ph_xform *inverse_bind; /* t in Q8.24; NULL: identity */
    uint32_t joint_count;
};

/* A joint's matrix is its node's place after its inverse bind matrix. */
void ph_skin_matrices(const struct ph_skin *skin, const struct ph_xform *places, struct ph_xform *matrices);

/* Four joints and their shares, Q15, the greatest first, 0 from the first unused one on. They sum to 32768; a vertex
 * whose shares sum to less is drawn towards the origin, and more than 32768 wrap. Behind those that sum to 32768 or
 * more none counts. */
struct ph_influence {
    uint8_t joints[4];
    uint16_t weights[4];
};

#define PH_INFLUENCE_ONE 32768 /* weights of a vertex add up to it */

/* Vertices that are bound to the joints of a skin. */
struct ph_bound {
    const int16_t (*positions)[3];
    const int16_t (*normals)[3];           /* Q1.14, or NULL */
    const struct ph_influence *influences; /* NULL: all follow joint 0 */
    uint32_t vertex_count;
    uint8_t frac;     /* bits of fraction of the positions, 12 .. 24 */
    bool scales_axes; /* joints scale the axes differently: normals take the cofactors of their matrices */
};

/* Positions in Q16.16, normals of length one in Q1.14 (a zero normal stays zero), where they are asked for. */
void ph_skin_vertices(const struct ph_bound *from, const struct ph_xform *matrices, struct fx_vec3 *positions,
                      int16_t (*normals)[3]);

/* ph_skin_vertices by both cores of a renderer, if it has two; r may be NULL. */
struct ph_renderer;
void ph_skin_mesh(const struct ph_renderer *r, const struct ph_bound *from, const struct ph_xform *matrices,
                  struct fx_vec3 *positions, int16_t (*normals)[3]);

/* Targets: what each adds to the vertices at weight 1, with the fraction of the positions, and of normals Q1.14. */
struct ph_morph {
    const int16_t (*positions)[3];
    const int16_t (*normals)[3];     /* or NULL */
    const int16_t (*d_positions)[3]; /* target behind target, vertex_count each */
    const int16_t (*d_normals)[3];   /* or NULL */
    uint32_t vertex_count, target_count;
};

/* Adds the targets by their weights (Q8.24, of which -8 .. 8 counts, in steps of 2^-12); saturates at 16 bits. Error:
 * 0.5 LSB of the positions, and 2^-4 and 2^-13 of the target's own for each of at most 256 targets. */
void ph_morph_vertices(const struct ph_morph *morph, const int32_t *weights, int16_t (*positions)[3],
                       int16_t (*normals)[3]);

#ifdef __cplusplus
}
#endif

#endif
