/*
 * memory_plan: who gets how many bytes, on kits and with demos that are made up so that the sums can be done by hand.
 * The kit has 240x240 pixels in bands of 16 lines: 7,680 bytes a band, as many for its depth, 64 for 15 bins.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "memory_plan.h"
#include "panels.h"

#include <string.h>

#define BAND    7680
#define PICTURE (2 * BAND + 7680 + 64) /* with two buffers */

/* 120 vertices and corners of 16 bytes, 300 references of 8, 16 slots of 144: 6,624 bytes; and an arena of 1,000. */
#define FINE 7624
/* 60 of 16, 100 of 8, 16 slots: 4,064; and an arena of 400. */
#define COARSE 4464
/* The most slots are 160, 144 more. */
#define SLOTS (144 * 144)

static struct board kit = {
    .panel = &panel_st7789_240x240, .format = PANEL_RGB565, .band_height = 16, .band_buffers = 2};
static struct demo_level coarse = {400, 400, 50, 100, 10, 0};
static struct demo thing = {.name = "a thing",
                            .arena_bytes = 1000,
                            .arena_bytes_32 = 1000,
                            .vertex_max = 100,
                            .triangle_max = 300,
                            .corner_max = 20,
                            .coarser = &coarse};

static int fresh(void **state)
{
    (void)state;
    kit.band_buffers = 2;
    kit.format = PANEL_RGB565;
    coarse.enough_px = 0;
    thing.coarser_count = 0;
    thing.blur_radius = 0;
    thing.triangle_max = 300;
    return 0;
}

static struct runner_config config_of(uint32_t budget)
{
    return (struct runner_config){
        .board = &kit, .depth_format = PH_DEPTH_FIXED16, .band_height = 16, .budget_bytes = budget, .demo = &thing};
}

static struct memory_plan plan_of(uint32_t budget)
{
    const struct runner_config config = config_of(budget);
    return memory_plan(&config, &thing);
}

/* ---- pictures ---------------------------------------------------------------------------------------------------- */

static void a_picture_takes_bands_depth_and_bins(void **state)
{
    (void)state;
    const struct runner_config config = config_of(0);
    const struct picture_memory p = memory_plan_picture(&config, 16);
    assert_int_equal(p.width * p.height, 240 * 240);
    assert_int_equal(p.lines, 16);
    assert_int_equal(p.bands, 15);
    assert_int_equal(p.buffers, 2);
    assert_int_equal(p.band_bytes, BAND);
    assert_int_equal(p.depth_bytes, 7680);
    assert_int_equal(p.bin_bytes, 64);
    assert_int_equal(p.wire_bytes + p.sample_bytes, 0);
    assert_int_equal(memory_plan_picture_bytes(&p), PICTURE);
}

static void a_turned_picture_has_the_sides_exchanged(void **state)
{
    (void)state;
    struct board upright = kit;
    upright.panel = &panel_st7789_135x240;
    struct runner_config config = config_of(0);
    config.board = &upright;
    config.rotation = PANEL_R90;
    const struct picture_memory p = memory_plan_picture(&config, 16);
    assert_int_equal(p.width, 240);
    assert_int_equal(p.height, 135);
    assert_int_equal(p.bands, 9); /* the last has 7 lines */
    assert_int_equal(p.bin_bytes, 40);
}

static void a_band_is_at_most_the_whole_picture(void **state)
{
    (void)state;
    const struct runner_config config = config_of(0);
    const struct picture_memory p = memory_plan_picture(&config, 241);
    assert_int_equal(p.lines, 240);
    assert_int_equal(p.bands, 1);
    assert_int_equal(memory_plan_picture(&config, 1).bands, 240);
    assert_int_equal(memory_plan_picture(&config, 0).bands, 0); /* there is no such picture */
}

static void depth_of_four_bytes_takes_twice_as_much(void **state)
{
    (void)state;
    struct runner_config config = config_of(0);
    config.depth_format = PH_DEPTH_FLOAT24;
    assert_int_equal(memory_plan_picture(&config, 16).depth_bytes, 2 * 7680);
}

