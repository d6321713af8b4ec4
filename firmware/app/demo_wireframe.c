/*
 * wireframe: the teapot as lines. Its faces are drawn first, in the colour of the background, so that they hide the
 * lines behind them; the lines lie a little nearer to the viewer.
 */
#include "demo_scene.h"
#include "models.h"

#define SEGMENTS  3
#define VERTICES  MODEL_TEAPOT_VERTICES(SEGMENTS)
#define TRIANGLES MODEL_TEAPOT_TRIANGLES(SEGMENTS)
#define EDGES     700

struct wireframe {
    struct ph_mesh faces, lines;
    struct ph_material face, line;
    struct demo_fit camera;
    uint16_t background;
};

static int wireframe_init(struct demo_context *context)
{
    struct demo_arena *const arena = &context->arena;
    struct wireframe *const w = demo_alloc(arena, sizeof(*w));
    if (!w || model_teapot(arena, &w->faces, SEGMENTS) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    w->background = ph_rgb565(6, 12, 28);
    w->face = (struct ph_material){.shading = PH_SHADE_UNLIT, .colour = w->background};
    w->line = (struct ph_material){.shading = PH_SHADE_WIRE, .depth_bias = 24, .colour = ph_rgb565(120, 230, 255)};
    if (model_quad_edges(arena, &w->faces) != PH_OK || model_material(arena, &w->faces, &w->face) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    w->lines = w->faces;
    w->lines.materials = &w->line;
    w->camera = demo_fit(context, &w->faces, 1, (struct fx_vec3){0, 0, 0});
    context->state = w;
    return PH_OK;
}

static int wireframe_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct wireframe *const w = context->state;
    const struct ph_xform turn = ph_xform_rotate_y((frame << 24) - (1u << 28));
    int status = demo_begin(context, r, &w->camera.view, &w->camera.projection, NULL, w->background);
    if (status == PH_OK) {
        status = ph_draw_mesh(r, &w->faces, &turn);
    }
    return status ? status : ph_draw_mesh(r, &w->lines, &turn);
}

const struct demo demo_wireframe = {
    .name = "wireframe",
    .summary = "the teapot as lines, hidden ones removed",
    .loop_frames = 256,
    .arena_bytes = MODEL_ROUND8(sizeof(struct wireframe)) + MODEL_BYTES(VERTICES, TRIANGLES) +
                   MODEL_EDGES_SCRATCH(VERTICES, TRIANGLES) + MODEL_EDGES_BYTES(EDGES) + 16,
    .vertex_max = VERTICES,
    .triangle_max = TRIANGLES + 2 * EDGES,
    .init = wireframe_init,
    .frame = wireframe_frame,
};
