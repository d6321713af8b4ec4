/* model_scene: a binary scene that pinhole-asset wrote (scene_file.h) as a model. */
#ifndef MODEL_SCENE_H
#define MODEL_SCENE_H

#include "model.h"

/* 0 or COMPLAINED. It is one block of memory: free(model). */
int model_scene_open(struct model **model, const char *path);

#endif
