/*
 * snake: seen from a camera on its head, looking where it moves (source: K. Juenemann, HAW Hamburg, chapter 9,
 * exercise 3). It plays itself: a closed path, a figure of eight that crosses over itself on a hump, with apples on the
 * way; what was eaten grows again behind it. View `outside` looks at it all from above.
 *
 * Left and right steer it in the view from the head. After the first press it leaves that path within one cell of a
 * field of 9 x 7 and goes from cell to cell. A press turns it by a quarter in the next cell; the last press counts. It
 * never leaves the field: it ignores a turn out of it, and at the border it turns to the side with more room. Apples
 * make it longer. When it runs into itself it plays by itself again.
 */
#include "demo_scene.h"
#include "hal.h"
#include "models.h"

#include <string.h>

#define LOOP_FRAMES 512
#define PATH_SHIFT  23 /* a frame is this part of a turn of the path */
#define BALLS       38
#define SPACING     10u /* frames between two balls of the body */
#define NOSE        10u /* frames by which the nose is before the camera */
#define APPLES      8
#define TREES       10
#define TREE_SIDES  6
#define TREE_POINTS 5
#define CELLS       10
#define RADIUS      (FX_ONE * 32 / 100)
#define SPREAD      FX_INT(5)

/* The field while it is steered; cells are counted from its middle. */
#define CELL        (FX_ONE * 5 / 4)
#define CELL_FRAMES 16u
#define CELLS_X     4 /* -4 .. 4 */
#define CELLS_Z     3
#define TRAIL       32u /* cells that are remembered; the longest body takes fewer */
#define SHORTEST    10u /* balls */

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

struct cell {
    int8_t x, z;
};

/* Directions are quarter turns from -z, counter-clockwise as seen from above. */
struct passage {
    struct cell cell;
    uint8_t in, out;
};

/* All zero while it plays by itself. */
struct steering {
    bool on;
    int8_t turn;     /* asked for in the next cell: 1 left, -1 right */
    uint32_t origin; /* the frame in which the snake left the path */
    uint32_t time;   /* frames since then */
    uint32_t length; /* balls */
    uint32_t random;
    struct passage trail[TRAIL]; /* the cell that was entered at time t is in [t / CELL_FRAMES % TRAIL] */
    struct cell apples[APPLES];
    uint32_t born[APPLES]; /* time */
};

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
    struct steering steering;
    uint32_t frame, buttons; /* of the last frame */
    struct steering before;  /* the steering, its frame and buttons before the last frame, which may come again */
    uint32_t frame_before, buttons_before;
    fx_t lawn_scale;
    struct ph_mesh ball[FORMS], shade[FORMS], tree, floor;
    struct ph_material skin[2], face, red, white, black, leaves, tiles[2], dark;
    uint16_t ramps[6][PH_RAMP_SIZE];
};

/* x = 5 sin t, z = 3.2 sin 2t. The path leads over the hump at t = 0 and below it half a turn later. */
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

/* ---- steering -------------------------------------------------------------------------------------------------- */

static struct fx_vec3 middle_of(struct cell c)
{
    return (struct fx_vec3){c.x * CELL, RADIUS, c.z * CELL};
}

static struct fx_vec3 heading(uint32_t turn32, fx_t length)
{
    int32_t s, c;
    fx_sincos_q30(turn32, &s, &c);
    return (struct fx_vec3){-fx_mul_sat(s >> 14, length), 0, -fx_mul_sat(c >> 14, length)};
}

