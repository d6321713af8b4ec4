/* model_assimp: a model file of any other format as a scene, by libassimp. noassimp/ says what to install. */
#ifndef MODEL_ASSIMP_H
#define MODEL_ASSIMP_H

#include "model_scene.h"

/* Reads the file that the model's folder names. false: shared->error. */
bool model_assimp_read(struct model_shared *shared, struct model_scene *scene);

#endif
