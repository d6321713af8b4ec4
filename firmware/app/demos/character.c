/* character: the figure of figure.h walks, and runs, in a circle. The lowest sole stands on the ground. */
#include "demo_scene.h"
#include "figure.h"
#include "fx_math.h"
#include "models.h"
#include "shadow.h"

#define LOOP_FRAMES       256
#define CYCLE_FRAMES      32 /* two steps */
#define FADE_FRAMES       16
#define WALK              93000 /* Q16.16: the way of a cycle */
#define RUN               131000
#define RADIUS            135660  /* 2.07 */
#define DEMO_SCALE_39_Q20 2950000 /* 1 / tan(19.57 degrees) */

/* ---- the ground: rings of tiles around a pond -------------------------------------------------------------------- */

#define TILE_RINGS          3
#define GROUND_VERTICES(n)  ((TILE_RINGS + 1) * (n))
#define GROUND_TRIANGLES(n) (2 * TILE_RINGS * (n) + (n)-2)

static int make_ground(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t n, const struct ph_material *tiles)
{
    static const int32_t radius[TILE_RINGS + 1] = {1080, 1740, 2400, 3060};
    struct fx_vec3 *const positions = demo_alloc(arena, GROUND_VERTICES(n) * sizeof *positions);
    uint16_t(*const triangles)[3] = demo_alloc(arena, GROUND_TRIANGLES(n) * sizeof *triangles);
    struct ph_part *const parts = demo_alloc(arena, 3 * sizeof *parts);
    if (!parts || !positions || !triangles) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t v = 0; v < GROUND_VERTICES(n); v++) {
        const fx_t turns = (fx_t)(v % n * 65536 / n), r = radius[v / n] * FX_ONE / 1000;
        positions[v] = (struct fx_vec3){fx_mul_sat(r, fx_sin(turns)), 0, fx_mul_sat(r, fx_cos(turns))};
    }
    uint32_t at = 0;
    for (uint32_t i = 0; i < TILE_RINGS * n * 2; i++) { /* the tiles of one colour, then those of the other */
        const uint32_t tile = i % (TILE_RINGS * n), ring = tile / n, k = tile % n;
        if ((ring + k) % 2 == i / (TILE_RINGS * n)) {
            const uint16_t a = (uint16_t)(ring * n + k), b = (uint16_t)(ring * n + (k + 1) % n);
            const uint16_t pair[2][3] = {{a, (uint16_t)(a + n), (uint16_t)(b + n)}, {a, (uint16_t)(b + n), b}};
            for (uint32_t c = 0; c < 6; c++) {
                triangles[at + c / 3][c % 3] = pair[c / 3][c % 3];
            }
            at += 2;
        }
    }
    parts[0] = (struct ph_part){0, at / 2, 0};
    parts[1] = (struct ph_part){at / 2, at / 2, 1};
    parts[2] = (struct ph_part){at, n - 2, 2};
    for (uint32_t k = 1; k < n - 1; k++, at++) {
        triangles[at][0] = 0;
        triangles[at][1] = (uint16_t)k;
        triangles[at][2] = (uint16_t)(k + 1);
    }
    *mesh = (struct ph_mesh){.positions = positions,
                             .triangles = (const uint16_t(*)[3])triangles,
                             .parts = parts,
                             .materials = tiles,
                             .vertex_count = GROUND_VERTICES(n),
                             .triangle_count = at,
                             .part_count = 3};
    return PH_OK;
}

/* ---- the demo ---------------------------------------------------------------------------------------------------- */

/* A level: of the figure, of its shadow (sides 0: none), sides of the ground; 128 >> this rows of the texture. */
struct detail {
    struct figure_detail figure, shadow;
    uint8_t ground, texture_down;
    bool runs;
};

struct character {
    struct ph_mesh ground;
    struct ph_texture texture;
    struct ph_material skin, tiles[3], shade;
    const struct detail *detail;
    uint16_t (*grids[2])[3]; /* of the figure, of its shadow */
    fx_t (*uvs[FIGURE_TUBES])[2];
    struct figure_gait *gaits[2]; /* walk, run; NULL where memory is small */
    struct fx_vec3 *positions;    /* of one tube, skinned */
    int16_t (*normals)[3];
    struct ph_xform joints[FIGURE_JOINTS]; /* of the tube that is drawn */
    struct ph_pose pose[FIGURE_NODES];
    union {
        struct ph_pose other[FIGURE_NODES]; /* which pose fades to */
        struct ph_xform places[FIGURE_NODES];
    };
};

