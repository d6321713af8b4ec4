/* model_rig_pose: where the nodes of a rig are at a moment of a clip, in double precision and in the file's units. */
#ifndef MODEL_RIG_POSE_H
#define MODEL_RIG_POSE_H

#include "model_rig_nodes.h"

/* Sets pose, weights and place of every node of the rig at a moment. The clips have the file's numbers. */
void model_rig_pose(struct model_rig *rig, const struct model_rig_moment *moment);

/* Makes the list of moments: the rest pose, and of each clip the times of its keys, of which very many are thinned out,
 * and others between them. false: no memory. */
bool model_rig_moments_find(struct model_rig *rig);

#endif
