/* asset_mesh: the parts of asset.h: order, simplification, motion, normals. */
#ifndef ASSET_MESH_H
#define ASSET_MESH_H

#include "asset.h"

/* Triangles with indices of any size; uvs and colours may be NULL. */
struct asset_shape {
    const struct fx_vec3 *positions;
    const int16_t (*normals)[3];
    const fx_t (*uvs)[2];
    const uint16_t *colours;
    uint32_t vertex_count;
    const unsigned *indices;
    size_t index_count;
    unsigned *sources; /* NULL, or of each vertex one of the model: those of different ones stay apart */
};

/*
 * Sets positions, normals, uvs, colours, triangles and their counts in *to. Equal vertices become one; triangles are
 * ordered so that vertices are used again soon, and vertices by their first use; so are the sources. False: the arena
 * is full, or more than MODEL_VERTICES_MAX vertices remain.
 */
bool asset_order(struct demo_arena *arena, const struct asset_shape *shape, struct ph_mesh *to);

/* Returns how many vertices are fetched for all triangles if the 16 used last are kept. */
double asset_fetches(const struct ph_mesh *mesh);

/* The triangles that remain of a model. Vertices are numbered through all meshes in order. */
struct asset_rest {
    unsigned *indices; /* free() it */
    size_t index_count;
    bool is_simplified;
    double error; /* as struct asset */
};

/* Keeps all triangles but those with two corners in one place. 0 or COMPLAINED. */
int asset_keep_all(const struct model *model, struct asset_rest *rest);

/* Keeps at most `triangles` of them, or more where the model cannot be simplified that far; each has three vertices of
 * one mesh. 0 or COMPLAINED. */
int asset_simplify(const struct model *model, uint32_t triangles, struct asset_rest *rest);

/* The arena that all that moves takes, when so many triangles remain. */
size_t asset_motion_room(const struct model *model, uint32_t triangles);

/* Begins the animation of an asset, without its meshes. False: the arena is full. */
bool asset_motion_begin(struct demo_arena *arena, const struct model *model, struct model *to);

/* Lets mesh number `mesh` of the asset move as `from` does, of which its vertices are the sources. False: the arena is
 * full. */
bool asset_motion_add(struct demo_arena *arena, const struct animation_mesh *from, const unsigned *sources,
                      struct model *to, uint32_t mesh);

/* Makes flat normals: corner i is at places[i], and three corners make a triangle. */
void asset_normals(const struct fx_vec3 *places, size_t count, int16_t (*normals)[3]);

#endif
