/*
 * yard: the benchmark's cube, sphere and plain dressed up, under another name, because those must stay as they are. A
 * crate, whole and lit, and a globe whose twenty faces show that it turns stand on a chequered plain that reaches the
 * horizon; the camera walks around them. Fog takes the plain into the colour of the sky.
 */
#include "demo_scene.h"
#include "models.h"
#include "shadow.h"

#define LOOP_FRAMES  256
#define FACES        20 /* of the icosahedron, from which the globe is made */
#define CELLS        24
#define CELLS_SOME   16                  /* where memory is less */
#define CELLS_FEW    10                  /* where it is small */
#define PLAIN        (FX_INT(2) * CELLS) /* its side */
#define TEXTURE_LOG2 4
#define TEXELS       (1u << (2 * TEXTURE_LOG2))
#define CRATE        (FX_ONE * 3 / 4) /* half its side */
#define SKY          150, 195, 235

struct yard {
    struct ph_mesh crate, globe, plain;
    struct ph_material wood, faces[3], tiles[2], shade;
    struct ph_texture texture;
    struct ph_part face_parts[FACES];
    uint16_t ramps[3][PH_RAMP_SIZE];
    uint16_t texels[TEXELS];
    fx_t plain_scale;
};

/* Planks, a frame around them, and nails. */
static void make_wood(struct yard *y)
{
    for (uint32_t i = 0; i < TEXELS; i++) {
        const uint32_t u = i % (1u << TEXTURE_LOG2), v = i >> TEXTURE_LOG2, last = (1u << TEXTURE_LOG2) - 1;
        const bool frame = u < 2 || v < 2 || u > last - 2 || v > last - 2;
        const bool nail = (u == 1 || u == last - 1) && (v == 1 || v == last - 1);
        const uint32_t grain = (u * 7 + (v >> 2) * 5) % 4 * 6, gap = !frame && v % 4 == 1 ? 60 : 0;
        y->texels[i] =
            nail ? ph_rgb565(70, 60, 55)
                 : ph_rgb565((uint8_t)((frame ? 200 : 228) - grain - gap), (uint8_t)((frame ? 140 : 170) - grain - gap),
                             (uint8_t)((frame ? 80 : 105) - grain - gap));
    }
    y->texture = (struct ph_texture){
        .texels = y->texels, .log2_width = TEXTURE_LOG2, .log2_height = TEXTURE_LOG2, .wrap = PH_WRAP_CLAMP};
    y->wood = (struct ph_material){
        .shading = PH_SHADE_TEXTURE_LIT, .texture = &y->texture, .ambient = FX_ONE / 3, .diffuse = FX_ONE * 2 / 3};
}

/* Each face of the icosahedron has one colour; faces that share an edge mostly differ. */
static void paint_globe(struct yard *y)
{
    static const uint8_t colours[FACES] = {0, 1, 2, 0, 1, 0, 1, 2, 0, 2, 1, 2, 0, 1, 2, 1, 1, 0, 1, 0};
    const uint32_t each = y->globe.triangle_count / FACES;
    for (uint32_t i = 0; i < FACES; i++) {
        y->face_parts[i] = (struct ph_part){i * each, each, colours[i]};
    }
    y->globe.parts = y->face_parts;
    y->globe.part_count = FACES;
    y->globe.materials = y->faces;
}

#define ARENA(levels, cells)                                                                                           \
    (MODEL_ROUND8(sizeof(struct yard)) + MODEL_ROUND8(sizeof(struct ph_part)) + MODEL_CUBE_BYTES +                     \
     MODEL_BYTES(MODEL_ICOSPHERE_VERTICES(levels), MODEL_ICOSPHERE_TRIANGLES(levels)) + MODEL_FLOOR_BYTES(cells))
#define ARENA_FINE ARENA(3, CELLS)
#define ARENA_LESS ARENA(3, CELLS_FEW)
#define ARENA_SOME ARENA(2, CELLS_SOME)
#define ARENA_FEW  ARENA(1, CELLS_FEW)

