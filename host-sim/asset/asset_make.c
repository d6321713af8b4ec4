/* asset: makes a model into the meshes, materials and textures that pinhole-asset writes (asset.h). */
#include "asset_mesh.h"
#include "asset_net.h"
#include "complain.h"
#include "model_texture.h"
#include "progress.h"

#include <stdlib.h>
#include <string.h>

#define TRIANGLE_BYTES 96 /* three vertices of its own, and its corners */
#define MESH_BYTES     256

/* Letters, digits, - and _ of the file's name, without folder and extension. */
static void make_name(char name[ASSET_NAME_BYTES], const char *file)
{
    const char *slash = strrchr(file, '/'), *start = slash != NULL ? slash + 1 : file, *dot = strrchr(start, '.');
    size_t n = dot != NULL && dot != start ? (size_t)(dot - start) : strlen(start);
    n = n < ASSET_NAME_BYTES - 1 ? n : ASSET_NAME_BYTES - 1;
    for (size_t i = 0; i < n; i++) {
        const char c = start[i];
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
        name[i] = is_plain ? c : '_';
    }
    name[n] = '\0';
}

/* ---- meshes --------------------------------------------------------------------------------------------- */

/* Adds material and part to a mesh that has the rest. */
static bool finish_mesh(struct demo_arena *arena, const struct ph_mesh *from, struct ph_material *material,
                        struct ph_mesh *to)
{
    struct ph_part *part = demo_alloc(arena, sizeof *part);
    if (part == NULL) {
        return false;
    }
    *part = (struct ph_part){.first = 0, .count = to->triangle_count, .material = 0};
    *material = from->materials[from->parts->material];
    to->parts = part;
    to->materials = material;
    to->part_count = to->material_count = 1;
    return true;
}

static bool order_mesh(struct demo_arena *arena, const struct ph_mesh *from, const unsigned *indices, size_t count,
                       unsigned *sources, struct ph_material *material, struct ph_mesh *to)
{
    const struct asset_shape shape = {from->positions,    from->normals, from->uvs, from->colours,
                                      from->vertex_count, indices,       count,     sources};
    for (uint32_t i = 0; sources != NULL && i < from->vertex_count; i++) {
        sources[i] = i;
    }
    return asset_order(arena, &shape, to) && finish_mesh(arena, from, material, to);
}

/* Triangles of a flat mesh, whose corners share no vertices, with new normals. */
struct loose {
    struct fx_vec3 *positions;
    int16_t (*normals)[3];
    fx_t (*uvs)[2];
    uint16_t *colours;
    unsigned *indices;
};

static void loosen(struct loose *l, const struct ph_mesh *from, const unsigned *indices, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        l->positions[i] = from->positions[indices[i]];
        l->indices[i] = (unsigned)i;
        if (from->uvs != NULL) {
            memcpy(l->uvs[i], from->uvs[indices[i]], sizeof l->uvs[i]);
        }
        l->colours[i] = from->colours != NULL ? from->colours[indices[i]] : 0;
    }
}

static bool remake_mesh(struct demo_arena *arena, const struct ph_mesh *from, const unsigned *indices, size_t count,
                        unsigned *sources, struct ph_material *material, struct ph_mesh *to)
{
    struct loose l = {malloc(sizeof *l.positions * (count + 1)), malloc(sizeof *l.normals * (count + 1)),
                      malloc(sizeof *l.uvs * (count + 1)), malloc(sizeof *l.colours * (count + 1)),
                      malloc(sizeof *l.indices * (count + 1))};
    bool is_done = l.positions != NULL && l.normals != NULL && l.uvs != NULL && l.colours != NULL && l.indices != NULL;
    if (is_done) {
        loosen(&l, from, indices, count);
        const struct asset_shape shape = {l.positions,
                                          (const int16_t(*)[3])l.normals,
                                          from->uvs != NULL ? (const fx_t(*)[2])l.uvs : NULL,
                                          from->colours != NULL ? l.colours : NULL,
                                          (uint32_t)count,
                                          l.indices,
                                          count,
                                          sources};
        if (sources != NULL) {
            memcpy(sources, indices, sizeof *sources * count);
        }
        asset_normals(l.positions, count, l.normals);
        is_done = asset_order(arena, &shape, to) && finish_mesh(arena, from, material, to);
    }
    free(l.positions);
    free(l.normals);
    free(l.uvs);
    free(l.colours);
    free(l.indices);
    return is_done;
}

