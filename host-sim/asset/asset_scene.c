/* asset_scene: a scene as the bytes of scene_file.h. */
#include "asset.h"
#include "crc32.h"
#include "model_texture.h"
#include "scene_file.h"

#include <stdlib.h>
#include <string.h>

struct writer {
    uint8_t *bytes; /* NULL: only counts */
    uint32_t used;
};

/* Appends n bytes at the next multiple of 4; returns where. The bytes between are 0. */
static uint32_t append(struct writer *to, const void *from, size_t n)
{
    const uint32_t at = to->used;
    if (to->bytes != NULL && n > 0) {
        memcpy(to->bytes + at, from, n);
    }
    to->used += ((uint32_t)n + 3) & ~3u;
    return at;
}

static uint8_t number_of_filter(const struct ph_filter *filter)
{
    uint8_t number = 0;
    while (number < SCENE_FILE_FILTERS - 1 && scene_file_filters[number].filter != filter) {
        number++;
    }
    return number;
}

/* Writes a texture. offset: where its texels are already, or 0. */
static struct scene_file_texture write_texture(struct writer *to, const struct ph_texture *t, uint32_t offset)
{
    if (t == NULL) {
        return (struct scene_file_texture){.texels = 0};
    }
    const size_t bytes = model_texture_texels(t, t->levels) * sizeof *t->texels;
    return (struct scene_file_texture){.texels = offset != 0 ? offset : append(to, t->texels, bytes),
                                       .log2_width = t->log2_width,
                                       .log2_height = t->log2_height,
                                       .wrap = scene_file_wrap(t->wrap),
                                       .filter = number_of_filter(t->filter),
                                       .levels = t->levels};
}

static const uint8_t blends[] = {
    [PH_BLEND_MASK] = SCENE_FILE_MASK,
    [PH_BLEND_ALPHA] = SCENE_FILE_ALPHA,
    [PH_BLEND_ADD] = SCENE_FILE_ADD,
    [PH_BLEND_TIMES] = SCENE_FILE_TIMES,
};

/* Tracks of a clip; returns where. Times that several tracks share are written once. */
static uint32_t write_tracks(struct writer *to, const struct ph_clip *clip)
{
    struct scene_file_track *tracks = calloc(clip->track_count + 1, sizeof *tracks);
    uint32_t offset = 0;
    for (uint32_t i = 0; tracks != NULL && i < clip->track_count; i++) {
        const struct ph_track *t = &clip->tracks[i];
        const uint32_t same = asset_first_times(clip, i),
                       times = same < i ? tracks[same].times : append(to, t->times, t->key_count * sizeof *t->times);
        tracks[i] = (struct scene_file_track){.times = times,
                                              .keys = append(to, t->keys, asset_key_numbers(t) * sizeof *t->keys),
                                              .node = t->node,
                                              .key_count = t->key_count,
                                              .path = t->path,
                                              .interpolation = t->interpolation,
                                              .width = t->width,
                                              .frac = t->frac};
    }
    offset = tracks != NULL ? append(to, tracks, clip->track_count * sizeof *tracks) : 0;
    free(tracks);
    return offset;
}

static uint32_t write_motion(struct writer *to, const struct model_motion *motion)
{
    const struct animation *a = &motion->animation;
    struct scene_file_motion m = {.nodes = append(to, a->rig.nodes, a->rig.node_count * sizeof *a->rig.nodes),
                                  .rest_weights = append(to, a->rest_weights, a->weight_count * sizeof(int32_t)),
                                  .node_count = a->rig.node_count,
                                  .weight_count = a->weight_count,
                                  .clip_count = a->clip_count,
                                  .cross_fade = a->cross_fade,
                                  .t = {a->root.t.x, a->root.t.y, a->root.t.z},
                                  .outline = append(to, a->outline, a->outline_count * sizeof *a->outline),
                                  .outline_count = a->outline_count};
    memcpy(m.r, a->root.r, sizeof m.r);
    const struct scene_file_clip none = {.tracks = 0};
    m.clips = to->used;
    for (uint32_t i = 0; i < a->clip_count; i++) {
        append(to, &none, sizeof none);
    }
    for (uint32_t i = 0; i < a->clip_count; i++) {
        const struct ph_clip *from = &a->clips[i];
        struct scene_file_clip clip = {
            .tracks = write_tracks(to, from), .track_count = from->track_count, .duration = from->duration};
        snprintf(clip.name, sizeof clip.name, "%.*s", (int)sizeof clip.name - 1, from->name);
        m.playing = from == a->clip ? i : m.playing;
        if (to->bytes != NULL) {
            memcpy(to->bytes + m.clips + i * sizeof clip, &clip, sizeof clip);
        }
    }
    return append(to, &m, sizeof m);
}

