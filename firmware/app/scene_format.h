/*
 * scene_format: the bytes of a binary scene (scene_file.h): a head, a table of meshes behind it, and what both name by
 * offsets from the head's first byte, all 4-byte aligned. Numbers are of little endian, colours in wire order.
 *
 * scene_file_wrong() refuses what cannot be drawn or cannot be meant. What follows is allowed, and drawn like this:
 *
 * - vertex_max, triangle_max are a wish. Too low: what has no room is left out and counted. Too high: the image says
 *   that it needs more memory, and shows its demos.
 * - SCENE_FILE_BARE says nothing beside SCENE_FILE_CAMERA; a camera without that flag is not looked at.
 * - A mesh without triangles, a triangle with equal corners or without area cover no pixel.
 * - Vertices that no triangle names, data that meshes share, bytes that nothing names do no harm.
 * - Positions far away saturate, and are clipped.
 * - Normals of length 0 have ambient light only; those of another length than 16384 are darker or brighter.
 * - Texture coordinates outside of 0 .. 1 are taken as the texture's wrap says.
 * - With alpha 0 nothing of the mesh shows.
 * - Of a studio without a lamp the direction says nothing.
 * - SCENE_FILE_MIPMAP without levels has its one level.
 * - A clip of 0 s stands at its beginning; keys behind the duration are never reached.
 * - A track without keys moves nothing; of two tracks for one property the later one counts.
 * - Two keys with the same time are a jump. Keys of rotations may have any length; 0 is no rotation.
 * - Weights of targets may have any size; -8 .. 8 counts.
 * - Places of the rig and of joints may scale, mirror and shear; what leaves Q16.16 saturates.
 * - A motion that no mesh follows moves nothing.
 * - SCENE_FILE_IN_TURN says nothing where there are fewer than two clips; with it, `playing` says nothing.
 */
#ifndef SCENE_FORMAT_H
#define SCENE_FORMAT_H

#include <stdbool.h>
#include <stdint.h>

#define SCENE_FILE_MAGIC   0x53484850u /* "PHHS" */
#define SCENE_FILE_VERSION 6u
#define SCENE_FILE_MESHES  4096u /* at most */
#define SCENE_FILE_NAME    40

/* BARE: without the platter of the turntable. STUDIO: a struct demo_studio stands behind the table of meshes. IN_TURN:
 * the clips play by themselves. */
enum scene_file_flag { SCENE_FILE_CAMERA = 1, SCENE_FILE_BARE = 2, SCENE_FILE_STUDIO = 4, SCENE_FILE_IN_TURN = 8 };

struct scene_file_head {
    uint32_t magic, version;
    uint32_t bytes; /* of all */
    uint32_t crc;   /* CRC-32 (IEEE 802.3) of what follows it */
    uint32_t mesh_count, flags, vertex_max, triangle_max;
    char name[SCENE_FILE_NAME]; /* without control characters; it ends with 0 */
    int32_t r[3][3], t[3];      /* the camera: struct ph_xform, a rotation, and the lens: struct ph_projection */
    uint32_t lens_kind;         /* perspective or orthographic */
    int32_t scale_x_q20, scale_y_q20, near_z, far_z;
    uint32_t motion; /* offset of struct scene_file_motion; 0: nothing moves */
};

struct scene_file_texture {
    uint32_t texels;                                                 /* offset; 0: there is no texture */
    uint8_t log2_width, log2_height, wrap, filter, levels, spare[3]; /* wrap, filter: numbers; spare: 0 */
};

/* Numbers of wraps: enum ph_wrap with 1 and 3 exchanged, for 1 was the clamp before there was one for each way. */
enum scene_file_wrap_number { SCENE_FILE_REPEAT, SCENE_FILE_CLAMP, SCENE_FILE_CLAMP_V, SCENE_FILE_CLAMP_U };

/* The number of an enum ph_wrap, and the enum ph_wrap of a number. */
static inline uint8_t scene_file_wrap(uint8_t wrap)
{
    return (uint8_t)((wrap & 1) << 1 ^ wrap);
}

/* Numbers of filters. */
enum scene_file_filter_number { SCENE_FILE_NEAREST, SCENE_FILE_BILINEAR, SCENE_FILE_MIPMAP, SCENE_FILE_FILTERS };

