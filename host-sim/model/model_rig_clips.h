/* model_rig_clips: the clips of a scene as clips of 16-bit keys. */
#ifndef MODEL_RIG_CLIPS_H
#define MODEL_RIG_CLIPS_H

#include "model_camera.h"
#include "model_rig_nodes.h"

/* How much longer the rig's unit is in what node i stands in than the file's, but for the model's scale. */
double model_rig_above(const struct model_rig *rig, uint32_t i);

/* What translations of node i count from: the middle of the model where it stands in no other node, else 0. */
void model_rig_origin(const struct model_rig *rig, uint32_t i, const struct model_fit *fit, double origin[3]);

/* Makes all clips. The rig's nodes have their numbers and lengths. The numbers of the scene's tracks become those of
 * the model. False: shared->error. */
bool model_rig_clips_make(struct model_shared *shared, struct model_motion *to, const struct model_fit *fit);

#endif
