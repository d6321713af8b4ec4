/* scene_motion: what moves in a binary scene (scene_format.h). */
#ifndef SCENE_MOTION_H
#define SCENE_MOTION_H

#include "animation.h"
#include "scene_format.h"

/* Whether every offset and number can be used; the meshes are right already. */
bool scene_motion_right(const struct scene_file_head *head);

/* Whether what it names can be meant: times of keys that do not fall, rotations of length one in the rest pose, shares
 * of joints that sum to one. scene_motion_right() said yes. */
bool scene_motion_can_move(const struct scene_file_head *head);

/* The functions below take what is right only, and but for scene_motion_bytes() where head->motion is not 0. */

/* Track number i of a clip. */
struct ph_track scene_motion_track(const struct scene_file_head *head, const struct scene_file_clip *clip, uint32_t i);

/* Makes what moves, with all clips, in the arena. Tracks stay where they are: the clips have their count, and a
 * sample() of the animation's own. NULL: it is full. */
const struct animation *scene_motion_make(const struct scene_file_head *head, struct demo_arena *arena);

/* Bytes that the scene's animation and its stage take of an arena, here or on a 32-bit target; 0 if nothing moves. */
size_t scene_motion_bytes(const struct scene_file_head *head, bool on_32);

/* Bytes of scene_motion_bytes that are not the stage's, with so many meshes that move and clips. */
size_t scene_motion_table_bytes(uint32_t mesh_count, uint32_t clip_count, bool on_32);

/* Begins with the clip number i from the next scene_motion_make() on: changes a scene that lies in RAM. */
void scene_motion_play(struct scene_file_head *head, uint32_t i);

#endif
