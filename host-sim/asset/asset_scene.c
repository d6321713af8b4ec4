/* asset_scene: a scene as the bytes of scene_file.h. */
#include "asset.h"
#include "crc32.h"
#include "model_texture.h"
#include "scene_file.h"

#include <string.h>

struct writer {
    uint8_t *bytes; /* NULL: only counts */
    uint32_t used;
};

/* Appends n bytes at the next multiple of 4; returns where. The bytes between are 0. */
static uint32_t append(struct writer *to, const void *from, size_t n)
{
    const uint32_t at = to->used;
    if (to->bytes != NULL) {
        memcpy(to->bytes + at, from, n);
    }
    to->used += ((uint32_t)n + 3) & ~3u;
    return at;
}

/* offset: where its texels are already, or 0. */
static struct scene_file_texture write_texture(struct writer *to, const struct ph_texture *t, uint32_t offset)
{
    if (t == NULL) {
        return (struct scene_file_texture){.texels = 0};
    }
    const size_t bytes = model_texture_texels(t, t->levels) * sizeof *t->texels;
    return (struct scene_file_texture){.texels = offset != 0 ? offset : append(to, t->texels, bytes),
                                       .log2_width = t->log2_width,
                                       .log2_height = t->log2_height,
                                       .wrap = t->wrap,
                                       .filter = t->filter,
                                       .levels = t->levels};
}

static const uint8_t blends[] = {
    [PH_BLEND_MASK] = SCENE_FILE_MASK, [PH_BLEND_ALPHA] = SCENE_FILE_ALPHA, [PH_BLEND_ADD] = SCENE_FILE_ADD};

static struct scene_file_mesh write_mesh(struct writer *to, const struct model *model, uint32_t i,
                                         const struct scene_file_mesh *before)
{
    const struct ph_mesh *mesh = &model->meshes[i];
    const struct ph_material *material = mesh->materials;
    const struct ph_blend *blend = material->blend;
    const uint32_t n = mesh->vertex_count, ramp = asset_first_ramp(model, i), texture = asset_first_texture(model, i),
                   same = asset_first_blend(model, i);
    return (struct scene_file_mesh){
        .positions = append(to, mesh->positions, n * sizeof *mesh->positions),
        .normals = append(to, mesh->normals, n * sizeof *mesh->normals),
        .uvs = mesh->uvs != NULL ? append(to, mesh->uvs, n * sizeof *mesh->uvs) : 0,
        .colours = mesh->colours != NULL ? append(to, mesh->colours, n * sizeof *mesh->colours) : 0,
        .triangles = append(to, mesh->triangles, mesh->triangle_count * sizeof *mesh->triangles),
        .ramp = ramp < i ? before[ramp].ramp : append(to, material->ramp, PH_RAMP_SIZE * sizeof *material->ramp),
        .texture = write_texture(to, material->texture, texture < i ? before[texture].texture.texels : 0),
        .alphas = write_texture(to, blend != NULL ? blend->alphas : NULL, same < i ? before[same].alphas.texels : 0),
        .vertex_count = n,
        .triangle_count = mesh->triangle_count,
        .ambient = material->ambient,
        .diffuse = material->diffuse,
        .specular = material->specular,
        .shading = material->shading,
        .two_sided = material->two_sided,
        .shininess_log2 = material->shininess_log2,
        .blend = blend == NULL ? SCENE_FILE_OPAQUE : blends[blend->kind],
        .depth_bias = material->depth_bias,
        .alpha = blend != NULL ? blend->alpha : 0,
        .colour = material->colour};
}

static struct scene_file_head make_head(const struct asset *asset)
{
    const struct demo demo = asset_demo(asset);
    const struct model *model = &asset->model;
    const struct ph_projection *lens = &model->camera.lens;
    struct scene_file_head head = {.magic = SCENE_FILE_MAGIC,
                                   .version = SCENE_FILE_VERSION,
                                   .mesh_count = model->mesh_count,
                                   .flags = (model->has_camera ? (uint32_t)SCENE_FILE_CAMERA : 0) |
                                            (asset->is_bare ? (uint32_t)SCENE_FILE_BARE : 0),
                                   .vertex_max = demo.vertex_max,
                                   .triangle_max = demo.triangle_max};
    snprintf(head.name, sizeof head.name, "%s", asset->name);
    if (model->has_camera) {
        const struct fx_vec3 t = model->camera.view.t;
        memcpy(head.r, model->camera.view.r, sizeof head.r);
        memcpy(head.t, (int32_t[3]){t.x, t.y, t.z}, sizeof head.t);
        head.lens_kind = lens->kind;
        head.scale_x_q20 = lens->scale_x_q20;
        head.scale_y_q20 = lens->scale_y_q20;
        head.near_z = lens->near_z;
        head.far_z = lens->far_z;
    }
    return head;
}

size_t asset_scene(const struct asset *asset, uint8_t *bytes)
{
    struct scene_file_head head = make_head(asset);
    struct scene_file_mesh meshes[SCENE_FILE_MESHES];
    struct writer to = {bytes, sizeof head};
    to.used += head.mesh_count * (uint32_t)sizeof *meshes;
    for (uint32_t i = 0; i < head.mesh_count; i++) {
        meshes[i] = write_mesh(&to, &asset->model, i, meshes);
    }
    if (bytes != NULL) {
        head.bytes = to.used;
        memcpy(bytes, &head, sizeof head);
        memcpy(bytes + sizeof head, meshes, head.mesh_count * sizeof *meshes);
        memcpy(bytes + 12, &(uint32_t){crc32_update(0, bytes + 16, to.used - 16)}, 4);
    }
    return to.used;
}
