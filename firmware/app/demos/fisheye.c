/*
 * fisheye: a room seen by a bug's eye of 200 degrees, turning slowly (source: S.-E. Yoon, Rendering, KAIST, ch. 4,
 * common questions). Walls, floor and ceiling are straight; no matrix draws them like this.
 */
#include "demo_scene.h"
#include "models.h"

#define LOOP_FRAMES  256
#define CELLS        6
#define CELLS_SOME   4 /* and the things' sides, where memory is less */
#define SIDES_SOME   7
#define CELLS_FEW    3 /* where it is small */
#define SIDES_FEW    5
#define FOV_FEW      FX_INT(84)
#define WALLS        6
#define ROOM         FX_INT(3) /* from the middle to each wall: CELLS / 2 */
#define THINGS       4
#define THING_SIDES  10
#define THING_POINTS 7

static const struct model_point pawn[THING_POINTS] = {
    {FX_ONE * 6 / 10, 0}, {FX_ONE * 5 / 10, FX_ONE / 4},       {FX_ONE / 5, FX_ONE * 6 / 10},
    {FX_ONE / 6, FX_ONE}, {FX_ONE * 4 / 10, FX_ONE * 13 / 10}, {FX_ONE * 3 / 10, FX_ONE * 17 / 10},
    {0, FX_ONE * 18 / 10}};

struct fisheye {
    struct ph_mesh floor, thing;
    uint32_t cells; /* along a wall */
    struct ph_material tiles[WALLS][2], things[THINGS];
    uint16_t ramps[THINGS][PH_RAMP_SIZE];
};

#define ARENA(sides, cells)                                                                                            \
    (MODEL_ROUND8(sizeof(struct fisheye)) + MODEL_LATHE_BYTES(sides, THING_POINTS, 1) + MODEL_FLOOR_BYTES(cells))

#define ARENA_SOME ARENA(SIDES_SOME, CELLS_SOME)

static int fisheye_init(struct demo_context *context)
{
    static const uint8_t light[WALLS][3] = {{215, 205, 190}, {110, 160, 220}, {225, 120, 100},
                                            {120, 190, 130}, {230, 190, 90},  {170, 140, 210}};
    static const uint8_t colours[THINGS][3] = {{250, 80, 70}, {80, 200, 250}, {250, 220, 80}, {240, 240, 240}};
    struct fisheye *const f = demo_alloc(&context->arena, sizeof(*f));
    if (!f) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t i = 0; i < WALLS; i++) {
        const uint8_t *const c = light[i];
        f->tiles[i][0] = demo_unlit(c[0], c[1], c[2]);
        f->tiles[i][1] = demo_unlit((uint8_t)(c[0] * 3 / 4), (uint8_t)(c[1] * 3 / 4), (uint8_t)(c[2] * 3 / 4));
    }
    for (uint32_t i = 0; i < THINGS; i++) {
        f->things[i] = demo_lit(f->ramps[i], PH_SHADE_GOURAUD, colours[i][0], colours[i][1], colours[i][2]);
    }
    const size_t size = context->arena.size;
    const uint32_t cells = size >= ARENA(THING_SIDES, CELLS) ? CELLS : size >= ARENA_SOME ? CELLS_SOME : CELLS_FEW;
    const uint32_t sides = cells == CELLS ? THING_SIDES : cells == CELLS_SOME ? SIDES_SOME : SIDES_FEW;
    f->cells = cells;
    context->state = f;
    if (model_lathe(&context->arena, &f->thing, pawn, THING_POINTS, sides, 1, f->things) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    return model_floor(&context->arena, &f->floor, cells, f->tiles[0]);
}

/* The floor, the ceiling and four walls; each is a floor, turned so that it faces the middle. */
static struct ph_xform wall(uint32_t i)
{
    struct ph_xform lie = ph_xform_translate(0, -ROOM, 0);
    const struct ph_xform tip = i < 2 ? ph_xform_rotate_x(i << 31) : ph_xform_rotate_x(1u << 30);
    const struct ph_xform turn = ph_xform_rotate_y(i << 30);
    lie = ph_xform_mul(&tip, &lie);
    return i < 2 ? lie : ph_xform_mul(&turn, &lie);
}

static int draw_room(struct ph_renderer *r, const struct fisheye *f)
{
    const struct ph_xform size = ph_xform_scale(FX_INT(CELLS) / (fx_t)f->cells);
    int status = PH_OK;
    for (uint32_t i = 0; i < WALLS && status == PH_OK; i++) {
        const struct ph_xform side = wall(i), place = ph_xform_mul(&side, &size);
        struct ph_mesh mesh = f->floor;
        mesh.materials = f->tiles[i];
        status = ph_draw_mesh(r, &mesh, &place);
    }
    for (uint32_t i = 0; i < THINGS && status == PH_OK; i++) {
        struct ph_mesh mesh = f->thing;
        const struct ph_xform place =
            ph_xform_translate(i & 1 ? FX_ONE * 2 : FX_ONE * -2, -ROOM, i & 2 ? FX_ONE * 2 : FX_ONE * -2);
        mesh.materials = &f->things[i];
        status = ph_draw_mesh(r, &mesh, &place);
    }
    return status;
}

static int fisheye_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    struct ph_projection projection;
    const fx_t sway = fx_mul_sat(FX_ONE, fx_sin((fx_t)(frame << 9)));
    const struct ph_xform at = ph_xform_translate(-sway, FX_ONE / 2, 0);
    const struct ph_xform turn = ph_xform_rotate_y(frame << 24);
    const struct ph_xform down = ph_xform_rotate_x(1u << 27);
    struct ph_xform view = ph_xform_mul(&turn, &at);
    view = ph_xform_mul(&down, &view);
    const struct fisheye *const f = context->state;
    const fx_t fov = f->cells == CELLS_FEW ? FOV_FEW : context->height > context->width ? FX_INT(200) : FX_INT(180);
    int status = ph_projection_fisheye(&projection, fov, FX_ONE / 8, FX_INT(12));
    status = status ? status : demo_begin(context, r, &view, &projection, &demo_daylight, 0);
    return status ? status : draw_room(r, f);
}

#define VERTICES(sides, cells)                                                                                         \
    (WALLS * MODEL_GROUND_VERTICES(cells) + THINGS * MODEL_LATHE_VERTICES(sides, THING_POINTS))

/* For pictures of up to 320 x 240 pixels (a larger one has more pieces), and for little memory. */
static const struct demo_level coarser[] = {
    {.arena_bytes = ARENA(THING_SIDES, CELLS),
     .vertex_max = VERTICES(THING_SIDES, CELLS),
     .triangle_max = 2640,
     .corner_max = 2800},
    {.arena_bytes = ARENA_SOME,
     .vertex_max = VERTICES(SIDES_SOME, CELLS_SOME),
     .triangle_max = 2300,
     .corner_max = 2050},
    {.arena_bytes = ARENA(SIDES_FEW, CELLS_FEW),
     .vertex_max = VERTICES(SIDES_FEW, CELLS_FEW),
     .triangle_max = 520,
     .corner_max = 540},
};

const struct demo demo_fisheye = {
    .name = "fisheye",
    .summary = "a room through a fisheye: straight walls, curved edges",
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = ARENA(THING_SIDES, CELLS),
    .vertex_max = VERTICES(THING_SIDES, CELLS),
    .triangle_max = 4200,
    .corner_max = 5200,
    .coarser = coarser,
    .coarser_count = sizeof coarser / sizeof coarser[0],
    .init = fisheye_init,
    .frame = fisheye_frame,
};
