/*
 * wireframe: the teapot as lines. Its faces are drawn first in the colour of the background, so that they hide the
 * lines behind them. The lines lie a little nearer to the viewer.
 */
#include "demo_scene.h"
#include "models.h"

#define SEGMENTS 3

struct wireframe {
    struct ph_mesh faces, lines;
    struct ph_material face, line;
    struct demo_fit camera;
    uint16_t background;
};

/* Moves the faces a little inside the lines, so that steep faces at the outline do not cut them. */
static int shrink_faces(struct demo_arena *arena, struct wireframe *w)
{
    struct fx_vec3 *const inner = demo_alloc(arena, w->lines.vertex_count * sizeof(*inner));
    if (!inner) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t i = 0; i < w->lines.vertex_count; i++) {
        const int16_t *const normal = w->lines.normals[i];
        const struct fx_vec3 by = {normal[0] / 20, normal[1] / 20, normal[2] / 20}; /* Q1.14 / 20 in Q16.16: .0125 */
        inner[i] = fx_vec3_sub_sat(w->lines.positions[i], by);
    }
    w->faces = w->lines;
    w->faces.positions = inner;
    w->faces.materials = &w->face;
    return PH_OK;
}

static int wireframe_model(struct demo_arena *arena, struct wireframe *w, uint32_t segments)
{
    if (model_teapot(arena, &w->lines, segments) != PH_OK || model_quad_edges(arena, &w->lines) != PH_OK ||
        model_material(arena, &w->lines, &w->line) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    return shrink_faces(arena, w);
}

static int wireframe_init(struct demo_context *context)
{
    struct wireframe *const w = demo_alloc(&context->arena, sizeof(*w));
    const struct demo_arena rest = context->arena;
    if (!w) {
        return PH_ERR_NOMEM;
    }
    w->background = ph_rgb565(6, 12, 28);
    w->face = (struct ph_material){.shading = PH_SHADE_UNLIT, .colour = w->background};
    w->line = (struct ph_material){.shading = PH_SHADE_WIRE, .depth_bias = 32, .colour = ph_rgb565(120, 230, 255)};
    for (uint32_t segments = SEGMENTS; segments >= 2; segments--) {
        context->arena = rest;
        if (wireframe_model(&context->arena, w, segments) == PH_OK) {
            w->camera = demo_fit(context, &w->lines, 1, (struct fx_vec3){0, 0, 0});
            w->camera.projection.shift_y = 0; /* there is no platter below, so the teapot is in the middle */
            context->state = w;
            return PH_OK;
        }
    }
    return PH_ERR_NOMEM;
}

static int wireframe_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct wireframe *const w = context->state;
    const struct ph_xform turn = ph_xform_rotate_y((frame << 24) - (1u << 28));
    struct demo_fit camera = w->camera;
    demo_orbit(context, &camera.view, &camera.projection);
    int status = demo_begin(context, r, &camera.view, &camera.projection, NULL, w->background);
    status = status == PH_OK ? ph_draw_mesh(r, &w->faces, &turn) : status;
    return status ? status : ph_draw_mesh(r, &w->lines, &turn);
}

#define ARENA(n)                                                                                                       \
    (MODEL_ROUND8(sizeof(struct wireframe)) + MODEL_BYTES(MODEL_TEAPOT_VERTICES(n), MODEL_TEAPOT_TRIANGLES(n)) +       \
     MODEL_EDGES_SCRATCH(MODEL_TEAPOT_VERTICES(n), MODEL_TEAPOT_TRIANGLES(n)) +                                        \
     MODEL_EDGES_BYTES(MODEL_TEAPOT_QUAD_EDGES(n)))
#define LISTED(n) (MODEL_TEAPOT_TRIANGLES(n) * 5 / 8 + MODEL_TEAPOT_QUAD_EDGES(n))

static const struct demo_level coarser = {
    .arena_bytes = ARENA(2), .vertex_max = 2 * MODEL_TEAPOT_VERTICES(2), .triangle_max = LISTED(2)};

const struct demo demo_wireframe = {
    .name = "wireframe",
    .summary = "the teapot as lines, hidden ones removed",
    .loop_frames = 256,
    .arena_bytes = ARENA(SEGMENTS),
    .vertex_max = 2 * MODEL_TEAPOT_VERTICES(SEGMENTS),
    .triangle_max = LISTED(SEGMENTS),
    .coarser = &coarser,
    .coarser_count = 1,
    .init = wireframe_init,
    .frame = wireframe_frame,
};
