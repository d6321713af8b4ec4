/* model_rig_nodes: what model_rig.c and model_rig_clips.c know of the nodes that may move. */
#ifndef MODEL_RIG_NODES_H
#define MODEL_RIG_NODES_H

#include "model_scene.h"

#include <math.h>

/* What is known of a node beside what the scene has. */
struct model_rig_node {
    double world[3][4];    /* its place in the rest pose, without the root's transform */
    double length;         /* how much longer the model's unit is than the node's */
    uint32_t drawn;        /* the node that draws its meshes; MODEL_NONE: it is not shown */
    uint32_t number;       /* in the rig */
    uint32_t first_weight; /* of its morph targets, in the rig */
};

struct model_rig {
    const struct model_scene *scene;
    struct model_rig_node *nodes;  /* of each node of the scene */
    struct animation_mesh *moving; /* the model's */
    uint32_t *order;               /* the nodes that are shown, parents first */
    uint32_t node_count;           /* of `order` */
};

/* Clamps a value to -most .. most; 0 if it is none. */
static inline double model_rig_clamp(double value, double most)
{
    return value > most ? most : value < -most ? -most : isfinite(value) ? value : 0;
}

/* Keeps the greatest error. */
static inline void model_rig_note(double *most, double error)
{
    *most = fmax(*most, fabs(error));
}

#endif
