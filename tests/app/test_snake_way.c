/* snake_way: the path that the snake plays by itself against its formula; then steered cell by cell, from states that
 * the test sets: turns, borders, bites, apples, frames that come again or are left out. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "assert_near.h"
#include "hal.h"
#include "snake_way.h"

#include <math.h>
#include <string.h>

#define CELL 1.25
#define HIGH (SNAKE_RADIUS / 65536.)

static struct snake_way w;

/* Steered, in frame 100 at the end of a cell; all that is remembered lies in the corner (4, 3). */
static int fresh(void **state)
{
    struct snake_steering *const s = &w.steering;
    (void)state;
    snake_way_begin(&w);
    w.frame = 100;
    w.frame_before = 99;
    *s = (struct snake_steering){.on = true, .time = 40 * 16 - 1, .length = 10};
    for (uint32_t i = 0; i < SNAKE_TRAIL; i++) {
        s->trail[i].cell = (struct snake_cell){4, 3};
    }
    for (int8_t i = 0; i < SNAKE_APPLES; i++) {
        s->apples[i] = (struct snake_cell){(int8_t)(i - 4), 3};
    }
    return 0;
}

static struct snake_passage *passage(uint32_t time)
{
    return &w.steering.trail[time / 16 % SNAKE_TRAIL];
}

/* The cell before the one that the next frame enters. */
static void last_is(int8_t x, int8_t z, uint8_t out)
{
    *passage(w.steering.time) = (struct snake_passage){{x, z}, out, out};
}

static void step(uint32_t buttons)
{
    snake_steer(&w, w.frame + 1, buttons);
}

static void entered(int x, int z, int in, int out)
{
    const struct snake_passage *const p = passage(w.steering.time);
    assert_true(w.steering.on && p->cell.x == x && p->cell.z == z && p->in == in);
    assert_int_equal(p->out, out);
}

static void spot_is(const struct snake_steering *s, uint32_t time, uint32_t ahead, double x, double y, double z)
{
    const struct fx_vec3 at = snake_spot(s, time, ahead);
    assert_near(real(at.x), x, .0005);
    assert_near(real(at.y), y, .0005);
    assert_near(real(at.z), z, .0005);
}

/* x = 5 sin t, z = 3.2 sin 2t, over a hump of 1.5 cos^8 t; 512 frames are one time around. */
static void it_plays_a_figure_of_eight_by_itself(void **state)
{
    const struct snake_steering own = {.on = false};
    (void)state;
    for (uint32_t frame = 0; frame < 1024; frame += 13) {
        const double t = frame / 512. * 2 * acos(-1), rise = fmax(cos(t), 0);
        spot_is(&own, frame, 0, 5 * sin(t), HIGH + 1.5 * pow(rise, 8), 3.2 * sin(2 * t));
        spot_is(&own, frame - 7, 7, 5 * sin(t), HIGH + 1.5 * pow(rise, 8), 3.2 * sin(2 * t));
    }
    assert_int_equal(snake_balls(&own), SNAKE_BALLS);
}

static void a_cell_is_crossed_straight_or_on_a_quarter_circle(void **state)
{
    static const uint8_t turns[3] = {0, 1, 3};
    struct snake_steering *const s = &w.steering;
    (void)state;
    for (uint8_t in = 0; in < 4; in++) {
        const double ahead_x = -sin(in * acos(0)), ahead_z = -cos(in * acos(0)); /* of the way in; left: 1 more */
        const double left_x = -sin((in + 1) * acos(0)), left_z = -cos((in + 1) * acos(0));
        for (int i = 0; i < 3; i++) {
            s->trail[5] = (struct snake_passage){{1, -2}, in, (uint8_t)((in + turns[i]) & 3)};
            for (uint32_t d = 0; d < 16; d++) {
                const double part = d / 16. * acos(0), side = i == 0 ? 0 : i == 1 ? CELL / 2 : -CELL / 2;
                const double along = i == 0 ? CELL * d / 16 - CELL / 2 : CELL / 2 * sin(part) - CELL / 2;
                const double across = side * (1 - cos(part));
                const double x = 1 * CELL + ahead_x * along + left_x * across;
                const double z = -2 * CELL + ahead_z * along + left_z * across;
                spot_is(s, 5 * 16 + d, 0, x, HIGH, z);
                const double turned = i == 0 ? 0 : i == 1 ? part : -part, far = 3 * CELL / 16;
                spot_is(s, (5 + SNAKE_TRAIL) * 16 + d, 3, x + far * (ahead_x * cos(turned) + left_x * sin(turned)),
                        HIGH, z + far * (ahead_z * cos(turned) + left_z * sin(turned)));
            }
        }
    }
}

