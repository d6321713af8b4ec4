/* See asset_mesh.h. Equal vertices become one, triangles are sorted so that vertices are used again soon
 * (asset_reuse.h), and vertices by their first use. */
#include "asset_mesh.h"
#include "asset_reuse.h"

#include <stdlib.h>
#include <string.h>

#define NONE UINT32_MAX

/* The new number of each old vertex (NONE: it is not used), and the triangles in new numbers. */
struct order {
    unsigned *remap, *indices, *scratch;
    size_t vertex_count;
};

static bool is_equal(const struct asset_shape *s, size_t a, size_t b)
{
    return memcmp(&s->positions[a], &s->positions[b], sizeof *s->positions) == 0 &&
           memcmp(s->normals[a], s->normals[b], sizeof *s->normals) == 0 &&
           (s->uvs == NULL || memcmp(s->uvs[a], s->uvs[b], sizeof *s->uvs) == 0) &&
           (s->colours == NULL || s->colours[a] == s->colours[b]) &&
           (s->sources == NULL || s->sources[a] == s->sources[b]);
}

/* FNV-1a, over words in place of bytes. */
static uint32_t mix(uint32_t hash, uint32_t word)
{
    return (hash ^ word) * 16777619u;
}

static uint32_t hash_of(const struct asset_shape *s, size_t v)
{
    const struct fx_vec3 *const p = &s->positions[v];
    const int16_t *const n = s->normals[v];
    uint32_t hash = 2166136261u;
    hash = mix(mix(mix(hash, (uint32_t)p->x), (uint32_t)p->y), (uint32_t)p->z);
    hash = mix(mix(mix(hash, (uint16_t)n[0]), (uint16_t)n[1]), (uint16_t)n[2]);
    hash = s->uvs != NULL ? mix(mix(hash, (uint32_t)s->uvs[v][0]), (uint32_t)s->uvs[v][1]) : hash;
    hash = s->sources != NULL ? mix(hash, s->sources[v]) : hash;
    return hash ^ hash >> 15;
}

/* Makes equal vertices one and leaves out unused ones. False: no memory. */
static bool join(struct order *order, const struct asset_shape *shape)
{
    size_t places = 16;
    while (places < shape->vertex_count + shape->vertex_count / 2) {
        places *= 2;
    }
    unsigned *const table = malloc(sizeof *table * places); /* the first one of each kind of vertex */
    if (table == NULL) {
        return false;
    }
    memset(table, 0xFF, sizeof *table * places);
    memset(order->remap, 0xFF, sizeof *order->remap * shape->vertex_count);
    for (size_t i = 0; i < shape->index_count; i++) {
        const unsigned v = shape->indices[i];
        if (order->remap[v] == NONE) {
            size_t at = hash_of(shape, v) & (places - 1);
            while (table[at] != NONE && !is_equal(shape, table[at], v)) {
                at = (at + 1) & (places - 1);
            }
            order->remap[v] = table[at] != NONE ? order->remap[table[at]] : (unsigned)order->vertex_count++;
            table[at] = table[at] != NONE ? table[at] : v;
        }
        order->indices[i] = order->remap[v];
    }
    free(table);
    return true;
}

/* Takes the order of the triangles in scratch if it is better. */
static void take_if_better(struct order *order, size_t count, unsigned *ages)
{
    const struct asset_corners now = {order->indices, count, order->vertex_count},
                               other = {order->scratch, count, order->vertex_count};
    if (asset_reuse_fetches(&other, ages) < asset_reuse_fetches(&now, ages)) {
        memcpy(order->indices, order->scratch, sizeof *order->indices * count);
    }
}

/* Sorts triangles in the better one of two ways, which depends on the mesh; a file may have a good order already.
 * False: no memory. */
static bool arrange(struct order *order, size_t count)
{
    unsigned *const ages = malloc(sizeof *ages * (order->vertex_count + 1));
    const struct asset_corners from = {order->indices, count, order->vertex_count};
    bool is_done = ages != NULL && asset_reuse_fans(&from, order->scratch);
    if (is_done) {
        take_if_better(order, count, ages);
        is_done = asset_reuse_scores(&from, order->scratch);
    }
    if (is_done) {
        take_if_better(order, count, ages);
    }
    free(ages);
    return is_done;
}

/* Numbers the vertices in the order of their first use. False: no memory. */
static bool sort(struct order *order, const struct asset_shape *shape)
{
    unsigned *const moves = malloc(sizeof *moves * (order->vertex_count + 1));
    if (moves == NULL) {
        return false;
    }
    memset(moves, 0xFF, sizeof *moves * order->vertex_count);
    unsigned next = 0;
    for (size_t i = 0; i < shape->index_count; i++) {
        unsigned *const move = &moves[order->indices[i]];
        *move = *move == NONE ? next++ : *move;
        order->indices[i] = *move;
    }
    for (size_t i = 0; i < shape->vertex_count; i++) {
        order->remap[i] = order->remap[i] != NONE ? moves[order->remap[i]] : NONE;
    }
    free(moves);
    return true;
}

/* Gives each vertex that is used its new number. */
static void move(const struct order *order, size_t count, const void *from, size_t bytes, void *to)
{
    for (size_t i = 0; i < count && from != NULL; i++) {
        if (order->remap[i] != NONE) {
            memcpy((uint8_t *)to + order->remap[i] * bytes, (const uint8_t *)from + i * bytes, bytes);
        }
    }
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
    move(order, from->vertex_count, from->positions, sizeof *positions, positions);
    move(order, from->vertex_count, from->normals, sizeof *normals, normals);
    move(order, from->vertex_count, from->uvs, sizeof *uvs, uvs);
    move(order, from->vertex_count, from->colours, sizeof *colours, colours);
    if (from->sources != NULL) { /* order->scratch is of no more use */
        move(order, from->vertex_count, from->sources, sizeof *from->sources, order->scratch);
        memcpy(from->sources, order->scratch, sizeof *from->sources * vertices);
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
        is_done = join(&order, shape) && arrange(&order, shape->index_count) &&
                  order.vertex_count <= MODEL_VERTICES_MAX && sort(&order, shape) && copy(arena, &order, shape, to);
    }
    free(order.remap);
    free(order.indices);
    free(order.scratch);
    return is_done;
}

double asset_fetches(const struct ph_mesh *mesh)
{
    const size_t n = (size_t)mesh->triangle_count * 3;
    unsigned *const indices = malloc(sizeof *indices * (n + 1)), *const ages = malloc(sizeof *ages *
                                                                                      ((size_t)mesh->vertex_count + 1));
    unsigned fetches = 0;
    if (indices != NULL && ages != NULL) {
        for (size_t i = 0; i < n; i++) {
            indices[i] = mesh->triangles[i / 3][i % 3];
        }
        const struct asset_corners corners = {indices, n, mesh->vertex_count};
        fetches = asset_reuse_fetches(&corners, ages);
    }
    free(indices);
    free(ages);
    return fetches;
}
