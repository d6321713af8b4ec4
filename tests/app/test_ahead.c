/* The other core makes the next scene while this one draws. The glass shows the same frames, whichever is first. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "runner.h"
#include "sim.h"

#include <pthread.h>
#include <sched.h>
#include <stdlib.h>

#define FRAMES 6 /* of each demo */
#ifdef __SANITIZE_ADDRESS__
#define SEEDS 5 /* of delays; each takes five times as long here */
#else
#define SEEDS 20
#endif
#define AHEAD_BYTES 524288

/* A stand-in for a second core: it runs at once, when it is joined, or is a thread. */
enum when { AT_ONCE, AT_JOIN, THREAD };
static enum when when;
static void (*waiting)(void *);
static void *waiting_argument;
static uint32_t scenes, busy, helped, chance;
static pthread_t thread;
static bool running, returned, joining, helps; /* helps: core 0 runs what the thread gave it */
static _Thread_local bool is_thread;
static void (*back)(void *); /* what the thread gives to core 0 while that one joins */
static void *back_argument;

static uint32_t below(uint32_t n)
{
    chance = chance * 1664525 + 1013904223;
    return (chance >> 16) % n;
}

static void delay(void)
{
    const uint32_t most[] = {1, 100, 3000, 300000}, steps = below(most[below(4)]);
    for (volatile uint32_t i = 0; i < steps; i++) {
    }
}

static bool is(const bool *flag)
{
    return __atomic_load_n(flag, __ATOMIC_ACQUIRE);
}

/* The other core's thread. In one of four runs the work begins when core 0 joins, so that the two meet however busy the
 * machine is. */
static void *thread_main(void *steps)
{
    is_thread = true;
    while ((uintptr_t)steps % 4 == 0 && !is(&joining)) {
        sched_yield();
    }
    for (volatile uintptr_t i = (uintptr_t)steps; i > 0; i--) {
    }
    waiting(waiting_argument);
    __atomic_store_n(&returned, true, __ATOMIC_RELEASE);
    return NULL;
}

/* NOLINTNEXTLINE(readability-non-const-parameter): the store changes it */
static void set(bool *flag, bool value)
{
    __atomic_store_n(flag, value, __ATOMIC_RELEASE);
}

static void join_thread(void)
{
    set(&joining, true);
    while (!is(&returned)) {
        if (is(&helps)) {
            delay();
            back(back_argument);
            set(&helps, false);
        }
        sched_yield();
    }
    set(&joining, false);
    assert_int_equal(pthread_join(thread, NULL), 0);
}

/* Gives work back from the thread; core 0 takes it while it joins. */
static bool give_back(void (*run)(void *), void *argument)
{
    if (!is(&joining)) {
        return false;
    }
    back = run;
    back_argument = argument;
    helped++;
    set(&helps, true);
    return true;
}

static void join(void)
{
    if (is_thread) {
        while (is(&helps)) {
            sched_yield();
        }
        return;
    }
    if (running && when == THREAD) {
        join_thread();
    } else if (running) {
        waiting(waiting_argument);
    }
    running = false;
}

static bool other_core(void (*run)(void *), void *argument)
{
    if (is_thread) {
        return give_back(run, argument);
    }
    if (when == AT_ONCE) {
        run(argument);
        return true;
    }
    if (running && (when == AT_JOIN || !__atomic_load_n(&returned, __ATOMIC_ACQUIRE))) {
        busy++;
        return false;
    }
    join();
    waiting = run;
    waiting_argument = argument;
    running = true;
    returned = false;
    if (when == THREAD) {
        assert_int_equal(pthread_create(&thread, NULL, thread_main, (void *)(uintptr_t)below(20000)), 0);
        delay();
    }
    return true;
}

struct stage {
    struct sim *sim;
    struct hal hal;
    struct runner runner;
    struct runner_config config;
    uint8_t seen[3 * 240 * 240];
};

static struct stage *stage_open(const char *board_name, size_t ahead_bytes)
{
    struct stage *s = calloc(1, sizeof *s);
    const struct board *const board = board_find(board_name);
    s->sim = sim_open(board, &s->hal);
    s->config = (struct runner_config){.board = board,
                                       .depth_format = PH_DEPTH_AUTO,
                                       .rotation = board->rotation,
                                       .band_height = board->band_height,
                                       .budget_bytes = board->scene_bytes,
                                       .demo = demo_list[0]};
    s->config.memory_bytes = runner_bytes(&s->config);
    s->config.memory = malloc(s->config.memory_bytes);
    if (ahead_bytes > 0) {
        s->config.other_core = other_core;
        s->config.other_core_join = join;
        s->config.cores = PH_TWO_CORES;
        s->config.ahead_bytes = ahead_bytes;
        s->config.ahead = malloc(ahead_bytes);
    }
    assert_int_equal(runner_open(&s->runner, &s->hal, &s->config), 0);
    return s;
}

