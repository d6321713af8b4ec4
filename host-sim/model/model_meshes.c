/* See model_meshes.h. A mesh that a node shows becomes pieces of at most 65,535 vertices, in Q16.16. */
#include "model_meshes.h"

#include "model_fit.h"
#include "model_places.h"
#include "model_rig.h"
#include "model_rig_range.h"

#include <math.h>
#include <stdlib.h>

/* Converts to Q16.16, saturated; NaN gives 0. */
static fx_t fixed(double value)
{
    if (!(fabs(value) < 32767)) {
        return value > 0 ? FX_MAX : value < 0 ? FX_MIN : 0;
    }
    return (fx_t)lround(value * 65536);
}

static void set_normal(int16_t normal[3], double x, double y, double z)
{
    const double length = sqrt(x * x + y * y + z * z);
    const bool has_direction = length > 0 && isfinite(length);
    normal[0] = has_direction ? (int16_t)lround(x / length * 16384) : 0;
    normal[1] = has_direction ? (int16_t)lround(y / length * 16384) : 0;
    normal[2] = has_direction ? (int16_t)lround(z / length * 16384) : 0;
}

/* A piece becomes one mesh: a whole place, or some faces with vertices of their own where there are no normals. */
struct piece {
    const struct model_place *place;
    unsigned first, count; /* faces */
    bool is_flat;
    uint32_t vertex_count;
};

#define FLAT_FACES (MODEL_VERTICES_MAX / 3)

/* Vertex i of the piece in the place's mesh. */
static unsigned vertex_of(const struct piece *piece, unsigned i)
{
    const struct model_mesh *mesh = piece->place->mesh;
    if (!piece->is_flat) {
        return i;
    }
    return mesh->triangles[piece->first + i / 3][i % 3];
}

static void copy_vertices(const struct piece *from, const struct model_fit *fit, double (*points)[3],
                          struct fx_vec3 *positions, int16_t (*normals)[3])
{
    for (unsigned i = 0; i < from->vertex_count; i++) {
        double *p = points[i], n[3];
        model_places_point(from->place, vertex_of(from, i), p);
        positions[i].x = fixed((p[0] - fit->centre[0]) * fit->scale);
        positions[i].y = fixed((p[1] - fit->centre[1]) * fit->scale);
        positions[i].z = fixed((p[2] - fit->centre[2]) * fit->scale);
        if (!from->is_flat) {
            model_places_normal(from->place, i, n);
            set_normal(normals[i], n[0], n[1], n[2]);
        }
    }
}

/* Makes the normals of a flat piece from unrounded points, so that small triangles have normals, too. */
static void make_normals(const struct ph_mesh *mesh, double (*points)[3], int16_t (*normals)[3])
{
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        const uint16_t *corners = mesh->triangles[t];
        const double *p = points[corners[0]], *q = points[corners[1]], *r = points[corners[2]];
        double cross[3];
        for (int axis = 0; axis < 3; axis++) {
            const int a = (axis + 1) % 3, b = (axis + 2) % 3;
            cross[axis] = (q[a] - p[a]) * (r[b] - p[b]) - (q[b] - p[b]) * (r[a] - p[a]);
        }
        for (int i = 0; i < 3; i++) {
            set_normal(normals[corners[i]], cross[0], cross[1], cross[2]);
        }
    }
}

/* Turns mirrored triangles over. */
static void copy_triangles(const struct piece *from, uint16_t (*to)[3])
{
    for (unsigned f = 0; f < from->count; f++) {
        for (unsigned i = 0; i < 3; i++) {
            const uint32_t index = from->is_flat ? 3 * f + i : from->place->mesh->triangles[from->first + f][i];
            to[f][from->place->mirrors ? 2 - i : i] = (uint16_t)index;
        }
    }
}

/* Copies the vertex colours; where all are the colour of the material, there are none. A texture's are drawn over it.
 */
static bool copy_colours(struct model_shared *shared, const struct piece *piece, struct ph_mesh *to)
{
    const float(*const from)[3] = (const float(*)[3])piece->place->mesh->colours;
    const struct ph_blend *blend = to->materials->blend;
    if (from == NULL || (blend != NULL && blend->kind == PH_BLEND_ADD)) { /* a glow has its own colour */
        return true;
    }
    if (to->materials->texture != NULL) {
        return true;
    }
    uint16_t *colours = demo_alloc(&shared->arena, sizeof *colours * piece->vertex_count);
    for (unsigned i = 0; colours != NULL && i < piece->vertex_count; i++) {
        const float *c = from[vertex_of(piece, i)];
        colours[i] = ph_rgb565(model_surface_channel(c[0]), model_surface_channel(c[1]), model_surface_channel(c[2]));
        to->colours = colours[i] != to->materials->colour ? colours : to->colours;
    }
    return colours != NULL;
}

