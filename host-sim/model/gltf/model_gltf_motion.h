/*
 * model_gltf_motion: animations, skins and morph targets of a glTF file as struct model_motion (model.h). Scales of the
 * rest pose go into the lengths, so that no matrix of a joint leaves -2 .. 2 because a file's unit is another.
 */
#ifndef MODEL_GLTF_MOTION_H
#define MODEL_GLTF_MOTION_H

#include "model_gltf_rig.h"

/* Finds the nodes' places, and moves what a skin draws to where its joints have it. False: file->error says why. */
bool model_gltf_motion_find(struct model_gltf_motion *motion, struct aiNode *root);

/* Makes rig and clips in shared->model, and room for `meshes` that move, if something does. False: shared->error. */
bool model_gltf_motion_begin(struct model_shared *shared, const struct model_fit *fit, size_t meshes);

/* Lets a mesh follow the rig: vertices[i] is the vertex of the place's mesh that became vertex i. */
bool model_gltf_motion_bind(struct model_shared *shared, const struct model_place *place, const struct model_fit *fit,
                            const unsigned *vertices, uint32_t mesh);

#endif
