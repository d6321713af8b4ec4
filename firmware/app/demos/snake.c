/*
 * snake: seen from a camera on its head, looking where it moves (source: K. Juenemann, HAW Hamburg, chapter 9,
 * exercise 3). View `outside` looks at it all from above. snake_way.h says where it goes.
 */
#include "demo_scene.h"
#include "models.h"
#include "snake_way.h"

#include <string.h>

#define LOOP_FRAMES 512
#define TREES       10
#define TREE_SIDES  6
#define TREE_POINTS 5
#define CELLS       10

/* Where memory is small trees are cones, and balls have fewer sides. */
#define TREE_SIDES_FEW  4
#define TREE_POINTS_FEW 3
#define BALL_SIDES_FEW  4
#define BALL_POINTS_FEW 3
#define CELLS_FEW       5
static const struct model_point cone_profile[TREE_POINTS_FEW] = {
    {FX_ONE / 8, 0}, {FX_ONE * 7 / 10, FX_HALF}, {0, FX_ONE * 11 / 5}};
static const struct model_point gem_profile[BALL_POINTS_FEW] = {{0, -FX_ONE}, {FX_ONE * 9 / 8, 0}, {0, FX_ONE}};

static const struct model_point tree_profile[TREE_POINTS] = {{FX_ONE / 8, 0},
                                                             {FX_ONE / 8, FX_HALF},
                                                             {FX_ONE * 7 / 10, FX_HALF},
                                                             {FX_ONE * 3 / 10, FX_ONE * 7 / 5},
                                                             {0, FX_ONE * 11 / 5}};

/* A ball of eight sides, and one of six for where it is small in the picture. */
#define BALL_SIDES   8
#define BALL_POINTS  5
#define SMALL_SIDES  6
#define SMALL_POINTS 4
static const struct model_point ball_profile[BALL_POINTS] = {
    {0, -FX_ONE}, {46341, -46341}, {FX_ONE, 0}, {46341, 46341}, {0, FX_ONE}};
static const struct model_point small_profile[SMALL_POINTS] = {
    {0, -FX_ONE}, {FX_ONE * 63 / 64, -FX_ONE / 3}, {FX_ONE * 63 / 64, FX_ONE / 3}, {0, FX_ONE}};

/* How finely balls and their shades are made. A ball takes the first form up to whose radius in the picture it is. */
enum { TINY, SMALL, LARGE, FORMS };
#define TINY_PX  2
#define SMALL_PX 4

/* A spot of shade on the lawn, a disc of eight sides; where memory is small it is a square of the first four corners.
 */
#define SHADE_CORNERS     8
#define SHADE_CORNERS_FEW 4
static const struct fx_vec3 shade_corners[SHADE_CORNERS] = {{FX_ONE, 0, 0},     {0, 0, -FX_ONE},    {-FX_ONE, 0, 0},
                                                            {0, 0, FX_ONE},     {46341, 0, -46341}, {-46341, 0, -46341},
                                                            {-46341, 0, 46341}, {46341, 0, 46341}};
static const uint16_t shade_triangles[SHADE_CORNERS - 2][3] = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1},
                                                               {1, 5, 2}, {2, 6, 3}, {3, 7, 0}};
static const struct ph_part shade_parts[2] = {{0, SHADE_CORNERS - 2, 0}, {0, SHADE_CORNERS_FEW - 2, 0}};

struct snake {
    struct snake_way way;
    fx_t lawn_scale;
    struct ph_mesh ball[FORMS], shade[FORMS], tree, floor;
    struct ph_material skin[2], face, red, white, black, leaves, tiles[2], dark;
    uint16_t ramps[6][PH_RAMP_SIZE];
};

/* ---- the scene ------------------------------------------------------------------------------------------------- */

static void snake_colours(struct snake *s)
{
    s->skin[0] = demo_lit(s->ramps[0], PH_SHADE_GOURAUD, 250, 205, 60);
    s->skin[1] = demo_lit(s->ramps[1], PH_SHADE_GOURAUD, 225, 90, 45);
    s->face = demo_lit(s->ramps[2], PH_SHADE_GOURAUD, 250, 235, 120);
    s->red = demo_lit(s->ramps[3], PH_SHADE_GOURAUD, 240, 40, 60);
    s->leaves = demo_lit(s->ramps[4], PH_SHADE_FLAT, 50, 150, 90);
    s->leaves.ambient = s->leaves.diffuse = FX_HALF; /* below they are not black */
    s->tiles[0] = demo_unlit(96, 168, 84);
    s->tiles[1] = demo_unlit(80, 148, 72);
    s->white = demo_lit(s->ramps[5], PH_SHADE_GOURAUD, 255, 255, 255);
    s->black = demo_unlit(20, 24, 30);
    s->dark = demo_unlit(52, 104, 50);
    s->dark.depth_bias = 16;
}

