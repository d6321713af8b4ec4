/* asset_measure: from where the model is looked at, and what becomes of the counts of triangles. The demo that is
 * drawn, and the memory plan, are the test's own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "made_asset.h"
#include "memory_plan.h"
#include "scene_file.h"
#include "stderr_capture.h"

#include <string.h>

enum { VIEWS_MAX = 128 };

static struct {
    uint32_t orbit, frame;
    fx_t dolly;
} views[VIEWS_MAX];
static uint32_t view_count, most_at, fails_at, blend_width;
static struct runner_config planned;
static struct demo planned_demo;

static int init(struct demo_context *context)
{
    assert_non_null(context->state);
    assert_int_equal(context->arena.size, ((const struct model *)context->state)->has_camera ? 512 : 256);
    memset(context->arena.base, 1, context->arena.size);
    return 0;
}

static int frame(struct demo_context *context, struct ph_renderer *r, uint32_t number)
{
    const struct ph_config *const c = &r->config;
    const uint8_t *const depth = c->depth, *const bins = (const uint8_t *)c->bins;
    assert_true(view_count < VIEWS_MAX);
    assert_int_equal(c->vertex_max, 1000 - 129);
    assert_true(c->triangle_max >= 1536 && c->width == 240 && c->height == 135 && c->band_height == 1);
    assert_true((const uint8_t *)c->triangles >= (const uint8_t *)c->vertices + c->vertex_max * ph_vertex_bytes);
    assert_true(depth >= (const uint8_t *)c->triangles + c->triangle_max * ph_triangle_bytes);
    assert_true(bins >= depth + (size_t)240 * 4 && context->arena.base >= bins + (size_t)135 * 4);
    views[view_count].orbit = context->orbit;
    views[view_count].dolly = context->dolly;
    views[view_count].frame = number;
    view_count++;
    r->stats.triangles_drawn = view_count == most_at ? 300 : 200;
    r->stats.triangles_dropped = 20;
    return view_count == fails_at ? PH_ERR_INVAL : 0;
}

struct demo model_demo(const struct model *model)
{
    static const char *const names[] = {"one", NULL};
    (void)model;
    return (struct demo){.name = "model",
                         .views = names,
                         .arena_bytes = 4096,
                         .arena_bytes_32 = 5096,
                         .vertex_max = 1000,
                         .triangle_max = 9,
                         .init = init,
                         .frame = frame};
}

uint32_t model_blend_triangles(const struct model *model, uint32_t width)
{
    (void)model;
    blend_width = width;
    return 7;
}

uint64_t runner_whole_bytes(const struct runner_config *config)
{
    planned = *config;
    planned_demo = *config->demo;
    return 123456789012;
}

static const struct board *board;

static struct asset *bare_asset(bool moves)
{
    struct asset *const asset = made_asset(moves);
    asset->is_bare = true;
    asset->listed = 0;
    board = board_find("pico-display");
    view_count = most_at = fails_at = 0;
    return asset;
}

/* 64 sides, and 16 from near and 16 from afar, each a part of a turn. */
static void it_is_looked_at_from_all_sides_near_and_far(void **state)
{
    (void)state;
    struct asset *const asset = bare_asset(false);
    assert_int_equal(asset_measure(asset, board), 0);
    assert_int_equal(view_count, 64 + 16 + 16);
    for (uint32_t i = 0; i < view_count; i++) {
        assert_int_equal(views[i].orbit, i < 64 ? i << 26 : (i - 64) % 16 << 28);
        assert_int_equal(views[i].dolly, i < 64 ? 0 : i < 80 ? -FX_HALF : FX_HALF);
        assert_int_equal(views[i].frame, 0);
    }
    assert_int_equal(blend_width, 240);
}

/* At 30 frames a second: 90 of the clip's 3 s. The turntable turns 1/256 a frame, which the orbit adds. */
static void what_moves_is_seen_at_other_moments_from_each_side(void **state)
{
    (void)state;
    struct asset *const asset = bare_asset(true);
    assert_int_equal(asset_measure(asset, board), 0);
    for (uint32_t i = 0; i < 64; i++) {
        const uint32_t moment = i * 90 / 64;
        assert_int_equal(views[i].frame, moment);
        assert_int_equal(views[i].orbit, (i << 26) + (moment << 24));
    }
    asset->model.has_camera = true; /* nothing turns */
    view_count = 0;
    assert_int_equal(asset_measure(asset, board), 0);
    assert_int_equal(views[63].frame, 88);
    assert_int_equal(views[63].orbit, 63u << 26);
    asset->model.motion->animation.clip = NULL;
    view_count = 0;
    assert_int_equal(asset_measure(asset, board), 0);
    assert_int_equal(views[63].frame, 0);
}

/* A million triangles in all, of which a mesh costs 16; but 4 sides at least. */
static void large_models_are_seen_from_fewer_sides(void **state)
{
    static const struct {
        uint32_t triangles, sides;
    } models[] = {{15625 - 4 * 16, 64}, {15626 - 4 * 16, 32}, {31250 - 4 * 16, 32}, {31251 - 4 * 16, 16},
                  {125000, 4},          {900000, 4},          {125000 - 4 * 16, 8}, {4000000, 4}};
    (void)state;
    for (size_t i = 0; i < sizeof models / sizeof models[0]; i++) {
        struct asset *const asset = bare_asset(false);
        asset->model.triangle_count = models[i].triangles;
        assert_int_equal(asset_measure(asset, board), 0);
        assert_int_equal(view_count, models[i].sides + 2 * (models[i].sides / 4));
    }
}

