/*
 * scene_file: a scene as one block of bytes, FILE.phs, which is drawn where it lies: in flash, or in a file's memory.
 * pinhole-asset writes it.
 *
 * It has a head, a table of meshes, and their data at offsets from its first byte, all 4-byte aligned. Numbers are of
 * little endian, colours in wire order. A machine of big endian takes none.
 */
#ifndef SCENE_FILE_H
#define SCENE_FILE_H

#include "demo.h"

#define SCENE_FILE_MAGIC   0x53484850u /* "PHHS" */
#define SCENE_FILE_VERSION 2u
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
};

struct scene_file_texture {
    uint32_t texels; /* offset; 0: there is no texture */
    uint8_t log2_width, log2_height, wrap, filter, levels, spare[3];
};

enum scene_file_blend { SCENE_FILE_OPAQUE, SCENE_FILE_MASK, SCENE_FILE_ALPHA, SCENE_FILE_ADD };

struct scene_file_mesh {
    uint32_t positions, normals, uvs, colours, triangles, ramp; /* offsets; 0: none of uvs, colours */
    uint32_t vertex_count, triangle_count;
    int32_t ambient, diffuse, specular;
    struct scene_file_texture texture, alphas; /* alphas: of the blend */
    uint8_t shading, two_sided, shininess_log2;
    uint8_t blend, alpha; /* enum scene_file_blend; 0 .. 32 */
    uint8_t depth_bias;   /* 0 .. 56 */
    uint16_t colour;
};

/* Returns NULL if `room` bytes from a 4-byte aligned place on begin with a scene that can be drawn, else what is wrong.
 * Every offset and index is checked. */
const char *scene_file_wrong(const void *bytes, size_t room);

/* The functions below take what is right only. */

/* Makes the meshes, whose data stay where they are, in the arena. NULL: it is full. */
struct ph_mesh *scene_file_meshes(const void *bytes, struct demo_arena *arena);
size_t scene_file_arena_bytes(const void *bytes); /* what that takes */

struct demo_eye scene_file_eye(const struct scene_file_head *head);

/* Returns a demo of it. Its context->state must be `bytes`. */
struct demo scene_file_demo(const void *bytes);

#endif