static void antialiasing_takes_a_quarter_of_the_lines_and_four_samples_a_pixel(void **state)
{
    (void)state;
    struct runner_config config = config_of(0);
    config.antialiasing = PH_ANTIALIAS_2X2;
    const struct picture_memory p = memory_plan_picture(&config, 16);
    assert_int_equal(p.lines, 4);
    assert_int_equal(p.bands, 60);
    assert_int_equal(p.band_bytes, BAND / 4);
    assert_int_equal(p.depth_bytes, 7680);
    assert_int_equal(p.sample_bytes, 7680);
    assert_int_equal(memory_plan_picture(&config, 17).lines, 5);
    assert_int_equal(memory_plan_picture_bytes(&p), 2 * BAND / 4 + 7680 + 240 + 7680);
}

static void other_formats_take_memory_for_the_wire(void **state)
{
    (void)state;
    struct runner_config config = config_of(0);
    kit.format = PANEL_RGB444;
    assert_int_equal(memory_plan_picture(&config, 16).wire_bytes, 240 * 16 / 2);
    assert_int_equal(memory_plan_picture(&config, 1).wire_bytes, PANEL_SCRATCH_MIN);
    assert_int_equal(memory_plan_picture(&config, 240).wire_bytes, 4096);
    kit.format = PANEL_RGB565;
    const struct panel_sender_ops copies = {.copies = true};
    config.sender.ops = &copies;
    const struct picture_memory p = memory_plan_picture(&config, 16);
    assert_int_equal(memory_plan_picture_bytes(&p), PICTURE + 4096);
    assert_int_equal(memory_plan_picture(&config, 1).wire_bytes, 4096);
}

static void a_queue_is_of_use_for_more_than_two_buffers_that_go_straight_to_the_wire(void **state)
{
    (void)state;
    const struct panel_sender_ops copies = {.copies = true}, keeps = {.copies = false};
    struct runner_config config = config_of(0);
    assert_false(memory_plan_has_queue(&config));
    kit.band_buffers = 3;
    assert_true(memory_plan_has_queue(&config));
    config.sender.ops = &keeps;
    assert_true(memory_plan_has_queue(&config));
    config.sender.ops = &copies;
    assert_false(memory_plan_has_queue(&config));
    config.sender.ops = NULL;
    kit.format = PANEL_RGB444;
    assert_false(memory_plan_has_queue(&config));
}

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

static void a_scene_is_whole_from_its_last_byte_on(void **state)
{
    (void)state;
    struct memory_plan plan = plan_of(PICTURE + FINE);
    assert_true(plan.scene.whole);
    assert_int_equal(plan.scene.triangle_max, 300);
    assert_int_equal(plan.scene.list_bytes, 6624);
    assert_int_equal(plan.scene.arena_bytes, 1000);
    assert_int_equal(plan.scene.arena_at, 6624);
    assert_int_equal(plan.scene.scratch_at, FINE);
    assert_int_equal(plan.scene.bytes_32, FINE);
    assert_int_equal(memory_plan_bytes(&plan), PICTURE + FINE);
    plan = plan_of(PICTURE + FINE - 1);
    assert_false(plan.scene.whole);
    const struct runner_config config = config_of(0);
    assert_int_equal(runner_whole_bytes(&config), PICTURE + FINE);
}

static void whether_a_scene_fits_is_counted_in_a_32_bit_targets_sizes(void **state)
{
    (void)state;
    struct demo here = thing;
    here.arena_bytes = 1800; /* on this machine */
    const struct runner_config config = config_of(PICTURE + FINE);
    const struct memory_plan plan = memory_plan(&config, &here);
    assert_true(plan.scene.whole);
    assert_int_equal(plan.scene.bytes_32, FINE);
    assert_int_equal(plan.scene.arena_bytes, 1800);
    assert_int_equal(plan.scene.scratch_at, 6624 + 1800);
    here.arena_bytes_32 = 0; /* it is not on the list: as many there */
    assert_false(memory_plan(&config, &here).scene.whole);
}

static void a_small_side_counts_whichever_it_is(void **state)
{
    (void)state;
    struct board wide = kit;
    wide.panel = &panel_st7789_135x240;
    struct runner_config config = config_of(1000000);
    config.board = &wide;
    thing.coarser_count = 1;
    coarse.enough_px = 135;
    for (int rotation = PANEL_R0; rotation <= PANEL_R90; rotation++) {
        config.rotation = (uint8_t)rotation;
        assert_int_equal(memory_plan(&config, &thing).scene.triangle_max, 100);
    }
}

