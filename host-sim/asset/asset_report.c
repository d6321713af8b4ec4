/* asset: says what a model takes of flash, and which boards have the memory to draw it (asset.h). */
#include "asset.h"
#include "complain.h"
#include "model_texture.h"
#include "progress.h"
#include "runner.h"

#include <stdlib.h>

/* Bytes beside the arrays, on a 32-bit target. */
#define MESH_BYTES     52
#define SPHERE_BYTES   20
#define MATERIAL_BYTES 36
#define PART_BYTES     12
#define BLEND_BYTES    12
#define TEXTURE_BYTES  8
#define DEMO_BYTES     64
#define EYE_BYTES      76
#define RAMP_BYTES     (2 * PH_RAMP_SIZE)

static uint8_t smaller(uint8_t a, uint8_t b)
{
    return a < b ? a : b;
}

static uint64_t texture_bytes(const struct ph_texture *t, uint8_t log2_max)
{
    const struct ph_texture small = {.log2_width = smaller(t->log2_width, log2_max),
                                     .log2_height = smaller(t->log2_height, log2_max)};
    const uint8_t longest = small.log2_width > small.log2_height ? small.log2_width : small.log2_height;
    return TEXTURE_BYTES + 2 * (uint64_t)model_texture_texels(&small, t->levels > 0 ? longest : 0);
}

uint64_t asset_texture_bytes(const struct asset *asset, uint8_t log2_max)
{
    const struct model *model = &asset->model;
    uint64_t bytes = 0;
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        const struct ph_texture *t = model->meshes[m].materials->texture;
        const struct ph_blend *blend = model->meshes[m].materials->blend;
        if (t != NULL && asset_first_texture(model, m) == m) {
            bytes += texture_bytes(t, log2_max);
        }
        if (blend != NULL && blend->alphas != NULL && asset_first_blend(model, m) == m) {
            bytes += texture_bytes(blend->alphas, log2_max);
        }
    }
    return bytes;
}

struct asset_sizes asset_sizes(const struct asset *asset)
{
    const struct model *model = &asset->model;
    struct asset_sizes s = {.tables = DEMO_BYTES + (model->has_camera ? EYE_BYTES : 0) +
                                      (model->studio != NULL ? sizeof(struct demo_studio) : 0),
                            .textures = asset_texture_bytes(asset, TEXTURE_LOG2_MAX),
                            .motion = asset_motion_bytes(model)};
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        const struct ph_mesh *mesh = &model->meshes[m];
        s.positions += (model_moving(model, m) != NULL ? 6 : 12) * (uint64_t)mesh->vertex_count;
        s.normals += 6 * (uint64_t)mesh->vertex_count;
        s.uvs += mesh->uvs != NULL ? 8 * (uint64_t)mesh->vertex_count : 0;
        s.colours += mesh->colours != NULL ? 2 * (uint64_t)mesh->vertex_count : 0;
        s.triangles += 6 * (uint64_t)mesh->triangle_count;
        s.tables += MESH_BYTES + (mesh->bounds != NULL ? SPHERE_BYTES : 0) + MATERIAL_BYTES + PART_BYTES +
                    (asset->first_ramps[m] == m ? RAMP_BYTES : 0) +
                    (mesh->materials->blend != NULL && asset_first_blend(model, m) == m ? BLEND_BYTES : 0);
    }
    return s;
}

uint64_t asset_flash_bytes(const struct asset *asset)
{
    const struct asset_sizes s = asset_sizes(asset);
    return s.positions + s.normals + s.uvs + s.colours + s.triangles + s.tables + s.textures + s.motion;
}

static void report_model(FILE *file, const struct asset *asset)
{
    const struct model *model = &asset->model;
    uint32_t vertices = 0;
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        vertices += model->meshes[m].vertex_count;
    }
    fprintf(file, "model      %s\n", asset->name);
    const bool lacks = !asset->is_simplified && model->triangle_count < asset->triangles_read;
    fprintf(file, "triangles  %u of %u: %s%s", (unsigned)model->triangle_count, (unsigned)asset->triangles_read,
            asset->is_simplified ? "simplified" : "as in the file", lacks ? ", without those that have no area" : "");
    if (asset->is_simplified) {
        fprintf(file, "; the surface moved by about %.3g %% of the model's radius", 100 * asset->error);
    }
    if (asset->off > 0) {
        fprintf(file, ", %.3g %% of its pixels are off", 100 * asset->off);
    }
    fprintf(file, "\nvertices   %u of %u%s, %u in the largest of %u meshes\n", (unsigned)vertices,
            (unsigned)asset->vertices_read, vertices < asset->vertices_read ? " (equal ones are one)" : "",
            (unsigned)model->vertex_max, (unsigned)model->mesh_count);
    if (asset->fetched > 0) {
        fprintf(file, "reuse      %.2f vertices fetched a triangle, %.2f before (16 at hand)\n", asset->fetched,
                asset->fetched_read);
    }
    fprintf(file, "camera     %s\n",
            model->has_camera ? "the file's"
            : asset->is_bare  ? "turntable without its platter"
                              : "turntable");
}

