/*
 * scene_file: a scene as one block of bytes, FILE.phs, which is drawn where it lies: in flash, or in a file's memory.
 * pinhole-asset writes it; scene_format.h says how. A machine of big endian takes none.
 */
#ifndef SCENE_FILE_H
#define SCENE_FILE_H

#include "scene_motion.h"

/* What a program draws scenes in, by the numbers of scene_format.h: it links these shadings and filters, and no others.
 * scene_file_wrong() returns `lacks` for a scene that needs one that is not there. */
struct scene_file_shading {
    bool is_there;
    const struct ph_shading *shading;
    const char *lacks;
};

struct scene_file_filter {
    bool is_there;
    const struct ph_filter *filter;
    const char *lacks;
};

extern const struct scene_file_shading scene_file_shadings[SCENE_FILE_SHADINGS];
extern const struct scene_file_filter scene_file_filters[SCENE_FILE_FILTERS];

/* Returns NULL if `room` bytes from a 4-byte aligned place on begin with a scene that can be drawn, else what is wrong.
 * Every offset and index is checked. */
const char *scene_file_wrong(const void *bytes, size_t room);

/* The functions below take what is right only. */

/* Makes the meshes, whose data stay where they are, in the arena. Those that move have no positions. NULL: it is full.
 */
struct ph_mesh *scene_file_meshes(const void *bytes, struct demo_arena *arena);

/* What meshes, animation and its stage take of an arena, here or on a 32-bit target; and the meshes alone. */
size_t scene_file_arena_bytes(const void *bytes, bool on_32);
size_t scene_file_table_bytes(uint32_t mesh_count, bool on_32);

struct demo_eye scene_file_eye(const struct scene_file_head *head);

/* Returns a demo of it. Its context->state must be `bytes`. */
struct demo scene_file_demo(const void *bytes);

#endif
