/* model_framing: whether the camera of a file shows the model, by a look at what it draws. */
#ifndef MODEL_FRAMING_H
#define MODEL_FRAMING_H

#include "model_shared.h"

/*
 * Takes the model's camera away, so that it stands on the turntable, where less than 5 % of the camera's picture show
 * the model; notes that, and a model of which the turntable shows less than 1 %. Of a clip the best of 8 frames counts.
 * The model stays as it is where there is no memory to draw it.
 */
void model_framing_check(struct model_shared *shared);

#endif
