/*
 * Two cores share vertices, culling, light, set-up and rows. Pixels and counts are those of one core, whichever core is
 * first, and however long each one waits.
 */
#include "demo.h"
#include "motion.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <pthread.h>
#include <time.h>

enum { WIDTH = 160, HEIGHT = 121, FRAMES = 3, LINES_MAX = 40 };

/* A stand-in for a second core: it runs at once, when it is joined, is busy, or is a thread. */
enum when { AT_ONCE, AT_JOIN, BUSY, THREAD };
static enum when when;
static void (*waiting)(void *);
static void *waiting_argument;
static uint32_t runs, chance;

static uint32_t below(uint32_t n)
{
    chance = chance * 1664525 + 1013904223;
    return (chance >> 16) % n;
}

/* Up to some 20 us, and now and then much longer than a share of the work takes. */
static void delay(uint32_t steps)
{
    for (volatile uint32_t i = 0; i < steps; i++) {
    }
}

static uint32_t any_delay(void)
{
    static const uint32_t most[] = {1, 100, 3000, 60000};
    return below(most[below(8) > 0 ? below(3) : 3]);
}

/* The other core waits for work all the time: a thread that begins anew for each would mostly come too late to meet
 * this one at the same triangle. */
static uint32_t thread_delay;
static uint32_t given, done; /* numbers of pieces of work */

static void *thread_main(void *unused)
{
    (void)unused;
    for (uint32_t next = 1;; next++) {
        while (__atomic_load_n(&given, __ATOMIC_ACQUIRE) != next) {
        }
        delay(thread_delay);
        waiting(waiting_argument);
        __atomic_store_n(&done, next, __ATOMIC_RELEASE);
    }
    return NULL;
}

static void give(void)
{
    static pthread_t thread;
    if (given == 0) {
        assert_int_equal(pthread_create(&thread, NULL, thread_main, NULL), 0);
    }
    __atomic_store_n(&given, given + 1, __ATOMIC_RELEASE);
}

static bool other_core(void (*run)(void *), void *argument)
{
    runs++;
    if (when == AT_ONCE) {
        run(argument);
    }
    waiting = when == AT_JOIN || when == THREAD ? run : NULL;
    waiting_argument = argument;
    if (when == THREAD) {
        if (below(16) == 0) { /* busy, once in a while */
            return false;
        }
        thread_delay = any_delay();
        give();
        delay(any_delay());
    }
    return when != BUSY;
}

static void other_core_join(void)
{
    if (when == THREAD) {
        while (__atomic_load_n(&done, __ATOMIC_ACQUIRE) != given) {
        }
    } else if (waiting != NULL) {
        waiting(waiting_argument);
    }
}

/* All frames of a demo below each other. */
struct film {
    uint16_t pixels[FRAMES][HEIGHT][WIDTH];
    struct ph_stats stats[FRAMES];
};

static void draw_frame(const struct demo *demo, struct demo_context *context, struct ph_renderer *r, uint32_t frame,
                       struct film *film)
{
    assert_int_equal(demo->frame(context, r, frame * 40), 0);
    const uint32_t bands = ph_frame_bands(r);
    uint32_t line = 0;
    for (uint32_t band = 0; band < bands; band++) {
        line += demo_draw_band(demo, context, r, band, film->pixels[frame][line]);
    }
    assert_int_equal(line, HEIGHT);
    film->stats[frame] = r->stats;
}

/* triangles: so many, in the memory of vertices too, with room for few slots or none; 0: as many as the demo wants, in
 * memory of their own, and room for slots. */