static void what_is_left_becomes_slots_up_to_160(void **state)
{
    (void)state;
    assert_int_equal(plan_of(PICTURE + FINE + 143).scene.list_bytes, 6624);
    assert_int_equal(plan_of(PICTURE + FINE + 144).scene.list_bytes, 6624 + 144);
    assert_int_equal(plan_of(PICTURE + FINE + SLOTS - 1).scene.list_bytes, 6624 + SLOTS - 144);
    assert_int_equal(plan_of(PICTURE + FINE + SLOTS).scene.list_bytes, 6624 + SLOTS);
    assert_int_equal(plan_of(PICTURE + FINE + SLOTS + 10000).scene.list_bytes, 6624 + SLOTS);
}

static void a_scene_has_no_more_slots_than_triangles_but_16(void **state)
{
    (void)state;
    const uint32_t plenty = 200000;
    thing.triangle_max = 30;
    assert_int_equal(plan_of(plenty).scene.list_bytes, (120 * 16 + 30 * 8 + 30 * 144 + 15) / 16 * 16);
    thing.triangle_max = 5;
    assert_int_equal(plan_of(plenty).scene.list_bytes, (120 * 16 + 5 * 8 + 16 * 144 + 15) / 16 * 16);
}

static void a_coarser_level_is_taken_where_the_finer_does_not_fit(void **state)
{
    (void)state;
    thing.coarser_count = 1;
    assert_int_equal(plan_of(PICTURE + FINE).scene.triangle_max, 300);
    const struct memory_plan plan = plan_of(PICTURE + FINE - 1);
    assert_true(plan.scene.whole);
    assert_int_equal(plan.scene.triangle_max, 100);
    assert_int_equal(plan.scene.arena_bytes, 400);
    assert_true(plan_of(PICTURE + COARSE).scene.whole);
    assert_false(plan_of(PICTURE + COARSE - 1).scene.whole);
}

static void a_coarser_level_is_taken_where_the_picture_is_small(void **state)
{
    (void)state;
    thing.coarser_count = 1;
    coarse.enough_px = 240;
    assert_int_equal(plan_of(PICTURE + FINE).scene.triangle_max, 100);
    coarse.enough_px = 239;
    assert_int_equal(plan_of(PICTURE + FINE).scene.triangle_max, 300);
}

/* The list needs the vertices and 2,048 bytes; its triangles are the share that it has of a whole one. */
static void a_scene_that_does_not_fit_has_a_share_of_its_triangles(void **state)
{
    (void)state;
    const uint32_t least = 1000 + 100 * 16 + 2048;
    const struct memory_plan plan = plan_of(PICTURE + least);
    assert_false(plan.scene.whole);
    assert_int_equal(plan.scene.list_bytes, 3648);
    assert_int_equal(plan.scene.triangle_max, 165); /* 300 x 3,648 / 6,624 */
    assert_int_equal(plan_of(PICTURE + least + 15).scene.list_bytes, 3648);
    assert_int_equal(plan_of(PICTURE + least + 16).scene.list_bytes, 3664);
    assert_int_equal(plan_of(PICTURE + least - 1).scene.triangle_max, 0);
    assert_int_equal(plan_of(PICTURE - 1).scene.triangle_max, 0);
}

static void with_antialiasing_a_line_is_two_triangles(void **state)
{
    (void)state;
    struct runner_config config = config_of(200000);
    config.antialiasing = PH_ANTIALIAS_2X2;
    const struct memory_plan plan = memory_plan(&config, &thing);
    assert_int_equal(plan.scene.triangle_max, 600);
    assert_int_equal(plan.scene.list_bytes, 120 * 16 + 600 * 8 + 160 * 144);
}

