/*
 * materials: what a surface can be, under three coloured lamps and a spot: lit in colours, with a colour for each
 * vertex, cut out, blended, glowing; in fog. A picture and text lie over it.
 */
#include "demo_scene.h"
#include "models.h"
#include "overlay.h"

#define LOOP_FRAMES 512
#define CELLS       14
#define LEVELS      2
#define CELLS_FEW   7 /* and levels, where memory is small */
#define LEVELS_FEW  1
#define LOG2        5 /* of the sides of the textures */
#define SIDE        (1 << LOG2)
#define TEXELS      (SIDE * SIDE)
#define LAMPS       3
#define FENCES      2
#define KEY         0x1ff8 /* wire order: magenta */

enum { BALL, CUBE, FENCE, GLASS, GLOW, MATERIALS = GLOW + LAMPS };

#define VERTICES(levels, cells)                                                                                        \
    (MODEL_GROUND_VERTICES(cells) + 2 * MODEL_ICOSPHERE_VERTICES(levels) + 24 + 4 * FENCES + 4 * LAMPS)
#define ARENA(levels, cells)                                                                                           \
    (MODEL_ROUND8(sizeof(struct materials)) + MODEL_FLOOR_BYTES(cells) +                                               \
     MODEL_BYTES(MODEL_ICOSPHERE_VERTICES(levels), MODEL_ICOSPHERE_TRIANGLES(levels)) + MODEL_CUBE_BYTES +             \
     2 * MODEL_ROUND8(sizeof(struct ph_part)))

struct materials {
    struct ph_mesh floor, ball, cube;
    struct ph_material list[MATERIALS], tiles[2];
    uint16_t colours[24]; /* of the cube's corners */
    uint16_t fence[TEXELS], light[TEXELS];
    struct ph_texture fence_texture, light_texture;
    struct ph_blend glow;
    struct ph_scene_light lights;
    fx_t floor_scale;
    uint32_t frame;
};

static const struct ph_blend cut_out = {.draw = ph_draw_blended, .kind = PH_BLEND_KEY, .key = KEY};
static const struct ph_blend glass = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 11};

/* White from above, and a red, a green and a blue lamp, which are placed in each frame. */
static const struct ph_scene_light lights = {
    .ambient = FX_ONE / 3,
    .count = 1 + LAMPS,
    .lights = {{.kind = PH_LIGHT_SPOT,
                .intensity = FX_ONE,
                .to_light_q30 = {0, 1 << 30, 0},
                .position = {0, FX_INT(6), 0},
                .cos_outer = FX_ONE * 82 / 100,
                .cos_inner = FX_ONE * 90 / 100},
               {.kind = PH_LIGHT_POINT, .intensity = FX_ONE, .reach = FX_INT(2), .red = FX_ONE, .green = FX_ONE / 8},
               {.kind = PH_LIGHT_POINT, .intensity = FX_ONE, .reach = FX_INT(2), .green = FX_ONE, .blue = FX_ONE / 8},
               {.kind = PH_LIGHT_POINT, .intensity = FX_ONE, .reach = FX_INT(2), .blue = FX_ONE, .red = FX_ONE / 4}}};

/* ---- what there is ---------------------------------------------------------------------------------------------- */

/* A wire fence in a frame, and a round spot of light. */
static void fill_textures(struct materials *m)
{
    for (int32_t i = 0; i < TEXELS; i++) {
        const int32_t x = i & (SIDE - 1), y = i >> LOG2, edge = SIDE - 2;
        const bool frame = x < 2 || y < 2 || x >= edge || y >= edge, wire = ((x + y) & 7) < 2 || ((x - y) & 7) < 2;
        m->fence[i] = frame ? ph_rgb565(190, 130, 70) : wire ? ph_rgb565(210, 210, 200) : KEY;
        const int32_t dx = 2 * x - SIDE + 1, dy = 2 * y - SIDE + 1, left = SIDE * SIDE - dx * dx - dy * dy;
        const int32_t part = left > 0 ? left * 255 / (SIDE * SIDE) : 0;
        m->light[i] = ph_rgb565(0, (uint8_t)(part * part / 255), 0);
    }
    m->fence_texture =
        (struct ph_texture){.texels = m->fence, .log2_width = LOG2, .log2_height = LOG2, .wrap = PH_WRAP_CLAMP};
    m->light_texture = m->fence_texture;
    m->light_texture.texels = m->light;
    m->light_texture.filter = PH_FILTER_BILINEAR;
    m->glow = (struct ph_blend){
        .draw = ph_draw_blended_alphas, .kind = PH_BLEND_ADD, .alpha = 32, .alphas = &m->light_texture};
}

/* A lit material without a ramp: the lamps have colours. */
static struct ph_material lit(uint8_t red, uint8_t green, uint8_t blue, fx_t specular)
{
    return (struct ph_material){.shading = PH_SHADE_GOURAUD,
                                .shininess_log2 = 5,
                                .ambient = FX_ONE,
                                .diffuse = FX_ONE * 9 / 10,
                                .specular = specular,
                                .colour = ph_rgb565(red, green, blue)};
}