/* The clips, and by how much the numbers that became 16 bits are off. */
static void report_motion(FILE *file, const struct model_motion *m)
{
    const struct model_rounding *r = &m->rounding;
    fprintf(file, "motion     %u nodes, %u clips:", (unsigned)m->animation.rig.node_count,
            (unsigned)m->animation.clip_count);
    for (uint32_t i = 0; i < m->animation.clip_count; i++) {
        const struct ph_clip *clip = &m->animation.clips[i];
        fprintf(file, "%s %s (%.2f s)%s", i > 0 ? "," : "", clip->name, clip->duration / 65536.0,
                m->animation.clip == clip && m->animation.clip_count > 1 && !m->animation.in_turn ? " plays" : "");
    }
    fputs(m->animation.in_turn ? ", in turn" : "", file);
    fprintf(file,
            "\nrounding   positions %.2g, morph targets %.2g, keys of translation %.2g of the model's radius, of "
            "rotation %.2g degrees,\n           of scale %.2g, of weights %.2g, their times %.2g s, shares of joints "
            "%.2g, at most\n",
            r->position, r->target, r->translation, r->rotation, r->scale, r->weight, r->time, r->share);
}

static void report_flash(FILE *file, const struct asset *asset)
{
    const struct asset_sizes s = asset_sizes(asset);
    const struct {
        const char *name;
        uint64_t bytes;
    } rows[] = {{"positions", s.positions}, {"normals", s.normals},     {"uvs", s.uvs},
                {"colours", s.colours},     {"triangles", s.triangles}, {"tables", s.tables},
                {"textures", s.textures},   {"motion", s.motion},       {"in all", asset_flash_bytes(asset)}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        fprintf(file, "%-10s %-10s %8llu bytes\n", i == 0 ? "flash" : "", rows[i].name,
                (unsigned long long)rows[i].bytes);
    }
}

static void report_board(FILE *file, const struct asset *asset, const struct board *board)
{
    const uint64_t need = asset_frame_bytes(asset, board, true), bands = asset_band_bytes(board),
                   budget = board->scene_bytes;
    char size[16];
    snprintf(size, sizeof size, "%ux%u", (unsigned)panel_width(board->panel, board->rotation),
             (unsigned)panel_height(board->panel, board->rotation));
    fprintf(file, "%-27s %-8s %6llu %10u %8llu %8llu %9llu  ", board->name, size, (unsigned long long)bands,
            (unsigned)asset->listed, (unsigned long long)(need - bands), (unsigned long long)need,
            (unsigned long long)budget);
    if (need <= budget) {
        fputs("fits\n", file);
    } else {
        fprintf(file, "%llu too many\n", (unsigned long long)(need - budget));
    }
}

/* Sets the list of triangles for board number i, which is the one of an earlier board with a glass of that size. */
static int measure(struct asset *asset, uint32_t i, uint32_t *listed)
{
    const uint32_t first = asset_first_glass(i);
    asset->listed = listed[first];
    const int status = asset->listed > 0 ? 0 : asset_measure(asset, board_list[i]);
    listed[first] = asset->listed;
    return status;
}

static int report_boards(FILE *file, const struct asset *asset, const struct board *board, uint32_t *listed)
{
    for (uint32_t i = 0; i < board_count; i++) {
        struct asset here = *asset;
        if (board != NULL && board != board_list[i]) {
            continue;
        }
        progress_show("measuring", i, board_count);
        const int status = measure(&here, i, listed);
        progress_show("measuring", 1, 1);
        if (status != 0) {
            return status;
        }
        report_board(file, &here, board_list[i]);
    }
    return 0;
}

int asset_report(FILE *file, const struct asset *asset, const struct board *board)
{
    uint32_t *const listed = calloc((size_t)board_count + 1, sizeof *listed);
    if (listed == NULL) {
        return complain("not enough memory for the report");
    }
    report_model(file, asset);
    if (asset->model.motion != NULL) {
        report_motion(file, asset->model.motion);
    }
    report_flash(file, asset);
    fprintf(file, "\n%-27s %-8s %6s %10s %8s %8s %9s\n", "board: bytes for a frame", "picture", "bands", "triangles",
            "scene", "in all", "budget");
    const int status = report_boards(file, asset, board, listed);
    free(listed);
    return status;
}
