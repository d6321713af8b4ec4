/* scene_motion: the animation in a binary scene, for scene_file.c. */
#ifndef SCENE_MOTION_H
#define SCENE_MOTION_H

#include "scene_file.h"

/* Whether so many things from an offset on lie behind the head, and in the scene. */
bool scene_file_inside(const struct scene_file_head *head, uint32_t offset, uint32_t count, uint32_t size);

static inline const struct scene_file_mesh *scene_file_table(const void *bytes)
{
    return (const void *)((const uint8_t *)bytes + sizeof(struct scene_file_head));
}

/* Whether every offset and number can be used; the meshes are right already. */
bool scene_motion_right(const struct scene_file_head *head);

/* What scene_file_animation() and its stage take of an arena; 0 if nothing moves. */
size_t scene_motion_bytes(const struct scene_file_head *head);

#endif