enum scene_file_blend { SCENE_FILE_OPAQUE, SCENE_FILE_MASK, SCENE_FILE_ALPHA, SCENE_FILE_ADD, SCENE_FILE_TIMES };

/* Shadings: the name after PH_SHADE_, the number in a scene, the name in a message, and whether a texture is drawn. 5
 * is no scene's. */
#define SCENE_FILE_SHADING_EACH(S)                                                                                     \
    S(UNLIT, 0, "unlit", false)                                                                                        \
    S(FLAT, 1, "flat", false)                                                                                          \
    S(GOURAUD, 2, "gouraud", false)                                                                                    \
    S(TEXTURE, 3, "texture", true)                                                                                     \
    S(TEXTURE_LIT, 4, "texture-lit", true)                                                                             \
    S(TEXTURE_GOURAUD, 6, "texture-gouraud", true)
#define SCENE_FILE_NUMBER(name, number, word, is_textured) SCENE_FILE_##name = (number),
enum scene_file_shading_number { SCENE_FILE_SHADING_EACH(SCENE_FILE_NUMBER) SCENE_FILE_SHADINGS };

/* Positions of a mesh that moves are those of struct ph_bound, else those of struct ph_mesh. */
struct scene_file_mesh {
    uint32_t positions, normals, uvs, colours, triangles, ramp; /* offsets; 0: none of uvs, colours */
    uint32_t vertex_count, triangle_count;
    int32_t ambient, diffuse, specular;
    struct scene_file_texture texture, alphas;  /* alphas: of the blend; a mask has them */
    uint8_t shading, two_sided, shininess_log2; /* enum scene_file_shading_number; 0 or 1 */
    uint8_t blend, alpha;                       /* enum scene_file_blend; 0 .. 32 */
    uint8_t depth_bias;                         /* 0 .. 56 */
    uint16_t colour;
    uint32_t moving; /* offset of struct scene_file_moving; 0: it stands still */
};

/* The animation of a scene, as struct animation has it. nodes: struct ph_rig_node. */
struct scene_file_motion {
    uint32_t nodes, rest_weights, clips; /* offsets */
    uint32_t node_count, weight_count, clip_count;
    uint32_t playing;   /* which clip begins */
    int32_t cross_fade; /* Q16.16 seconds, 0 or more */
    int32_t r[3][3], t[3];
    uint32_t outline, outline_count; /* an offset: struct fx_vec3 */
};

struct scene_file_clip {
    char name[SCENE_FILE_NAME];
    uint32_t tracks; /* offset */
    uint32_t track_count;
    int32_t duration;
};

struct scene_file_track {
    uint32_t times, keys; /* offsets; tracks may share their times */
    uint16_t node, key_count;
    uint8_t path, interpolation, width, frac;
};

/* A mesh that moves, as struct animation_mesh has it. */
struct scene_file_moving {
    uint32_t joints, inverse_bind, influences; /* offsets: uint16_t, struct ph_xform, struct ph_influence or 0 */
    uint32_t targets, target_normals;          /* offsets; 0: none */
    uint32_t joint_count, target_count, first_weight;
    uint8_t frac, scales_axes; /* of struct ph_bound; scales_axes: 0 or 1 */
    uint16_t spare;            /* 0 */
};

static inline const struct scene_file_mesh *scene_file_table(const struct scene_file_head *head)
{
    return (const void *)((const uint8_t *)head + sizeof(*head));
}

/* The offset of its studio, where it has one. */
static inline uint32_t scene_file_studio(const struct scene_file_head *head)
{
    return (uint32_t)(sizeof(*head) + head->mesh_count * sizeof(struct scene_file_mesh));
}

/* What is at an offset, which may be none that is in the scene until it was checked; 0: NULL. */
static inline const void *scene_file_at(const struct scene_file_head *head, uint32_t offset)
{
    return offset != 0 ? (const void *)((uintptr_t)head + offset) : NULL;
}

/* Whether so many things from an offset on lie behind the head, and in the scene. */
static inline bool scene_file_inside(const struct scene_file_head *head, uint32_t offset, uint32_t count, uint32_t size)
{
    return offset % 4 == 0 && offset >= sizeof(*head) && offset <= head->bytes &&
           (uint64_t)count * size <= head->bytes - offset;
}

#endif
