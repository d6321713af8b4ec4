/*
 * ball: a ball is reflected inside a view frustum (source: K. Juenemann, HAW Hamburg, chapter 9, exercise 1). The view
 * `outside` shows the frustum as lines with its eye at the tip while the camera swings around it; `inside` looks
 * through that eye.
 *
 * The frustum has 90 degrees in both directions: at the distance z it is 2 z wide and high. The ball starts
 * perpendicularly from the right wall. Reflections keep its direction a permutation of (+-1, +-1, 0), which is exact.
 * After the far plane, the upper wall, the left wall and the far plane again it meets the lower wall perpendicularly.
 * So it runs the same way back, again and again: the physics itself is a loop.
 */
#include "demo_scene.h"
#include "models.h"

#define LOOP_FRAMES 512
#define NEAR_Z      FX_ONE
#define FAR_Z       FX_INT(4)
#define RADIUS      DEMO_BALL_RADIUS
#define TRAIL       36 /* lines of the trail, one behind the other */
#define TRAIL_STEP  3u /* frames between their ends */
#define TRAIL_WIDE  (FX_ONE / 28)
#define FADES       6                /* steps in which it fades */
#define MIDDLE      (FX_ONE * 5 / 2) /* of the frustum, seen from its eye; it is the origin of the world */

enum { LINE_FRUSTUM, LINE_RAY, LINE_TRAIL, LINES = LINE_TRAIL + FADES };

struct ball {
    struct ph_mesh mesh;
    struct ph_material colour, lines[LINES];
    uint16_t ramp[PH_RAMP_SIZE];
    struct demo_ball_way way;
};

struct flight {
    struct fx_vec3 at;
    int32_t direction[3]; /* -1, 0, 1 */
};

/* Inward normals of the right, left, upper and lower wall, the near and the far plane; the eye looks along -z. */
static const int8_t walls[6][3] = {{-1, 0, -1}, {1, 0, -1}, {0, -1, -1}, {0, 1, -1}, {0, 0, -1}, {0, 0, 1}};

