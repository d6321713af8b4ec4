/* model_read: reads a model file; runs in the child process. */
#ifndef MODEL_READ_H
#define MODEL_READ_H

#include "model_shared.h"

/* Reads path into shared->model. false: shared->error says why. */
bool model_read(struct model_shared *shared, const char *path);

#endif
