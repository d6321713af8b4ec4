/* See asset_mesh.h. meshoptimizer removes triangles: all meshes together first, so that no gap opens between two of
 * them. */
#include "asset_mesh.h"
#include "complain.h"

#include <meshoptimizer.h>

#include <stdlib.h>
#include <string.h>

#define ANY_ERROR 1e9f
#define MUCH_LESS 0.5 /* joining loses the normals of the file, and creases need vertices */

/* A vertex without its normal. */
struct key {
    uint32_t mesh, colour;
    fx_t place[3], uv[2];
};

/* The vertices that triangles use. (meshoptimizer does not move a vertex that shares its place with an unused one.) */
struct used {
    float (*places)[3];
    unsigned *numbers, *indices; /* of the used vertices; the triangles by them */
    size_t count;
};

/* All meshes as one, so that shared edges are simplified alike and no gap opens between meshes. */
struct whole {
    float (*places)[3];
    struct key *keys;
    unsigned *indices, *scratch;
    size_t vertex_count, index_count;
};

static void free_whole(struct whole *w)
{
    free(w->places);
    free(w->keys);
    free(w->indices);
    free(w->scratch);
}

static bool same_place(const struct fx_vec3 *a, const struct fx_vec3 *b)
{
    return a->x == b->x && a->y == b->y && a->z == b->z;
}

/* Are two corners in one place? Such a triangle is never seen. */
static bool is_point_or_line(const struct ph_mesh *mesh, const uint16_t corners[3])
{
    const struct fx_vec3 *p = mesh->positions;
    return same_place(&p[corners[0]], &p[corners[1]]) || same_place(&p[corners[1]], &p[corners[2]]) ||
           same_place(&p[corners[2]], &p[corners[0]]);
}

static void add_mesh(struct whole *w, const struct ph_mesh *mesh, uint32_t number)
{
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        for (int i = 0; i < 3 && !is_point_or_line(mesh, mesh->triangles[t]); i++) {
            w->indices[w->index_count++] = (unsigned)w->vertex_count + mesh->triangles[t][i];
        }
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++, w->vertex_count++) {
        const struct fx_vec3 *p = &mesh->positions[i];
        struct key *key = &w->keys[w->vertex_count];
        float *place = w->places[w->vertex_count];
        *key = (struct key){.mesh = number, .place = {p->x, p->y, p->z}};
        key->colour = mesh->colours != NULL ? mesh->colours[i] : 0;
        if (mesh->uvs != NULL) {
            memcpy(key->uv, mesh->uvs[i], sizeof key->uv);
        }
        for (int axis = 0; axis < 3; axis++) {
            place[axis] = (float)key->place[axis] / FX_ONE;
        }
    }
}

static bool gather(struct whole *w, const struct model *model)
{
    size_t vertices = 0;
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        vertices += model->meshes[m].vertex_count;
    }
    *w = (struct whole){.places = malloc(sizeof *w->places * (vertices + 1)),
                        .keys = malloc(sizeof *w->keys * (vertices + 1)),
                        .indices = malloc(sizeof *w->indices * 3 * ((size_t)model->triangle_count + 1)),
                        .scratch = malloc(sizeof *w->scratch * 3 * ((size_t)model->triangle_count + 1))};
    if (w->places == NULL || w->keys == NULL || w->indices == NULL || w->scratch == NULL) {
        return false;
    }
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        add_mesh(w, &model->meshes[m], m);
    }
    return true;
}

/* Converts meshoptimizer's relative error to radii of the model. */
static double error_of(const struct whole *w, float relative)
{
    return (double)relative * meshopt_simplifyScale(w->places[0], w->vertex_count, sizeof *w->places);
}

static bool find_used(const struct whole *w, const unsigned *indices, struct used *u)
{
    unsigned *new_numbers = calloc(w->vertex_count + 1, sizeof *new_numbers); /* from 1 */
    *u = (struct used){.places = malloc(sizeof *u->places * (w->vertex_count + 1)),
                       .numbers = malloc(sizeof *u->numbers * (w->vertex_count + 1)),
                       .indices = malloc(sizeof *u->indices * (w->index_count + 1))};
    const bool is_done = new_numbers != NULL && u->places != NULL && u->numbers != NULL && u->indices != NULL;
    for (size_t i = 0; is_done && i < w->index_count; i++) {
        const unsigned v = indices[i];
        if (new_numbers[v] == 0) {
            memcpy(u->places[u->count], w->places[v], sizeof *u->places);
            u->numbers[u->count] = v;
            new_numbers[v] = (unsigned)++u->count;
        }
        u->indices[i] = new_numbers[v] - 1;
    }
    free(new_numbers);
    return is_done;
}

