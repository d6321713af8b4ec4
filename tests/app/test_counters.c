/*
 * Counters that have run for long: frames near 2^31, near 2^32 where their count begins anew, near 65,536 s, and clocks
 * near 2^32 us. No demo, no clip and nothing in a kit's program jumps there.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "animation.h"
#include "crc32.h"
#include "demo_stage.h"
#include "hal.h"
#include "models.h"
#include "panel_diff.h"
#include "panel_tiles.h"
#include "runner.h"
#include "sim.h"
#include "snake_way.h"

#include <stdlib.h>
#include <string.h>

#define AROUND 3 /* frames on either side */

static const uint64_t places[] = {AROUND, 65536ULL * ANIMATION_FRAMES_A_SECOND, 1ULL << 31, 1ULL << 32};
#define PLACES (sizeof places / sizeof places[0])

/* ---- demos ------------------------------------------------------------------------------------------------------ */

/* test_demos.c shows that a loop has no jump; here the frames of any count are those of the loop. */
static void assert_repeats(const struct demo *demo, const char *view)
{
    struct demo_stage s = demo_stage_open(demo, 40, 30);
    s.context.view = view;
    for (size_t i = 0; i < PLACES; i++) {
        for (uint64_t frame = places[i] - AROUND; frame < places[i] + AROUND; frame++) {
            const uint32_t crc = demo_stage_frame(&s, (uint32_t)frame);
            if (demo_stage_frame(&s, (uint32_t)(frame % demo->loop_frames)) != crc) {
                fail_msg("%s, %s: frame %llu is not that of its loop", demo->name, view != NULL ? view : "",
                         (unsigned long long)frame);
            }
        }
    }
    demo_stage_close(&s);
}

static void every_view_of_every_demo_repeats_its_loop_at_any_count(void **state)
{
    static const char *const one[] = {NULL, NULL};
    (void)state;
    for (uint32_t d = 0; d < demo_count; d++) {
        const char *const *view = demo_list[d]->views != NULL ? demo_list[d]->views : one;
        do {
            assert_repeats(demo_list[d], *view);
        } while (*view != NULL && *++view != NULL);
    }
}

/* ---- clips ------------------------------------------------------------------------------------------------------ */

static fx_t times[] = {0, 1000, 30000, 65535};
static const int16_t keys[][3] = {{0, -32768, 5}, {32767, 0, -5}, {-20000, 77, 8000}, {30000, 32767, -32768}};
static const struct ph_track track = {.path = PH_PATH_TRANSLATION,
                                      .interpolation = PH_KEYS_LINEAR,
                                      .width = 3,
                                      .frac = 12,
                                      .key_count = 4,
                                      .times = times,
                                      .keys = keys[0]};
static const struct ph_rig_node node = {-1, {{0, 0, 0, FX_Q30_ONE}, {0, 0, 0}, {0, 0, 0}}};
static struct ph_clip clip = {.tracks = &track, .track_count = 1};
static const struct animation moving = {
    .rig = {&node, 1},
    .root = {{{FX_Q30_ONE, 0, 0}, {0, FX_Q30_ONE, 0}, {0, 0, FX_Q30_ONE}}, {0, 0, 0}},
    .clip = &clip};

static int clip_init(struct demo_context *context)
{
    struct ph_mesh *const mesh = demo_alloc(&context->arena, sizeof *mesh);
    static const struct ph_material material = {.shading = PH_SHADE_UNLIT, .colour = 0xffff};
    assert_int_equal(model_cube(&context->arena, mesh), PH_OK);
    assert_int_equal(model_material(&context->arena, mesh, &material), PH_OK);
    return animation_init(context, &moving, mesh, 1, NULL);
}

static const struct demo clip_demo = {.name = "a clip",
                                      .loop_frames = 256,
                                      .arena_bytes = 16384,
                                      .vertex_max = 24 + DEMO_TURNTABLE_VERTICES,
                                      .triangle_max = 12 + DEMO_TURNTABLE_TRIANGLES,
                                      .init = clip_init,
                                      .frame = animation_frame};

