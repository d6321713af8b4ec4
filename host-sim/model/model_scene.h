/*
 * model_scene: what a reader has found in a model file: nodes that show meshes, and what moves them. Each format has a
 * reader that makes this; model_meshes.h makes the model of it.
 *
 * Positions are the file's, y is up unless `root` turns them. Texture coordinates have v downwards. Colours are those
 * of the display. Triangles look outwards where they turn anticlockwise. All indices are right: who makes a scene
 * checks them. Nothing of it is freed: the process that reads a model ends when it is done.
 */
#ifndef MODEL_SCENE_H
#define MODEL_SCENE_H

#include "model_surface.h"

#define MODEL_NONE UINT32_MAX /* in place of an index */

/* What moves the vertices of a mesh. */
struct model_moved {
    float *joints, *weights; /* four for each source, or NULL */
    float **targets;         /* what a morph target adds to the position of each source; an element may be NULL */
    float **target_normals;  /* what it adds to the normals */
    bool has_normals;        /* some target has */
    uint32_t target_count;
    uint32_t *sources; /* of each vertex of the mesh; NULL where nothing moves it */
};

/* Vertices of one material; arrays that a file does not have are NULL. */
struct model_mesh {
    float (*positions)[3], (*normals)[3], (*uvs)[2], (*colours)[3];
    uint32_t (*triangles)[3];
    uint32_t vertex_count, triangle_count, material;
    struct model_moved moved;
};

struct model_node {
    float m[3][4];                /* to the parent: three rows, the last column is the translation */
    double t[3], q[4], s[3];      /* of what moves: m as translation, rotation (x, y, z, w) and scale */
    uint32_t parent, child, next; /* of the tree: the first child, and the next one of the same parent; or MODEL_NONE */
    uint32_t first_mesh, mesh_count;
    uint32_t skin;   /* or MODEL_NONE */
    double *weights; /* of the morph targets at rest; may be NULL */
    uint32_t weight_count;
    bool is_shown;     /* it is in the tree */
    bool is_bound;     /* its meshes are bound in another place than it has at rest: in `bound` */
    float bound[3][4]; /* to the world, but for root */
};

struct model_skin {
    uint32_t *joints; /* nodes */
    uint32_t count;
    float *bind; /* the inverse bind matrix of each, 16 numbers, column by column; or NULL */
};

/* The keys of one property of a node. */
struct model_track {
    uint32_t node;
    uint8_t path, interpolation; /* enum ph_path, enum ph_interpolation */
    float *times, *numbers;      /* numbers of a cubic key: tangent, value, tangent */
    uint32_t keys, width;        /* numbers of a value */
};

struct model_clip {
    const char *name; /* may be NULL or empty */
    struct model_track *tracks;
    uint32_t count;
};

/* The first camera. A camera looks along `forward` from `position`, both as its node has them. */
struct model_camera {
    const char *name;
    uint32_t node; /* MODEL_NONE: it stands in none */
    float position[3], forward[3], up[3];
    float fov_x;         /* radians */
    float half_width;    /* of what an orthographic camera sees; 0: it is none */
    float aspect;        /* width / height; 0: that of the panel */
    float near_z, far_z; /* 0: the file does not say */
};

struct model_scene {
    struct model_material *materials;
    struct model_mesh *meshes;
    struct model_node *nodes;
    struct model_skin *skins;
    struct model_clip *clips;
    struct model_camera camera;
    uint32_t material_count, mesh_count, node_count, skin_count, clip_count, camera_count;
    uint32_t first_node; /* of those without a parent */
    float root[3][4];    /* takes them to the world */
};

/* Whether a scene has anything that moves a vertex. */
bool model_scene_moves(const struct model_scene *scene);

/* The node behind `node`, or the first one (MODEL_NONE): parents come before their children, children in their order.
 * MODEL_NONE: there is no other. */
uint32_t model_scene_next(const struct model_scene *scene, uint32_t node);

/* Gives a scene without nodes one that shows all meshes. false: no memory. */
bool model_scene_one_node(struct model_scene *scene);

/* to = parent * local: three rows each, the last column is the translation. */
void model_scene_multiply(double to[3][4], double (*parent)[4], const float (*local)[4]);

#endif