static void fill_materials(const struct demo_context *context, struct materials *m)
{
    m->tiles[0] = m->tiles[1] = lit(0, 0, 0, 0);
    m->tiles[0].colour = demo_tile(context, 200, 200, 210).colour;
    m->tiles[1].colour = demo_tile(context, 120, 125, 140).colour;
    m->list[BALL] = lit(225, 225, 225, FX_ONE * 3 / 4);
    m->list[CUBE] = lit(255, 255, 255, 0);
    m->list[FENCE] = (struct ph_material){
        .shading = PH_SHADE_TEXTURE, .texture = &m->fence_texture, .two_sided = 1, .blend = &cut_out};
    m->list[GLASS] = lit(120, 220, 255, FX_ONE);
    m->list[GLASS].two_sided = 1;
    m->list[GLASS].blend = &glass;
    for (uint32_t i = 0; i < LAMPS; i++) {
        const struct ph_light *const l = &lights.lights[1 + i];
        m->list[GLOW + i] = demo_unlit((uint8_t)(60 + l->red * 195 / FX_ONE), (uint8_t)(60 + l->green * 195 / FX_ONE),
                                       (uint8_t)(60 + l->blue * 195 / FX_ONE));
        m->list[GLOW + i].blend = &m->glow;
    }
}

static int make_models(struct demo_arena *arena, struct materials *m, bool fine)
{
    if (model_icosphere(arena, &m->ball, fine ? LEVELS : LEVELS_FEW) != PH_OK ||
        model_material(arena, &m->ball, &m->list[BALL]) != PH_OK || model_cube(arena, &m->cube) != PH_OK ||
        model_material(arena, &m->cube, &m->list[CUBE]) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t i = 0; i < m->cube.vertex_count; i++) {
        const struct fx_vec3 *const p = &m->cube.positions[i];
        m->colours[i] = ph_rgb565(p->x > 0 ? 255 : 30, p->y > 0 ? 255 : 30, p->z > 0 ? 255 : 30);
    }
    m->cube.colours = m->colours;
    return PH_OK;
}

static int make_floor(struct demo_context *context, bool fine)
{
    struct materials *const m = context->state;
    const uint32_t cells = fine ? CELLS : CELLS_FEW;
    m->floor_scale = (fx_t)(FX_INT(CELLS) / cells);
    return model_floor(&context->arena, &m->floor, cells, m->tiles);
}

static int materials_init(struct demo_context *context)
{
    struct materials *const m = demo_alloc(&context->arena, sizeof(*m));
    if (!m) {
        return PH_ERR_NOMEM;
    }
    m->lights = lights;
    fill_textures(m);
    fill_materials(context, m);
    context->state = m;
    const bool fine = context->arena.size >= ARENA(LEVELS, CELLS);
    const int status = make_models(&context->arena, m, fine);
    return status ? status : make_floor(context, fine);
}

/* ---- a frame ---------------------------------------------------------------------------------------------------- */

static struct fx_vec3 lamp_at(uint32_t frame, uint32_t i)
{
    int32_t s, c;
    fx_sincos_q30((frame << 24) + (uint32_t)(((uint64_t)i << 32) / LAMPS), &s, &c);
    return (struct fx_vec3){(c >> 14) * 5 / 2, FX_ONE * 9 / 5 + (fx_t)i * FX_ONE / 4, (s >> 14) * 5 / 2};
}

static int draw_solids(const struct materials *m, struct ph_renderer *r)
{
    struct ph_xform ball = ph_xform_translate(0, FX_ONE, 0), cube = ph_xform_scale(FX_ONE * 6 / 10);
    const struct ph_xform turn = ph_xform_rotate_y(m->frame << 24), floor = ph_xform_scale(m->floor_scale),
                          here = ph_xform_identity;
    cube = ph_xform_mul(&turn, &cube);
    cube.t = (struct fx_vec3){-FX_ONE * 22 / 10, FX_ONE * 8 / 10, FX_ONE / 2};
    int status = ph_draw_mesh(r, &m->floor, &floor);
    status = status ? status : ph_draw_mesh(r, &m->ball, &ball);
    status = status ? status : ph_draw_mesh(r, &m->cube, &cube);
    for (int32_t i = 0; i < FENCES && status == PH_OK; i++) {
        static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
        static const fx_t uvs[4][2] = {{0, FX_ONE}, {FX_ONE, FX_ONE}, {FX_ONE, 0}, {0, 0}};
        static const struct ph_part all = {.count = 2};
        const fx_t x = i == 0 ? -FX_INT(3) : FX_ONE / 4, z = -FX_ONE * 5 / 2, side = FX_ONE * 11 / 4, h = FX_ONE * 2;
        const struct fx_vec3 corners[4] = {{x, 0, z}, {x + side, 0, z}, {x + side, h, z}, {x, h, z}};
        const struct ph_mesh fence = {.positions = corners,
                                      .uvs = uvs,
                                      .triangles = triangles,
                                      .parts = &all,
                                      .materials = &m->list[FENCE],
                                      .vertex_count = 4,
                                      .triangle_count = 2,
                                      .part_count = 1};
        status = ph_draw_mesh(r, &fence, &here);
    }
    return status;
}

