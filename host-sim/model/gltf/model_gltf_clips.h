/*
 * model_gltf_clips: the animations of a glTF file as clips of 16-bit keys.
 */
#ifndef MODEL_GLTF_CLIPS_H
#define MODEL_GLTF_CLIPS_H

#include "model_camera.h"
#include "model_places.h"

/* Reads all animations; unit: how much longer the model's unit is than the file's. The rig's nodes have their numbers
 * and lengths. False: shared->error. */
bool model_gltf_clips_read(struct model_shared *shared, struct model_motion *to, double unit);

#endif