/* The remaining triangles mesh by mesh, each in its old order: a model may have 50,000 meshes, too many to look through
 * all triangles for each. */
struct by_mesh {
    unsigned *indices; /* numbered from the mesh's first vertex */
    size_t *ends;      /* in indices, of each mesh */
};

static void free_by_mesh(struct by_mesh *b)
{
    free(b->indices);
    free(b->ends);
}

/* Sorts by counting: mesh_of and first_of know the mesh of a vertex and a mesh's first vertex. */
static void sort_by_mesh(struct by_mesh *b, const struct asset_rest *rest, const uint32_t *mesh_of,
                         const uint32_t *first_of, uint32_t mesh_count)
{
    for (size_t i = 0; i < rest->index_count; i += 3) {
        b->ends[mesh_of[rest->indices[i]]] += 3;
    }
    size_t begin = 0;
    for (uint32_t m = 0; m < mesh_count; m++) {
        const size_t n = b->ends[m];
        b->ends[m] = begin; /* so far: of what is sorted */
        begin += n;
    }
    for (size_t i = 0; i < rest->index_count; i += 3) {
        const uint32_t m = mesh_of[rest->indices[i]];
        for (size_t k = 0; k < 3; k++) {
            b->indices[b->ends[m]++] = rest->indices[i + k] - first_of[m];
        }
    }
}

/* The caller frees *b in any case. False: no memory. */
static bool make_by_mesh(struct by_mesh *b, const struct model *from, const struct asset_rest *rest, size_t vertices)
{
    uint32_t *const mesh_of = malloc(sizeof *mesh_of * (vertices + 1));
    uint32_t *const first_of = malloc(sizeof *first_of * ((size_t)from->mesh_count + 1));
    *b = (struct by_mesh){malloc(sizeof *b->indices * (rest->index_count + 1)),
                          calloc((size_t)from->mesh_count + 1, sizeof *b->ends)};
    const bool is_done = mesh_of != NULL && first_of != NULL && b->indices != NULL && b->ends != NULL;
    for (uint32_t m = 0, v = 0; m < from->mesh_count && is_done; m++) {
        first_of[m] = v;
        for (uint32_t i = 0; i < from->meshes[m].vertex_count; i++) {
            mesh_of[v++] = m;
        }
    }
    if (is_done) {
        sort_by_mesh(b, rest, mesh_of, first_of, from->mesh_count);
    }
    free(mesh_of);
    free(first_of);
    return is_done;
}

static void count_mesh(struct asset *asset, const struct ph_mesh *mesh)
{
    struct model *model = &asset->model;
    model->mesh_count++;
    model->triangle_count += mesh->triangle_count;
    model->vertex_max = mesh->vertex_count > model->vertex_max ? mesh->vertex_count : model->vertex_max;
    asset->fetched += asset_fetches(mesh);
}

/* Gives a mesh the sphere around its vertices. False: the arena is full. */
static bool set_bounds(struct demo_arena *arena, struct ph_mesh *mesh)
{
    struct ph_sphere *const bounds = demo_alloc(arena, sizeof *bounds);
    return bounds != NULL && ph_mesh_bounds(mesh, bounds) == PH_OK;
}

/* Adds what remains of mesh number m, `n` indices, to the asset. */
static bool make_mesh(struct asset *asset, struct demo_arena *arena, const struct model *from, uint32_t m,
                      const unsigned *indices, size_t n, bool is_simplified, unsigned *sources)
{
    const struct ph_mesh *const mesh = &from->meshes[m];
    struct ph_mesh *const to = &asset->model.meshes[asset->model.mesh_count];
    struct ph_material *const material = &asset->materials[asset->model.mesh_count];
    const struct animation_mesh *const moving = model_moving(from, m);
    *to = (struct ph_mesh){.bounds = NULL}; /* what moves has none */
    const bool is_done =
        (is_simplified && asset_net_is_flat(mesh) ? remake_mesh : order_mesh)(
            arena, mesh, indices, n, moving != NULL ? sources : NULL, material, to) &&
        (moving == NULL ? set_bounds(arena, to)
                        : asset_motion_add(arena, moving, sources, &asset->model, asset->model.mesh_count));
    if (is_done) {
        count_mesh(asset, to);
    }
    return is_done;
}