static struct fx_vec3 plus(struct fx_vec3 a, struct fx_vec3 b)
{
    return (struct fx_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

/* Goes over from `a` to `b` in the first cell after the path. */
static struct fx_vec3 blend(struct fx_vec3 a, struct fx_vec3 b, uint32_t time)
{
    const fx_t part = time < CELL_FRAMES ? (fx_t)time * (FX_ONE / (fx_t)CELL_FRAMES) : FX_ONE;
    return (struct fx_vec3){fx_lerp_sat(a.x, b.x, part), fx_lerp_sat(a.y, b.y, part), fx_lerp_sat(a.z, b.z, part)};
}

/* The place in the cell of that time, on a straight line or a quarter circle, and then `ahead` frames straight on. */
static struct fx_vec3 track(const struct steering *s, uint32_t time, uint32_t ahead)
{
    const struct passage *const p = &s->trail[time / CELL_FRAMES % TRAIL];
    const fx_t step = CELL / (fx_t)CELL_FRAMES, done = (fx_t)(time % CELL_FRAMES);
    const uint32_t from = (uint32_t)p->in << 30, left = 1u << 30;
    const fx_t side = p->in == p->out ? 0 : ((p->in + 1) & 3) == p->out ? CELL / 2 : -CELL / 2;
    const uint32_t part = (uint32_t)done * (left / CELL_FRAMES);
    const uint32_t now = side == 0 ? from : side > 0 ? from + part : from - part;
    struct fx_vec3 at = plus(middle_of(p->cell), heading(from, -CELL / 2 + (side == 0 ? step * done : 0)));
    at = plus(at, plus(heading(from + left, side), heading(now + left, -side))); /* around the corner */
    return plus(at, heading(now, step * (fx_t)ahead));
}

/* Where the head is at a time (while steered: since it left the path), and where it would be `ahead` frames later. */
static struct fx_vec3 spot(const struct steering *s, uint32_t time, uint32_t ahead)
{
    const struct fx_vec3 own = path((s->origin + time + ahead) << PATH_SHIFT);
    return s->on && (int32_t)time >= 0 ? blend(own, track(s, time, ahead), time) : own;
}

/* Balls of the body. When it is steered it becomes shorter, but not at once. */
static uint32_t balls(const struct steering *s)
{
    if (!s->on) {
        return BALLS;
    }
    return s->time + s->length < BALLS ? BALLS - s->time : s->length;
}

/* The number of cells up to the border. */
static int32_t room(struct cell c, uint32_t direction)
{
    const int32_t cells[4] = {CELLS_Z + c.z, CELLS_X + c.x, CELLS_Z - c.z, CELLS_X - c.x};
    return cells[direction & 3];
}

/* Whether c was one of the last `count` cells before this one. */
static bool was_at(const struct steering *s, struct cell c, uint32_t count)
{
    const uint32_t now = s->time / CELL_FRAMES;
    for (uint32_t i = 1; i <= count && i <= now; i++) {
        const struct cell old = s->trail[(now - i) % TRAIL].cell;
        if (old.x == c.x && old.z == c.z) {
            return true;
        }
    }
    return false;
}

static uint32_t apple_at(const struct steering *s, struct cell c)
{
    uint32_t i = 0;
    while (i < APPLES && (s->apples[i].x != c.x || s->apples[i].z != c.z)) {
        i++;
    }
    return i;
}

/* Eats an apple; a new one grows in a free cell. Snake and apples take at most TRAIL + APPLES of 63 cells. */
static void eat(struct steering *s, uint32_t apple)
{
    const struct cell old = s->apples[apple];
    s->random = s->random * 1664525u + 1013904223u;
    uint32_t place = (s->random >> 16) % 63;
    struct cell c = old;
    for (uint32_t i = 0; i < 63 && (apple_at(s, c) < APPLES || was_at(s, c, TRAIL - 1)); i++) {
        place = place == 62 ? 0 : place + 1;
        c = (struct cell){(int8_t)(place % 9 - CELLS_X), (int8_t)(place / 9 - CELLS_Z)};
    }
    s->apples[apple] = c;
    s->born[apple] = s->time;
    s->length += s->length < BALLS ? 1 : 0;
}

/* The head enters cell c. Decides where it will go from there, and what it eats. */
static void enter(struct steering *s, struct cell c, uint8_t in)
{
    const uint32_t asked = in + (uint32_t)s->turn;
    uint32_t out = room(c, asked) > 0 ? asked : in;
    if (room(c, out) == 0) {
        out = room(c, in + 1u) > room(c, in + 3u) ? in + 1u : in + 3u;
    }
    s->turn = 0;
    s->trail[s->time / CELL_FRAMES % TRAIL] = (struct passage){c, in, (uint8_t)(out & 3)};
    const uint32_t apple = apple_at(s, c);
    if (apple < APPLES) {
        eat(s, apple);
    }
}

static struct cell cell_at(struct fx_vec3 p)
{
    const fx_t x = (p.x + 16 * CELL + CELL / 2) / CELL - 16, z = (p.z + 16 * CELL + CELL / 2) / CELL - 16;
    return (struct cell){(int8_t)(x < -CELLS_X  ? -CELLS_X
                                  : x > CELLS_X ? CELLS_X
                                                : x),
                         (int8_t)(z < -CELLS_Z  ? -CELLS_Z
                                  : z > CELLS_Z ? CELLS_Z
                                                : z)};
}

/* The snake goes to the nearest cell before it, and the apples move to the cells below them. */
static void leave_path(struct steering *s, uint32_t frame, int8_t turn)
{
    const struct fx_vec3 at = path(frame << PATH_SHIFT), next = path((frame + 1) << PATH_SHIFT);
    const fx_t x = next.x - at.x, z = next.z - at.z;
    const uint8_t in = fx_abs_sat(x) > fx_abs_sat(z) ? (x < 0 ? 1 : 3) : (z < 0 ? 0 : 2);
    *s = (struct steering){.on = true, .turn = turn, .origin = frame, .length = SHORTEST, .random = frame};
    for (uint32_t i = 0; i < APPLES; i++) {
        s->apples[i] = cell_at(path((2 * i + 1) << 28));
        s->born[i] = 0u - 2 * CELL_FRAMES;
    }
    enter(s, cell_at(plus(at, heading((uint32_t)in << 30, CELL / 2))), in);
}

/* Steers for one frame. */
static void steer_on(struct steering *s)
{
    static const struct cell steps[4] = {{0, -1}, {-1, 0}, {0, 1}, {1, 0}};
    const struct passage last = s->trail[s->time / CELL_FRAMES % TRAIL];
    s->time++;
    if (s->time % CELL_FRAMES != 0) {
        return;
    }
    const struct cell c = {(int8_t)(last.cell.x + steps[last.out].x), (int8_t)(last.cell.z + steps[last.out].z)};
    if (was_at(s, c, balls(s) * SPACING / CELL_FRAMES)) {
        *s = (struct steering){.on = false};
        return;
    }
    enter(s, c, last.out);
}

/* A frame that is drawn again is steered again, by its new buttons; a few left out are made up for; a jump (the loop's
 * end) counts as one. */
static void snake_input(struct snake *s, uint32_t frame, uint32_t buttons)
{
    if (frame == s->frame) {
        s->steering = s->before;
    } else {
        s->before = s->steering;
        s->frame_before = s->frame;
        s->buttons_before = s->buttons;
    }
    const uint32_t passed = frame - s->frame_before;
    const uint32_t pressed = buttons & ~s->buttons_before & (HAL_BUTTON_LEFT | HAL_BUTTON_RIGHT);
    s->frame = frame;
    s->buttons = buttons;
    for (uint32_t i = 0; s->steering.on && i < (passed <= CELL_FRAMES ? passed : 1); i++) {
        steer_on(&s->steering);
    }
    if (pressed == HAL_BUTTON_LEFT || pressed == HAL_BUTTON_RIGHT) {
        const int8_t turn = pressed == HAL_BUTTON_LEFT ? 1 : -1;
        s->steering.turn = turn;
        if (!s->steering.on) {
            leave_path(&s->steering, frame, turn);
        }
    }
}

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
    memset(&s->steering, 0, sizeof(s->steering));
    s->buttons = s->buttons_before = 0;
    s->frame = s->frame_before = UINT32_MAX;
    s->before = s->steering;
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

/* Not at all: most bodies within `reach` of a point that are behind the camera, where most of the snake is, or beside
 * the picture. Its form is that of a ball of this size. */
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
    const uint32_t ahead = outside ? 0 : NOSE;
    const fx_t size = outside ? RADIUS * 6 / 5 : RADIUS * 3 / 4;
    const struct fx_vec3 at = spot(&s->steering, now, ahead), next = spot(&s->steering, now, ahead + 4);
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
    for (uint32_t i = 1; i <= balls(&s->steering) && status == PH_OK; i++) {
        const fx_t size = RADIUS - (fx_t)(i * i) * (RADIUS / (BALLS * BALLS * 2));
        status = draw_shaded(r, s, &s->skin[(i >> 1) & 1 ? 0 : 1], spot(&s->steering, now - i * SPACING, 0), size);
    }
    return status;
}

/*
 * Apples hover over the path. One is eaten when the nose is there, and is whole again three quarters of the way later.
 * While the snake is steered they hover over cells and grow within two of them.
 */
static int draw_apples(struct ph_renderer *r, const struct snake *s, uint32_t now)
{
    const struct steering *const steering = &s->steering;
    int status = PH_OK;
    for (uint32_t i = 0; i < APPLES && status == PH_OK; i++) {
        const uint32_t at = (2 * i + 1) << 28;
        const uint32_t since = (((now + NOSE) << PATH_SHIFT) - at) >> 16; /* 65536 is one time around */
        uint32_t grown = since < 24576 ? 0 : since < 49152 ? since - 24576 : 24576;
        struct fx_vec3 p = path(at);
        if (steering->on) {
            const uint32_t age = now - steering->born[i];
            grown = age < 2 * CELL_FRAMES ? age * (24576 / (2 * CELL_FRAMES)) : 24576;
            p = blend(p, middle_of(steering->apples[i]), now);
        }
        if (grown > 0) {
            p.y += FX_ONE / 6;
            status = draw_shaded(r, s, &s->red, p, (fx_t)(grown * 2 / 3) + 256);
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
    const struct fx_vec3 at = spot(&s->steering, now, 0), next = spot(&s->steering, now, 4);
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
    snake_input(s, frame, outside ? 0 : context->buttons);
    const uint32_t now = s->steering.on ? s->steering.time : frame;
    int status = snake_camera(context, r, now, outside);
    status = status ? status : draw_body(r, s, now, outside);
    status = status ? status : draw_apples(r, s, now);
    return status ? status : draw_garden(r, s);
}

static const char *const views[] = {"head", "outside", NULL};

#define VERTICES 2059 /* of all bodies of a frame */

/* For pictures of kits, which are narrower, and for little memory. */
static const struct demo_level coarser[] = {
    {DEMO_ARENA(ARENA_FINE, 9024), .vertex_max = VERTICES, .triangle_max = 1060, .corner_max = 96},
    {DEMO_ARENA(ARENA_FEW, 4288), .vertex_max = 642, .triangle_max = 300, .corner_max = 48},
};

const struct demo demo_snake = {
    .name = "snake",
    .summary = "a snake that eats apples, seen from a camera on its head",
    .views = views,
    .loop_frames = LOOP_FRAMES,
    DEMO_ARENA(ARENA_FINE, 9024),
    .vertex_max = VERTICES,
    .triangle_max = 1900,
    .corner_max = 96,
    .coarser = coarser,
    .coarser_count = sizeof coarser / sizeof coarser[0],
    .init = snake_init,
    .frame = snake_frame,
};
