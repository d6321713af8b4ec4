/* See snake_way.h. */
#include "snake_way.h"

#include "fx.h"
#include "hal.h"

#include <string.h>

#define PATH_SHIFT 23 /* a frame is this part of a turn of the path */
#define SPREAD     5

/* The field while it is steered; cells are counted from its middle. */
#define CELL          (FX_ONE * 5 / 4)
#define CELL_FRAMES   16u
#define CELLS_X       4 /* -4 .. 4 */
#define CELLS_Z       3
#define SHORTEST      10u /* balls */
#define REPEAT_FRAMES (SNAKE_TRAIL * CELL_FRAMES)

/* x = 5 sin t, z = 3.2 sin 2t. The path leads over the hump at t = 0 and below it half a turn later. */
static struct fx_vec3 path(uint32_t turn32)
{
    int32_t sin_q30, cos_q30;
    fx_sincos_q30(turn32, &sin_q30, &cos_q30);
    const fx_t s = sin_q30 >> 14, c = cos_q30 >> 14, rise = c > 0 ? fx_mul_sat(c, c) : 0;
    const fx_t hump = fx_mul_sat(fx_mul_sat(rise, rise), fx_mul_sat(rise, rise));
    return (struct fx_vec3){SPREAD * s, SNAKE_RADIUS + fx_mul_sat(FX_ONE * 3 / 2, hump),
                            fx_mul_sat(FX_ONE * 64 / 10, fx_mul_sat(s, c))}; /* sin 2t = 2 sin t cos t */
}