/* The place of the node in the frame, which must be that of the clip's time, here by 64-bit division. */
static void assert_clip(struct demo_stage *s, uint64_t frame)
{
    struct ph_pose right, *const pose = ((const struct animation_stage *)s->context.state)->pose;
    const uint64_t time = frame * FX_ONE / ANIMATION_FRAMES_A_SECOND;
    memset(pose, 0, sizeof *pose);
    ph_rig_rest(&moving.rig, &right);
    ph_clip_sample(&clip, clip.duration > 0 ? (fx_t)(time % (uint64_t)clip.duration) : 0, &right, NULL);
    assert_int_equal(clip_demo.frame(&s->context, &s->rig.r, (uint32_t)frame), PH_OK);
    if (memcmp(pose, &right, sizeof right) != 0) {
        fail_msg("a clip of %d / 65536 s jumps at frame %llu", (int)clip.duration, (unsigned long long)frame);
    }
}

/* Frames of another rate, and the clock in place of frames. */
static void a_clip_has_the_time_that_the_context_says(void **state)
{
    static const uint32_t rates[] = {1, 7, 13, 24, 60, 1000};
    (void)state;
    clip.duration = 163840;
    struct demo_stage s = demo_stage_open(&clip_demo, 16, 12);
    struct animation_stage *const stage = s.context.state;
    const struct ph_pose *const pose = stage->pose;
    for (size_t i = 0; i < sizeof rates / sizeof rates[0]; i++) {
        s.context.clip_fps = (uint16_t)rates[i];
        stage->wraps = stage->quarter = 0;
        const uint64_t end = (uint64_t)(rates[i] < 9 ? rates[i] : 9) << 32; /* seconds have 32 bits */
        for (uint64_t frame = 0; frame < end; frame += frame < 300 ? 1 : (1U << 30) - 7) {
            struct ph_pose right;
            ph_rig_rest(&moving.rig, &right);
            ph_clip_sample(&clip, (fx_t)(frame * FX_ONE / rates[i] % (uint64_t)clip.duration), &right, NULL);
            assert_int_equal(clip_demo.frame(&s.context, &s.rig.r, (uint32_t)frame), PH_OK);
            assert_memory_equal(&pose->t, &right.t, sizeof right.t);
        }
    }
    s.context.clip_fps = DEMO_CLIPS_BY_CLOCK;
    for (uint32_t k = 0; k < 1000; k++) {
        const struct demo_clock clock = {k * 4294967, (uint16_t)(k * 65), 0};
        struct ph_pose right;
        ph_rig_rest(&moving.rig, &right);
        ph_clip_sample(&clip, (fx_t)(((uint64_t)clock.seconds * FX_ONE + clock.part) % (uint64_t)clip.duration), &right,
                       NULL);
        s.context.clock = clock;
        assert_int_equal(clip_demo.frame(&s.context, &s.rig.r, 5), PH_OK);
        assert_memory_equal(&pose->t, &right.t, sizeof right.t);
    }
    demo_stage_close(&s);
}

/* Microseconds add up without a loss, whatever their steps: 2^16 parts are 10^6 of them. */
static void the_clock_loses_nothing(void **state)
{
    static const uint32_t steps[] = {1, 15, 16, 33333, 76923, 999999, 1000000, 123456789, UINT32_MAX};
    (void)state;
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        struct demo_clock clock = {0, 0, 0};
        for (uint64_t n = 1; n <= 200000; n++) {
            const uint64_t us = n * steps[i];
            clock = demo_clock_after(clock, steps[i]);
            if (clock.seconds != (uint32_t)(us / 1000000) || clock.part != us % 1000000 * 65536 / 1000000) {
                fail_msg("%u us, %u times", (unsigned)steps[i], (unsigned)n);
            }
        }
    }
}

