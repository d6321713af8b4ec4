/*
 * snake: seen from a camera on its head, looking where it moves (SEEDS row M5). It plays itself: a closed path, a
 * figure of eight that crosses over itself on a hump, with apples on the way; what was eaten grows again behind it.
 * View `outside` looks at it all from above.
 */
#include "demo_scene.h"
#include "models.h"

#define LOOP_FRAMES 512
#define BALLS       38
#define SPACING     0x05000000u /* between two balls of the body, in turns of the path */
#define NOSE        (5u << 24)  /* before the camera */
#define APPLES      8
#define TREES       10
#define TREE_SIDES  6
#define TREE_POINTS 5
#define CELLS       10
#define RADIUS      (FX_ONE * 32 / 100)
#define SPREAD      FX_INT(5)

static const struct model_point tree_profile[TREE_POINTS] = {{FX_ONE / 8, 0},
                                                             {FX_ONE / 8, FX_HALF},
                                                             {FX_ONE * 7 / 10, FX_HALF},
                                                             {FX_ONE * 3 / 10, FX_ONE * 7 / 5},
                                                             {0, FX_ONE * 11 / 5}};

/* A ball of eight sides. */
#define BALL_SIDES  8
#define BALL_POINTS 5
static const struct model_point ball_profile[BALL_POINTS] = {
    {0, -FX_ONE}, {46341, -46341}, {FX_ONE, 0}, {46341, 46341}, {0, FX_ONE}};

struct snake {
    struct ph_mesh light_ball, dark_ball, head, apple, tree, floor;
    struct ph_material skin[2], face, red, leaves, tiles[2];
    uint16_t ramps[5][PH_RAMP_SIZE];
};

/* x = 5 sin t, z = 3.2 sin 2t; over the hump at t = 0, below it at half a turn. */
static struct fx_vec3 path(uint32_t turn32)
{
    int32_t s, c, s2, unused;
    fx_sincos_q30(turn32, &s, &c);
    fx_sincos_q30(2 * turn32, &s2, &unused);
    const fx_t rise = c > 0 ? fx_mul_sat(c >> 14, c >> 14) : 0;
    const fx_t hump = fx_mul_sat(fx_mul_sat(rise, rise), fx_mul_sat(rise, rise));
    return (struct fx_vec3){fx_mul_sat(SPREAD, s >> 14), RADIUS + fx_mul_sat(FX_ONE * 3 / 2, hump),
                            fx_mul_sat(FX_ONE * 32 / 10, s2 >> 14)};
}

static void snake_colours(struct snake *s)
{
    s->skin[0] = demo_lit(s->ramps[0], PH_SHADE_GOURAUD, 250, 205, 60);
    s->skin[1] = demo_lit(s->ramps[1], PH_SHADE_GOURAUD, 225, 90, 45);
    s->face = demo_lit(s->ramps[2], PH_SHADE_GOURAUD, 250, 235, 120);
    s->red = demo_lit(s->ramps[3], PH_SHADE_GOURAUD, 240, 40, 60);
    s->leaves = demo_lit(s->ramps[4], PH_SHADE_FLAT, 50, 150, 90);
    s->tiles[0] = demo_unlit(96, 168, 84);
    s->tiles[1] = demo_unlit(80, 148, 72);
}