static void it_turns_in_the_next_cell_and_the_last_press_counts(void **state)
{
    (void)state;
    w.steering.time--;
    last_is(0, 0, 0);
    step(HAL_BUTTON_RIGHT);
    assert_int_equal(w.steering.turn, -1);
    w.buttons = 0;
    step(0);
    entered(0, -1, 0, 3);
    assert_int_equal(w.steering.turn, 0);
    fresh(NULL);
    w.steering.time -= 3;
    last_is(0, 0, 2);
    step(HAL_BUTTON_RIGHT);
    step(HAL_BUTTON_RIGHT | HAL_BUTTON_LEFT); /* left is pressed while right is held */
    step(HAL_BUTTON_RIGHT | HAL_BUTTON_LEFT);
    step(0);
    entered(0, 1, 2, 3);
    fresh(NULL);
    w.steering.time--;
    last_is(0, 0, 1);
    step(HAL_BUTTON_RIGHT | HAL_BUTTON_LEFT | HAL_BUTTON_UP); /* both at once */
    step(0);
    entered(-1, 0, 1, 1);
}

static void it_stays_in_the_field(void **state)
{
    static const struct {
        int8_t x, z, out, turn, to;
    } cases[] = {
        {-4, 1, 0, 1, 0},  {-4, 1, 0, -1, 3}, {4, 1, 0, -1, 0},  {4, 1, 0, 1, 1}, /* a turn out of the field */
        {1, -2, 0, 0, 1},  {-1, -2, 0, 0, 3}, {0, -2, 0, 0, 3},                   /* to the side with more room */
        {1, -2, 0, -1, 3}, {3, -2, 3, 0, 2},  {3, 2, 3, 0, 0},   {-3, 2, 1, 0, 0},
        {-3, -2, 1, 0, 2}, {1, 2, 2, 0, 1},   {-3, 1, 1, -1, 0}, {0, 0, 3, 1, 0},
    };
    static const int8_t steps[4][2] = {{0, -1}, {-1, 0}, {0, 1}, {1, 0}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        fresh(NULL);
        memset(w.steering.apples, 100, sizeof w.steering.apples);
        last_is(cases[i].x, cases[i].z, (uint8_t)cases[i].out);
        w.steering.turn = cases[i].turn;
        step(0);
        entered(cases[i].x + steps[cases[i].out][0], cases[i].z + steps[cases[i].out][1], cases[i].out, cases[i].to);
    }
}

/* 10 balls, 10 frames apart, lie in the last 6 cells of 16 frames. */
static void it_ends_where_it_bites_itself(void **state)
{
    (void)state;
    for (uint32_t before = 1; before <= 8; before++) {
        fresh(NULL);
        last_is(0, 0, 0);
        w.steering.trail[(40 - before) % SNAKE_TRAIL].cell = (struct snake_cell){0, -1};
        if (before == 1) {
            continue; /* that is the last cell itself */
        }
        step(0);
        assert_int_equal(w.steering.on, before > 6);
    }
    const struct snake_steering off = {.on = false};
    fresh(NULL);
    last_is(0, 0, 0);
    w.steering.trail[38 % SNAKE_TRAIL].cell = (struct snake_cell){0, -1};
    step(0);
    assert_memory_equal(&w.steering, &off, sizeof off);
}