static void a_clip_plays_on_at_any_count(void **state)
{
    static const fx_t durations[] = {0, 1, 2, 2184, 65535, 65536, 65537, 163840, 7777777, FX_MAX - 1, FX_MAX};
    (void)state;
    for (size_t d = 0; d < sizeof durations / sizeof durations[0]; d++) {
        clip.duration = durations[d];
        for (int i = 0; i < 4; i++) { /* most of a long clip */
            times[i] = durations[d] > 65535 ? durations[d] / 4 * i : (fx_t[]){0, 1000, 30000, 65535}[i];
        }
        struct demo_stage s = demo_stage_open(&clip_demo, 16, 12);
        for (size_t i = 0; i < PLACES; i++) {
            for (uint64_t frame = places[i] - AROUND; frame < places[i] + AROUND; frame++) {
                assert_clip(&s, frame);
                assert_clip(&s, frame); /* drawn again */
            }
        }
        for (uint64_t frame = (1ULL << 32) + AROUND; frame >= (1ULL << 32) - AROUND; frame--) { /* and back */
            assert_clip(&s, frame);
        }
        demo_stage_close(&s);
        s = demo_stage_open(&clip_demo, 16, 12);
        assert_clip(&s, UINT32_MAX); /* as its first frame */
        assert_clip(&s, UINT32_MAX + 1ULL);
        for (uint64_t frame = UINT32_MAX + 1ULL; frame < 16ULL << 32; frame += 1U << 29) { /* 70 years */
            assert_clip(&s, frame);
        }
        demo_stage_close(&s);
    }
}

/* ---- the snake while it is steered ---------------------------------------------------------------------------------
 */

static fx_t farther(fx_t step, fx_t a, fx_t b)
{
    const fx_t now = fx_abs_sat(fx_sub_sat(a, b));
    return now > step ? now : step;
}

/* Steers on for so many frames, in which the head, the body's end and the apples move. Returns the longest step. */
static fx_t longest_step(struct snake_way *w, uint32_t frames)
{
    struct fx_vec3 at[3 + SNAKE_APPLES], before[3 + SNAKE_APPLES];
    uint32_t grown[SNAKE_APPLES] = {0};
    fx_t step = 0;
    for (uint32_t i = 0; i < frames; i++) {
        const struct snake_steering *const s = &w->steering;
        assert_true(s->on);
        for (uint32_t k = 0; k < 3; k++) {
            at[k] = snake_spot(s, s->time - k * 45, 0);
        }
        for (uint32_t k = 0; k < SNAKE_APPLES; k++) {
            const uint32_t now = snake_apple(s, k, s->time, &at[3 + k]);
            assert_true(i == 0 || now >= grown[k]);
            grown[k] = now;
        }
        for (uint32_t k = 0; k < 3 + SNAKE_APPLES && i > 0; k++) {
            step = farther(farther(step, at[k].x, before[k].x), at[k].z, before[k].z);
        }
        memcpy(before, at, sizeof at);
        snake_steer(w, w->frame + 1, 0);
    }
    return step;
}

static void a_steered_snake_creeps_on_at_any_count(void **state)
{
    static const uint32_t when[] = {(1U << 31) - 512, 0U - 512};
    (void)state;
    for (size_t i = 0; i < sizeof when / sizeof when[0]; i++) {
        struct snake_way w;
        snake_way_begin(&w);
        snake_steer(&w, 512, HAL_BUTTON_LEFT);
        for (uint32_t k = 0; k < 1536; k++) { /* until it creeps along the border, and has eaten what lies there */
            snake_steer(&w, w.frame + 1, 0);
        }
        const fx_t usual = longest_step(&w, 1024);
        assert_in_range(usual, FX_ONE / 32, FX_ONE / 4);
        const uint32_t time = (w.steering.time % 512) + when[i];
        for (uint32_t k = 0; k < SNAKE_APPLES; k++) {
            w.steering.born[k] += time - w.steering.time;
        }
        w.steering.time = time;
        assert_in_range(longest_step(&w, 2048), 0, usual + usual / 16);
    }
}

/* ---- a kit's program ------------------------------------------------------------------------------------------------
 */

static uint32_t clock_us, looks;

/* A frame takes 6 to 14 ms, and the bus 8.4: so senders weigh what is faster. */
static uint32_t time_us(void *context)
{
    (void)context;
    clock_us += 6000 + looks++ * 2503 % 8000;
    return clock_us;
}

static uint32_t write_ns(void *context)
{
    (void)context;
    return 5000;
}

/* A queue that is always empty: without one, no tiles are sent. */
static void bus_queue(void *context, bool on)
{
    (void)context, (void)on;
}

static uint32_t bus_written(void *context)
{
    (void)context;
    return 0;
}

static int bus_until(void *context, uint32_t written)
{
    (void)context, (void)written;
    return HAL_OK;
}