static struct ph_mesh shade_of(const struct snake *s, bool few)
{
    return (struct ph_mesh){.positions = shade_corners,
                            .triangles = shade_triangles,
                            .parts = &shade_parts[few],
                            .materials = &s->dark,
                            .vertex_count = few ? SHADE_CORNERS_FEW : SHADE_CORNERS,
                            .triangle_count = shade_parts[few].count,
                            .part_count = 1};
}

/* Makes one vertex of each pole of a ball, where the lathe has one for each side: the ball is drawn some 60 times. */
static void close_poles(struct ph_mesh *ball, uint32_t sides)
{
    struct fx_vec3 *const positions = (struct fx_vec3 *)(uintptr_t)ball->positions;
    int16_t(*const normals)[3] = (int16_t(*)[3])(uintptr_t)ball->normals;
    uint16_t(*const triangles)[3] = (uint16_t(*)[3])(uintptr_t)ball->triangles;
    const uint32_t last = ball->vertex_count - sides, fewer = sides - 1;
    uint32_t count = 0;
    for (uint32_t v = sides; v <= last; v++) {
        positions[v - fewer] = positions[v];
        memcpy(normals[v - fewer], normals[v], sizeof(normals[v]));
    }
    for (uint32_t i = 0; i < ball->triangle_count; i++) {
        uint16_t corners[3];
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t v = triangles[i][k] < last ? triangles[i][k] : last;
            corners[k] = (uint16_t)(v < sides ? 0 : v - fewer);
        }
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) {
            memcpy(triangles[count++], corners, sizeof(corners));
        }
    }
    ball->vertex_count = last - fewer + 1;
    ball->triangle_count = count;
    ((struct ph_part *)(uintptr_t)ball->parts)->count = count;
}

#define ARENA(balls, tree_sides, tree_points, cells)                                                                   \
    (MODEL_ROUND8(sizeof(struct snake)) + (balls) + MODEL_LATHE_BYTES(tree_sides, tree_points, 1) +                    \
     MODEL_FLOOR_BYTES(cells))
#define GEM        MODEL_LATHE_BYTES(BALL_SIDES_FEW, BALL_POINTS_FEW, 1)
#define ROUND      (MODEL_LATHE_BYTES(BALL_SIDES, BALL_POINTS, 1) + MODEL_LATHE_BYTES(SMALL_SIDES, SMALL_POINTS, 1))
#define ARENA_FINE ARENA(GEM + ROUND, TREE_SIDES, TREE_POINTS, CELLS)
#define ARENA_FEW  ARENA(GEM, TREE_SIDES_FEW, TREE_POINTS_FEW, CELLS_FEW)

static int make_ball(struct demo_arena *arena, struct ph_mesh *ball, const struct model_point *profile, uint32_t points,
                     uint32_t sides)
{
    const int status = model_lathe(arena, ball, profile, points, sides, 1, NULL);
    if (status == PH_OK) {
        close_poles(ball, sides);
    }
    return status;
}

static int make_fine(struct demo_arena *arena, struct snake *s)
{
    s->lawn_scale = FX_ONE * 17 / 10;
    s->shade[SMALL] = s->shade[LARGE] = shade_of(s, false);
    return make_ball(arena, &s->ball[SMALL], small_profile, SMALL_POINTS, SMALL_SIDES) |
           make_ball(arena, &s->ball[LARGE], ball_profile, BALL_POINTS, BALL_SIDES) |
           model_lathe(arena, &s->tree, tree_profile, TREE_POINTS, TREE_SIDES, 1, &s->leaves) |
           model_floor(arena, &s->floor, CELLS, s->tiles);
}

static int make_coarse(struct demo_arena *arena, struct snake *s)
{
    s->lawn_scale = FX_ONE * 17 / 10 * CELLS / CELLS_FEW;
    s->shade[SMALL] = s->shade[LARGE] = s->shade[TINY];
    s->ball[SMALL] = s->ball[LARGE] = s->ball[TINY];
    return model_lathe(arena, &s->tree, cone_profile, TREE_POINTS_FEW, TREE_SIDES_FEW, 1, &s->leaves) |
           model_floor(arena, &s->floor, CELLS_FEW, s->tiles);
}

