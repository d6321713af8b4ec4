/* model_rig_range: how far the nodes of a rig get in all moments, and what their numbers are counted in for that. */
#ifndef MODEL_RIG_RANGE_H
#define MODEL_RIG_RANGE_H

#include "model_camera.h"
#include "model_matrix.h"
#include "model_rig_nodes.h"

/*
 * Finds lengths, most_weights, scales_axes and mirrors of the rig's nodes, and in references[i] the place in which the
 * meshes of node i, if it has some, are bound: where they are in the rest pose, each axis as long as it ever gets. So
 * the positions have 16 bits of what is seen of them at most, and the elements of no joint's matrix leave -2 .. 2.
 * false: no memory.
 */
bool model_rig_ranges_find(struct model_rig *rig, model_matrix *references);

/* Calls visit for the places in the world of all vertices that move, in all moments of the clips, or at rest where
 * there is no clip; in fewer moments if there are very many vertices. false: no memory. */
bool model_rig_visit(struct model_rig *rig, const struct model_places *places,
                     void (*visit)(void *context, const double point[3]), void *context);

/* Moves what is bound outside of the model's sphere, as the clips do not show the rest pose, to its middle. */
void model_rig_settle(const struct model_rig *rig, const struct model_places *places, const struct model_fit *fit);

/* The node of the rig whose meshes this one draws; MODEL_NONE: there is none, or rig is NULL. */
uint32_t model_rig_mover(const struct model_rig *rig, uint32_t drawn);

#endif