static void stage_close(struct stage *s)
{
    assert_int_equal(runner_close(&s->runner), 0);
    assert_int_equal(sim_complaint_count(s->sim), 0);
    sim_close(s->sim);
    free(s->config.memory);
    free(s->config.ahead);
    free(s);
}

static void take(struct stage *s, const struct demo *demo)
{
    assert_int_equal(runner_take(&s->runner, demo), 0);
}

/* Buttons of a frame: some are held, some for one frame only. */
static uint32_t buttons_of(uint32_t frame)
{
    static const uint32_t pattern[] = {0, 0, HAL_BUTTON_LEFT, HAL_BUTTON_LEFT, 0, HAL_BUTTON_RIGHT | HAL_BUTTON_UP};
    return pattern[frame % FRAMES];
}

static void draw(struct stage *s, uint32_t frame)
{
    assert_int_equal(runner_buttons(&s->runner, buttons_of(frame)), 0);
    scenes += s->runner.ahead;
    assert_int_equal(runner_scene(&s->runner, frame), 0);
    if (s->config.ahead != NULL) {
        runner_ahead(&s->runner, frame + 1);
    }
    assert_int_equal(runner_send(&s->runner), 0);
    assert_int_equal(runner_finish(&s->runner), 0);
    sim_pixels(s->sim, s->config.rotation, s->seen);
}

static void compare(const char *board, size_t ahead_bytes)
{
    struct stage *alone = stage_open(board, 0), *two = stage_open(board, ahead_bytes);
    for (uint32_t i = 0; i < demo_count; i++) {
        take(alone, demo_list[i]);
        take(two, demo_list[i]);
        for (uint32_t frame = 0; frame < FRAMES; frame++) {
            draw(alone, frame);
            draw(two, frame);
            assert_memory_equal(alone->seen, two->seen, sizeof alone->seen);
            assert_memory_equal(&alone->runner.renderer.stats, &two->runner.renderer.stats, sizeof(struct ph_stats));
        }
    }
    stage_close(alone);
    stage_close(two);
}

static void every_demo_is_the_same(void **state)
{
    (void)state;
    for (when = AT_ONCE; when <= AT_JOIN; when++) {
        scenes = 0;
        compare("pico-display", AHEAD_BYTES);
        assert_true(scenes >= 2 * (demo_count - 6)); /* not focus, nor small scenes */
    }
}

static void it_is_with_any_delays_between_the_cores(void **state)
{
    (void)state;
    const char *const given = getenv("AHEAD_SEEDS");
    when = THREAD;
    scenes = busy = helped = 0;
    for (uint32_t seed = 0, seeds = given ? (uint32_t)strtoul(given, NULL, 10) : SEEDS; seed < seeds; seed++) {
        chance = seed;
        compare("pico-display", AHEAD_BYTES);
    }
    print_message("# %u scenes made ahead, %u times the other core was busy, %u times this one helped it\n",
                  (unsigned)scenes, (unsigned)busy, (unsigned)helped);
    assert_true(scenes > 0 && helped > 0);
}

/* Without memory for a list it is made here. Not a byte behind what is given is touched: a sanitizer sees that. */
static void little_memory_is_enough(void **state)
{
    (void)state;
    when = AT_ONCE;
    scenes = 0;
    compare("pico-display", sizeof(struct runner_ahead));
    assert_int_equal(scenes, 0);
    compare("pico-display", sizeof(struct runner_ahead) + 30080);
    assert_true(scenes > 0);
}

static void a_frame_out_of_turn_is_made_again(void **state)
{
    (void)state;
    struct stage *alone = stage_open("pico-display", 0), *two = stage_open("pico-display", AHEAD_BYTES);
    when = AT_JOIN;
    static const uint32_t order[] = {0, 1, 7, 3, 4, 4, 5};
    for (uint32_t i = 0; i < sizeof order / sizeof order[0]; i++) {
        draw(alone, order[i]);
        draw(two, order[i]);
        assert_memory_equal(alone->seen, two->seen, sizeof alone->seen);
    }
    stage_close(alone);
    stage_close(two);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_demo_is_the_same),
        cmocka_unit_test(it_is_with_any_delays_between_the_cores),
        cmocka_unit_test(little_memory_is_enough),
        cmocka_unit_test(a_frame_out_of_turn_is_made_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
