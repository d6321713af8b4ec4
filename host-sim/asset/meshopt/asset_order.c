/* See asset_mesh.h. meshoptimizer makes equal vertices one, and sorts triangles so that vertices are used again soon.
 */
#include "asset_mesh.h"

#include <meshoptimizer.h>

#include <stdlib.h>
#include <string.h>

#define CACHE 16

static size_t list_streams(const struct asset_shape *shape, struct meshopt_Stream streams[5])
{
    streams[0] = (struct meshopt_Stream){shape->positions, sizeof *shape->positions, sizeof *shape->positions};
    streams[1] = (struct meshopt_Stream){shape->normals, sizeof *shape->normals, sizeof *shape->normals};
    size_t n = 2;
    if (shape->uvs != NULL) {
        streams[n++] = (struct meshopt_Stream){shape->uvs, sizeof *shape->uvs, sizeof *shape->uvs};
    }
    if (shape->colours != NULL) {
        streams[n++] = (struct meshopt_Stream){shape->colours, sizeof *shape->colours, sizeof *shape->colours};
    }
    if (shape->sources != NULL) {
        streams[n++] = (struct meshopt_Stream){shape->sources, sizeof *shape->sources, sizeof *shape->sources};
    }
    return n;
}

/* The new number of each old vertex, and the triangles in new numbers. */
struct order {
    unsigned *remap, *indices, *scratch;
    size_t vertex_count;
};

/* Makes equal vertices one and leaves out unused ones. */
static void join(struct order *order, const struct asset_shape *shape)
{
    struct meshopt_Stream streams[5];
    const size_t n = list_streams(shape, streams);
    order->vertex_count = meshopt_generateVertexRemapMulti(order->remap, shape->indices, shape->index_count,
                                                           shape->vertex_count, streams, n);
    meshopt_remapIndexBuffer(order->indices, shape->indices, shape->index_count, order->remap);
}

static unsigned count_fetches(const unsigned *indices, size_t count, size_t vertex_count)
{
    return meshopt_analyzeVertexCache(indices, count, vertex_count, CACHE, 0, 0).vertices_transformed;
}

/* Takes the order of the triangles in scratch if it is better. */
static void take_if_better(struct order *order, size_t count)
{
    if (count_fetches(order->scratch, count, order->vertex_count) <
        count_fetches(order->indices, count, order->vertex_count)) {
        memcpy(order->indices, order->scratch, sizeof *order->indices * count);
    }
}

/* Sorts triangles in the better one of two ways, which depends on the mesh; a file may have a good order already. */
static void arrange(struct order *order, size_t count)
{
    meshopt_optimizeVertexCacheFifo(order->scratch, order->indices, count, order->vertex_count, CACHE);
    take_if_better(order, count);
    meshopt_optimizeVertexCache(order->scratch, order->indices, count, order->vertex_count);
    take_if_better(order, count);
}

/* Vertices in the order of their first use. */
static bool sort(struct order *order, const struct asset_shape *shape)
{
    unsigned *moves = malloc(sizeof *moves * (order->vertex_count + 1));
    if (moves == NULL) {
        return false;
    }
    meshopt_optimizeVertexFetchRemap(moves, order->indices, shape->index_count, order->vertex_count);
    meshopt_remapIndexBuffer(order->indices, order->indices, shape->index_count, moves);
    for (size_t i = 0; i < shape->vertex_count; i++) {
        order->remap[i] = order->remap[i] != ~0u ? moves[order->remap[i]] : ~0u;
    }
    free(moves);
    return true;
}

static bool copy(struct demo_arena *arena, const struct order *order, const struct asset_shape *from,
                 struct ph_mesh *to)
{
    const size_t vertices = order->vertex_count, triangles = from->index_count / 3;
    struct fx_vec3 *positions = demo_alloc(arena, sizeof *positions * vertices);
    int16_t(*normals)[3] = demo_alloc(arena, sizeof *normals * vertices);
    fx_t(*uvs)[2] = from->uvs != NULL ? demo_alloc(arena, sizeof *uvs * vertices) : NULL;
    uint16_t *colours = from->colours != NULL ? demo_alloc(arena, sizeof *colours * vertices) : NULL;
    uint16_t(*corners)[3] = demo_alloc(arena, sizeof *corners * triangles);
    if (positions == NULL || normals == NULL || (from->uvs != NULL && uvs == NULL) ||
        (from->colours != NULL && colours == NULL) || corners == NULL) {
        return false;
    }
    meshopt_remapVertexBuffer(positions, from->positions, from->vertex_count, sizeof *positions, order->remap);
    meshopt_remapVertexBuffer(normals, from->normals, from->vertex_count, sizeof *normals, order->remap);
    if (uvs != NULL) {
        meshopt_remapVertexBuffer(uvs, from->uvs, from->vertex_count, sizeof *uvs, order->remap);
    }
    if (colours != NULL) {
        meshopt_remapVertexBuffer(colours, from->colours, from->vertex_count, sizeof *colours, order->remap);
    }
    if (from->sources != NULL) {
        meshopt_remapVertexBuffer(from->sources, from->sources, from->vertex_count, sizeof *from->sources,
                                  order->remap);
    }
    for (size_t i = 0; i < from->index_count; i++) {
        corners[i / 3][i % 3] = (uint16_t)order->indices[i];
    }
    to->positions = positions;
    to->normals = (const int16_t(*)[3])normals;
    to->uvs = (const fx_t(*)[2])uvs;
    to->colours = colours;
    to->triangles = (const uint16_t(*)[3])corners;
    to->vertex_count = (uint32_t)vertices;
    to->triangle_count = (uint32_t)triangles;
    return true;
}

bool asset_order(struct demo_arena *arena, const struct asset_shape *shape, struct ph_mesh *to)
{
    struct order order = {.remap = malloc(sizeof(unsigned) * (shape->vertex_count + 1)),
                          .indices = malloc(sizeof(unsigned) * (shape->index_count + 1)),
                          .scratch = malloc(sizeof(unsigned) * (shape->index_count + 1))};
    bool is_done = order.remap != NULL && order.indices != NULL && order.scratch != NULL;
    if (is_done) {
        join(&order, shape);
        arrange(&order, shape->index_count);
        is_done = order.vertex_count <= MODEL_VERTICES_MAX && sort(&order, shape) && copy(arena, &order, shape, to);
    }
    free(order.remap);
    free(order.indices);
    free(order.scratch);
    return is_done;
}

double asset_fetches(const struct ph_mesh *mesh)
{
    const size_t n = (size_t)mesh->triangle_count * 3;
    unsigned *indices = malloc(sizeof *indices * (n + 1));
    if (indices == NULL) {
        return 0;
    }
    for (size_t i = 0; i < n; i++) {
        indices[i] = mesh->triangles[i / 3][i % 3];
    }
    const unsigned fetches = count_fetches(indices, n, mesh->vertex_count);
    free(indices);
    return fetches;
}
