/*
 * hitchcock: the zoom of Vertigo (source: LMU Munich, computer graphics, summer 2020, tutorial 4, task 4). The camera
 * rolls away from a spinning top on its own axis and narrows its field of view, so that the top keeps its size on the
 * screen to the pixel while the colonnade behind it swells.
 *
 * The top stands in the plane through the origin. Its two tips lie on its axis, so its projected height is the axis's:
 * TOP_HEIGHT / distance / (2 tan(fov / 2)) = TOP_HEIGHT / VIEW_HEIGHT of the picture.
 */
#include "camera.h"
#include "demo_scene.h"
#include "models.h"

#define LOOP_FRAMES   512
#define VIEW_HEIGHT   (FX_ONE * 7 / 2) /* seen at the distance of the top */
#define NEAREST       (FX_ONE * 5 / 2) /* 70 degrees */
#define FURTHEST      FX_INT(18)       /* 11 degrees */
#define EYE_HEIGHT    (FX_ONE * 6 / 5)
#define TOP_SIDES     16
#define TOP_FEW       8 /* sides, columns' sides and cells where memory is small */
#define COLUMN_FEW    4
#define CELLS_FEW     7
#define TOP_STRIPES   4
#define COLUMN_SIDES  8
#define COLUMN_POINTS 8
#define PAIRS         7
#define CELLS         14
#define FLOOR_SCALE   (FX_ONE * 195 / 100)
#define FLOOR_MIDDLE  (FX_ONE * -5 / 2)

static const struct model_point top_profile[] = {
    {0, 0},
    {FX_ONE / 10, FX_ONE / 4},
    {FX_ONE * 6 / 10, FX_ONE * 8 / 10},
    {FX_ONE * 72 / 100, FX_ONE * 11 / 10},
    {FX_ONE * 6 / 10, FX_ONE * 135 / 100},
    {FX_ONE * 2 / 10, FX_ONE * 155 / 100},
    {FX_ONE / 10, FX_ONE * 17 / 10},
    {FX_ONE / 9, FX_ONE * 21 / 10},
    {0, FX_ONE * 24 / 10},
};
#define TOP_POINTS (sizeof(top_profile) / sizeof(top_profile[0]))

static const struct model_point column_profile[COLUMN_POINTS] = {
    {FX_ONE * 45 / 100, 0},
    {FX_ONE * 45 / 100, FX_ONE / 4},
    {FX_ONE * 33 / 100, FX_ONE / 3},
    {FX_ONE * 33 / 100, FX_ONE / 3},
    {FX_ONE * 28 / 100, FX_ONE * 34 / 10},
    {FX_ONE * 28 / 100, FX_ONE * 34 / 10},
    {FX_ONE * 48 / 100, FX_ONE * 37 / 10},
    {FX_ONE * 48 / 100, FX_INT(4)},
};

struct hitchcock {
    struct ph_mesh top, column, floor;
    fx_t floor_scale;
    struct ph_material stripes[TOP_STRIPES], stone, tiles[2];
    uint16_t ramps[TOP_STRIPES + 1][PH_RAMP_SIZE];
};

#define ARENA(sides, column, cells)                                                                                    \
    (MODEL_ROUND8(sizeof(struct hitchcock)) + MODEL_LATHE_BYTES(sides, TOP_POINTS, TOP_STRIPES) +                      \
     MODEL_LATHE_BYTES(column, COLUMN_POINTS, 1) + MODEL_FLOOR_BYTES(cells))
#define ARENA_FINE ARENA(TOP_SIDES, COLUMN_SIDES, CELLS)
#define ARENA_FEW  ARENA(TOP_FEW, COLUMN_FEW, CELLS_FEW)