static void a_blur_has_memory_if_all_else_has(void **state)
{
    (void)state;
    thing.blur_radius = 2;
    const size_t scratch = demo_scratch_bytes(&thing, 240, 16), rounded = (scratch + 7) / 8 * 8;
    assert_true(scratch > 0);
    struct memory_plan plan = plan_of((uint32_t)(PICTURE + FINE + rounded));
    assert_true(plan.scene.whole && !plan.scene.lacks_scratch);
    assert_int_equal(plan.scene.scratch_bytes, scratch);
    assert_int_equal(plan.scene.bytes_32, FINE + rounded);
    assert_int_equal(memory_plan_bytes(&plan), PICTURE + FINE + rounded);
    plan = plan_of((uint32_t)(PICTURE + FINE + rounded - 1));
    assert_true(plan.scene.whole && plan.scene.lacks_scratch);
    assert_int_equal(plan.scene.scratch_bytes, 0);
    plan = plan_of(PICTURE + FINE - 1);
    assert_false(plan.scene.whole);
    assert_int_equal(plan.scene.scratch_bytes, 0);
}

/* ---- buffers ----------------------------------------------------------------------------------------------------- */

static void without_a_queue_there_are_two_buffers(void **state)
{
    (void)state;
    assert_int_equal(plan_of(1000000).picture.buffers, 2);
}

static void buffers_are_taken_away_until_the_scene_is_whole(void **state)
{
    (void)state;
    kit.band_buffers = 5;
    for (uint32_t buffers = 2; buffers <= 5; buffers++) {
        const uint32_t enough = PICTURE + (buffers - 2) * BAND + FINE;
        assert_int_equal(plan_of(enough).picture.buffers, buffers);
        assert_true(plan_of(enough).scene.whole);
        assert_int_equal(plan_of(enough - 1).picture.buffers, buffers > 2 ? buffers - 1 : 2);
        assert_int_equal(plan_of(enough - 1).scene.whole, buffers > 2);
    }
}

static void buffers_are_taken_away_for_a_blur(void **state)
{
    (void)state;
    kit.band_buffers = 3;
    thing.blur_radius = 2;
    const uint32_t scratch = (uint32_t)(demo_scratch_bytes(&thing, 240, 16) + 7) / 8 * 8;
    assert_int_equal(plan_of(PICTURE + BAND + FINE + scratch).picture.buffers, 3);
    assert_int_equal(plan_of(PICTURE + BAND + FINE + scratch - 1).picture.buffers, 2);
    assert_false(plan_of(PICTURE + BAND + FINE + scratch - 1).scene.lacks_scratch);
}

static void room_beside_a_whole_scene_becomes_buffers_of_which_16_are_enough(void **state)
{
    (void)state;
    kit.band_buffers = 3;
    const uint32_t whole = PICTURE + FINE + SLOTS;
    assert_int_equal(plan_of(whole + 2 * BAND - 1).picture.buffers, 3);
    assert_int_equal(plan_of(whole + 2 * BAND).picture.buffers, 4);
    assert_int_equal(plan_of(whole + 12 * BAND).picture.buffers, 14);
    assert_int_equal(plan_of(whole + 20 * BAND).picture.buffers, 15); /* the picture has no more bands */
    struct board thin = kit;
    thin.band_height = 8;
    struct runner_config config = config_of(1000000);
    config.board = &thin;
    config.band_height = 8;
    assert_int_equal(memory_plan(&config, &thing).picture.buffers, 16); /* of 30 bands */
}

/* The same scene in other bands, so that the picture is the same; as many lines or fewer wait on the bus. */
static void other_bands_share_the_lines_of_the_boards_own(void **state)
{
    (void)state;
    static const struct {
        uint16_t lines;
        uint32_t buffers;
    } bands[] = {{1, 6}, {4, 6}, {8, 6}, {16, 6}, {24, 4}, {31, 3}, {32, 3}, {33, 2}, {48, 2}, {96, 2}, {240, 2}};
    kit.band_buffers = 6;
    const uint32_t budget = PICTURE + 4 * BAND + FINE;
    const struct memory_plan own = plan_of(budget);
    for (size_t i = 0; i < sizeof bands / sizeof bands[0]; i++) {
        struct runner_config config = config_of(budget);
        config.band_height = bands[i].lines;
        const struct memory_plan plan = memory_plan(&config, &thing);
        assert_int_equal(plan.picture.buffers, bands[i].buffers);
        assert_int_equal(plan.picture.lines, bands[i].lines);
        assert_int_equal(plan.scene.triangle_max, own.scene.triangle_max);
        assert_int_equal(plan.scene.list_bytes, own.scene.list_bytes);
        assert_int_equal(plan.scene.bytes_32, own.scene.bytes_32);
    }
}