static bool make_meshes(struct asset *asset, struct demo_arena *arena, const struct model *from,
                        const struct asset_rest *rest)
{
    const size_t most = 3 * ((size_t)from->triangle_count + 1) + from->vertex_max;
    unsigned *sources = malloc(sizeof *sources * most);
    struct by_mesh sorted;
    bool is_done = make_by_mesh(&sorted, from, rest, (size_t)asset->vertices_read) && sources != NULL;
    size_t begin = 0;
    for (uint32_t m = 0; m < from->mesh_count && is_done; m++) {
        progress_show("ordering", m, from->mesh_count);
        const size_t n = sorted.ends[m] - begin;
        is_done = n == 0 || make_mesh(asset, arena, from, m, sorted.indices + begin, n, rest->is_simplified, sources);
        begin = sorted.ends[m];
    }
    progress_show("ordering", from->mesh_count, from->mesh_count);
    free_by_mesh(&sorted);
    free(sources);
    if (asset->model.motion != NULL && asset->model.motion->animation.mesh_count == 0) {
        asset->model.motion = NULL; /* nothing remains that moves */
    }
    return is_done;
}

static bool is_one_place(const struct fx_vec3 *a, const struct fx_vec3 *b)
{
    return a->x == b->x && a->y == b->y && a->z == b->z;
}

/* Corners in one place: if they do not move, it is drawn nowhere, whatever the camera. */
static bool is_collapsed(const struct fx_vec3 p[3])
{
    return is_one_place(&p[0], &p[1]) || is_one_place(&p[1], &p[2]) || is_one_place(&p[2], &p[0]);
}

int asset_keep_all(const struct model *model, struct asset_rest *rest)
{
    *rest = (struct asset_rest){.indices = malloc(sizeof *rest->indices * 3 * ((size_t)model->triangle_count + 1))};
    uint32_t first = 0;
    for (uint32_t m = 0; m < model->mesh_count && rest->indices != NULL; m++) {
        const struct ph_mesh *mesh = &model->meshes[m];
        for (uint32_t t = 0; t < mesh->triangle_count; t++) {
            const uint16_t *corner = mesh->triangles[t];
            const struct fx_vec3 p[3] = {mesh->positions[corner[0]], mesh->positions[corner[1]],
                                         mesh->positions[corner[2]]};
            if (is_collapsed(p) && model_moving(model, m) == NULL) {
                continue;
            }
            for (int i = 0; i < 3; i++) {
                rest->indices[rest->index_count++] = first + mesh->triangles[t][i];
            }
        }
        first += mesh->vertex_count;
    }
    return rest->indices != NULL ? 0 : complain("not enough memory for the model");
}

/* ---- textures ------------------------------------------------------------------------------------------- */

static size_t texel_count(const struct ph_texture *texture)
{
    return model_texture_texels(texture, texture->levels);
}

/* Red, green and blue of a texel, 0 .. 31, 63, 31; ph_rgb565 puts them into wire order. */
static void add_texel(uint32_t sum[3], uint16_t texel)
{
    uint8_t bytes[2];
    memcpy(bytes, &texel, sizeof bytes);
    const uint32_t colour = (uint32_t)bytes[0] << 8 | bytes[1];
    sum[0] += colour >> 11;
    sum[1] += colour >> 5 & 63;
    sum[2] += colour & 31;
}

static uint16_t mean_texel(const struct ph_texture *from, uint32_t x, uint32_t y, unsigned shift_x, unsigned shift_y)
{
    uint32_t sum[3] = {0, 0, 0};
    const unsigned shift = shift_x + shift_y;
    const uint32_t half = (1u << shift) / 2;
    for (uint32_t j = y << shift_y; j < (y + 1) << shift_y; j++) {
        for (uint32_t i = x << shift_x; i < (x + 1) << shift_x; i++) {
            add_texel(sum, from->texels[((size_t)j << from->log2_width) + i]);
        }
    }
    const uint32_t colour = (sum[0] + half) >> shift << 11 | (sum[1] + half) >> shift << 5 | (sum[2] + half) >> shift;
    const uint8_t bytes[2] = {(uint8_t)(colour >> 8), (uint8_t)colour};
    uint16_t texel;
    memcpy(&texel, bytes, sizeof texel);
    return texel;
}

