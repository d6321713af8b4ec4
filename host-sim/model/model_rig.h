/*
 * model_rig: clips, skins and morph targets of a scene as struct model_motion (model.h). Each node counts in units of
 * the greatest size that it gets in any clip, so that no matrix of a joint leaves -2 .. 2, whatever a file's unit is;
 * weights of targets are shares of their greatest. What no clip moves is no part of it.
 */
#ifndef MODEL_RIG_H
#define MODEL_RIG_H

#include "model_camera.h"

/* Makes shared->rig if something moves, and shows what moves where it is bound. false: no memory. */
bool model_rig_find(struct model_shared *shared, struct model_scene *scene);

/* Makes rig and clips in shared->model, and room for `meshes` that move, if something does. False: shared->error. */
bool model_rig_begin(struct model_shared *shared, const struct model_fit *fit, size_t meshes);

/* Lets a mesh follow the rig: vertices[i] is the vertex of the place's mesh that became vertex i. */
bool model_rig_bind(struct model_shared *shared, const struct model_place *place, const struct model_fit *fit,
                    const unsigned *vertices, uint32_t mesh);

#endif
