/* asset: measures how much memory a model takes to draw, by drawing it from all sides (asset.h). */
#include "asset.h"
#include "complain.h"
#include "model_stage.h"
#include "runner.h"
#include "scene_file.h"

#include <stdlib.h>

#define SIDES_MOST  64 /* from which it is looked at */
#define SIDES_LEAST 4
#define WORK        1000000u /* triangles in all, about */
#define MESH_WORK   16       /* what a mesh costs before its first triangle, in triangles */

/* The scene, and how it is looked at. */
struct view {
    struct model_stage stage;
    uint32_t frames; /* of the clip */
    bool turns;      /* on the turntable */
};

static uint32_t sides_of(const struct model *model)
{
    const uint64_t work = (uint64_t)model->triangle_count + (uint64_t)model->mesh_count * MESH_WORK;
    uint32_t sides = SIDES_MOST;
    while (sides > SIDES_LEAST && sides * work > WORK) {
        sides /= 2;
    }
    return sides;
}

static int set_up(struct view *v, struct asset *asset, const struct board *board)
{
    const struct demo demo = asset_demo(asset);
    const struct model_stage_size size = {.width = panel_width(board->panel, board->rotation),
                                          .height = panel_height(board->panel, board->rotation),
                                          .band_height = 1,
                                          .triangle_max =
                                              asset->model.triangle_count + asset->model.triangle_count / 2 + 1536};
    v->frames = model_clip_frames(&asset->model);
    v->turns = !asset->model.has_camera;
    return model_stage_open(&v->stage, &demo, &asset->model, &size);
}

/* Looks at the model from all sides, and at one that moves at another moment of its clip from each side. The orbit
 * takes back what the turntable turns meanwhile. `most` is raised to the most triangles listed in a frame. */
static int look_around(struct view *v, fx_t dolly, uint32_t sides, uint32_t *most)
{
    struct model_stage *const s = &v->stage;
    s->context.dolly = dolly;
    for (uint32_t side = 0; side < sides; side++) {
        const uint32_t frame = (uint32_t)((uint64_t)side * v->frames / sides), turn = v->turns ? frame << 24 : 0;
        s->context.orbit = (uint32_t)(((uint64_t)side << 32) / sides) + turn;
        const int status = s->demo.frame(&s->context, &s->r, frame);
        if (status != 0) {
            return status;
        }
        const uint32_t listed = s->r.stats.triangles_drawn + s->r.stats.triangles_dropped;
        *most = listed > *most ? listed : *most;
    }
    return 0;
}

uint32_t asset_first_glass(uint32_t board)
{
    const struct board *const b = board_list[board];
    uint32_t i = 0;
    while (panel_width(board_list[i]->panel, board_list[i]->rotation) != panel_width(b->panel, b->rotation) ||
           panel_height(board_list[i]->panel, board_list[i]->rotation) != panel_height(b->panel, b->rotation)) {
        i++;
    }
    return i;
}

int asset_measure(struct asset *asset, const struct board *board)
{
    struct view view;
    const uint32_t sides = sides_of(&asset->model);
    uint32_t most = 0;
    int status = set_up(&view, asset, board);
    if (status == 0) {
        status = look_around(&view, 0, sides, &most);
    }
    for (int i = 0; i < 2 && status == 0; i++) {
        status = look_around(&view, i == 0 ? -DEMO_DOLLY_MAX : DEMO_DOLLY_MAX, sides / 4, &most);
    }
    free(view.stage.memory);
    const uint16_t width = panel_width(board->panel, board->rotation);
    const uint32_t listed = most + most / 16 + 8 + model_blend_triangles(&asset->model, width);
    asset->listed = listed > asset->listed ? listed : asset->listed;
    return status == 0 ? 0 : complain("%s: the scene cannot be drawn there (%d)", board->name, status);
}

size_t asset_table_bytes(const struct asset *asset, bool on_32)
{
    const struct model *model = &asset->model;
    const struct animation *a = model->motion != NULL ? &model->motion->animation : NULL;
    const size_t moving = a != NULL ? scene_motion_table_bytes(a->mesh_count, a->clip_count, on_32) : 0;
    return scene_file_table_bytes(model->mesh_count, on_32) + moving;
}

struct demo asset_demo(const struct asset *asset)
{
    struct demo demo = model_demo(&asset->model);
    demo.name = asset->name;
    demo.views = NULL;
    demo.triangle_max = asset->listed;
    if (asset->model.has_camera || asset->is_bare) {
        const uint32_t less =
            DEMO_TURNTABLE_BYTES - (asset->model.has_camera ? DEMO_STILL_BYTES : DEMO_TURNTABLE_BARE_BYTES);
        demo.arena_bytes -= less;
        demo.arena_bytes_32 -= less;
        demo.vertex_max -= DEMO_TURNTABLE_VERTICES;
    }
    return demo;
}

static struct runner_config config_of(const struct board *board, const struct demo *demo)
{
    return (struct runner_config){.board = board,
                                  .rotation = board->rotation,
                                  .depth_format = PH_DEPTH_AUTO,
                                  .band_height = board->band_height,
                                  .demo = demo};
}

uint64_t asset_frame_bytes(const struct asset *asset, const struct board *board, bool is_binary)
{
    struct demo demo = asset_demo(asset);
    demo.arena_bytes += is_binary ? asset_table_bytes(asset, false) : 0;
    demo.arena_bytes_32 += is_binary ? (uint32_t)asset_table_bytes(asset, true) : 0;
    const struct runner_config config = config_of(board, &demo);
    return runner_whole_bytes(&config);
}

uint64_t asset_band_bytes(const struct board *board)
{
    const struct demo none = {.name = ""};
    const struct runner_config config = config_of(board, &none);
    return runner_whole_bytes(&config);
}
