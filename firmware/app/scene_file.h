/*
 * scene_file: a scene as one block of bytes, FILE.phs, which is drawn where it lies: in flash, or in a file's memory.
 * pinhole-asset writes it.
 *
 * It has a head, a table of meshes, and their data at offsets from its first byte, all 4-byte aligned. Numbers are of
 * little endian, colours in wire order. A machine of big endian takes none.
 */
#ifndef SCENE_FILE_H
#define SCENE_FILE_H

#include "animation.h"

#define SCENE_FILE_MAGIC   0x53484850u /* "PHHS" */
#define SCENE_FILE_VERSION 3u
#define SCENE_FILE_MESHES  4096u /* at most */
#define SCENE_FILE_NAME    40

enum scene_file_flag { SCENE_FILE_CAMERA = 1, SCENE_FILE_BARE = 2 }; /* bare: without the platter of the turntable */

struct scene_file_head {
    uint32_t magic, version;
    uint32_t bytes; /* of all */
    uint32_t crc;   /* CRC-32 (IEEE 802.3) of what follows it */
    uint32_t mesh_count, flags, vertex_max, triangle_max;
    char name[SCENE_FILE_NAME];
    int32_t r[3][3], t[3]; /* the camera: struct ph_xform, and the lens: struct ph_projection */
    uint32_t lens_kind;
    int32_t scale_x_q20, scale_y_q20, near_z, far_z;
    uint32_t motion; /* offset of struct scene_file_motion; 0: nothing moves */
};

struct scene_file_texture {
    uint32_t texels; /* offset; 0: there is no texture */
    uint8_t log2_width, log2_height, wrap, filter, levels, spare[3];
};

enum scene_file_blend { SCENE_FILE_OPAQUE, SCENE_FILE_MASK, SCENE_FILE_ALPHA, SCENE_FILE_ADD };

/* Positions of a mesh that moves are those of struct ph_bound, else those of struct ph_mesh. */
struct scene_file_mesh {
    uint32_t positions, normals, uvs, colours, triangles, ramp; /* offsets; 0: none of uvs, colours */
    uint32_t vertex_count, triangle_count;
    int32_t ambient, diffuse, specular;
    struct scene_file_texture texture, alphas; /* alphas: of the blend */
    uint8_t shading, two_sided, shininess_log2;
    uint8_t blend, alpha; /* enum scene_file_blend; 0 .. 32 */
    uint8_t depth_bias;   /* 0 .. 56 */
    uint16_t colour;
    uint32_t moving; /* offset of struct scene_file_moving; 0: it stands still */
};

/* See struct animation. nodes: struct ph_rig_node. */
struct scene_file_motion {
    uint32_t nodes, rest_weights, clips; /* offsets */
    uint32_t node_count, weight_count, clip_count;
    uint32_t playing; /* which clip */
    int32_t r[3][3], t[3];
};

struct scene_file_clip {
    char name[SCENE_FILE_NAME];
    uint32_t tracks; /* offset */
    uint32_t track_count;
    int32_t duration;
    uint32_t time_shift;
};

struct scene_file_track {
    uint32_t times, keys; /* offsets */
    uint16_t node, key_count;
    uint8_t path, interpolation, width, frac;
};

/* See struct animation_mesh. */
struct scene_file_moving {
    uint32_t joints, inverse_bind, influences; /* offsets: uint16_t, struct ph_xform, struct ph_influence or 0 */
    uint32_t targets, target_normals;          /* offsets; 0: none */
    uint32_t joint_count, target_count, first_weight, frac;
};

/* Returns NULL if `room` bytes from a 4-byte aligned place on begin with a scene that can be drawn, else what is wrong.
 * Every offset and index is checked. */
const char *scene_file_wrong(const void *bytes, size_t room);

/* The functions below take what is right only. */

/* Makes the meshes, whose data stay where they are, in the arena. Those that move have no positions. NULL: it is full.
 */
struct ph_mesh *scene_file_meshes(const void *bytes, struct demo_arena *arena);

/* Makes the clip number i in the arena. False: it is full. */
bool scene_file_clip(const void *bytes, uint32_t i, struct demo_arena *arena, struct ph_clip *clip);

/* Makes what moves, with the clip that plays, in the arena. NULL: it is full. */
const struct animation *scene_file_animation(const void *bytes, struct demo_arena *arena);

/* Plays the clip number i from the next scene_file_animation() on: changes a scene that lies in RAM. */
void scene_file_play(void *bytes, uint32_t i);

/* What meshes, animation and its stage take of an arena. */
size_t scene_file_arena_bytes(const void *bytes);

struct demo_eye scene_file_eye(const struct scene_file_head *head);

/* Returns a demo of it. Its context->state must be `bytes`. */
struct demo scene_file_demo(const void *bytes);

#endif
