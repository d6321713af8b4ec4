/* See models.h. The edges of a mesh as lines, each once; the diagonals of quads can be left out. */
#include "models_build.h"

/* All edges by their lower vertex: upper[first[v]] .. upper[first[v + 1] - 1] are the upper ends of v's edges. */
struct edge_buckets {
    uint32_t *first; /* vertex_count + 1 */
    uint32_t *seen;  /* for each vertex: 1 + the last lower vertex that had an edge to it */
    uint16_t *upper; /* 3 * triangle_count */
};

/* Whether side 0 (a-b), 1 (b-c) or 2 (c-a) of triangle t is the diagonal of the quad (a, b, c), (a, c, d). */
static bool is_diagonal(const struct ph_mesh *mesh, uint32_t t, uint32_t side)
{
    const uint32_t even = t & ~1u;
    if (side != (t == even ? 2 : 0) || even + 1 >= mesh->triangle_count) {
        return false;
    }
    const uint16_t *const p = mesh->triangles[even];
    const uint16_t *const q = mesh->triangles[even + 1];
    return p[0] == q[0] && p[2] == q[1];
}

/* The lower and the upper end of a side. */
static void ends(const struct ph_mesh *mesh, uint32_t t, uint32_t side, uint16_t *lower, uint16_t *upper)
{
    const uint16_t a = mesh->triangles[t][side], b = mesh->triangles[t][(side + 1) % 3];
    *lower = a < b ? a : b;
    *upper = a < b ? b : a;
}

/* Sorts all sides by their lower vertex (counting sort). */
static void sort_edges(const struct ph_mesh *mesh, bool quads, const struct edge_buckets *buckets)
{
    uint16_t lower, upper;
    for (uint32_t v = 0; v <= mesh->vertex_count; v++) {
        buckets->first[v] = 0;
    }
    for (uint32_t i = 0; i < 3 * mesh->triangle_count; i++) {
        if (!quads || !is_diagonal(mesh, i / 3, i % 3)) {
            ends(mesh, i / 3, i % 3, &lower, &upper);
            buckets->first[lower]++;
        }
    }
    uint32_t sum = 0;
    for (uint32_t v = 0; v <= mesh->vertex_count; v++) {
        sum += buckets->first[v];
        buckets->first[v] = sum;
    }
    for (uint32_t i = 3 * mesh->triangle_count; i-- > 0;) {
        if (!quads || !is_diagonal(mesh, i / 3, i % 3)) {
            ends(mesh, i / 3, i % 3, &lower, &upper);
            buckets->upper[--buckets->first[lower]] = upper;
        }
    }
}

/* Writes each edge once, or only counts if edges is NULL. Returns how many there are. */
static uint32_t unique_edges(const struct edge_buckets *buckets, uint32_t vertex_count, uint16_t (*edges)[2])
{
    uint32_t count = 0;
    for (uint32_t v = 0; v < vertex_count; v++) {
        buckets->seen[v] = 0;
    }
    for (uint32_t v = 0; v < vertex_count; v++) {
        for (uint32_t i = buckets->first[v]; i < buckets->first[v + 1]; i++) {
            const uint16_t upper = buckets->upper[i];
            if (upper == v || buckets->seen[upper] == v + 1) {
                continue;
            }
            buckets->seen[upper] = v + 1;
            if (edges) {
                edges[count][0] = (uint16_t)v;
                edges[count][1] = upper;
            }
            count++;
        }
    }
    return count;
}

static int make_edges(struct demo_arena *arena, struct ph_mesh *mesh, bool quads)
{
    const size_t size = arena->size;
    struct edge_buckets buckets;
    uint16_t(*edges)[2] = NULL;
    buckets.first = model_scratch(arena, 8 * (size_t)mesh->vertex_count + 4);
    buckets.upper = model_scratch(arena, 6 * (size_t)mesh->triangle_count);
    if (buckets.first && buckets.upper) {
        buckets.seen = buckets.first + mesh->vertex_count + 1;
        sort_edges(mesh, quads, &buckets);
        const uint32_t count = unique_edges(&buckets, mesh->vertex_count, NULL);
        edges = demo_alloc(arena, count * sizeof(*edges));
        if (edges) {
            mesh->edge_count = unique_edges(&buckets, mesh->vertex_count, edges);
            mesh->edges = (const uint16_t(*)[2])edges;
        }
    }
    arena->size = size;
    return edges ? PH_OK : PH_ERR_NOMEM;
}

int model_edges(struct demo_arena *arena, struct ph_mesh *mesh)
{
    return make_edges(arena, mesh, false);
}

int model_quad_edges(struct demo_arena *arena, struct ph_mesh *mesh)
{
    return make_edges(arena, mesh, true);
}