static bool copy_uvs(struct model_shared *shared, const struct piece *piece, struct ph_mesh *to)
{
    fx_t(*uvs)[2] = demo_alloc(&shared->arena, sizeof *uvs * piece->vertex_count);
    for (unsigned i = 0; uvs != NULL && i < piece->vertex_count; i++) {
        const float *uv = piece->place->mesh->uvs[vertex_of(piece, i)];
        uvs[i][0] = fixed((double)uv[0]);
        uvs[i][1] = fixed((double)uv[1]);
    }
    to->uvs = (const fx_t(*)[2])uvs;
    return uvs != NULL;
}

/* Copies the material for the mesh; it keeps its texture only if there are texture coordinates. */
static bool copy_material(struct model_shared *shared, const struct piece *piece, const struct ph_material *given,
                          struct ph_mesh *to)
{
    const struct model_mesh *from = piece->place->mesh;
    struct ph_material *material = demo_alloc(&shared->arena, sizeof *material);
    struct ph_part *part = demo_alloc(&shared->arena, sizeof *part);
    if (material == NULL || part == NULL) {
        return false;
    }
    *material = *given;
    *part = (struct ph_part){.first = 0, .count = to->triangle_count, .material = 0};
    to->parts = part;
    to->part_count = 1;
    to->materials = material;
    const bool has_alphas = material->blend != NULL && material->blend->alphas != NULL;
    if (from->uvs == NULL) {
        if (shared->texture != NULL) {
            model_shared_note(shared, "what has no texture coordinates keeps its colour");
        }
        material->texture = NULL;
        material->blend = has_alphas ? NULL : material->blend;
    } else if ((material->texture != NULL || has_alphas) && !copy_uvs(shared, piece, to)) {
        return false;
    }
    if (material->texture != NULL) {
        material->shading = material->shading == PH_SHADE_UNLIT ? PH_SHADE_TEXTURE : PH_SHADE_TEXTURE_GOURAUD;
    }
    return copy_colours(shared, piece, to);
}

/* Positions, triangles and normals into arrays of the right size. false: no memory. */
static bool copy_shape(const struct piece *from, const struct model_fit *fit, struct fx_vec3 *positions,
                       int16_t (*normals)[3], struct ph_mesh *to)
{
    double(*points)[3] = calloc(to->vertex_count, sizeof *points);
    if (points == NULL) {
        return false;
    }
    copy_vertices(from, fit, points, positions, normals);
    if (from->is_flat) {
        make_normals(to, points, normals);
    }
    free(points);
    return true;
}

static bool copy_mesh(struct model_shared *shared, const struct piece *from, const struct model_fit *fit,
                      const struct ph_material *material, struct ph_mesh *to)
{
    const uint32_t n = from->vertex_count;
    if (n == 0 || n > MODEL_VERTICES_MAX) {
        return model_shared_failed(shared, "is broken: a mesh of %u vertices", n);
    }
    struct fx_vec3 *positions = demo_alloc(&shared->arena, sizeof *positions * n);
    int16_t(*normals)[3] = demo_alloc(&shared->arena, sizeof *normals * n);
    uint16_t(*triangles)[3] = demo_alloc(&shared->arena, sizeof *triangles * from->count);
    if (positions == NULL || normals == NULL || triangles == NULL) {
        return model_shared_failed(shared, "needs too much memory");
    }
    *to = (struct ph_mesh){.positions = positions,
                           .normals = (const int16_t(*)[3])normals,
                           .triangles = (const uint16_t(*)[3])triangles,
                           .vertex_count = n,
                           .triangle_count = from->count};
    copy_triangles(from, triangles);
    return (copy_shape(from, fit, positions, normals, to) && copy_material(shared, from, material, to)) ||
           model_shared_failed(shared, "needs too much memory");
}

/* The piece of a place that starts with face `first`. */
static struct piece next_piece(const struct model_place *place, unsigned first)
{
    const struct model_mesh *mesh = place->mesh;
    const unsigned rest = mesh->triangle_count - first;
    if (mesh->normals != NULL) {
        return (struct piece){place, 0, rest, false, mesh->vertex_count};
    }
    const unsigned count = rest < FLAT_FACES ? rest : FLAT_FACES;
    return (struct piece){place, first, count, true, 3 * count};
}

static size_t count_pieces(const struct model_places *places)
{
    size_t count = 0;
    for (size_t i = 0; i < places->count; i++) {
        count += 3 * (places->list[i].mesh->triangle_count / FLAT_FACES + 1); /* glow and tint are meshes, too */
    }
    return count;
}