/* Simplifies all meshes together; rest->indices has room for all triangles. */
static bool simplify(const struct whole *w, const unsigned *indices, size_t target, struct asset_rest *rest)
{
    struct used u;
    float error = 0;
    const bool is_done = find_used(w, indices, &u);
    if (is_done) {
        rest->index_count = meshopt_simplify(rest->indices, u.indices, w->index_count, u.places[0], u.count,
                                             sizeof *u.places, target, ANY_ERROR, 0, &error);
        rest->error = error_of(w, error);
    }
    for (size_t i = 0; is_done && i < rest->index_count; i++) {
        rest->indices[i] = u.numbers[rest->indices[i]];
    }
    free(u.places);
    free(u.numbers);
    free(u.indices);
    return is_done;
}

/* Simplifies `count` indices of one mesh to `target`, by the vertices first .. end - 1 alone: a model may have 50,000
 * meshes, and meshoptimizer goes through all vertices that it gets. */
static void simplify_mesh(const struct whole *w, const unsigned *from, size_t count, size_t target,
                          struct asset_rest *rest)
{
    unsigned *const to = rest->indices + rest->index_count;
    unsigned first = from[0], end = first;
    for (size_t i = 0; i < count; i++) {
        first = from[i] < first ? from[i] : first;
        end = from[i] >= end ? from[i] + 1 : end;
    }
    for (size_t i = 0; i < count; i++) {
        w->scratch[i] = from[i] - first;
    }
    float error = 0;
    const size_t n = meshopt_simplifySloppy(to, w->scratch, count, w->places[first], end - first, sizeof *w->places,
                                            target, ANY_ERROR, &error);
    for (size_t i = 0; i < n; i++) {
        to[i] += first;
    }
    rest->index_count += n;
    const double moved = (double)error * meshopt_simplifyScale(w->places[first], end - first, sizeof *w->places);
    rest->error = moved > rest->error ? moved : rest->error;
}

/* Simplifies each mesh by its share, without keeping triangles connected. What has less than a triangle goes. */
static void simplify_sloppily(const struct whole *w, size_t target, struct asset_rest *rest)
{
    size_t first = 0;
    rest->index_count = 0;
    rest->error = 0;
    while (first < w->index_count) {
        const uint32_t mesh = w->keys[w->indices[first]].mesh;
        size_t end = first;
        while (end < w->index_count && w->keys[w->indices[end]].mesh == mesh) {
            end++;
        }
        const size_t share = (size_t)((uint64_t)(end - first) * target / w->index_count) / 3 * 3;
        if (share > 0) {
            simplify_mesh(w, w->indices + first, end - first, share, rest);
        }
        first = end;
    }
    rest->way = ASSET_SLOPPY;
}

static void swap(unsigned **a, unsigned **b)
{
    unsigned *const c = *a;
    *a = *b;
    *b = c;
}

static void take_numbers(struct asset_rest *to, const struct asset_rest *from)
{
    to->index_count = from->index_count;
    to->error = from->error;
    to->way = from->way;
}

/* Keeps all triangles: meshoptimizer asserts that it gets more triangles than it is to leave. */
static bool take_all(const struct whole *w, struct asset_rest *rest)
{
    memcpy(rest->indices, w->indices, sizeof *w->indices * w->index_count);
    rest->index_count = w->index_count;
    rest->way = ASSET_KEPT;
    return true;
}

/* Takes the better of two ways that reach the number, else the way that always does. */
static bool choose(struct whole *w, size_t target, struct asset_rest *rest)
{
    struct asset_rest joined = {.indices = malloc(sizeof *joined.indices * (w->index_count + 1)), .way = ASSET_JOINED};
    rest->way = ASSET_KEPT;
    meshopt_generateShadowIndexBuffer(w->scratch, w->indices, w->index_count, w->keys, w->vertex_count, sizeof *w->keys,
                                      sizeof *w->keys);
    if (joined.indices == NULL || !simplify(w, w->indices, target, rest) || !simplify(w, w->scratch, target, &joined)) {
        free(joined.indices);
        return false;
    }
    const bool is_kept = rest->index_count <= target, is_joined = joined.index_count <= target;
    if (is_joined && (!is_kept || joined.error < rest->error * MUCH_LESS)) {
        swap(&joined.indices, &rest->indices);
        take_numbers(rest, &joined);
    } else if (!is_kept) {
        simplify_sloppily(w, target, &joined);
        if (joined.index_count > 0) { /* else more than asked for remain */
            swap(&joined.indices, &rest->indices);
            take_numbers(rest, &joined);
        }
    }
    free(joined.indices);
    return true;
}

const bool asset_can_simplify = true;

int asset_simplify(const struct model *model, uint32_t triangles, struct asset_rest *rest)
{
    struct whole w;
    *rest = (struct asset_rest){.indices = malloc(sizeof *rest->indices * 3 * ((size_t)model->triangle_count + 1))};
    const size_t target = (size_t)triangles * 3;
    const bool is_done = gather(&w, model) && rest->indices != NULL &&
                         (w.index_count <= target ? take_all(&w, rest) : choose(&w, target, rest));
    free_whole(&w);
    if (!is_done) {
        return complain("not enough memory to simplify the model");
    }
    return 0;
}
