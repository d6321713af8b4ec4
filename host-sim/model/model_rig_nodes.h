/* model_rig_nodes: what the files of model_rig know of the nodes that may move. */
#ifndef MODEL_RIG_NODES_H
#define MODEL_RIG_NODES_H

#include "model_scene.h"

#include <math.h>

/* What is known of a node beside what the scene has. */
struct model_rig_node {
    double t[3], q[4], s[3], *weights; /* at the moment that model_rig_pose() set */
    double world[3][4];                /* its place then, without the root's transform */
    double length[3];      /* how much longer the rig's unit is along each of its axes than the file's in the node */
    double *most_weights;  /* the largest size of each weight at any moment; the rig's are shares of it */
    uint32_t drawn;        /* the node that draws its meshes; MODEL_NONE: they are not shown, or stand still */
    uint32_t number;       /* in the rig; MODEL_NONE: it is not in it */
    uint32_t first_weight; /* of its morph targets, in the rig */
    bool moves;            /* a clip moves it, or what it stands in */
    bool mirrors;          /* at some moment its meshes are the mirror image of what is bound */
    bool scales_axes;      /* its meshes are scaled differently along their axes at some moment */
};

/* A moment of a clip; NULL: the rest pose. */
struct model_rig_moment {
    const struct model_clip *clip;
    double time;
};

struct model_rig {
    const struct model_scene *scene;
    struct model_rig_node *nodes;     /* of each node of the scene */
    struct animation_mesh *moving;    /* the model's */
    uint32_t *order;                  /* the nodes of the rig, parents first */
    uint32_t node_count;              /* of `order` */
    struct model_rig_moment *moments; /* the rest pose, and then what the clips show */
    size_t moment_count;
};

#define MODEL_RIG_MOST 120 /* of what Q8.24 holds: translations, scales */

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
