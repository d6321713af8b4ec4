/* A second core draws the lower half of each band. Pixels and counts are the same, whichever core is first. */
#include "demo.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 160, HEIGHT = 121, FRAMES = 3, LINES_MAX = 40 };

/* A stand-in for a second core: it runs at once, when it is joined, or is busy. */
enum when { AT_ONCE, AT_JOIN, BUSY };
static enum when when;
static void (*waiting)(void *);
static void *waiting_argument;
static uint32_t runs;

static bool other_core(void (*run)(void *), void *argument)
{
    runs++;
    if (when == AT_ONCE) {
        run(argument);
    }
    waiting = when == AT_JOIN ? run : NULL;
    waiting_argument = argument;
    return when != BUSY;
}

static void other_core_join(void)
{
    if (waiting != NULL) {
        waiting(waiting_argument);
    }
}

/* All frames of a demo below each other. */
struct film {
    uint16_t pixels[FRAMES][HEIGHT][WIDTH];
    uint32_t fragments[FRAMES];
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
    film->fragments[frame] = r->stats.fragments;
}

static struct film *shoot(const struct demo *demo, uint16_t lines, uint8_t format, bool two)
{
    static uint32_t depth[WIDTH * LINES_MAX], bins[HEIGHT];
    struct film *film = calloc(1, sizeof *film);
    struct demo_context context = {.width = WIDTH, .height = HEIGHT};
    const size_t scratch_bytes = demo_scratch_bytes(demo, WIDTH, lines);
    context.arena.base = malloc(demo->arena_bytes + 1);
    context.arena.size = demo->arena_bytes;
    context.scratch = malloc(scratch_bytes + 1);
    context.scratch_bytes = scratch_bytes;
    assert_int_equal(demo->init(&context), 0);
    const struct ph_config config = {.width = WIDTH,
                                     .height = HEIGHT,
                                     .band_height = lines,
                                     .depth_format = format,
                                     .vertices = malloc(ph_vertex_bytes * demo->vertex_max + 1),
                                     .vertex_max = demo->vertex_max,
                                     .triangles = malloc(ph_triangle_bytes * demo->triangle_max + 1),
                                     .triangle_max = demo->triangle_max,
                                     .bins = bins,
                                     .bin_max = HEIGHT,
                                     .depth = depth,
                                     .other_core = two ? other_core : NULL,
                                     .other_core_join = two ? other_core_join : NULL};
    struct ph_renderer r;
    assert_int_equal(ph_renderer_init(&r, &config), 0);
    for (uint32_t frame = 0; frame < FRAMES; frame++) {
        draw_frame(demo, &context, &r, frame, film);
    }
    free(config.vertices);
    free(config.triangles);
    free(context.arena.base);
    free(context.scratch);
    return film;
}

static void compare(const struct demo *demo, uint16_t lines, uint8_t format)
{
    struct film *alone = shoot(demo, lines, format, false);
    for (when = AT_ONCE; when <= BUSY; when++) {
        runs = 0;
        struct film *two = shoot(demo, lines, format, true);
        assert_int_equal(memcmp(alone, two, sizeof *two), 0);
        assert_int_equal(
            runs, lines == 1 ? 0 : FRAMES * ((HEIGHT + lines - 2) / lines)); /* a band of one row is not shared */
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_cores_draw_every_demo_as_one_does),
        cmocka_unit_test(also_with_other_bands_and_depths),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