/* Drawn and dropped, a sixteenth more and 8, and what blends take. */
static void the_longest_list_counts(void **state)
{
    (void)state;
    for (uint32_t at = 0; at <= 96; at += 32) {
        struct asset *const asset = bare_asset(false);
        most_at = at;
        assert_int_equal(asset_measure(asset, board), 0);
        assert_int_equal(asset->listed, at == 0 ? 220 + 13 + 8 + 7 : 320 + 20 + 8 + 7);
        asset->listed = 1000;
        view_count = 0;
        assert_int_equal(asset_measure(asset, board), 0);
        assert_int_equal(asset->listed, 1000);
    }
}

static void a_scene_that_cannot_be_drawn_is_told(void **state)
{
    static const uint32_t at[] = {1, 64, 65, 80, 81, 96};
    (void)state;
    for (size_t i = 0; i < sizeof at / sizeof at[0]; i++) {
        struct stderr_capture said;
        struct asset *const asset = bare_asset(false);
        fails_at = at[i];
        stderr_capture_begin(&said);
        const int status = asset_measure(asset, board);
        stderr_capture_end(&said);
        assert_int_equal(status, COMPLAINED);
        assert_int_equal(view_count, at[i]);
        assert_string_equal(said.text, "pinhole: pico-display: the scene cannot be drawn there (-22)\n");
    }
}

static void the_first_glass_of_a_size_is_found(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < board_count; i++) {
        const uint32_t first = asset_first_glass(i);
        assert_true(first <= i);
        for (uint32_t k = 0; k <= first; k++) {
            const struct board *const a = board_list[i], *const b = board_list[k];
            const bool same = panel_width(a->panel, a->rotation) == panel_width(b->panel, b->rotation) &&
                              panel_height(a->panel, a->rotation) == panel_height(b->panel, b->rotation);
            assert_int_equal(same, k == first);
        }
    }
}

static void its_demo_asks_for_what_was_measured(void **state)
{
    (void)state;
    struct asset *const asset = made_asset(false);
    struct demo demo = asset_demo(asset);
    assert_string_equal(demo.name, "made-by_hand");
    assert_null(demo.views);
    assert_int_equal(demo.triangle_max, 77);
    assert_int_equal(demo.arena_bytes, 4096);
    assert_int_equal(demo.arena_bytes_32, 5096);
    assert_int_equal(demo.vertex_max, 1000);
    asset->is_bare = true; /* without the platter's 129 vertices */
    demo = asset_demo(asset);
    assert_int_equal(demo.arena_bytes, 256);
    assert_int_equal(demo.arena_bytes_32, 1256);
    assert_int_equal(demo.vertex_max, 871);
    asset->is_bare = false;
    asset->model.has_camera = true;
    demo = asset_demo(asset);
    assert_int_equal(demo.arena_bytes, 512);
    assert_int_equal(demo.arena_bytes_32, 1512);
    assert_int_equal(demo.vertex_max, 871);
}

static void the_plan_is_asked_for_the_boards_own_picture(void **state)
{
    (void)state;
    const struct asset *const asset = made_asset(true);
    board = board_find("pico-display");
    assert_true(asset_frame_bytes(asset, board, false) == 123456789012);
    assert_ptr_equal(planned.board, board);
    assert_int_equal(planned.rotation, board->rotation);
    assert_int_equal(planned.band_height, board->band_height);
    assert_ptr_equal(planned.depth_format, PH_DEPTH_AUTO);
    assert_int_equal(planned_demo.arena_bytes, 4096);
    assert_int_equal(planned_demo.arena_bytes_32, 5096);
    asset_frame_bytes(asset, board, true);
    assert_int_equal(planned_demo.arena_bytes, 4096 + asset_table_bytes(asset, false));
    assert_int_equal(planned_demo.arena_bytes_32, 5096 + asset_table_bytes(asset, true));
    assert_true(asset_band_bytes(board) == 123456789012);
    assert_int_equal(planned_demo.arena_bytes + planned_demo.vertex_max + planned_demo.triangle_max, 0);
    assert_ptr_equal(planned.board, board);
}

/* Four meshes, three of them moving, and two clips. */
static void tables_are_those_of_the_scene(void **state)
{
    (void)state;
    struct asset *const asset = made_asset(true);
    for (int on_32 = 0; on_32 < 2; on_32++) {
        const size_t meshes = scene_file_table_bytes(4, on_32 != 0);
        assert_int_equal(asset_table_bytes(asset, on_32 != 0), meshes + scene_motion_table_bytes(3, 2, on_32 != 0));
        asset->model.motion->animation.clip_count = 0;
        assert_int_equal(asset_table_bytes(asset, on_32 != 0), meshes + scene_motion_table_bytes(3, 0, on_32 != 0));
        assert_int_equal(asset_table_bytes(made_asset(false), on_32 != 0), meshes);
        made_asset(true);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_looked_at_from_all_sides_near_and_far),
        cmocka_unit_test(what_moves_is_seen_at_other_moments_from_each_side),
        cmocka_unit_test(large_models_are_seen_from_fewer_sides),
        cmocka_unit_test(the_longest_list_counts),
        cmocka_unit_test(a_scene_that_cannot_be_drawn_is_told),
        cmocka_unit_test(the_first_glass_of_a_size_is_found),
        cmocka_unit_test(its_demo_asks_for_what_was_measured),
        cmocka_unit_test(the_plan_is_asked_for_the_boards_own_picture),
        cmocka_unit_test(tables_are_those_of_the_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