static int32_t dot(const int8_t a[3], const int32_t b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* How far the ball's centre may still move along the normal of a wall, in units of the normal's length. */
static fx_t room(const struct flight *f, uint32_t wall)
{
    const int8_t *const n = walls[wall];
    const fx_t along = n[0] * f->at.x + n[1] * f->at.y + n[2] * f->at.z, root_2 = 92682;
    const fx_t from_origin = wall < 4 ? -fx_mul_sat(RADIUS, root_2) : wall == 4 ? -NEAR_Z - RADIUS : FAR_Z - RADIUS;
    return along + from_origin;
}

/* The wall that the ball meets next, and the way until then (of each coordinate that moves). */
static uint32_t next_wall(const struct flight *f, fx_t *way)
{
    uint32_t next = 0;
    *way = FX_MAX;
    for (uint32_t i = 0; i < 6; i++) {
        const int32_t speed = -dot(walls[i], f->direction); /* towards the wall: 1 or 2 */
        const fx_t distance = room(f, i);
        if (speed > 0 && distance / speed < *way) {
            *way = distance / speed;
            next = i;
        }
    }
    return next;
}

static void advance(struct flight *f, fx_t way)
{
    f->at.x += f->direction[0] * way;
    f->at.y += f->direction[1] * way;
    f->at.z += f->direction[2] * way;
}

/* d - 2 (d.n) n / (n.n) */
static void reflect(struct flight *f, uint32_t wall)
{
    const int8_t *const n = walls[wall];
    const int32_t times = 2 * dot(n, f->direction) / (wall < 4 ? 2 : 1);
    for (uint32_t k = 0; k < 3; k++) {
        f->direction[k] -= times * n[k];
    }
}

/* The start of the ball: on the right wall, moving away from it. */
static struct flight start(void)
{
    const fx_t z = FX_ONE * -31 / 10;
    const struct flight f = {{-z - fx_mul_sat(RADIUS, 92682), FX_ONE * 3 / 2, z}, {-1, 0, -1}};
    return f;
}

void demo_ball_run(struct demo_ball_way *way)
{
    struct flight f = start();
    fx_t sum = 0;
    for (uint32_t i = 0; i < DEMO_BALL_LEGS; i++) {
        struct demo_ball_leg *const leg = &way->legs[i];
        fx_t length;
        const uint32_t wall = next_wall(&f, &length);
        *leg = (struct demo_ball_leg){f.at, {f.direction[0], f.direction[1], f.direction[2]}, sum};
        advance(&f, length);
        sum += length;
        reflect(&f, wall);
    }
    way->whole = sum;
}

struct fx_vec3 demo_ball_position(const struct demo_ball_way *way, uint32_t frame)
{
    const uint32_t phase = frame % LOOP_FRAMES, step = phase < LOOP_FRAMES / 2 ? phase : LOOP_FRAMES - phase;
    const fx_t gone = way->whole * (int32_t)step / (LOOP_FRAMES / 2); /* the whole way is below 2^7 units */
    const struct demo_ball_leg *leg = &way->legs[DEMO_BALL_LEGS - 1];
    while (leg->begin > gone) {
        leg--;
    }
    struct flight f = {leg->from, {leg->direction[0], leg->direction[1], leg->direction[2]}};
    advance(&f, gone - leg->begin);
    return f.at;
}

static int ball_init(struct demo_context *context)
{
    struct ball *const b = demo_alloc(&context->arena, sizeof(*b));
    if (!b) {
        return PH_ERR_NOMEM;
    }
    b->colour = demo_lit(b->ramp, PH_SHADE_GOURAUD, 255, 120, 40);
    b->lines[LINE_FRUSTUM] = demo_unlit(120, 220, 255);
    b->lines[LINE_RAY] = demo_unlit(50, 90, 120);
    for (uint32_t i = 0; i < FADES; i++) { /* from the ball's colour to that of the background */
        const uint32_t left = FADES - i;
        b->lines[LINE_TRAIL + i] = demo_unlit((uint8_t)(10 + 245 * left / FADES), (uint8_t)(14 + 140 * left / FADES),
                                              (uint8_t)(26 + 20 * left / FADES));
    }
    demo_ball_run(&b->way);
    context->state = b;
    if (model_icosphere(&context->arena, &b->mesh, 2) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    return model_material(&context->arena, &b->mesh, &b->colour);
}

/* Converts the eye's coordinates to those of the world, whose origin is the frustum's middle. */
static struct fx_vec3 placed(struct fx_vec3 p)
{
    p.z += MIDDLE;
    return p;
}

static struct fx_vec3 corner(uint32_t i, fx_t z)
{
    return placed((struct fx_vec3){(i + 1) & 2 ? z : -z, i & 2 ? z : -z, -z});
}

static void draw_frustum(struct ph_renderer *r, const struct ball *b, bool outside)
{
    const struct fx_vec3 eye = placed((struct fx_vec3){0, 0, 0});
    for (uint32_t i = 0; i < 4; i++) {
        ph_draw_line(r, corner(i, FAR_Z), corner((i + 1) & 3, FAR_Z), &b->lines[LINE_FRUSTUM]);
        ph_draw_line(r, corner(i, NEAR_Z), corner(i, FAR_Z), &b->lines[LINE_FRUSTUM]);
        if (outside) {
            ph_draw_line(r, corner(i, NEAR_Z), corner((i + 1) & 3, NEAR_Z), &b->lines[LINE_FRUSTUM]);
            ph_draw_line(r, eye, corner(i, NEAR_Z), &b->lines[LINE_RAY]);
        }
    }
}

/* Draws a square grid on the far plane. */
static void draw_far_plane(struct ph_renderer *r, const struct ball *b)
{
    for (fx_t at = -FAR_Z + FX_ONE; at < FAR_Z; at += FX_ONE) {
        ph_draw_line(r, placed((struct fx_vec3){at, -FAR_Z, -FAR_Z}), placed((struct fx_vec3){at, FAR_Z, -FAR_Z}),
                     &b->lines[LINE_RAY]);
        ph_draw_line(r, placed((struct fx_vec3){-FAR_Z, at, -FAR_Z}), placed((struct fx_vec3){FAR_Z, at, -FAR_Z}),
                     &b->lines[LINE_RAY]);
    }
}

static int ball_camera(const struct demo_context *context, struct ph_renderer *r, uint32_t frame, bool outside)
{
    struct ph_projection projection = demo_perspective(context, FX_ONE << 4, FX_HALF, FX_INT(5)); /* 90 degrees */
    struct ph_xform view = ph_xform_translate(0, 0, -MIDDLE);
    if (outside) {
        const struct ph_xform above = demo_look(0, FX_ONE * 19 / 4, FX_ONE * 45 / 4, 0, FX_ONE * -2 / 5, 0);
        const struct ph_xform turn = ph_xform_rotate_y(0x28000000u + ((uint32_t)demo_swing(frame, LOOP_FRAMES) << 13));
        projection = demo_perspective(context, DEMO_SCALE_60_Q20, FX_INT(4), FX_INT(20));
        view = ph_xform_mul(&above, &turn);
        demo_orbit(context, &view, &projection);
    }
    return demo_begin(context, r, &view, &projection, &demo_daylight, ph_rgb565(10, 14, 26));
}

/* Draws the ball's trail as two lines, one above the other. */
static void draw_trail(struct ph_renderer *r, const struct ball *b, uint32_t frame)
{
    struct fx_vec3 from = placed(demo_ball_position(&b->way, frame));
    for (uint32_t i = 0; i < TRAIL; i++) {
        const struct ph_material *const line = &b->lines[LINE_TRAIL + i * FADES / TRAIL];
        struct fx_vec3 to = placed(demo_ball_position(&b->way, frame - (i + 1) * TRAIL_STEP));
        ph_draw_line(r, from, to, line);
        from.y += TRAIL_WIDE;
        to.y += TRAIL_WIDE;
        ph_draw_line(r, from, to, line);
        to.y -= TRAIL_WIDE;
        from = to;
    }
}

static int ball_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct ball *const b = context->state;
    const bool outside = demo_view_is(context, &demo_ball, 0);
    const int status = ball_camera(context, r, frame, outside);
    if (status != PH_OK) {
        return status;
    }
    draw_frustum(r, b, outside);
    draw_far_plane(r, b);
    struct ph_xform place = ph_xform_scale(RADIUS);
    place.t = placed(demo_ball_position(&b->way, frame));
    draw_trail(r, b, frame);
    return ph_draw_mesh(r, &b->mesh, &place);
}

static const char *const views[] = {"outside", "inside", NULL};

const struct demo demo_ball = {
    .name = "ball",
    .summary = "a ball reflected inside a view frustum, seen from outside and from its eye",
    .views = views,
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = MODEL_ROUND8(sizeof(struct ball)) + MODEL_ROUND8(sizeof(struct ph_part)) +
                   MODEL_BYTES(MODEL_ICOSPHERE_VERTICES(2), MODEL_ICOSPHERE_TRIANGLES(2)),
    .vertex_max = MODEL_ICOSPHERE_VERTICES(2),
    .triangle_max = 300,
    .corner_max = 128,
    .init = ball_init,
    .frame = ball_frame,
};
