/*
 * model_gltf_motion: animations, skins and morph targets of a glTF file as struct model_motion (model.h). Scales of the
 * rest pose go into the lengths, so that no matrix of a joint leaves -2 .. 2 because a file's unit is another.
 */
#ifndef MODEL_GLTF_MOTION_H
#define MODEL_GLTF_MOTION_H

#include "gltf_file.h"
#include "model_camera.h"
#include "model_places.h"

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
    const struct cJSON *json;
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

/* Finds the nodes' places, and moves what a skin draws to where its joints have it. False: file->error says why. */
bool model_gltf_motion_find(struct model_gltf_motion *motion, struct aiNode *root);

/* Makes rig and clips in shared->model, and room for `meshes` that move, if something does. False: shared->error. */
bool model_gltf_motion_begin(struct model_shared *shared, const struct model_fit *fit, size_t meshes);

/* Lets a mesh follow the rig: vertices[i] is the vertex of the place's mesh that became vertex i. */
bool model_gltf_motion_bind(struct model_shared *shared, const struct model_place *place, const struct model_fit *fit,
                            const unsigned *vertices, uint32_t mesh);

#endif
