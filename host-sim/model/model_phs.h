/* model_phs: a binary scene that pinhole-asset wrote (scene_file.h) as a model. */
#ifndef MODEL_PHS_H
#define MODEL_PHS_H

#include "model.h"

/* Opens a binary scene as a model. 0 or COMPLAINED. It is one block of memory: free(model). */
int model_phs_open(struct model **model, const char *path);

#endif