/* The means of the texels of `from` under each texel of a level. */
static void shrink_level(uint16_t *texels, const struct ph_texture *from, unsigned log2_width, unsigned log2_height)
{
    for (uint32_t y = 0; y < 1u << log2_height; y++) {
        for (uint32_t x = 0; x < 1u << log2_width; x++) {
            texels[((size_t)y << log2_width) + x] =
                mean_texel(from, x, y, from->log2_width - log2_width, from->log2_height - log2_height);
        }
    }
}

static const struct ph_texture *shrink(struct demo_arena *arena, const struct ph_texture *from,
                                       const struct asset_limits *limits)
{
    const uint8_t log2_max = limits->texture_log2;
    struct ph_texture *to = demo_alloc(arena, sizeof *to);
    if (to == NULL) {
        return NULL;
    }
    *to = *from;
    to->log2_width = from->log2_width < log2_max ? from->log2_width : log2_max;
    to->log2_height = from->log2_height < log2_max ? from->log2_height : log2_max;
    const uint8_t longest = to->log2_width > to->log2_height ? to->log2_width : to->log2_height;
    to->levels = from->filter == PH_FILTER_MIPMAP ? longest : 0;
    uint16_t *texels = demo_alloc(arena, sizeof *texels * texel_count(to));
    if (texels == NULL) {
        return NULL;
    }
    to->texels = texels;
    for (unsigned k = 0; k <= to->levels; k++) {
        const unsigned width = k < to->log2_width ? to->log2_width - k : 0;
        const unsigned height = k < to->log2_height ? to->log2_height - k : 0;
        shrink_level(texels, from, width, height);
        texels += (size_t)1 << (width + height);
    }
    return to;
}

/* Makes textures smaller; meshes that shared one share the new one. */
static bool shrink_textures(struct asset *asset, struct demo_arena *arena, const struct asset_limits *limits)
{
    const uint32_t count = asset->model.mesh_count;
    for (uint32_t m = 0; m < count; m++) {
        const struct ph_texture *from = asset->materials[m].texture;
        if (from == NULL || asset_first_texture(&asset->model, m) != m) {
            continue;
        }
        const struct ph_texture *to = shrink(arena, from, limits);
        if (to == NULL) {
            return false;
        }
        for (uint32_t other = m; other < count; other++) {
            struct ph_material *material = &asset->materials[other];
            material->texture = material->texture == from ? to : material->texture;
        }
    }
    return true;
}

/* Makes the textures of blends smaller; meshes that shared a blend share the new one. */
static bool shrink_blends(struct asset *asset, struct demo_arena *arena, const struct asset_limits *limits)
{
    for (uint32_t m = 0; m < asset->model.mesh_count; m++) {
        const struct ph_blend *from = asset->materials[m].blend;
        if (from == NULL || asset_first_blend(&asset->model, m) != m) {
            continue;
        }
        struct ph_blend *to = demo_alloc(arena, sizeof *to);
        const struct ph_texture *alphas = from->alphas != NULL ? shrink(arena, from->alphas, limits) : NULL;
        if (to == NULL || (from->alphas != NULL && alphas == NULL)) {
            return false;
        }
        *to = *from;
        to->alphas = alphas;
        for (uint32_t other = m; other < asset->model.mesh_count; other++) {
            struct ph_material *material = &asset->materials[other];
            material->blend = material->blend == from ? to : material->blend;
        }
    }
    return true;
}

/* A ramp and its mesh, to be sorted: a model may have 50,000 meshes, each with a colour of its own. */
struct ramp_of {
    const uint16_t *ramp;
    uint32_t mesh;
};

static int compare_ramps(const void *a, const void *b)
{
    const struct ramp_of *const left = a, *const right = b;
    const int order = memcmp(left->ramp, right->ramp, sizeof *left->ramp * PH_RAMP_SIZE);
    return order != 0 ? order : left->mesh < right->mesh ? -1 : 1;
}

static bool find_first_ramps(struct asset *asset)
{
    const uint32_t count = asset->model.mesh_count;
    struct ramp_of *const all = malloc(sizeof *all * ((size_t)count + 1));
    asset->first_ramps = malloc(sizeof *asset->first_ramps * ((size_t)count + 1));
    const bool is_done = all != NULL && asset->first_ramps != NULL;
    for (uint32_t m = 0; is_done && m < count; m++) {
        all[m] = (struct ramp_of){asset->materials[m].ramp, m};
    }
    if (is_done) {
        qsort(all, count, sizeof *all, compare_ramps);
    }
    for (uint32_t i = 0, first = 0; is_done && i < count; i++) {
        first = memcmp(all[i].ramp, all[first].ramp, sizeof *all[i].ramp * PH_RAMP_SIZE) == 0 ? first : i;
        asset->first_ramps[all[i].mesh] = all[first].mesh;
    }
    free(all);
    return is_done;
}

