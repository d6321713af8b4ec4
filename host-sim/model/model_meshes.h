/* model_meshes: a scene's meshes, fitted to the unit sphere; the camera is fitted with them. */
#ifndef MODEL_MESHES_H
#define MODEL_MESHES_H

#include "model_scene.h"

/* Makes the model's meshes of a scene. false: shared->error says why. */
bool model_meshes_read(struct model_shared *shared, const struct model_scene *scene);

#endif