static void an_apple_makes_it_longer_and_grows_elsewhere(void **state)
{
    (void)state;
    for (uint32_t random = 0; random < 300; random++) {
        fresh(NULL);
        last_is(0, 0, 0);
        w.steering.apples[2] = (struct snake_cell){0, -1};
        w.steering.random = random * 2654435761u;
        w.steering.length = random == 7 ? SNAKE_BALLS : 10;
        step(0);
        const struct snake_steering *const s = &w.steering;
        const struct snake_cell c = s->apples[2];
        assert_int_equal(s->length, random == 7 ? SNAKE_BALLS : 11);
        assert_true(s->born[2] == s->time && c.x >= -4 && c.x <= 4 && c.z >= -3 && c.z <= 3);
        assert_false((c.x == 0 && (c.z == -1 || c.z == 0)) || (c.x == 4 && c.z == 3));
        for (int i = 0; i < SNAKE_APPLES; i++) {
            assert_true(i == 2 || s->apples[i].x != c.x || s->apples[i].z != c.z);
        }
        assert_true(s->random == random * 2654435761u * 1664525u + 1013904223u);
    }
}

static void it_becomes_shorter_but_not_at_once(void **state)
{
    static const uint32_t cases[][2] = {{0, 38}, {1, 37}, {27, 11}, {28, 10}, {29, 10}, {600, 10}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        w.steering.time = cases[i][0];
        assert_int_equal(snake_balls(&w.steering), cases[i][1]);
    }
}

/* It goes to the nearest cell before it, within one cell; all apples stand still over theirs. */
static void a_press_leaves_the_path(void **state)
{
    (void)state;
    for (uint32_t frame = 3; frame < 512; frame += 17) {
        snake_way_begin(&w);
        snake_steer(&w, frame, 0);
        const struct fx_vec3 own = snake_spot(&w.steering, frame + 1, 0), next = snake_spot(&w.steering, frame + 2, 0);
        snake_steer(&w, frame + 1, HAL_BUTTON_LEFT);
        const struct snake_steering *const s = &w.steering;
        const struct snake_passage p = s->trail[0];
        assert_true(s->on && s->origin == frame + 1 && s->time == 0);
        uint32_t eaten = 0; /* there may be an apple in that cell */
        const double x = real(next.x - own.x), z = real(next.z - own.z);
        assert_int_equal(p.in, fabs(x) > fabs(z) ? (x < 0 ? 1 : 3) : (z < 0 ? 0 : 2));
        assert_true(p.cell.x >= -4 && p.cell.x <= 4 && p.cell.z >= -3 && p.cell.z <= 3);
        const double ahead_x = p.in == 1 ? -CELL / 2 : p.in == 3 ? CELL / 2 : 0;
        const double ahead_z = p.in == 0 ? -CELL / 2 : p.in == 2 ? CELL / 2 : 0;
        const double off_x = fabs(real(own.x) + ahead_x - p.cell.x * CELL);
        const double off_z = fabs(real(own.z) + ahead_z - p.cell.z * CELL);
        assert_true((off_x < CELL / 2 + .001 || p.cell.x == 4 || p.cell.x == -4) &&
                    (off_z < CELL / 2 + .001 || p.cell.z == 3 || p.cell.z == -3));
        spot_is(s, 0, 0, real(own.x), real(own.y), real(own.z)); /* and then goes over */
        const struct snake_steering off = {.on = false};
        const struct fx_vec3 tail = snake_spot(&off, frame - 44, 0); /* which is still on the path */
        spot_is(s, (uint32_t)-45, 0, real(tail.x), real(tail.y), real(tail.z));
        for (uint32_t i = 0; i < SNAKE_APPLES; i++) {
            struct fx_vec3 at;
            const bool is_new = s->born[i] == 0;
            eaten += is_new;
            const struct fx_vec3 before = snake_spot(&off, 64 * i + 32, 0);
            assert_int_equal(snake_apple(s, i, 0, &at), is_new ? 0 : 24576);
            assert_true(at.x == before.x && at.z == before.z);
            snake_apple(s, i, 16, &at);
            assert_near(real(at.x), s->apples[i].x * CELL, .0005);
            assert_near(real(at.z), s->apples[i].z * CELL, .0005);
        }
        assert_int_equal(s->length, 10 + eaten);
    }
}