/* Lets the mesh of a piece move, where something does. */
static bool bind_piece(struct model_shared *shared, const struct piece *piece, const struct model_fit *fit,
                       uint32_t mesh)
{
    if (shared->model.motion == NULL || shared->model.meshes[mesh].triangle_count == 0) {
        return true;
    }
    unsigned *vertices = calloc(piece->vertex_count, sizeof *vertices);
    for (unsigned i = 0; vertices != NULL && i < piece->vertex_count; i++) {
        vertices[i] = vertex_of(piece, i);
    }
    const bool done = vertices != NULL ? model_rig_bind(shared, piece->place, fit, vertices, mesh)
                                       : model_shared_failed(shared, "needs too much memory");
    free(vertices);
    return done;
}

/* Copies the piece as the next mesh of the model. */
static bool add_mesh(struct model_shared *shared, const struct piece *piece, const struct model_fit *fit,
                     const struct ph_material *material)
{
    struct model *model = &shared->model;
    struct ph_mesh *mesh = &model->meshes[model->mesh_count];
    if (!copy_mesh(shared, piece, fit, material, mesh) || !bind_piece(shared, piece, fit, model->mesh_count)) {
        return false;
    }
    model->mesh_count += mesh->triangle_count > 0;
    model->triangle_count += mesh->triangle_count;
    model->vertex_max = mesh->vertex_count > model->vertex_max ? mesh->vertex_count : model->vertex_max;
    return true;
}

/* Whether vertices of a textured mesh have colours that change the texture's. */
static bool is_tinted(struct model_shared *shared, const struct model_mesh *mesh, const struct model_material *material)
{
    bool is_white = true;
    for (size_t i = 0; mesh->colours != NULL && i < mesh->vertex_count; i++) {
        const float *const c = mesh->colours[i];
        is_white = is_white && c[0] >= 1 && c[1] >= 1 && c[2] >= 1;
    }
    if (is_white || mesh->uvs == NULL || material->surface.texture == NULL) {
        return false;
    }
    if (!material->can_tint) {
        model_shared_note(shared, "vertex colours of textured meshes that are not opaque are ignored");
    }
    return material->can_tint;
}

static bool copy_place(struct model_shared *shared, const struct model_place *place, const struct model_fit *fit,
                       const struct model_material *material)
{
    const bool tints = is_tinted(shared, place->mesh, material);
    for (unsigned first = 0; first < place->mesh->triangle_count;) {
        const struct piece piece = next_piece(place, first);
        if (!add_mesh(shared, &piece, fit, &material->surface) ||
            (tints && !add_mesh(shared, &piece, fit, &material->tint)) ||
            (material->glows && !add_mesh(shared, &piece, fit, &material->glow))) {
            return false;
        }
        first += piece.count;
    }
    return true;
}

static bool has_area(const struct ph_mesh *mesh, uint32_t triangle)
{
    const struct fx_vec3 *p[3];
    for (int i = 0; i < 3; i++) {
        p[i] = &mesh->positions[mesh->triangles[triangle][i]];
    }
    const double a[3] = {(double)p[1]->x - p[0]->x, (double)p[1]->y - p[0]->y, (double)p[1]->z - p[0]->z};
    const double b[3] = {(double)p[2]->x - p[0]->x, (double)p[2]->y - p[0]->y, (double)p[2]->z - p[0]->z};
    return a[1] * b[2] != a[2] * b[1] || a[2] * b[0] != a[0] * b[2] || a[0] * b[1] != a[1] * b[0];
}

static bool any_has_area(const struct model *model)
{
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        for (uint32_t t = 0; t < model->meshes[m].triangle_count; t++) {
            if (has_area(&model->meshes[m], t)) {
                return true;
            }
        }
    }
    return false;
}

static bool copy_meshes(struct model_shared *shared, const struct model_scene *scene, struct model_places *places,
                        struct model_fit *fit)
{
    struct model *model = &shared->model;
    struct model_outline outline;
    if (!model_fit_find(shared, places, fit, &outline)) {
        return false;
    }
    model->scale = fit->scale;
    model_rig_settle(shared->rig, places, fit);
    model->meshes = demo_alloc(&shared->arena, sizeof *model->meshes * count_pieces(places));
    if (model->meshes == NULL) {
        return model_shared_failed(shared, "needs too much memory");
    }
    if (!model_rig_begin(shared, fit, count_pieces(places)) || !model_fit_outline(shared, &outline)) {
        return false;
    }
    for (size_t i = 0; i < places->count; i++) {
        if (!copy_place(shared, &places->list[i], fit, &scene->materials[places->list[i].mesh->material])) {
            return false;
        }
    }
    model_camera_read(shared, scene, places, fit);
    return model->triangle_count == 0
               ? model_shared_failed(shared, "has no triangles")
               : any_has_area(model) || model_shared_failed(shared, "has no triangle with an area");
}

bool model_meshes_read(struct model_shared *shared, const struct model_scene *scene)
{
    struct model_places places;
    struct model_fit fit;
    const bool done = model_places_find(scene, &places) ? copy_meshes(shared, scene, &places, &fit)
                                                        : model_shared_failed(shared, "needs too much memory");
    free(places.list);
    free(places.nodes);
    return done;
}
