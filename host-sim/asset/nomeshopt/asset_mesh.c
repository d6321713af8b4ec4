/* See asset_mesh.h. Stands in where meshoptimizer is not installed: copies a mesh as it is. */
#include "asset_mesh.h"

bool asset_order(struct demo_arena *arena, const struct asset_shape *shape, struct ph_mesh *to)
{
    uint16_t(*corners)[3] = demo_alloc(arena, sizeof(uint16_t) * shape->index_count);
    if (corners == NULL || shape->vertex_count > MODEL_VERTICES_MAX) {
        return false;
    }
    for (size_t i = 0; i < shape->index_count; i++) {
        corners[i / 3][i % 3] = (uint16_t)shape->indices[i];
    }
    to->positions = shape->positions; /* the model outlives what is made of it */
    to->normals = shape->normals;
    to->uvs = shape->uvs;
    to->colours = shape->colours;
    to->triangles = (const uint16_t(*)[3])corners;
    to->vertex_count = shape->vertex_count;
    to->triangle_count = (uint32_t)(shape->index_count / 3);
    return true;
}

double asset_fetches(const struct ph_mesh *mesh)
{
    (void)mesh;
    return 0;
}