#define LEVELS 4
static const struct detail details[LEVELS] = {
    {{14, 1}, {8, 2}, 32, 0, true},
    {{10, 1}, {5, 2}, 16, 1, true},
    {{8, 2}, {5, 2}, 16, 1, true},
    {{6, 2}, {0, 2}, 12, 2, false},
};

#define UV_BYTES(s, count, every) MODEL_ROUND8(8 * ((s) + 1) * FIGURE_RINGS_OF(count, every))
#define ARENA(s, every, shadow, ground, down, gaits)                                                                   \
    (MODEL_ROUND8(sizeof(struct character)) + (gaits)*MODEL_ROUND8(sizeof(struct figure_gait)) +                       \
     UV_BYTES(s, FIGURE_BODY_RINGS, every) + UV_BYTES(s, FIGURE_ARM_RINGS, every) +                                    \
     UV_BYTES(s, FIGURE_LEG_RINGS, every) + MODEL_ROUND8(6 * FIGURE_GRID(s, every)) +                                  \
     MODEL_ROUND8(6 * FIGURE_GRID(shadow, 2)) + MODEL_ROUND8(12 * ((s) + 1) * FIGURE_RINGS_MOST(every)) +              \
     MODEL_ROUND8(6 * ((s) + 1) * FIGURE_RINGS_MOST(every)) + (8192U >> 2 * (down)) +                                  \
     MODEL_ROUND8(12 * GROUND_VERTICES(ground)) + MODEL_ROUND8(6 * GROUND_TRIANGLES(ground)) +                         \
     MODEL_ROUND8(3 * sizeof(struct ph_part)))
#define ARENAS                                                                                                         \
    {                                                                                                                  \
        ARENA(14, 1, 8, 32, 0, 2), ARENA(10, 1, 5, 16, 1, 2), ARENA(8, 2, 5, 16, 1, 2), ARENA(6, 2, 0, 12, 2, 1)       \
    }

static void make_materials(struct character *c)
{
    c->skin = (struct ph_material){.shading = PH_SHADE_TEXTURE_GOURAUD,
                                   .ambient = FX_ONE * 2 / 5,
                                   .diffuse = FX_ONE * 13 / 20,
                                   .texture = &c->texture};
    c->tiles[0] = demo_unlit(112, 158, 88);
    c->tiles[1] = demo_unlit(96, 142, 78);
    c->tiles[2] = demo_unlit(104, 164, 200);
    c->shade = demo_unlit(58, 92, 54);
    c->shade.depth_bias = 16;
}

static bool make_figure(struct demo_arena *arena, struct character *c)
{
    const struct detail *const detail = c->detail;
    const uint32_t most = FIGURE_RINGS_MOST(detail->figure.every) * (detail->figure.sides + 1U);
    bool fits = figure_make_grid(arena, &c->grids[0], detail->figure) &&
                (detail->shadow.sides == 0 || figure_make_grid(arena, &c->grids[1], detail->shadow));
    for (uint32_t i = 0; i < FIGURE_TUBES; i++) {
        fits = fits && figure_make_uvs(arena, &c->uvs[i], &figure_tubes[i], detail->figure);
    }
    for (uint32_t i = 0; i < (detail->runs ? 2 : 1); i++) {
        c->gaits[i] = fits ? demo_alloc(arena, sizeof **c->gaits) : NULL;
        fits = c->gaits[i] != NULL;
        if (fits) {
            figure_make_gait(c->gaits[i], i);
        }
    }
    c->positions = demo_alloc(arena, most * sizeof *c->positions);
    c->normals = demo_alloc(arena, most * sizeof *c->normals);
    return fits && c->positions && c->normals;
}

