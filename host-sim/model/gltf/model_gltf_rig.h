/* model_gltf_rig: what is known of the nodes and meshes of a glTF file that may move. */
#ifndef MODEL_GLTF_RIG_H
#define MODEL_GLTF_RIG_H

#include "gltf_file.h"
#include "model_camera.h"
#include "model_places.h"

#include <math.h>

#define MODEL_GLTF_TARGETS_MAX 200

/* What moves the vertices of a mesh; arrays of the primitive's vertices. */
struct model_gltf_moved {
    float *joints, *weights; /* four for each vertex, or NULL */
    float **targets;         /* what is added to each position, or NULL */
    float **target_normals;  /* the same of each normal */
    bool has_normals;        /* some target has */
    uint32_t target_count;
    uint32_t *sources; /* the primitive's vertex of each vertex of the mesh */
};

/* A node of the file. */
struct model_gltf_node {
    const struct gltf_json *json;
    struct aiNode *drawn; /* draws its mesh; NULL: it is not in the scene */
    int32_t parent;       /* -1: none */
    double world[3][4];   /* its place in the rest pose, without the root's transform */
    uint32_t number;      /* in the rig */
    double length;        /* how much longer the model's unit is than the node's */
    uint32_t first_weight, weight_count;
};

struct model_gltf_motion {
    struct gltf_file *file;
    const struct aiScene *scene;
    struct model_gltf_moved *moved; /* of each mesh of the scene */
    struct model_gltf_node *nodes;
    struct animation_mesh *moving; /* the model's */
    uint32_t *order;               /* the nodes of the scene, parents first */
    uint32_t node_count;
};

/* value within -most .. most; 0 if it is none. */
static inline double model_gltf_clamp(double value, double most)
{
    return value > most ? most : value < -most ? -most : isfinite(value) ? value : 0;
}

/* Keeps the greatest error. */
static inline void model_gltf_note(double *most, double error)
{
    *most = fmax(*most, fabs(error));
}

#endif