/* Writes what moves a mesh. A skin that several meshes share is written once; skins: where the data of each mesh that
 * moves are. */
static uint32_t write_moving(struct writer *to, const struct animation *a, uint32_t i, struct scene_file_moving *skins)
{
    const struct animation_mesh *from = &a->meshes[i];
    const struct ph_skin *skin = &from->skin;
    const struct ph_morph *morph = &from->morph;
    const uint32_t same = asset_first_skin(a, i), n = from->bound.vertex_count, targets = morph->target_count * n;
    skins[i] = same < i
                   ? skins[same]
                   : (struct scene_file_moving){
                         .joints = append(to, skin->nodes, skin->joint_count * sizeof *skin->nodes),
                         .inverse_bind = append(to, skin->inverse_bind, skin->joint_count * sizeof *skin->inverse_bind),
                         .joint_count = skin->joint_count};
    struct scene_file_moving m = skins[i];
    m.influences =
        from->bound.influences != NULL ? append(to, from->bound.influences, n * sizeof *from->bound.influences) : 0;
    m.targets = targets > 0 ? append(to, morph->d_positions, targets * sizeof(int16_t[3])) : 0;
    m.target_normals = morph->d_normals != NULL ? append(to, morph->d_normals, targets * sizeof(int16_t[3])) : 0;
    m.target_count = morph->target_count;
    m.first_weight = from->first_weight;
    m.frac = from->bound.frac;
    m.scales_axes = from->bound.scales_axes;
    return append(to, &m, sizeof m);
}

static uint8_t number_of_shading(const struct ph_shading *shading)
{
    uint8_t number = 0;
    while (number < SCENE_FILE_SHADINGS - 1 && scene_file_shadings[number].shading != shading) {
        number++;
    }
    return number;
}

static struct scene_file_mesh write_mesh(struct writer *to, const struct asset *asset, uint32_t i,
                                         const struct scene_file_mesh *before)
{
    const struct model *const model = &asset->model;
    const struct animation_mesh *moving = model_moving(model, i);
    const struct ph_mesh *mesh = &model->meshes[i];
    const struct ph_material *material = mesh->materials;
    const struct ph_blend *blend = material->blend;
    const uint32_t n = mesh->vertex_count, ramp = asset->first_ramps[i], texture = asset_first_texture(model, i),
                   same = asset_first_blend(model, i);
    return (struct scene_file_mesh){
        .positions = moving != NULL ? append(to, moving->bound.positions, n * sizeof *moving->bound.positions)
                                    : append(to, mesh->positions, n * sizeof *mesh->positions),
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
        .shading = number_of_shading(material->shading),
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
                                            (asset->is_bare ? (uint32_t)SCENE_FILE_BARE : 0) |
                                            (model->studio != NULL ? (uint32_t)SCENE_FILE_STUDIO : 0),
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
    struct scene_file_moving skins[SCENE_FILE_MESHES];
    const struct model_motion *motion = asset->model.motion;
    struct writer to = {bytes, sizeof head};
    to.used += head.mesh_count * (uint32_t)sizeof *meshes;
    if (asset->model.studio != NULL) {
        append(&to, asset->model.studio, sizeof *asset->model.studio);
    }
    for (uint32_t i = 0; i < head.mesh_count; i++) {
        meshes[i] = write_mesh(&to, asset, i, meshes);
    }
    for (uint32_t i = 0; motion != NULL && i < motion->animation.mesh_count; i++) {
        meshes[motion->animation.meshes[i].mesh].moving = write_moving(&to, &motion->animation, i, skins);
    }
    head.motion = motion != NULL ? write_motion(&to, motion) : 0;
    head.flags |= motion != NULL && motion->animation.in_turn ? (uint32_t)SCENE_FILE_IN_TURN : 0;
    if (bytes != NULL) {
        head.bytes = to.used;
        memcpy(bytes, &head, sizeof head);
        memcpy(bytes + sizeof head, meshes, head.mesh_count * sizeof *meshes);
        const uint32_t crc = crc32_update(0, bytes + 16, to.used - 16);
        memcpy(bytes + 12, &crc, sizeof crc);
    }
    return to.used;
}