static int yard_init(struct demo_context *context)
{
    struct demo_arena *const arena = &context->arena;
    struct yard *const y = context->state = demo_alloc(arena, sizeof(*y));
    const uint32_t levels = arena->size >= ARENA_LESS ? 3 : arena->size >= ARENA_SOME ? 2 : 1;
    const uint32_t cells = arena->size >= ARENA_FINE ? CELLS : levels == 2 ? CELLS_SOME : CELLS_FEW;
    if (!y || model_cube(arena, &y->crate) != PH_OK || model_material(arena, &y->crate, &y->wood) != PH_OK ||
        model_icosphere(arena, &y->globe, levels) != PH_OK || model_floor(arena, &y->plain, cells, y->tiles) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    make_wood(y);
    y->wood.ambient = demo_is_small(context) ? FX_ONE : FX_ONE / 3;
    y->faces[0] = demo_figure(context, y->ramps[0], 60, 130, 230);
    y->faces[1] = demo_figure(context, y->ramps[1], 245, 245, 235);
    y->faces[2] = demo_figure(context, y->ramps[2], 240, 90, 60);
    y->tiles[0] = demo_tile(context, 196, 186, 150);
    y->tiles[1] = demo_tile(context, 140, 150, 110);
    y->shade = demo_tile(context, 84, 86, 76);
    y->shade.depth_bias = 16;
    y->plain_scale = PLAIN / (fx_t)cells;
    paint_globe(y);
    return PH_OK;
}

static int begin(const struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    struct ph_projection projection = demo_perspective(context, DEMO_SCALE_60_Q20, FX_ONE, FX_INT(40));
    struct ph_xform view = demo_look(0, FX_ONE * 9 / 4, FX_ONE * 21 / 4, 0, FX_ONE * 3 / 4, 0);
    const struct ph_xform turn = ph_xform_rotate_y(frame << 24);
    const struct ph_fog fog = {.start = FX_INT(9), .end = FX_INT(22), .colour = demo_sky(context, SKY)};
    view = ph_xform_mul(&view, &turn);
    demo_orbit(context, &view, &projection);
    const int status = demo_begin(context, r, &view, &projection, &demo_daylight, fog.colour);
    return status ? status : ph_frame_fog(r, &fog);
}

static int draw_with_shadow(struct ph_renderer *r, const struct yard *y, const struct ph_mesh *mesh,
                            const struct ph_xform *place)
{
    static const struct ph_plane_equation ground = {{0, FX_Q30_ONE, 0}, 0};
    static const struct fx_vec3 sun = {FX_INT(-20), FX_INT(28), FX_INT(20)}; /* along demo_daylight */
    const int status = ph_draw_mesh(r, mesh, place);
    return status ? status : ph_draw_shadow(r, mesh, place, sun, &ground, &y->shade);
}

static int yard_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct yard *const y = context->state;
    const struct ph_xform size = ph_xform_scale(CRATE), turn = ph_xform_rotate_y(0x15000000);
    struct ph_xform crate = ph_xform_mul(&turn, &size);
    const struct ph_xform globe = demo_place(FX_ONE * 13 / 10, FX_ONE, FX_ONE / 4, frame << 25);
    const struct ph_xform plain = ph_xform_scale(y->plain_scale);
    crate.t = (struct fx_vec3){FX_ONE * -13 / 10, CRATE, 0};
    int status = begin(context, r, frame);
    status = status ? status : draw_with_shadow(r, y, &y->crate, &crate);
    status = status ? status : draw_with_shadow(r, y, &y->globe, &globe);
    return status ? status : ph_draw_mesh(r, &y->plain, &plain);
}

/* Vertices of a frame: each body twice, because its shadow is drawn of it, and the plain. */
#define VERTICES(levels, cells) (48 + 2 * MODEL_ICOSPHERE_VERTICES(levels) + MODEL_GROUND_VERTICES(cells))

static const struct demo_level coarser[] = {
    {.arena_bytes = ARENA_LESS, .vertex_max = VERTICES(3, CELLS_FEW), .triangle_max = 1378, .corner_max = 60},
    {.arena_bytes = ARENA_SOME, .vertex_max = VERTICES(2, CELLS_SOME), .triangle_max = 700, .corner_max = 100},
    {.arena_bytes = ARENA_FEW, .vertex_max = VERTICES(1, CELLS_FEW), .triangle_max = 260, .corner_max = 60},
};

const struct demo demo_yard = {
    .name = "yard",
    .summary = "a crate and a turning globe on a plain with a horizon: scenes of the benchmark, dressed up",
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = ARENA_FINE,
    .vertex_max = VERTICES(3, CELLS),
    .triangle_max = 1750,
    .corner_max = 150,
    .coarser = coarser,
    .coarser_count = sizeof coarser / sizeof coarser[0],
    .init = yard_init,
    .frame = yard_frame,
};
