/*
 * shadow: a teapot and a ring cast shadows on the floor, lit by a lamp that circles above them (source: K. Juenemann,
 * HAW Hamburg, chapter 9, self-made shadows).
 */
#include "shadow.h"
#include "demo_scene.h"
#include "models.h"

#define LOOP_FRAMES  256
#define SEGMENTS     3
#define MAJOR        16 /* of the ring */
#define MINOR        8
#define CELLS        14
#define MINOR_SMALL  6 /* in small pictures */
#define CELLS_SMALL  10
#define SEGMENTS_FEW 2 /* where memory is small */
#define MAJOR_FEW    8
#define MINOR_FEW    4
#define CELLS_FEW    6
#define BELOW_POT    (FX_ONE * 64 / 100) /* a hair above the floor: its shadow needs no clipping */

struct shadows {
    struct ph_mesh pot, ring, lamp, floor;
    struct ph_material china, gold, glow, tiles[2], shade;
    uint16_t ramps[4][PH_RAMP_SIZE];
    fx_t floor_scale;
};

static void shadow_colours(struct shadows *s)
{
    s->china = demo_lit(s->ramps[0], PH_SHADE_GOURAUD, 110, 170, 235);
    s->gold = demo_lit(s->ramps[1], PH_SHADE_GOURAUD, 250, 190, 60);
    s->tiles[0] = demo_lit(s->ramps[2], PH_SHADE_GOURAUD, 235, 225, 205);
    s->tiles[1] = demo_lit(s->ramps[3], PH_SHADE_GOURAUD, 200, 180, 155);
    s->glow = demo_unlit(255, 245, 190);
    s->shade = demo_unlit(52, 46, 52);
    s->shade.depth_bias = 16;
}

#define ARENA(n, major, minor, lamp, cells)                                                                            \
    (MODEL_ROUND8(sizeof(struct shadows)) + 3 * MODEL_ROUND8(sizeof(struct ph_part)) +                                 \
     MODEL_BYTES(MODEL_TEAPOT_VERTICES(n), MODEL_TEAPOT_TRIANGLES(n)) +                                                \
     MODEL_BYTES(MODEL_TORUS_VERTICES(major, minor), MODEL_TORUS_TRIANGLES(major, minor)) +                            \
     MODEL_BYTES(MODEL_ICOSPHERE_VERTICES(lamp), MODEL_ICOSPHERE_TRIANGLES(lamp)) + MODEL_FLOOR_BYTES(cells))
#define ARENA_FINE  ARENA(SEGMENTS, MAJOR, MINOR, 1, CELLS)
#define ARENA_SMALL ARENA(SEGMENTS, MAJOR, MINOR_SMALL, 1, CELLS_SMALL)
#define ARENA_FEW   ARENA(SEGMENTS_FEW, MAJOR_FEW, MINOR_FEW, 0, CELLS_FEW)

static int shadow_init(struct demo_context *context)
{
    struct demo_arena *const arena = &context->arena;
    struct shadows *const s = demo_alloc(arena, sizeof(*s));
    if (!s) {
        return PH_ERR_NOMEM;
    }
    shadow_colours(s);
    context->state = s;
    const bool fine = arena->size >= ARENA_FINE, few = arena->size < ARENA_SMALL;
    const uint32_t cells = fine ? CELLS : few ? CELLS_FEW : CELLS_SMALL;
    s->floor_scale = FX_ONE * CELLS / (fx_t)cells;
    if (model_teapot(arena, &s->pot, few ? SEGMENTS_FEW : SEGMENTS) != PH_OK ||
        model_material(arena, &s->pot, &s->china) != PH_OK ||
        model_torus(arena, &s->ring, few ? MAJOR_FEW : MAJOR,
                    fine  ? MINOR
                    : few ? MINOR_FEW
                          : MINOR_SMALL,
                    1 << 27, 1 << 25) != PH_OK ||
        model_material(arena, &s->ring, &s->gold) != PH_OK || model_icosphere(arena, &s->lamp, few ? 0 : 1) != PH_OK ||
        model_material(arena, &s->lamp, &s->glow) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    return model_floor(arena, &s->floor, cells, s->tiles);
}

/* The lamp moves on a circle above the scene, three units wide. */
static struct fx_vec3 lamp_at(uint32_t frame)
{
    int32_t sin, cos;
    fx_sincos_q30(frame << 24, &sin, &cos);
    return (struct fx_vec3){(cos >> 14) * 5 / 4, FX_ONE * 3, (sin >> 14) * 5 / 4};
}

static int shadow_begin(const struct demo_context *context, struct ph_renderer *r, struct fx_vec3 lamp)
{
    const struct ph_scene_light light = {
        .ambient = FX_ONE,
        .count = 1,
        .lights = {{.kind = PH_LIGHT_POINT, .intensity = FX_ONE * 5 / 4, .position = lamp, .reach = FX_INT(7)}}};
    struct ph_projection projection = demo_perspective(context, DEMO_SCALE_60_Q20, FX_ONE, FX_INT(24));
    struct ph_xform view = demo_look(0, FX_ONE * 3, FX_ONE * 5, 0, FX_ONE * 3 / 4, 0);
    demo_orbit(context, &view, &projection);
    return demo_begin(context, r, &view, &projection, &light, demo_sky(context, 24, 26, 36));
}

static int draw_with_shadow(struct ph_renderer *r, const struct shadows *s, const struct ph_mesh *mesh,
                            const struct ph_xform *place, struct fx_vec3 lamp)
{
    const struct ph_plane_equation ground = {{0, FX_Q30_ONE, 0}, 0};
    const int status = ph_draw_mesh(r, mesh, place);
    return status ? status : ph_draw_shadow(r, mesh, place, lamp, &ground, &s->shade);
}

static int shadow_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct shadows *const s = context->state;
    const struct fx_vec3 lamp = lamp_at(frame);
    const struct ph_xform pot = demo_place(-FX_ONE / 2, BELOW_POT, 0, 0u - (frame << 24));
    const struct ph_xform tilt = ph_xform_rotate_x(frame << 25);
    struct ph_xform ring = demo_place(FX_ONE * 13 / 10, FX_ONE * 9 / 10, FX_ONE * 3 / 10, frame << 24);
    ring = ph_xform_mul(&ring, &tilt);
    struct ph_xform bulb = ph_xform_scale(FX_ONE / 8);
    bulb.t = lamp;
    const struct ph_xform floor = ph_xform_scale(s->floor_scale);
    int status = shadow_begin(context, r, lamp);
    status = status ? status : draw_with_shadow(r, s, &s->pot, &pot, lamp);
    status = status ? status : draw_with_shadow(r, s, &s->ring, &ring, lamp);
    status = status ? status : ph_draw_mesh(r, &s->lamp, &bulb);
    return status ? status : ph_draw_mesh(r, &s->floor, &floor);
}

/* vertex_max: each body twice, its shadow, too */
static const struct demo_level coarser[] = {
    {.arena_bytes = ARENA_SMALL, .vertex_max = 959, .triangle_max = 1030, .corner_max = 40, .enough_px = 135},
    {.arena_bytes = ARENA_FEW, .vertex_max = 401, .triangle_max = 480, .corner_max = 24},
};

const struct demo demo_shadow = {
    .name = "shadow",
    .summary = "shadows of a teapot and a ring by a lamp that circles above them",
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = ARENA_FINE,
    .vertex_max = 1127,
    .triangle_max = 1280,
    .corner_max = 40,
    .coarser = coarser,
    .coarser_count = sizeof coarser / sizeof coarser[0],
    .init = shadow_init,
    .frame = shadow_frame,
};