static int hitchcock_init(struct demo_context *context)
{
    static const uint8_t colours[TOP_STRIPES][3] = {{235, 60, 50}, {250, 200, 60}, {60, 130, 230}, {245, 240, 225}};
    struct demo_arena *const arena = &context->arena;
    struct hitchcock *const h = demo_alloc(arena, sizeof(*h));
    const bool fine = arena->size >= ARENA_FINE;
    if (!h) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t i = 0; i < TOP_STRIPES; i++) {
        h->stripes[i] = demo_lit(h->ramps[i], PH_SHADE_GOURAUD, colours[i][0], colours[i][1], colours[i][2]);
    }
    h->stone = demo_lit(h->ramps[TOP_STRIPES], PH_SHADE_GOURAUD, 225, 205, 175);
    h->tiles[0] = demo_unlit(92, 72, 78);
    h->tiles[1] = demo_unlit(140, 112, 104);
    context->state = h;
    if (model_lathe(arena, &h->top, top_profile, TOP_POINTS, fine ? TOP_SIDES : TOP_FEW, TOP_STRIPES, h->stripes) !=
            PH_OK ||
        model_lathe(arena, &h->column, column_profile, COLUMN_POINTS, fine ? COLUMN_SIDES : COLUMN_FEW, 1, &h->stone) !=
            PH_OK) {
        return PH_ERR_NOMEM;
    }
    h->floor_scale = fine ? FLOOR_SCALE : FLOOR_SCALE * CELLS / CELLS_FEW;
    return model_floor(arena, &h->floor, fine ? CELLS : CELLS_FEW, h->tiles);
}

/* The camera's distance: it starts near, rolls away and comes back. */
static fx_t distance_at(uint32_t frame)
{
    const fx_t t = demo_swing(frame, LOOP_FRAMES);
    return fx_lerp_sat(NEAREST, FURTHEST, fx_mul_sat(t, t)); /* slow while it is near, where the eye sees most */
}

static int hitchcock_camera(const struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    struct ph_projection square;
    const fx_t distance = distance_at(frame);
    const struct ph_xform view = ph_xform_translate(0, -EYE_HEIGHT, -distance);
    const int status =
        ph_projection_perspective(&square, ph_fov_of(VIEW_HEIGHT, distance), FX_ONE, FX_HALF, FX_INT(60));
    if (status != PH_OK) {
        return status;
    }
    const struct ph_projection projection =
        demo_perspective(context, square.scale_y_q20, FX_HALF, distance + FX_INT(40));
    return demo_begin(context, r, &view, &projection, &demo_daylight, ph_rgb565(150, 190, 225));
}

static int hitchcock_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct hitchcock *const h = context->state;
    const struct ph_xform spin = ph_xform_rotate_y(frame << 26); /* 8 turns a loop */
    int status = hitchcock_camera(context, r, frame);
    status = status == PH_OK ? ph_draw_mesh(r, &h->top, &spin) : status;
    for (int32_t i = 0; i < 2 * PAIRS && status == PH_OK; i++) {
        const fx_t x = (i & 1 ? FX_ONE : -FX_ONE) * 17 / 10;
        const struct ph_xform place = ph_xform_translate(x, 0, (i >> 1) * (FX_ONE * -5 / 2) - FX_ONE);
        status = ph_draw_mesh(r, &h->column, &place);
    }
    struct ph_xform below = ph_xform_scale(h->floor_scale);
    below.t.z = FLOOR_MIDDLE;
    return status ? status : ph_draw_mesh(r, &h->floor, &below);
}

#define VERTICES(sides, column, cells)                                                                                 \
    (MODEL_GROUND_VERTICES(cells) + MODEL_LATHE_VERTICES(sides, TOP_POINTS) +                                          \
     2 * PAIRS * MODEL_LATHE_VERTICES(column, COLUMN_POINTS))

/* For pictures of kits, which are narrower, and for little memory. */
static const struct demo_level coarser[] = {
    {DEMO_ARENA(ARENA_FINE, 14104), .vertex_max = VERTICES(TOP_SIDES, COLUMN_SIDES, CELLS), .triangle_max = 848},
    {DEMO_ARENA(ARENA_FEW, 6464), .vertex_max = VERTICES(TOP_FEW, COLUMN_FEW, CELLS_FEW), .triangle_max = 440},
};

const struct demo demo_hitchcock = {
    .name = "hitchcock",
    .summary = "dolly out, zoom in: the top keeps its size, the columns behind it do not",
    .loop_frames = LOOP_FRAMES,
    DEMO_ARENA(ARENA_FINE, 14104),
    .vertex_max = VERTICES(TOP_SIDES, COLUMN_SIDES, CELLS),
    .triangle_max = 1000,
    .corner_max = 40,
    .coarser = coarser,
    .coarser_count = sizeof coarser / sizeof coarser[0],
    .init = hitchcock_init,
    .frame = hitchcock_frame,
};
