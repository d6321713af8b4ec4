/* model_weld: triangles of single vertices as meshes in which equal vertices are one. */
#ifndef MODEL_WELD_H
#define MODEL_WELD_H

#include "model_scene.h"

/* Vertices are equal where all of their bits are. */
struct model_vertex {
    float position[3], normal[3], uv[2], colour[3]; /* 0 where the triangles have none */
    uint32_t source;                                /* of what moves: see struct model_moved */
};

struct model_triangles {
    uint32_t count, material;
    bool has_normals, has_uvs, has_colours;
    struct model_moved moved; /* its sources are found here */
    /* Fills corner i % 3 of triangle i / 3 into *to, which is 0. */
    void (*corner)(const void *context, size_t i, struct model_vertex *to);
    const void *context;
};

/* Adds the triangles to the scene's meshes, in their order, in as many as MODEL_VERTICES_MAX allows. false: no memory.
 */
bool model_weld(struct model_scene *scene, const struct model_triangles *from);

#endif