static int character_init(struct demo_context *context)
{
    static const size_t arenas[LEVELS] = ARENAS;
    struct demo_arena *const arena = &context->arena;
    uint32_t level = 0;
    while (level + 1 < LEVELS && arena->size < arenas[level]) {
        level++;
    }
    struct character *const c = demo_alloc(arena, sizeof(*c));
    if (!c) {
        return PH_ERR_NOMEM;
    }
    *c = (struct character){.detail = &details[level]};
    context->state = c;
    make_materials(c);
    if (!make_figure(arena, c) || figure_make_texture(arena, &c->texture, c->detail->texture_down) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    return make_ground(arena, &c->ground, c->detail->ground, c->tiles);
}

/* How far the figure runs: 0: it walks; FX_ONE: it runs; between them it fades. */
static fx_t running_at(const struct character *c, uint32_t frame)
{
    const uint32_t half = LOOP_FRAMES / 2, in = frame % half, steady = half - FADE_FRAMES;
    const fx_t up = in < steady ? 0 : (fx_t)((in - steady) * (FX_ONE / FADE_FRAMES));
    return !c->gaits[1] ? 0 : frame % LOOP_FRAMES < half ? up : FX_ONE - up;
}

/* The angle on the circle that the figure walks; the circle is as long as the way of a whole loop. */
static uint32_t angle_at(const struct character *c, uint32_t frame)
{
    uint32_t way = 0, whole = 0;
    for (uint32_t i = 0; i < LOOP_FRAMES; i++) {
        const uint32_t step = (uint32_t)fx_lerp_sat(WALK, RUN, running_at(c, i)) / CYCLE_FRAMES;
        way += i < frame % LOOP_FRAMES ? step : 0;
        whole += step;
    }
    return (uint32_t)(((uint64_t)way << 32) / whole);
}

static fx_t sole_height(const struct ph_xform *place, int32_t y, int32_t z)
{
    return ph_xform_point(place, (struct fx_vec3){0, FIGURE_MM(y), FIGURE_MM(z)}).y >> 8;
}

/* Sets the places of the nodes: the lowest sole is on the ground, but when the figure flies. */
static void pose_figure(struct character *c, uint32_t frame, uint32_t heading)
{
    const fx_t time = (fx_t)(frame % CYCLE_FRAMES * (FX_ONE / CYCLE_FRAMES)), running = running_at(c, frame);
    const struct ph_xform root = ph_xform_rotate_y(heading);
    ph_rig_rest(&figure_rig, c->pose);
    ph_clip_sample(&c->gaits[0]->clip, time, c->pose, NULL);
    if (running > 0) {
        ph_rig_rest(&figure_rig, c->other);
        ph_clip_sample(&c->gaits[1]->clip, time, c->other, NULL);
        ph_pose_blend(c->pose, c->other, FIGURE_NODES, running);
    }
    ph_rig_places(&figure_rig, c->pose, &root, c->places);
    fx_t lowest = FX_MAX;
    for (uint32_t side = 0; side < 2; side++) {
        const struct ph_xform *const foot = &c->places[FIGURE_LEG + 4 * side + 2], *const toes = foot + 1;
        lowest = fx_min(lowest, fx_min(sole_height(foot, -85, -55), sole_height(foot, -85, 100)));
        lowest = fx_min(lowest, sole_height(toes, -25, 85));
    }
    const int32_t lift = c->pose[FIGURE_HIPS].t.y - figure_rig.nodes[FIGURE_HIPS].rest.t.y - lowest * 256;
    for (uint32_t i = 0; i < FIGURE_NODES; i++) {
        c->places[i].t.y += lift;
    }
}

/* Draws a tube, or its shadow. */
static int draw_tube(const struct character *c, struct ph_renderer *r, uint32_t which, bool is_shadow)
{
    const struct ph_plane_equation plane = {{0, FX_Q30_ONE, 0}, 0};
    const struct fx_vec3 sun = {FX_INT(-5), FX_INT(9), FX_INT(4)};
    const struct figure_detail detail = is_shadow ? c->detail->shadow : c->detail->figure;
    const uint32_t rings = FIGURE_RINGS_OF(figure_tubes[which].count, detail.every),
                   triangles = 2 * detail.sides * (rings - 1);
    const struct ph_part part = {.count = triangles};
    const struct ph_mesh mesh = {.positions = c->positions,
                                 .normals = (const int16_t(*)[3])c->normals,
                                 .uvs = (const fx_t(*)[2])c->uvs[which],
                                 .triangles = (const uint16_t(*)[3])c->grids[is_shadow],
                                 .parts = &part,
                                 .materials = &c->skin,
                                 .vertex_count = rings * (detail.sides + 1U),
                                 .triangle_count = triangles,
                                 .part_count = 1};
    if (detail.sides == 0) {
        return PH_OK;
    }
    figure_skin_tube(&figure_tubes[which], detail, c->joints, c->positions, is_shadow ? NULL : c->normals);
    return is_shadow ? ph_draw_shadow(r, &mesh, &ph_xform_identity, sun, &plane, &c->shade)
                     : ph_draw_mesh(r, &mesh, &ph_xform_identity);
}

static int draw_figure(struct character *c, struct ph_renderer *r)
{
    int status = PH_OK;
    for (uint32_t i = 0; i < 2 * FIGURE_TUBES && status == PH_OK; i++) {
        const struct figure_tube *const tube = &figure_tubes[i / 2];
        uint16_t numbers[FIGURE_JOINTS];
        for (uint32_t k = 0; k < FIGURE_JOINTS; k++) {
            numbers[k] = (uint16_t)(tube->nodes[i % 2] + k);
        }
        if (i % 2 < tube->places) {
            const struct ph_skin skin = {numbers, tube->inverse_bind, (uint32_t)tube->joints};
            ph_skin_matrices(&skin, c->places, c->joints);
            status = draw_tube(c, r, i / 2, false);
            status = status ? status : draw_tube(c, r, i / 2, true);
        }
    }
    return status;
}

/* The figure stays at the origin, and the ground moves. */
static int character_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    struct character *const c = context->state;
    const uint32_t angle = angle_at(c, frame);
    int32_t sin, cos;
    fx_sincos_q30(angle, &sin, &cos);
    const struct ph_xform ground =
        ph_xform_translate(-fx_mul_sat(RADIUS, sin >> 14), 0, -fx_mul_sat(RADIUS, cos >> 14));
    struct ph_xform view = demo_look(0, FX_ONE * 14 / 10, FX_ONE * 33 / 10, 0, FX_ONE * 86 / 100, 0);
    struct ph_projection projection = demo_perspective(context, DEMO_SCALE_39_Q20, FX_ONE, FX_INT(12));
    demo_orbit(context, &view, &projection);
    const int status = demo_begin(context, r, &view, &projection, &demo_two_lamps, ph_rgb565(150, 190, 222));
    pose_figure(c, frame, angle + (1u << 30));
    return status || draw_figure(c, r) ? PH_ERR_NOMEM : ph_draw_mesh(r, &c->ground, &ground);
}