/* What is blended, from the farthest on: the lamps' glow, and a ball of glass. */
static int draw_blended(const struct materials *m, struct ph_renderer *r)
{
    struct fx_vec3 at[LAMPS + 1] = {[LAMPS] = {FX_ONE * 21 / 10, FX_ONE, FX_ONE * 9 / 10}};
    bool drawn[LAMPS + 1] = {false};
    int status = PH_OK;
    for (uint32_t i = 0; i < LAMPS; i++) {
        at[i] = lamp_at(m->frame, i);
    }
    for (uint32_t n = 0; n <= LAMPS && status == PH_OK; n++) {
        uint32_t next = 0;
        fx_t most = FX_MIN;
        for (uint32_t i = 0; i <= LAMPS; i++) {
            const fx_t away = -ph_xform_point(&r->view, at[i]).z;
            if (!drawn[i] && away > most) {
                most = away;
                next = i;
            }
        }
        drawn[next] = true;
        if (next < LAMPS) {
            status = ph_draw_billboard(r, at[next], FX_ONE * 3 / 2, FX_ONE * 3 / 2, &m->list[GLOW + next]);
            continue;
        }
        struct ph_mesh ball = m->ball;
        ball.materials = &m->list[GLASS];
        struct ph_xform place = ph_xform_scale(FX_ONE * 9 / 10);
        place.t = at[LAMPS];
        status = ph_draw_mesh(r, &ball, &place);
    }
    return status;
}

static uint8_t title_scale(const struct demo_context *context)
{
    return context->width >= 200 ? 2 : 1;
}

static int materials_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    struct materials *const m = context->state;
    struct ph_projection projection = demo_perspective(context, DEMO_SCALE_60_Q20, FX_HALF, FX_INT(24));
    struct ph_xform view = demo_look(0, FX_ONE * 32 / 10, FX_ONE * 64 / 10, 0, FX_ONE * 8 / 10, 0);
    const struct ph_xform turn = ph_xform_rotate_y((uint32_t)demo_swing(frame, LOOP_FRAMES) << 13);
    const struct ph_fog fog = {demo_sky(context, 60, 66, 96), FX_INT(6), FX_INT(13)};
    m->frame = context->frame = frame;
    for (uint32_t i = 0; i < LAMPS; i++) {
        m->lights.lights[1 + i].position = lamp_at(frame, i);
    }
    view = ph_xform_mul(&view, &turn);
    demo_orbit(context, &view, &projection);
    projection =
        demo_below(projection, context->height, demo_text_inset(context) + title_scale(context) * DEMO_TEXT_LINE);
    int status = demo_begin(context, r, &view, &projection, &m->lights, fog.colour);
    status = status ? status : ph_frame_fog(r, &fog);
    status = status ? status : draw_solids(m, r);
    return status ? status : draw_blended(m, r);
}

/* Which frame it is, in the strip above the scene, and a badge with the fence's pattern, through which the scene is
 * seen. */
static uint32_t materials_band(struct demo_context *context, struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const struct materials *const m = context->state;
    const uint32_t lines = ph_draw_band(r, band, pixels), height = (uint32_t)r->config.band_height >> r->samples_log2;
    const struct ph_overlay_band over = {pixels, context->width, (int32_t)(band * height), (int32_t)lines};
    const struct ph_sprite badge = {m->fence, SIDE, SIDE, 20, true, KEY, NULL};
    const struct ph_overlay_style style = {ph_rgb565(255, 255, 255), ph_rgb565(20, 20, 40), title_scale(context)};
    const int32_t inset = demo_text_inset(context), edge = demo_may_be_round(context) ? inset + 6 : 6;
    char text[10 + PH_TEXT_NUMBER_SIZE];
    ph_text_number(demo_add_text(text, "Materials "), (int32_t)(context->frame % LOOP_FRAMES));
    if (context->width >= 200) {
        ph_overlay_sprite(&over, context->width - SIDE - edge, context->height - SIDE - edge, &badge);
    }
    ph_text(&over, (context->width - ph_text_width("Materials 888", style.scale)) / 2, inset, text, &style);
    return lines;
}

/* For little memory. */
static const struct demo_level coarser = {.arena_bytes = ARENA(LEVELS_FEW, CELLS_FEW),
                                          .vertex_max = VERTICES(LEVELS_FEW, CELLS_FEW),
                                          .triangle_max = 320,
                                          .corner_max = 160};

const struct demo demo_materials = {
    .name = "materials",
    .summary = "coloured lamps and corners, a fence that is cut out, glass, glow, fog, a badge and text",
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = ARENA(LEVELS, CELLS),
    .vertex_max = VERTICES(LEVELS, CELLS),
    .triangle_max = 960,
    .corner_max = 256,
    .coarser = &coarser,
    .coarser_count = 1,
    .init = materials_init,
    .frame = materials_frame,
    .band = materials_band,
};