static int snake_init(struct demo_context *context)
{
    struct demo_arena *const arena = &context->arena;
    struct snake *const s = demo_alloc(arena, sizeof(*s));
    if (!s) {
        return PH_ERR_NOMEM;
    }
    snake_colours(s);
    if (model_lathe(arena, &s->light_ball, ball_profile, BALL_POINTS, BALL_SIDES, 1, &s->skin[0]) != PH_OK ||
        model_lathe(arena, &s->tree, tree_profile, TREE_POINTS, TREE_SIDES, 1, &s->leaves) != PH_OK ||
        model_floor(arena, &s->floor, CELLS, s->tiles) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    s->dark_ball = s->head = s->apple = s->light_ball;
    s->dark_ball.materials = &s->skin[1];
    s->head.materials = &s->face;
    s->apple.materials = &s->red;
    context->state = s;
    return PH_OK;
}

static int draw_at(struct ph_renderer *r, const struct ph_mesh *mesh, struct fx_vec3 at, fx_t size)
{
    struct ph_xform place = ph_xform_scale(size);
    place.t = at;
    return ph_draw_mesh(r, mesh, &place);
}

/* Thinner towards the tail; the camera on the head sees its nose. */
static int draw_body(struct ph_renderer *r, const struct snake *s, uint32_t head, bool outside)
{
    int status = draw_at(r, &s->head, path(outside ? head : head + NOSE), outside ? RADIUS * 6 / 5 : RADIUS * 3 / 4);
    for (uint32_t i = 1; i <= BALLS && status == PH_OK; i++) {
        const fx_t size = RADIUS - (fx_t)(i * i) * (RADIUS / (BALLS * BALLS * 2));
        status = draw_at(r, (i >> 1) & 1 ? &s->light_ball : &s->dark_ball, path(head - i * SPACING), size);
    }
    return status;
}

/* They hover over the path; eaten when the nose is there, whole again three quarters of the way later. */
static int draw_apples(struct ph_renderer *r, const struct snake *s, uint32_t head)
{
    int status = PH_OK;
    for (uint32_t i = 0; i < APPLES && status == PH_OK; i++) {
        const uint32_t at = (2 * i + 1) << 28;
        const uint32_t since = (head + NOSE - at) >> 16; /* 65536: one time around */
        const uint32_t grown = since < 24576 ? 0 : since < 49152 ? since - 24576 : 24576;
        struct fx_vec3 p = path(at);
        if (grown > 0) {
            p.y += FX_ONE / 6;
            status = draw_at(r, &s->apple, p, (fx_t)(grown * 2 / 3) + 256);
        }
    }
    return status;
}

static int draw_garden(struct ph_renderer *r, const struct snake *s)
{
    static const int8_t places[TREES][2] = {{-7, -6}, {-3, -7}, {2, -6}, {6, -7}, {7, -2},
                                            {7, 4},   {3, 7},   {-2, 6}, {-6, 7}, {-7, 1}};
    int status = PH_OK;
    for (uint32_t i = 0; i < TREES && status == PH_OK; i++) {
        status = draw_at(r, &s->tree, (struct fx_vec3){FX_INT(places[i][0]), 0, FX_INT(places[i][1])},
                         FX_ONE + (fx_t)(i % 3) * (FX_ONE / 4));
    }
    const struct ph_xform lawn = ph_xform_scale(FX_ONE * 17 / 10);
    return status ? status : ph_draw_mesh(r, &s->floor, &lawn);
}

static int snake_camera(const struct demo_context *context, struct ph_renderer *r, uint32_t head, bool outside)
{
    struct ph_projection projection = demo_perspective(context, FX_ONE << 4, FX_ONE / 8, FX_INT(40)); /* 90 degrees */
    const struct fx_vec3 at = path(head);
    const struct fx_vec3 next = path(head + (1u << 25));
    const fx_t up = FX_HALF;
    struct ph_xform view = demo_look(at.x, at.y + up, at.z, next.x, next.y + up - FX_ONE / 32, next.z);
    if (outside) {
        projection = demo_perspective(context, DEMO_SCALE_60_Q20, FX_INT(4), FX_INT(30));
        view = demo_look(0, FX_INT(9), FX_ONE * 8, 0, 0, 0);
        demo_orbit(context, &view, &projection);
    }
    return demo_begin(context, r, &view, &projection, &demo_daylight, ph_rgb565(140, 195, 235));
}

static int snake_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct snake *const s = context->state;
    const uint32_t head = frame << 23;
    const bool outside = demo_view_is(context, &demo_snake, 1);
    int status = snake_camera(context, r, head, outside);
    status = status ? status : draw_body(r, s, head, outside);
    status = status ? status : draw_apples(r, s, head);
    return status ? status : draw_garden(r, s);
}

static const char *const views[] = {"head", "outside", NULL};

const struct demo demo_snake = {
    .name = "snake",
    .summary = "a snake that eats apples, seen from a camera on its head",
    .views = views,
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = MODEL_ROUND8(sizeof(struct snake)) + MODEL_LATHE_BYTES(BALL_SIDES, BALL_POINTS, 1) +
                   MODEL_LATHE_BYTES(TREE_SIDES, TREE_POINTS, 1) + MODEL_FLOOR_BYTES(CELLS),
    .vertex_max = MODEL_GROUND_VERTICES(CELLS),
    .triangle_max = 1600,
    .init = snake_init,
    .frame = snake_frame,
};
