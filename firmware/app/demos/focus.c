/*
 * focus: a row of skittles that stretches away, and a lens whose focus wanders along it (source: S.-E. Yoon,
 * Rendering, KAIST, ch. 4, common questions). Without scratch memory (struct demo_context) everything is sharp.
 */
#include "demo_scene.h"
#include "models.h"

#define LOOP_FRAMES 256
#define SIDES       10
#define POINTS      8
#define SKITTLES    7
#define CELLS       16
#define SIDES_FEW   6 /* and cells, where memory is small */
#define CELLS_FEW   8
#define RADIUS      5 /* px, the largest blur; it is less on small pictures */
#define NEAREST     (FX_ONE * 22 / 10)
#define FURTHEST    FX_INT(9)

static const struct model_point profile[POINTS] = {
    {FX_ONE * 28 / 100, 0},
    {FX_ONE * 40 / 100, FX_ONE * 30 / 100},
    {FX_ONE * 42 / 100, FX_ONE * 55 / 100},
    {FX_ONE * 18 / 100, FX_ONE * 105 / 100},
    {FX_ONE * 16 / 100, FX_ONE * 120 / 100},
    {FX_ONE * 25 / 100, FX_ONE * 140 / 100},
    {FX_ONE * 18 / 100, FX_ONE * 158 / 100},
    {0, FX_ONE * 165 / 100},
};

struct focus {
    struct ph_mesh skittle, floor;
    struct ph_material colours[SKITTLES], tiles[2];
    uint16_t ramps[SKITTLES][PH_RAMP_SIZE];
    struct ph_focus focus;
    fx_t floor_scale;
    bool sharp; /* there is no memory for blur */
};

#define ARENA(sides, cells)                                                                                            \
    (MODEL_ROUND8(sizeof(struct focus)) + MODEL_LATHE_BYTES(sides, POINTS, 1) + MODEL_FLOOR_BYTES(cells))

static int focus_init(struct demo_context *context)
{
    static const uint8_t colours[SKITTLES][3] = {{235, 70, 60},  {245, 150, 50},  {245, 220, 80}, {90, 200, 100},
                                                 {70, 170, 235}, {150, 110, 230}, {240, 240, 235}};
    struct focus *const f = demo_alloc(&context->arena, sizeof(*f));
    if (!f) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t i = 0; i < SKITTLES; i++) {
        f->colours[i] = demo_figure(context, f->ramps[i], colours[i][0], colours[i][1], colours[i][2]);
    }
    f->tiles[0] = demo_tile(context, 70, 84, 100);
    f->tiles[1] = demo_tile(context, 150, 160, 165);
    const bool fine = context->arena.size >= ARENA(SIDES, CELLS);
    f->floor_scale = fine ? FX_ONE : FX_ONE * CELLS / CELLS_FEW;
    context->state = f;
    if (model_lathe(&context->arena, &f->skittle, profile, POINTS, fine ? SIDES : SIDES_FEW, 1, f->colours) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    return model_floor(&context->arena, &f->floor, fine ? CELLS : CELLS_FEW, f->tiles);
}

/* The focus goes along the row's depth and back. The blur is a share of the picture's size. */
static struct ph_focus focus_at(const struct demo_context *context, uint32_t frame)
{
    const int32_t smaller = context->width < context->height ? context->width : context->height;
    const fx_t strength = FX_ONE * smaller / 30;
    const int32_t radius = smaller / 32 < RADIUS ? smaller / 32 : RADIUS;
    return (struct ph_focus){.distance = fx_lerp_sat(NEAREST, FURTHEST, demo_swing(frame, LOOP_FRAMES)),
                             .strength = strength < FX_INT(64) ? strength : FX_INT(64),
                             .radius = (uint8_t)(radius > 1 ? radius : 1)};
}

static int focus_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    struct focus *const f = context->state;
    const struct ph_projection projection = demo_perspective(context, DEMO_SCALE_60_Q20, FX_HALF, FX_INT(24));
    const struct ph_xform view = demo_look(0, FX_ONE * 13 / 10, FX_ONE * 3, 0, FX_ONE * 8 / 10, 0);
    int status = demo_begin(context, r, &view, &projection, &demo_daylight, demo_sky(context, 120, 150, 190));
    for (int32_t i = 0; i < SKITTLES && status == PH_OK; i++) {
        struct ph_mesh mesh = f->skittle;
        const struct ph_xform place =
            ph_xform_translate(i * (FX_ONE * 6 / 10) - FX_ONE * 9 / 10, 0, FX_ONE - i * (FX_ONE * 11 / 10));
        mesh.materials = &f->colours[i];
        status = ph_draw_mesh(r, &mesh, &place);
    }
    f->focus = focus_at(context, frame);
    struct ph_xform below = ph_xform_scale(f->floor_scale);
    below.t.z = -FX_INT(4);
    return status ? status : ph_draw_mesh(r, &f->floor, &below);
}

static uint32_t focus_band(struct demo_context *context, struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    struct focus *const f = context->state;
    if (band == 0) {
        f->sharp = ph_blur_begin(&context->blur, r, context->scratch, context->scratch_bytes, &f->focus) != PH_OK;
    }
    if (f->sharp) {
        return ph_draw_band(r, band, pixels);
    }
    return ph_blur_band(&context->blur, r, band, pixels);
}

#define VERTICES(sides, cells) (MODEL_GROUND_VERTICES(cells) + SKITTLES * MODEL_LATHE_VERTICES(sides, POINTS))

/* For pictures of kits, which are narrower, and for little memory. */
static const struct demo_level coarser[] = {
    {.arena_bytes = ARENA(SIDES, CELLS), .vertex_max = VERTICES(SIDES, CELLS), .triangle_max = 824},
    {.arena_bytes = ARENA(SIDES_FEW, CELLS_FEW), .vertex_max = VERTICES(SIDES_FEW, CELLS_FEW), .triangle_max = 368},
};

const struct demo demo_focus = {
    .name = "focus",
    .summary = "a row of skittles through a lens whose focus wanders: depth of field",
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = ARENA(SIDES, CELLS),
    .vertex_max = VERTICES(SIDES, CELLS),
    .triangle_max = 1000,
    .corner_max = 24,
    .coarser = coarser,
    .coarser_count = sizeof coarser / sizeof coarser[0],
    .blur_radius = RADIUS,
    .init = focus_init,
    .frame = focus_frame,
    .band = focus_band,
};