static struct film *shoot(const struct demo *demo, uint16_t lines, const struct ph_depth_format *format,
                          uint32_t triangles, bool two)
{
    static uint32_t depth[WIDTH * LINES_MAX], bins[HEIGHT];
    struct film *film = calloc(1, sizeof *film);
    struct demo_context context = {.width = WIDTH, .height = HEIGHT};
    const size_t scratch_bytes = demo_scratch_bytes(demo, WIDTH, lines);
    const uint32_t spare = triangles > 0 ? triangles / 2 + 4 : 600;
    const uint32_t vertices = demo->vertex_max + demo->corner_max + spare;
    context.arena.base = malloc(demo->arena_bytes + 1);
    context.arena.size = demo->arena_bytes;
    context.scratch = malloc(scratch_bytes + 1);
    context.scratch_bytes = scratch_bytes;
    assert_int_equal(demo->init(&context), 0);
    struct ph_config config = {.width = WIDTH,
                               .height = HEIGHT,
                               .band_height = lines,
                               .depth_format = format,
                               .colouring = PH_COLOURS,
                               .vertices = malloc(ph_vertex_bytes * vertices + 1),
                               .vertex_max = vertices,
                               .triangles = malloc(ph_triangle_bytes * demo->triangle_max + 1),
                               .triangle_max = demo->triangle_max,
                               .bins = bins,
                               .bin_max = HEIGHT,
                               .depth = depth,
                               .other_core = two ? other_core : NULL,
                               .other_core_join = two ? other_core_join : NULL,
                               .cores = two ? PH_TWO_CORES : NULL};
    void *const own = config.triangles;
    if (triangles > 0) {
        config.triangles = config.vertices;
        config.triangle_max = triangles;
    }
    struct ph_renderer r;
    assert_int_equal(ph_renderer_init(&r, &config), 0);
    for (uint32_t frame = 0; frame < FRAMES; frame++) {
        draw_frame(demo, &context, &r, frame, film);
    }
    free(config.vertices);
    free(own);
    free(context.arena.base);
    free(context.scratch);
    return film;
}

static void compare(const struct demo *demo, uint16_t lines, const struct ph_depth_format *format)
{
    struct film *alone = shoot(demo, lines, format, 0, false);
    for (when = AT_ONCE; when <= BUSY; when++) {
        runs = 0;
        struct film *two = shoot(demo, lines, format, 0, true);
        assert_memory_equal(alone, two, sizeof *two);
        assert_true(runs >= (lines == 1 ? 0U : FRAMES * ((HEIGHT + lines - 2U) / lines)));
        free(two);
    }
    free(alone);
}

static void two_cores_draw_every_demo_as_one_does(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < demo_count; i++) {
        compare(demo_list[i], 20, PH_DEPTH_AUTO);
    }
}

static void also_with_other_bands_and_depths(void **state)
{
    (void)state;
    static const uint16_t lines[] = {1, 2, 3, 8, 40};
    for (uint32_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        compare(demo_find("turntable"), lines[i], PH_DEPTH_FIXED16);
        compare(demo_find("cube"), lines[i], PH_DEPTH_FLOAT24);
    }
}

/* Two threads with delays between them: 36 seeds, each with demos that are clipped, curved, textured, blended, fogged,
 * seen by several cameras, and with memory that has slots for few triangles or for none. */
static void no_delay_between_the_cores_changes_a_byte(void **state)
{
    static const char *const names[] = {"turntable", "ground",  "conventions", "shadow", "cube",
                                        "snake",     "fisheye", "materials",   "yard"};
    static const uint16_t lines[] = {16, 3, 20, 40};
    (void)state;
    when = THREAD;
    for (uint32_t seed = 0; seed < 36; seed++) {
        chance = seed * 977;
        const struct demo *const demo = demo_find(names[seed % 9]);
        const uint32_t triangles = seed / 9 % 3 == 0 ? 0 : demo->triangle_max;
        const uint16_t height = lines[seed % 4];
        struct film *one = shoot(demo, height, PH_DEPTH_AUTO, triangles, false);
        struct film *two = shoot(demo, height, PH_DEPTH_AUTO, triangles, true);
        assert_memory_equal(one, two, sizeof *two);
        free(one);
        free(two);
    }
}

/* Without slots a triangle is set up again in each band, in its place in drawing order. */
static void the_number_of_slots_changes_no_byte(void **state)
{
    static const char *const names[] = {"turntable", "ground",      "cube",      "fill",     "zfight",
                                        "focus",     "conventions", "materials", "character"};
    static const uint16_t lines[] = {1, 7, 16};
    (void)state;
    for (uint32_t i = 0; i < 3 * sizeof names / sizeof names[0]; i++) {
        const struct demo *const demo = demo_find(names[i / 3]);
        struct film *with = shoot(demo, lines[i % 3], PH_DEPTH_AUTO, 0, false);
        struct film *without = shoot(demo, lines[i % 3], PH_DEPTH_AUTO, demo->triangle_max, false);
        assert_memory_equal(with, without, sizeof *with);
        free(with);
        free(without);
    }
}

