/* model_rig_clips: the clips of a scene as clips of 16-bit keys. */
#ifndef MODEL_RIG_CLIPS_H
#define MODEL_RIG_CLIPS_H

#include "model_shared.h"

/* Makes all clips; unit: how much longer the model's unit is than the file's. The rig's nodes have their numbers and
 * lengths. The numbers of the scene's tracks become those of the model. False: shared->error. */
bool model_rig_clips_make(struct model_shared *shared, struct model_motion *to, double unit);

#endif