static void bands_of_no_lines_are_no_plan_and_no_error(void **state)
{
    (void)state;
    struct runner_config config = config_of(200000);
    config.band_height = 0;
    assert_int_equal(memory_plan(&config, &thing).picture.bands, 0);
    assert_int_equal(memory_plan(&config, &thing).picture.buffers, 2);
}

static void a_blur_in_other_bands_takes_what_these_want(void **state)
{
    (void)state;
    thing.blur_radius = 2;
    struct runner_config config = config_of(200000);
    config.band_height = 60;
    assert_int_equal(memory_plan(&config, &thing).scene.scratch_bytes, demo_scratch_bytes(&thing, 240, 60));
}

/* ---- for callers ------------------------------------------------------------------------------------------------- */

static void memory_is_enough_for_every_demo_and_no_more_than_one_takes(void **state)
{
    (void)state;
    struct runner_config config = config_of(60000);
    const size_t bytes = runner_bytes(&config);
    bool taken = false;
    for (uint32_t i = 0; i < demo_count; i++) {
        const struct memory_plan plan = memory_plan(&config, demo_list[i]);
        const uint64_t takes = plan.scene.triangle_max > 0 ? memory_plan_bytes(&plan) : 0;
        assert_true(takes <= bytes);
        taken = taken || takes == bytes;
    }
    assert_true(taken);
    thing.triangle_max = 100000; /* one that is not on the list */
    config.budget_bytes = 2000000;
    const struct memory_plan own = memory_plan(&config, &thing);
    assert_int_equal(runner_bytes(&config), memory_plan_bytes(&own));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_picture_takes_bands_depth_and_bins, fresh),
        cmocka_unit_test_setup(a_turned_picture_has_the_sides_exchanged, fresh),
        cmocka_unit_test_setup(a_band_is_at_most_the_whole_picture, fresh),
        cmocka_unit_test_setup(depth_of_four_bytes_takes_twice_as_much, fresh),
        cmocka_unit_test_setup(antialiasing_takes_a_quarter_of_the_lines_and_four_samples_a_pixel, fresh),
        cmocka_unit_test_setup(other_formats_take_memory_for_the_wire, fresh),
        cmocka_unit_test_setup(a_queue_is_of_use_for_more_than_two_buffers_that_go_straight_to_the_wire, fresh),
        cmocka_unit_test_setup(a_scene_is_whole_from_its_last_byte_on, fresh),
        cmocka_unit_test_setup(whether_a_scene_fits_is_counted_in_a_32_bit_targets_sizes, fresh),
        cmocka_unit_test_setup(a_small_side_counts_whichever_it_is, fresh),
        cmocka_unit_test_setup(what_is_left_becomes_slots_up_to_160, fresh),
        cmocka_unit_test_setup(a_scene_has_no_more_slots_than_triangles_but_16, fresh),
        cmocka_unit_test_setup(a_coarser_level_is_taken_where_the_finer_does_not_fit, fresh),
        cmocka_unit_test_setup(a_coarser_level_is_taken_where_the_picture_is_small, fresh),
        cmocka_unit_test_setup(a_scene_that_does_not_fit_has_a_share_of_its_triangles, fresh),
        cmocka_unit_test_setup(with_antialiasing_a_line_is_two_triangles, fresh),
        cmocka_unit_test_setup(a_blur_has_memory_if_all_else_has, fresh),
        cmocka_unit_test_setup(without_a_queue_there_are_two_buffers, fresh),
        cmocka_unit_test_setup(buffers_are_taken_away_until_the_scene_is_whole, fresh),
        cmocka_unit_test_setup(buffers_are_taken_away_for_a_blur, fresh),
        cmocka_unit_test_setup(room_beside_a_whole_scene_becomes_buffers_of_which_16_are_enough, fresh),
        cmocka_unit_test_setup(other_bands_share_the_lines_of_the_boards_own, fresh),
        cmocka_unit_test_setup(bands_of_no_lines_are_no_plan_and_no_error, fresh),
        cmocka_unit_test_setup(a_blur_in_other_bands_takes_what_these_want, fresh),
        cmocka_unit_test_setup(memory_is_enough_for_every_demo_and_no_more_than_one_takes, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