/* While it plays by itself an apple is eaten when the nose is there, 10 frames before the head. */
static void apples_grow_again(void **state)
{
    static const struct {
        uint32_t after, grown;
    } own[] = {{0, 0}, {191, 0}, {192, 0}, {193, 128}, {383, 24448}, {384, 24576}, {511, 24576}};
    const struct snake_steering off = {.on = false};
    struct fx_vec3 at;
    (void)state;
    for (uint32_t i = 0; i < SNAKE_APPLES; i++) {
        for (size_t k = 0; k < sizeof own / sizeof own[0]; k++) {
            assert_int_equal(snake_apple(&off, i, 64 * i + 32 - 10 + own[k].after, &at), own[k].grown);
        }
    }
    w.steering.born[1] = 100;
    assert_int_equal(snake_apple(&w.steering, 1, 100, &at), 0);
    assert_int_equal(snake_apple(&w.steering, 1, 101, &at), 768);
    assert_int_equal(snake_apple(&w.steering, 1, 131, &at), 31 * 768);
    assert_int_equal(snake_apple(&w.steering, 1, 132, &at), 24576);
    assert_int_equal(snake_apple(&w.steering, 1, 500, &at), 24576);
}

static void a_frame_may_come_again_and_some_may_be_left_out(void **state)
{
    (void)state;
    w.steering.time--;
    last_is(0, 0, 0);
    step(HAL_BUTTON_LEFT);
    snake_steer(&w, 101, HAL_BUTTON_RIGHT); /* the same frame with other buttons */
    assert_true(w.steering.turn == -1 && w.steering.time == 639);
    snake_steer(&w, 101, 0);
    assert_int_equal(w.steering.turn, 0);
    snake_steer(&w, 104, 0);
    assert_int_equal(w.steering.time, 642);
    snake_steer(&w, 104 + 16, 0);
    assert_int_equal(w.steering.time, 658);
    snake_steer(&w, 120 + 17, 0); /* a jump */
    assert_int_equal(w.steering.time, 659);
    snake_steer(&w, 0, 0);
    assert_int_equal(w.steering.time, 660);
}

static void time_goes_back_before_it_is_large(void **state)
{
    (void)state;
    w.steering.time = 1022;
    w.steering.born[0] = 1000, w.steering.born[1] = 3;
    step(0);
    assert_true(w.steering.time == 1023 && w.steering.born[0] == 1000);
    last_is(0, 0, 0);
    step(0);
    assert_int_equal(w.steering.time, 512);
    assert_int_equal(w.steering.time - w.steering.born[0], 24);
    assert_int_equal(w.steering.time - w.steering.born[1], 32);
    entered(0, -1, 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(it_plays_a_figure_of_eight_by_itself, fresh),
        cmocka_unit_test_setup(a_cell_is_crossed_straight_or_on_a_quarter_circle, fresh),
        cmocka_unit_test_setup(it_turns_in_the_next_cell_and_the_last_press_counts, fresh),
        cmocka_unit_test_setup(it_stays_in_the_field, fresh),
        cmocka_unit_test_setup(it_ends_where_it_bites_itself, fresh),
        cmocka_unit_test_setup(an_apple_makes_it_longer_and_grows_elsewhere, fresh),
        cmocka_unit_test_setup(it_becomes_shorter_but_not_at_once, fresh),
        cmocka_unit_test_setup(a_press_leaves_the_path, fresh),
        cmocka_unit_test_setup(apples_grow_again, fresh),
        cmocka_unit_test_setup(a_frame_may_come_again_and_some_may_be_left_out, fresh),
        cmocka_unit_test_setup(time_goes_back_before_it_is_large, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