static int snake_init(struct demo_context *context)
{
    struct demo_arena *const arena = &context->arena;
    struct snake *const s = demo_alloc(arena, sizeof(*s));
    if (!s) {
        return PH_ERR_NOMEM;
    }
    snake_way_begin(&s->way);
    snake_colours(s);
    s->shade[TINY] = shade_of(s, true);
    if (make_ball(arena, &s->ball[TINY], gem_profile, BALL_POINTS_FEW, BALL_SIDES_FEW) != PH_OK ||
        (arena->size >= ARENA_FINE ? make_fine(arena, s) : make_coarse(arena, s)) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    context->state = s;
    return PH_OK;
}

/* Where a body is as the camera sees it. */
struct seen {
    bool at_all;
    uint32_t form;
};

/* How a ball of radius `reach` around a point can be seen: `form` is for its size in the picture. It is not seen at all
 * behind the camera, where most of the snake is, or beside the picture. */
static struct seen see(const struct ph_renderer *r, struct fx_vec3 at, fx_t reach)
{
    const struct ph_projection *const lens = &r->projection;
    const struct fx_vec3 v = ph_xform_point(&r->view, at);
    if (v.z > reach || lens->kind != PH_PERSPECTIVE || (lens->shift_x | lens->shift_y) != 0) {
        return (struct seen){v.z <= reach, LARGE};
    }
    const fx_t far = fx_sub_sat(reach, v.z), size = fx_mul_sat(reach, lens->scale_y_q20 >> 4);
    if (fx_mul_sat(fx_abs_sat(v.x) - reach, lens->scale_x_q20 >> 4) > far ||
        fx_mul_sat(fx_abs_sat(v.y) - reach, lens->scale_y_q20 >> 4) > far) {
        return (struct seen){false, LARGE};
    }
    const fx_t radius = fx_mul_sat(size, FX_INT(r->config.height / 2)); /* px, at a distance of 1 */
    return (struct seen){true, radius / TINY_PX <= -v.z ? TINY : radius / SMALL_PX <= -v.z ? SMALL : LARGE};
}

static int draw_at(struct ph_renderer *r, const struct ph_mesh *mesh, struct fx_vec3 at, fx_t size)
{
    struct ph_xform place = ph_xform_scale(size);
    place.t = at;
    return ph_draw_mesh(r, mesh, &place);
}

static int draw_ball(struct ph_renderer *r, const struct snake *s, const struct ph_material *material,
                     struct fx_vec3 at, fx_t size)
{
    const struct seen seen = see(r, at, size);
    if (!seen.at_all) {
        return PH_OK;
    }
    struct ph_mesh ball = s->ball[seen.form];
    ball.materials = material;
    return draw_at(r, &ball, at, size);
}

/* Draws a spot of shade on the lawn. */
static int draw_shade(struct ph_renderer *r, const struct snake *s, struct fx_vec3 at, fx_t size)
{
    const struct seen seen = see(r, at, size);
    return seen.at_all ? draw_at(r, &s->shade[seen.form], at, size) : PH_OK;
}

/* Draws a ball, and its shade on the lawn below it: that of a lamp high above. */
static int draw_shaded(struct ph_renderer *r, const struct snake *s, const struct ph_material *material,
                       struct fx_vec3 at, fx_t size)
{
    const int status = draw_ball(r, s, material, at, size);
    return status ? status : draw_shade(r, s, (struct fx_vec3){at.x + size / 8, 0, at.z - size / 8}, size);
}

/* The head, and its eyes, which look where it moves. */
static int draw_head(struct ph_renderer *r, const struct snake *s, uint32_t now, bool outside)
{
    const uint32_t ahead = outside ? 0 : SNAKE_NOSE;
    const fx_t size = outside ? SNAKE_RADIUS * 6 / 5 : SNAKE_RADIUS * 3 / 4;
    const struct fx_vec3 at = snake_spot(&s->way.steering, now, ahead),
                         next = snake_spot(&s->way.steering, now, ahead + 4);
    struct fx_vec3 forward;
    int status = draw_shaded(r, s, &s->face, at, size);
    fx_vec3_direction_q30((struct fx_vec3){next.x - at.x, 0, next.z - at.z}, &forward);
    const fx_t x = forward.x >> 14, z = forward.z >> 14;
    for (int32_t i = 0; i < 4 && status == PH_OK; i++) { /* in hundredths of the head's size */
        const bool pupil = i >= 2;
        const fx_t side = (i & 1 ? size : -size) / 100 * (pupil ? 50 : 42), front = size / 100 * (pupil ? 78 : 56);
        const struct fx_vec3 eye = {at.x + fx_mul_sat(front, x) - fx_mul_sat(side, z), at.y + size / 100 * 66,
                                    at.z + fx_mul_sat(front, z) + fx_mul_sat(side, x)};
        status = draw_ball(r, s, pupil ? &s->black : &s->white, eye, size / 100 * (pupil ? 22 : 38));
    }
    return status;
}

/* The body becomes thinner towards the tail. The camera on the head sees its nose. */
static int draw_body(struct ph_renderer *r, const struct snake *s, uint32_t now, bool outside)
{
    int status = draw_head(r, s, now, outside);
    for (uint32_t i = 1; i <= snake_balls(&s->way.steering) && status == PH_OK; i++) {
        const fx_t size = SNAKE_RADIUS - (fx_t)(i * i) * (SNAKE_RADIUS / (SNAKE_BALLS * SNAKE_BALLS * 2));
        status = draw_shaded(r, s, &s->skin[(i >> 1) & 1 ? 0 : 1],
                             snake_spot(&s->way.steering, now - i * SNAKE_SPACING, 0), size);
    }
    return status;
}

static int draw_apples(struct ph_renderer *r, const struct snake *s, uint32_t now)
{
    int status = PH_OK;
    for (uint32_t i = 0; i < SNAKE_APPLES && status == PH_OK; i++) {
        struct fx_vec3 at;
        const uint32_t grown = snake_apple(&s->way.steering, i, now, &at);
        if (grown > 0) {
            at.y += FX_ONE / 6;
            status = draw_shaded(r, s, &s->red, at, (fx_t)(grown * 2 / 3) + 256);
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
        const struct fx_vec3 at = {FX_INT(places[i][0]), 0, FX_INT(places[i][1])};
        const fx_t size = FX_ONE + (fx_t)(i % 3) * (FX_ONE / 4);
        const struct fx_vec3 middle = {at.x, size * 11 / 10, at.z};
        status = see(r, middle, size * 5 / 4).at_all ? draw_at(r, &s->tree, at, size) : PH_OK;
        status = status ? status : draw_shade(r, s, at, size * 3 / 4);
    }
    const struct ph_xform lawn = ph_xform_scale(s->lawn_scale);
    return status ? status : ph_draw_mesh(r, &s->floor, &lawn);
}

static int snake_camera(const struct demo_context *context, struct ph_renderer *r, uint32_t now, bool outside)
{
    const struct snake *const s = context->state;
    struct ph_projection projection = demo_perspective(context, FX_ONE << 4, FX_ONE / 8, FX_INT(40)); /* 90 degrees */
    const struct fx_vec3 at = snake_spot(&s->way.steering, now, 0), next = snake_spot(&s->way.steering, now, 4);
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
    struct snake *const s = context->state;
    const bool outside = demo_view_is(context, &demo_snake, 1);
    snake_steer(&s->way, frame, outside ? 0 : context->buttons);
    const uint32_t now = s->way.steering.on ? s->way.steering.time : frame;
    int status = snake_camera(context, r, now, outside);
    status = status ? status : draw_body(r, s, now, outside);
    status = status ? status : draw_apples(r, s, now);
    return status ? status : draw_garden(r, s);
}

static const char *const views[] = {"head", "outside", NULL};

#define VERTICES 2059 /* of all bodies of a frame */

/* For pictures of kits, which are narrower, and for little memory. */
static const struct demo_level coarser[] = {
    {.arena_bytes = ARENA_FINE, .vertex_max = VERTICES, .triangle_max = 1060, .corner_max = 96},
    {.arena_bytes = ARENA_FEW, .vertex_max = 642, .triangle_max = 300, .corner_max = 48},
};

const struct demo demo_snake = {
    .name = "snake",
    .summary = "a snake that eats apples, seen from a camera on its head",
    .views = views,
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = ARENA_FINE,
    .vertex_max = VERTICES,
    .triangle_max = 1900,
    .corner_max = 96,
    .coarser = coarser,
    .coarser_count = sizeof coarser / sizeof coarser[0],
    .init = snake_init,
    .frame = snake_frame,
};