static struct fx_vec3 middle_of(struct snake_cell c)
{
    return (struct fx_vec3){c.x * CELL, SNAKE_RADIUS, c.z * CELL};
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
static struct fx_vec3 track(const struct snake_steering *s, uint32_t time, uint32_t ahead)
{
    const struct snake_passage *const p = &s->trail[time / CELL_FRAMES % SNAKE_TRAIL];
    const fx_t step = CELL / (fx_t)CELL_FRAMES, done = (fx_t)(time % CELL_FRAMES);
    const uint32_t from = (uint32_t)p->in << 30, left = 1u << 30;
    const fx_t side = p->in == p->out ? 0 : ((p->in + 1) & 3) == p->out ? CELL / 2 : -CELL / 2;
    const uint32_t part = (uint32_t)done * (left / CELL_FRAMES);
    const uint32_t now = side == 0 ? from : side > 0 ? from + part : from - part;
    struct fx_vec3 at = plus(middle_of(p->cell), heading(from, -CELL / 2 + (side == 0 ? step * done : 0)));
    at = plus(at, plus(heading(from + left, side), heading(now + left, -side))); /* around the corner */
    return plus(at, heading(now, step * (fx_t)ahead));
}

struct fx_vec3 snake_spot(const struct snake_steering *s, uint32_t time, uint32_t ahead)
{
    const struct fx_vec3 own = path((s->origin + time + ahead) << PATH_SHIFT);
    return s->on && (int32_t)time >= 0 ? blend(own, track(s, time, ahead), time) : own;
}

uint32_t snake_balls(const struct snake_steering *s)
{
    if (!s->on) {
        return SNAKE_BALLS;
    }
    return s->time + s->length < SNAKE_BALLS ? SNAKE_BALLS - s->time : s->length;
}

/* The number of cells up to the border. */
static int32_t room(struct snake_cell c, uint32_t direction)
{
    const int32_t cells[4] = {CELLS_Z + c.z, CELLS_X + c.x, CELLS_Z - c.z, CELLS_X - c.x};
    return cells[direction & 3];
}

/* Whether c was one of the last `count` cells before this one. */
static bool was_at(const struct snake_steering *s, struct snake_cell c, uint32_t count)
{
    const uint32_t now = s->time / CELL_FRAMES;
    for (uint32_t i = 1; i <= count && i <= now; i++) {
        const struct snake_cell old = s->trail[(now - i) % SNAKE_TRAIL].cell;
        if (old.x == c.x && old.z == c.z) {
            return true;
        }
    }
    return false;
}

static uint32_t apple_at(const struct snake_steering *s, struct snake_cell c)
{
    uint32_t i = 0;
    while (i < SNAKE_APPLES && (s->apples[i].x != c.x || s->apples[i].z != c.z)) {
        i++;
    }
    return i;
}

/* Eats an apple; a new one grows in a free cell. Snake and apples take at most SNAKE_TRAIL + SNAKE_APPLES of 63 cells.
 */
static void eat(struct snake_steering *s, uint32_t apple)
{
    const struct snake_cell old = s->apples[apple];
    s->random = s->random * 1664525u + 1013904223u;
    uint32_t place = (s->random >> 16) % 63;
    struct snake_cell c = old;
    for (uint32_t i = 0; i < 63 && (apple_at(s, c) < SNAKE_APPLES || was_at(s, c, SNAKE_TRAIL - 1)); i++) {
        place = place == 62 ? 0 : place + 1;
        c = (struct snake_cell){(int8_t)(place % 9 - CELLS_X), (int8_t)(place / 9 - CELLS_Z)};
    }
    s->apples[apple] = c;
    s->born[apple] = s->time;
    s->length += s->length < SNAKE_BALLS ? 1 : 0;
}

/* The head enters cell c. Decides where it will go from there, and what it eats. */
static void enter(struct snake_steering *s, struct snake_cell c, uint8_t in)
{
    const uint32_t asked = in + (uint32_t)s->turn;
    uint32_t out = room(c, asked) > 0 ? asked : in;
    if (room(c, out) == 0) {
        out = room(c, in + 1u) > room(c, in + 3u) ? in + 1u : in + 3u;
    }
    s->turn = 0;
    s->trail[s->time / CELL_FRAMES % SNAKE_TRAIL] = (struct snake_passage){c, in, (uint8_t)(out & 3)};
    const uint32_t apple = apple_at(s, c);
    if (apple < SNAKE_APPLES) {
        eat(s, apple);
    }
}

static struct snake_cell cell_at(struct fx_vec3 p)
{
    const fx_t x = (p.x + 16 * CELL + CELL / 2) / CELL - 16, z = (p.z + 16 * CELL + CELL / 2) / CELL - 16;
    return (struct snake_cell){(int8_t)(x < -CELLS_X  ? -CELLS_X
                                        : x > CELLS_X ? CELLS_X
                                                      : x),
                               (int8_t)(z < -CELLS_Z  ? -CELLS_Z
                                        : z > CELLS_Z ? CELLS_Z
                                                      : z)};
}

/* The snake goes to the nearest cell before it, and the apples move to the cells below them. */
static void leave_path(struct snake_steering *s, uint32_t frame, int8_t turn)
{
    const struct fx_vec3 at = path(frame << PATH_SHIFT), next = path((frame + 1) << PATH_SHIFT);
    const fx_t x = next.x - at.x, z = next.z - at.z;
    const uint8_t in = fx_abs_sat(x) > fx_abs_sat(z) ? (x < 0 ? 1 : 3) : (z < 0 ? 0 : 2);
    *s = (struct snake_steering){.on = true, .turn = turn, .origin = frame, .length = SHORTEST, .random = frame};
    for (uint32_t i = 0; i < SNAKE_APPLES; i++) {
        s->apples[i] = cell_at(path((2 * i + 1) << 28));
        s->born[i] = 0u - 2 * CELL_FRAMES;
    }
    enter(s, cell_at(plus(at, heading((uint32_t)in << 30, CELL / 2))), in);
}

/* Keeps the time small, so that it does not overflow: it goes back by a whole number of times around the path and of
 * cells that are remembered. Apples that are fully grown stay so. */
static void keep_time_small(struct snake_steering *s)
{
    _Static_assert(REPEAT_FRAMES % (1u << (32 - PATH_SHIFT)) == 0, "the path would jump");
    if (s->time < 2 * REPEAT_FRAMES) {
        return;
    }
    for (uint32_t i = 0; i < SNAKE_APPLES; i++) {
        const uint32_t age = s->time - s->born[i];
        s->born[i] = s->time - REPEAT_FRAMES - (age < 2 * CELL_FRAMES ? age : 2 * CELL_FRAMES);
    }
    s->time -= REPEAT_FRAMES;
}

/* Steers for one frame. */
static void steer_on(struct snake_steering *s)
{
    static const struct snake_cell steps[4] = {{0, -1}, {-1, 0}, {0, 1}, {1, 0}};
    const struct snake_passage last = s->trail[s->time / CELL_FRAMES % SNAKE_TRAIL];
    s->time++;
    keep_time_small(s);
    if (s->time % CELL_FRAMES != 0) {
        return;
    }
    const struct snake_cell c = {(int8_t)(last.cell.x + steps[last.out].x), (int8_t)(last.cell.z + steps[last.out].z)};
    if (was_at(s, c, snake_balls(s) * SNAKE_SPACING / CELL_FRAMES)) {
        *s = (struct snake_steering){.on = false};
        return;
    }
    enter(s, c, last.out);
}

void snake_way_begin(struct snake_way *w)
{
    memset(w, 0, sizeof(*w));
    w->frame = w->frame_before = UINT32_MAX;
}

void snake_steer(struct snake_way *w, uint32_t frame, uint32_t buttons)
{
    if (frame == w->frame) {
        w->steering = w->before;
    } else {
        w->before = w->steering;
        w->frame_before = w->frame;
        w->buttons_before = w->buttons;
    }
    const uint32_t passed = frame - w->frame_before;
    const uint32_t pressed = buttons & ~w->buttons_before & (HAL_BUTTON_LEFT | HAL_BUTTON_RIGHT);
    w->frame = frame;
    w->buttons = buttons;
    for (uint32_t i = 0; w->steering.on && i < (passed <= CELL_FRAMES ? passed : 1); i++) {
        steer_on(&w->steering);
    }
    if (pressed == HAL_BUTTON_LEFT || pressed == HAL_BUTTON_RIGHT) {
        const int8_t turn = pressed == HAL_BUTTON_LEFT ? 1 : -1;
        w->steering.turn = turn;
        if (!w->steering.on) {
            leave_path(&w->steering, frame, turn);
        }
    }
}

/*
 * Apples hover over the path. One is eaten when the nose is there, and is whole again three quarters of the way later.
 * While the snake is steered they hover over cells and grow within two of them.
 */
uint32_t snake_apple(const struct snake_steering *s, uint32_t i, uint32_t now, struct fx_vec3 *at)
{
    const uint32_t place = (2 * i + 1) << 28;
    *at = path(place);
    if (s->on) {
        const uint32_t age = now - s->born[i];
        *at = blend(*at, middle_of(s->apples[i]), now);
        return age < 2 * CELL_FRAMES ? age * (24576 / (2 * CELL_FRAMES)) : 24576;
    }
    const uint32_t since = (((now + SNAKE_NOSE) << PATH_SHIFT) - place) >> 16; /* 65536 is one time around */
    return since < 24576 ? 0 : since < 49152 ? since - 24576 : 24576;
}