/* Up to 47 % of the triangles were listed in any frame: those that face the viewer, and of the shadow the lamp. */
#define TRIANGLES(s, every) (2 * (s) * (FIGURE_RINGS_DRAWN(every) - 5))
#define LEVEL(s, every, shadow, ground, down, gaits)                                                                   \
    .arena_bytes = ARENA(s, every, shadow, ground, down, gaits),                                                       \
    .vertex_max = ((s) + 1) * FIGURE_RINGS_DRAWN(every) + ((shadow) ? (shadow) + 1 : 0) * FIGURE_RINGS_DRAWN(2) +      \
                  GROUND_VERTICES(ground),                                                                             \
    .triangle_max = (TRIANGLES(s, every) + TRIANGLES(shadow, 2)) / 2 + GROUND_TRIANGLES(ground), .corner_max = 24

static const struct demo_level coarser[LEVELS - 1] = {
    {LEVEL(10, 1, 5, 16, 1, 2), .enough_px = 128},
    {LEVEL(8, 2, 5, 16, 1, 2), .enough_px = 80},
    {LEVEL(6, 2, 0, 12, 2, 1)},
};

const struct demo demo_character = {
    .name = "character",
    .summary = "a figure that walks and runs in a circle",
    .loop_frames = LOOP_FRAMES,
    LEVEL(14, 1, 8, 32, 0, 2),
    .coarser = coarser,
    .coarser_count = LEVELS - 1,
    .init = character_init,
    .frame = character_frame,
};