/* What does not fit is left out alike, and counted alike. Returns how many. */
static uint32_t leave_out_alike(const struct demo *demo, uint32_t triangles)
{
    struct film *one = shoot(demo, 16, PH_DEPTH_AUTO, triangles, false);
    for (when = AT_ONCE; when <= THREAD; when++) {
        struct film *two = shoot(demo, 16, PH_DEPTH_AUTO, triangles, true);
        assert_memory_equal(one, two, sizeof *two);
        free(two);
    }
    const uint32_t dropped = one->stats[0].triangles_dropped;
    free(one);
    return dropped;
}

static void two_cores_leave_out_what_one_does(void **state)
{
    static const char *const names[] = {"turntable", "fisheye"};
    static const uint32_t most[] = {12, 4}; /* of 16 parts of the room it wants: that is too little */
    (void)state;
    for (uint32_t i = 0; i < 2; i++) {
        const struct demo *const demo = demo_find(names[i]);
        for (uint32_t part = 1; part < 16; part++) {
            assert_true(leave_out_alike(demo, demo->triangle_max * part / 16) > 0 || part > most[i]);
        }
    }
}

enum { SKINNED = 200 };

struct skinned {
    struct fx_vec3 positions[SKINNED];
    int16_t normals[SKINNED][3];
};

static void two_cores_skin_as_one_does(void **state)
{
    (void)state;
    static const uint32_t counts[] = {0, 1, 31, 32, 33, SKINNED};
    int16_t positions[SKINNED][3], normals[SKINNED][3];
    struct ph_influence influences[SKINNED];
    const struct ph_xform joints[2] = {ph_xform_rotate_y(1u << 29), ph_xform_rotate_y(1u << 27)};
    for (uint32_t i = 0; i < SKINNED; i++) {
        for (uint32_t k = 0; k < 3; k++) {
            positions[i][k] = (int16_t)(below(60000) - 30000);
            normals[i][k] = (int16_t)(below(16000) - 8000);
        }
        const uint16_t share = (uint16_t)(PH_INFLUENCE_ONE / 2 * (1 + below(2)));
        influences[i] = (struct ph_influence){{(uint8_t)below(2), 1}, {share, (uint16_t)(PH_INFLUENCE_ONE - share)}};
    }
    when = AT_JOIN;
    for (uint32_t i = 0; i < 3 * sizeof counts / sizeof *counts; i++) {
        const struct ph_renderer r = {.config = {.other_core = other_core, .other_core_join = other_core_join}};
        const struct ph_bound from = {(const int16_t(*)[3])positions,
                                      i % 3 == 1 ? NULL : (const int16_t(*)[3])normals,
                                      i % 3 == 2 ? NULL : influences,
                                      counts[i / 3],
                                      15,
                                      false};
        struct skinned one = {0}, two = {0};
        runs = 0;
        ph_skin_vertices(&from, joints, one.positions, one.normals);
        ph_skin_mesh(&r, &from, joints, two.positions, two.normals);
        assert_memory_equal(&one, &two, sizeof one);
        assert_int_equal(runs, from.vertex_count >= 32 ? 1 : 0);
        ph_skin_mesh(&r, &from, joints, two.positions, NULL);
    }
}

static void a_second_core_without_what_shares_work_is_refused(void **state)
{
    (void)state;
    static uint64_t room[64];
    static uint32_t bins[1];
    static uint16_t depth[8 * 8];
    struct ph_config config = {.width = 8,
                               .height = 8,
                               .band_height = 8,
                               .depth_format = PH_DEPTH_FIXED16,
                               .vertices = room,
                               .vertex_max = sizeof room / ph_vertex_bytes,
                               .triangles = room,
                               .triangle_max = 1,
                               .bins = bins,
                               .bin_max = 1,
                               .depth = depth,
                               .other_core = other_core,
                               .other_core_join = other_core_join};
    struct ph_renderer r;
    assert_int_equal(ph_renderer_init(&r, &config), PH_ERR_INVAL);
    config.cores = PH_TWO_CORES;
    assert_int_equal(ph_renderer_init(&r, &config), PH_OK);
    config.other_core_join = NULL;
    assert_int_equal(ph_renderer_init(&r, &config), PH_ERR_INVAL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_second_core_without_what_shares_work_is_refused),
        cmocka_unit_test(two_cores_draw_every_demo_as_one_does),
        cmocka_unit_test(also_with_other_bands_and_depths),
        cmocka_unit_test(no_delay_between_the_cores_changes_a_byte),
        cmocka_unit_test(the_number_of_slots_changes_no_byte),
        cmocka_unit_test(two_cores_leave_out_what_one_does),
        cmocka_unit_test(two_cores_skin_as_one_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