/* ---- all of it ------------------------------------------------------------------------------------------ */

static size_t bytes_for(const struct model *model, uint32_t triangles)
{
    size_t bytes = 4096 + (size_t)triangles * TRIANGLE_BYTES + (size_t)model->mesh_count * MESH_BYTES * 2 +
                   asset_motion_room(model, triangles);
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        const struct ph_texture *texture = model->meshes[m].materials->texture;
        const struct ph_blend *blend = model->meshes[m].materials->blend;
        if (texture != NULL && asset_first_texture(model, m) == m) {
            bytes += 64 + 2 * model_texture_texels(texture, 15);
        }
        if (blend != NULL && asset_first_blend(model, m) == m) {
            bytes += 128 + (blend->alphas != NULL ? 2 * model_texture_texels(blend->alphas, 15) : 0);
        }
    }
    return bytes;
}

static int make(struct asset *asset, const struct model *model, const struct asset_limits *limits,
                const struct asset_rest *rest)
{
    const size_t bytes = bytes_for(model, (uint32_t)(rest->index_count / 3));
    asset->memory = malloc(bytes);
    struct demo_arena arena = {.base = asset->memory, .size = asset->memory != NULL ? bytes : 0};
    asset->model.meshes = demo_alloc(&arena, sizeof *asset->model.meshes * model->mesh_count);
    asset->materials = demo_alloc(&arena, sizeof *asset->materials * model->mesh_count);
    asset->is_simplified = rest->is_simplified;
    asset->error = rest->error;
    return asset->model.meshes != NULL && asset->materials != NULL &&
                   asset_motion_begin(&arena, model, &asset->model) && make_meshes(asset, &arena, model, rest) &&
                   shrink_textures(asset, &arena, limits) && shrink_blends(asset, &arena, limits) &&
                   find_first_ramps(asset)
               ? 0
               : complain("not enough memory for the model, or too many vertices in one mesh; simplify it "
                          "(--max-triangles)");
}

int asset_make(struct asset *asset, const struct model *model, const struct asset_limits *limits)
{
    struct asset_rest rest;
    *asset = (struct asset){.triangles_read = model->triangle_count};
    make_name(asset->name, limits->file_name);
    asset->model.has_camera = model->has_camera && !limits->is_on_turntable;
    asset->model.camera = model->camera;
    asset->model.studio = model->studio;
    asset->is_bare = limits->is_bare && !asset->model.has_camera;
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        asset->vertices_read += model->meshes[m].vertex_count;
        asset->fetched_read += asset_fetches(&model->meshes[m]);
    }
    int status = model->triangle_count > limits->triangles ? asset_simplify(model, limits->triangles, &rest)
                                                           : asset_keep_all(model, &rest);
    if (status == 0 && rest.index_count == 0) {
        status = complain("no triangle remains of the model: too few are allowed");
    }
    if (status == 0) {
        status = make(asset, model, limits, &rest);
    }
    free(rest.indices);
    asset->fetched_read /= model->triangle_count;
    asset->fetched /= asset->model.triangle_count > 0 ? asset->model.triangle_count : 1;
    return status;
}

void asset_free(struct asset *asset)
{
    free(asset->memory);
    free(asset->first_ramps);
    asset->memory = NULL;
    asset->first_ramps = NULL;
}

/* ---- what meshes share ---------------------------------------------------------------------------------- */

uint32_t asset_first_texture(const struct model *model, uint32_t mesh)
{
    const struct ph_texture *texture = model->meshes[mesh].materials->texture;
    uint32_t first = 0;
    while (model->meshes[first].materials->texture != texture) {
        first++;
    }
    return first;
}

uint32_t asset_first_blend(const struct model *model, uint32_t mesh)
{
    const struct ph_blend *blend = model->meshes[mesh].materials->blend;
    uint32_t first = 0;
    while (model->meshes[first].materials->blend != blend) {
        first++;
    }
    return first;
}
