/* See model_weld.h. */
#include "model_weld.h"

#include <stdlib.h>
#include <string.h>

/* A mesh that grows vertex by vertex; equal vertices are found by a hash table. */
struct welder {
    struct model_vertex *vertices;
    uint32_t *table, mask, count; /* the table holds index + 1, or 0 */
};

static uint32_t weld(struct welder *w, const struct model_vertex *v)
{
    uint32_t words[sizeof *v / 4], hash = 2166136261u;
    memcpy(words, v, sizeof words);
    for (size_t i = 0; i < sizeof words / 4; i++) {
        hash = (hash ^ words[i]) * 16777619u;
        hash ^= hash >> 15;
    }
    for (;; hash++) {
        uint32_t *slot = &w->table[hash & w->mask];
        if (*slot == 0) {
            w->vertices[w->count] = *v;
            *slot = ++w->count;
        }
        /* NOLINTNEXTLINE(bugprone-suspicious-memory-comparison,cert-exp42-c,cert-flp37-c): the same bits are meant */
        if (memcmp(&w->vertices[*slot - 1], v, sizeof *v) == 0) {
            return *slot - 1;
        }
    }
}

/* The vertices of the welder as arrays of a mesh. */
static bool fill_mesh(struct model_mesh *mesh, const struct welder *w, const struct model_triangles *from)
{
    const bool moves = from->moved.joints != NULL || from->moved.target_count > 0;
    mesh->positions = calloc(w->count, sizeof *mesh->positions);
    mesh->normals = from->has_normals ? calloc(w->count, sizeof *mesh->normals) : NULL;
    mesh->uvs = from->has_uvs ? calloc(w->count, sizeof *mesh->uvs) : NULL;
    mesh->colours = from->has_colours ? calloc(w->count, sizeof *mesh->colours) : NULL;
    mesh->moved.sources = moves ? calloc(w->count, sizeof *mesh->moved.sources) : NULL;
    if (mesh->positions == NULL || (from->has_normals && mesh->normals == NULL) ||
        (from->has_uvs && mesh->uvs == NULL) || (from->has_colours && mesh->colours == NULL) ||
        (moves && mesh->moved.sources == NULL)) {
        return false;
    }
    for (uint32_t i = 0; i < w->count; i++) {
        const struct model_vertex *v = &w->vertices[i];
        memcpy(mesh->positions[i], v->position, sizeof v->position);
        if (from->has_normals) {
            memcpy(mesh->normals[i], v->normal, sizeof v->normal);
        }
        if (from->has_uvs) {
            memcpy(mesh->uvs[i], v->uv, sizeof v->uv);
        }
        if (from->has_colours) {
            memcpy(mesh->colours[i], v->colour, sizeof v->colour);
        }
        if (moves) {
            mesh->moved.sources[i] = v->source;
        }
    }
    mesh->vertex_count = w->count;
    return true;
}

/* Makes a mesh of triangles from *next on, as many as there are or as its vertices allow. */
static bool make_mesh(struct model_mesh *mesh, const struct model_triangles *from, struct welder *w, uint32_t *next)
{
    *mesh = (struct model_mesh){.material = from->material, .moved = from->moved};
    mesh->triangles = calloc(from->count - *next, sizeof *mesh->triangles);
    if (mesh->triangles == NULL) {
        return false;
    }
    memset(w->table, 0, sizeof *w->table * (w->mask + 1));
    w->count = 0;
    for (; *next < from->count && w->count + 3 <= MODEL_VERTICES_MAX; ++*next) {
        for (int i = 0; i < 3; i++) {
            struct model_vertex v = {.source = 0};
            from->corner(from->context, 3 * (size_t)*next + (size_t)i, &v);
            mesh->triangles[mesh->triangle_count][i] = weld(w, &v);
        }
        mesh->triangle_count++;
    }
    return fill_mesh(mesh, w, from);
}

bool model_weld(struct model_scene *scene, const struct model_triangles *from)
{
    struct welder w = {.mask = 15};
    const uint64_t corners = (uint64_t)from->count * 3;
    while (w.mask < 2 * MODEL_VERTICES_MAX && w.mask < 2 * corners) {
        w.mask = w.mask * 2 + 1;
    }
    w.table = calloc(w.mask + 1, sizeof *w.table);
    w.vertices = calloc((w.mask + 1) / 2, sizeof *w.vertices); /* the table has twice as many places as vertices */
    bool done = w.table != NULL && w.vertices != NULL;
    for (uint32_t next = 0; done && next < from->count;) {
        struct model_mesh *more = model_shared_grow(scene->meshes, scene->mesh_count, sizeof *more);
        scene->meshes = more != NULL ? more : scene->meshes;
        done = more != NULL && make_mesh(&scene->meshes[scene->mesh_count++], from, &w, &next);
    }
    free(w.table);
    free(w.vertices);
    return done;
}