/* What came over the bus, and the last picture, of so many frames from here on. */
struct shown {
    struct sim_counters counters;
    uint32_t crc, edges_missed;
};

static struct shown show(const struct demo *demo, bool tiles, uint32_t frame, uint32_t from_us, uint32_t frames)
{
    const struct board *const board = board_find("pico-display");
    struct hal hal;
    struct sim *const sim = sim_open(board, &hal);
    struct hal_ops ops = *hal.ops;
    ops.time_us = time_us;
    ops.write_ns = write_ns;
    ops.bus_queue = tiles ? bus_queue : NULL;
    ops.bus_written = tiles ? bus_written : NULL;
    ops.bus_until = tiles ? bus_until : NULL;
    hal.ops = &ops;
    clock_us = from_us;
    looks = 0;
    struct panel_tiles tile;
    struct panel_diff diff;
    struct runner_config config = {.board = board,
                                   .depth_format = PH_DEPTH_AUTO,
                                   .rotation = board->rotation,
                                   .band_height = board->band_height,
                                   .budget_bytes = board->scene_bytes,
                                   .demo = demo,
                                   .sender = tiles ? panel_tiles_sender(&tile) : panel_diff_sender(&diff)};
    config.memory_bytes = runner_bytes(&config);
    config.memory = malloc(config.memory_bytes);
    struct runner *const runner = calloc(1, sizeof *runner);
    assert_int_equal(runner_open(runner, &hal, &config), 0);
    const uint16_t width = runner->driver.width, height = runner->driver.height;
    const size_t bytes = tiles ? panel_tiles_bytes(width, height, board->band_height) : panel_diff_bytes(width, height);
    void *const memory = malloc(bytes);
    uint8_t *const rgb = malloc((size_t)width * height * 3);
    assert_int_equal(tiles ? panel_tiles_init(&tile, &runner->driver, board->band_height, memory, bytes)
                           : panel_diff_init(&diff, &runner->driver, 0, memory, bytes),
                     0);
    for (uint32_t i = 0; i < frames; i++) {
        assert_int_equal(runner_frame(runner, frame + i), 0);
    }
    assert_int_equal(runner_finish(runner), 0);
    sim_pixels(sim, board->rotation, rgb);
    struct shown shown = {sim_counters(sim), crc32_update(0, rgb, (size_t)width * height * 3), runner->edges_missed};
    assert_int_equal(runner_close(runner), 0);
    assert_int_equal(sim_complaint_count(sim), 0);
    sim_close(sim);
    free(rgb);
    free(memory);
    free(runner);
    free(config.memory);
    return shown;
}

static void assert_alike(const struct shown *a, const struct shown *b)
{
    assert_int_equal(a->crc, b->crc);
    assert_int_equal(a->edges_missed, b->edges_missed);
    assert_int_equal(a->counters.bytes, b->counters.bytes);
    assert_int_equal(a->counters.writes, b->counters.writes);
}

static void a_kit_sends_alike_whatever_its_clock_and_its_frames_count(void **state)
{
    (void)state;
    for (uint32_t d = 0; d < 2 * demo_count; d++) {
        const struct demo *const demo = demo_list[d / 2];
        const uint32_t frames = d < 2 ? 24 : 4, wraps = d < 2 ? 16 : 1; /* its clock wraps before each of 16 frames */
        const struct shown first = show(demo, d % 2 != 0, demo->loop_frames - 2, 0, frames);
        for (uint32_t i = 0; i < 2 * wraps; i++) {
            const uint32_t from_us = (i % 2 != 0 ? 0U : 1U << 31) - (i / 2 + 1) * 10000;
            const struct shown late = show(demo, d % 2 != 0, (uint32_t)places[2 + i % 2] - 2, from_us, frames);
            assert_alike(&first, &late);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_view_of_every_demo_repeats_its_loop_at_any_count),
        cmocka_unit_test(a_clip_plays_on_at_any_count),
        cmocka_unit_test(a_clip_has_the_time_that_the_context_says),
        cmocka_unit_test(the_clock_loses_nothing),
        cmocka_unit_test(a_steered_snake_creeps_on_at_any_count),
        cmocka_unit_test(a_kit_sends_alike_whatever_its_clock_and_its_frames_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
