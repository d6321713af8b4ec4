/* asset_mesh: what meshoptimizer does for asset.h; meshopt/ has it, nomeshopt/ copies and refuses. */
#ifndef ASSET_MESH_H
#define ASSET_MESH_H

#include "asset.h"

/* Triangles with indices of any size; uvs may be NULL. */
struct asset_shape {
    const struct fx_vec3 *positions;
    const int16_t (*normals)[3];
    const fx_t (*uvs)[2];
    uint32_t vertex_count;
    const unsigned *indices;
    size_t index_count;
};

/*
 * Gives to->positions, normals, uvs, triangles and their counts: equal vertices once, triangles in an order in which
 * vertices are used again soon, vertices in the order of their first use. False: the arena is full, or more than
 * MODEL_VERTICES_MAX vertices remain.
 */
bool asset_order(struct demo_arena *arena, const struct asset_shape *shape, struct ph_mesh *to);

/* Vertices that are fetched for all triangles of the mesh, with the 16 used last at hand. */
double asset_fetches(const struct ph_mesh *mesh);

/* Triangles that remain of a model. Vertices are counted through all meshes; meshes follow each other. */
struct asset_rest {
    unsigned *indices; /* free() it */
    size_t index_count;
    enum asset_way way;
    double error; /* as struct asset */
};

/* All triangles. 0, or COMPLAINED when one line has said why. */
int asset_keep_all(const struct model *model, struct asset_rest *rest);

/* At most `triangles` of them; more where that is not to be had. 0, or COMPLAINED as above. */
int asset_simplify(const struct model *model, uint32_t triangles, struct asset_rest *rest);

/*
 * Normals for corners without any: corner i is at places[i], three make a triangle. Flat, or smooth but where faces
 * meet at more than 66 degrees. False: no memory.
 */
bool asset_normals(const struct fx_vec3 *places, size_t count, bool is_flat, int16_t (*normals)[3]);

#endif
