/* model_studio: what is behind a model, and what lights it, as the options say. */
#ifndef MODEL_STUDIO_H
#define MODEL_STUDIO_H

#include "model_shared.h"

/* Makes the studio of shared->options that of the model, if they ask for one. */
void model_studio_make(struct model_shared *shared);

#endif
