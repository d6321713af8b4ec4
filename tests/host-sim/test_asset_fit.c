/*
 * asset_fit on models that are made up: a function says what so many triangles take, and asset_make() gives as many as
 * it is asked for. So the largest number that fits is known by looking at all of them. (test_asset has real models.)
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "../../host-sim/asset/asset_fit.c" /* NOLINT(bugprone-suspicious-include) */

#include "boards.h"
#include "boards_all.h"
#include "stderr_capture.h"

#include <stdlib.h>

/* ---- assets that are made up ------------------------------------------------------------------------------------- */

static struct {
    uint64_t (*takes)(uint32_t triangles); /* bytes of flash, and of the board's memory beside PLATTER */
    uint32_t fewest;                       /* to which it can be simplified */
    uint64_t texels;                       /* bytes of textures of the longest side 256 */
    uint32_t made, measured, held;         /* calls; assets that were not given back */
    bool fails;
} made_up;

#define PLATTER 3000 /* bytes of memory that the turntable takes */
#define BANDS   5000 /* .. and the bands */

int asset_make(struct asset *asset, const struct model *model, const struct asset_limits *limits)
{
    uint32_t n = model->triangle_count < limits->triangles ? model->triangle_count : limits->triangles;
    n = n > made_up.fewest ? n : made_up.fewest;
    made_up.made++;
    made_up.held++;
    *asset = (struct asset){.model = *model,
                            .memory = &made_up,
                            .is_bare = limits->is_bare,
                            .triangles_read = model->triangle_count,
                            .is_simplified = n < model->triangle_count,
                            .error = .0124};
    asset->model.triangle_count = n;
    return made_up.fails ? COMPLAINED : 0;
}

void asset_free(struct asset *asset)
{
    made_up.held -= asset->memory != NULL;
    asset->memory = NULL;
}

int asset_measure(struct asset *asset, const struct board *board)
{
    (void)asset, (void)board;
    made_up.measured++;
    return 0;
}

uint32_t asset_first_glass(uint32_t board)
{
    return board - board % 4; /* four in a row are alike */
}

uint64_t asset_texture_bytes(const struct asset *asset, uint8_t log2_max)
{
    (void)asset;
    return made_up.texels >> 2 * (8 - log2_max);
}

struct asset_sizes asset_sizes(const struct asset *asset)
{
    (void)asset;
    return (struct asset_sizes){.textures = made_up.texels};
}

uint64_t asset_flash_bytes(const struct asset *asset)
{
    return made_up.takes(asset->model.triangle_count) + made_up.texels;
}

uint64_t asset_band_bytes(const struct board *board)
{
    (void)board;
    return BANDS;
}

uint64_t asset_frame_bytes(const struct asset *asset, const struct board *board, bool is_binary)
{
    assert_true(board != NULL && is_binary);
    return BANDS + made_up.takes(asset->model.triangle_count) + (asset->is_bare ? 0 : PLATTER);
}

static uint64_t straight(uint32_t n)
{
    return 40ULL * n;
}

static uint64_t with_tables(uint32_t n)
{
    return 30000 + 40ULL * n;
}

static uint64_t square(uint32_t n)
{
    return (uint64_t)n * n / 100;
}

static uint64_t steps(uint32_t n)
{
    return 9000 * ((uint64_t)n / 200 + 1);
}

/* ---- goals ------------------------------------------------------------------------------------------------------- */

static struct model model;
static struct board board;
static struct stderr_capture said;

static int fresh(void **state)
{
    (void)state;
    memset(&made_up, 0, sizeof made_up);
    made_up.takes = straight;
    model = (struct model){.triangle_count = 5000};
    board = board_pico_display;
    return 0;
}

static struct asset_goal goal_of(uint32_t flash_bytes)
{
    return (struct asset_goal){.model = "m.obj",
                               .board = &board,
                               .triangles = UINT32_MAX,
                               .fit = true,
                               .texture_log2 = 8,
                               .flash_bytes = flash_bytes};
}

/* For a goal of flash alone the board has plenty. */
static void give_plenty(void)
{
    board.scene_bytes = 100000000;
}

static int fit(struct asset *asset, const struct asset_goal *goal)
{
    stderr_capture_begin(&said);
    const int status = asset_fit(asset, &model, goal);
    stderr_capture_end(&said);
    return status;
}

/* ---- the tests --------------------------------------------------------------------------------------------------- */

static void what_fits_stays_whole_and_nothing_is_said(void **state)
{
    (void)state;
    struct asset asset;
    give_plenty();
    const struct asset_goal goal = goal_of(5000 * 40);
    assert_int_equal(fit(&asset, &goal), 0);
    assert_int_equal(asset.model.triangle_count, 5000);
    assert_false(asset.is_bare);
    assert_int_equal(made_up.made, 1);
    assert_string_equal(said.text, "");
    asset_free(&asset);
}

/* The most triangles of n that take no more than these bytes. */
static uint32_t most_of(uint32_t n, uint64_t bytes)
{
    while (n > 0 && made_up.takes(n) > bytes) {
        n--;
    }
    return n;
}

static void expect_near_the_most(uint32_t flash_bytes)
{
    struct asset asset;
    const struct asset_goal goal = goal_of(flash_bytes);
    const uint32_t most = most_of(5000, flash_bytes - made_up.texels);
    made_up.made = 0;
    assert_int_equal(fit(&asset, &goal), 0);
    assert_in_range(asset.model.triangle_count, most - most / 32 - 1, most);
    assert_in_range(made_up.made, 2, 14);
    char line[200];
    snprintf(line, sizeof line,
             "m.obj: %u of its 5000 triangles have room on pico-display; it was simplified, its surface moved by about "
             "1.2 %% of its radius\n",
             (unsigned)asset.model.triangle_count);
    assert_non_null(strstr(said.text, line));
    asset_free(&asset);
    assert_int_equal(made_up.held, 0);
}

static void the_most_triangles_that_fit_are_found_to_one_in_32(void **state)
{
    (void)state;
    static uint64_t (*const takes[])(uint32_t) = {straight, with_tables, square, steps};
    give_plenty();
    for (size_t i = 0; i < sizeof takes / sizeof takes[0]; i++) {
        made_up.takes = takes[i];
        const uint32_t whole = (uint32_t)takes[i](5000), least = (uint32_t)takes[i](700);
        for (uint32_t bytes = least; bytes < whole - 1; bytes += (whole - least) / 23) {
            expect_near_the_most(bytes);
        }
    }
}

static void textures_are_counted_beside_the_triangles(void **state)
{
    (void)state;
    give_plenty();
    made_up.texels = 60000;
    for (uint32_t bytes = 90000; bytes < 250000; bytes += 16000) {
        expect_near_the_most(bytes);
    }
}

static void the_boards_memory_is_counted_as_well(void **state)
{
    (void)state;
    struct asset asset;
    const struct asset_goal goal = goal_of(UINT32_MAX);
    board.scene_bytes = 70000;
    assert_int_equal(fit(&asset, &goal), 0);
    const uint32_t most = (70000 - BANDS - PLATTER) / 40;
    assert_in_range(asset.model.triangle_count, most - most / 32 - 1, most);
    asset_free(&asset);
}

/* Below 400 triangles the platter costs more than it is worth; without it there is room for 75 more. */
static void small_models_go_without_a_platter(void **state)
{
    (void)state;
    struct asset asset;
    const struct asset_goal goal = goal_of(UINT32_MAX);
    for (uint32_t most = 370; most <= 430; most += 60) {
        board.scene_bytes = BANDS + PLATTER + 40 * most;
        assert_int_equal(fit(&asset, &goal), 0);
        const bool is_bare = most < 400;
        const uint32_t bare = most + (is_bare ? PLATTER / 40 : 0);
        assert_int_equal(asset.is_bare, is_bare);
        assert_in_range(asset.model.triangle_count, bare - bare / 32 - 1, bare);
        assert_int_equal(strstr(said.text, "pico-display, without a platter; ") != NULL, is_bare);
        asset_free(&asset);
    }
    model.has_camera = true; /* it is on no platter */
    board.scene_bytes = BANDS + PLATTER + 40 * 370;
    assert_int_equal(fit(&asset, &goal), 0);
    assert_false(asset.is_bare);
    asset_free(&asset);
    assert_int_equal(made_up.held, 0);
}

static void what_cannot_become_so_small_is_refused(void **state)
{
    (void)state;
    struct asset asset;
    give_plenty();
    made_up.fewest = 3000;
    const struct asset_goal goal = goal_of(2900 * 40);
    assert_int_equal(fit(&asset, &goal), COMPLAINED);
    assert_non_null(strstr(said.text, "m.obj: its 3000 triangles take 120000 bytes, and the flash has 116000 for them; "
                                      "it cannot be simplified so far"));
    assert_in_range(made_up.made, 2, 12); /* it gives up */
    asset_free(&asset);
}

static void a_model_that_must_stay_whole_is_refused_with_what_would_fit(void **state)
{
    (void)state;
    struct asset asset;
    give_plenty();
    struct asset_goal goal = goal_of(2000 * 40);
    goal.fit = false;
    assert_int_equal(fit(&asset, &goal), COMPLAINED);
    static const char begin[] = "m.obj: its 5000 triangles take 200000 bytes, and the flash has 80000 for them; ";
    const char *const told = strstr(said.text, begin);
    assert_non_null(told);
    assert_in_range(strtoul(told + strlen(begin), NULL, 10), 2000 - 2000 / 32, 2000);
    assert_non_null(strstr(told, " fit: --max-triangles fit (make: SCENE_TRIANGLES=fit)"));
    assert_int_equal(made_up.held, 1);
    asset_free(&asset);
    board.scene_bytes = 100000;
    goal = goal_of(UINT32_MAX);
    goal.fit = false;
    assert_int_equal(fit(&asset, &goal), COMPLAINED);
    assert_non_null(
        strstr(said.text, "m.obj: its 5000 triangles need 208000 bytes of memory, and pico-display has 100000; "));
    asset_free(&asset);
}

/* A side of half the length is a quarter of the bytes. */
static void textures_that_are_too_large_are_refused_with_the_size_that_fits(void **state)
{
    (void)state;
    static const struct {
        uint64_t texels;
        const char *size;
    } textures[] = {{100000, "--texture-size 128 has"},
                    {200000, "--texture-size 128 has"},
                    {200004, "--texture-size 64 has"},
                    {100000000000, "--texture-size 1 has"}};
    give_plenty();
    for (size_t i = 0; i < sizeof textures / sizeof textures[0]; i++) {
        struct asset asset;
        struct asset_goal goal = goal_of(100000);
        made_up.texels = textures[i].texels;
        goal.fit = false;
        assert_int_equal(fit(&asset, &goal), COMPLAINED);
        assert_non_null(strstr(said.text, textures[i].size));
        asset_free(&asset);
    }
}

static void as_many_triangles_as_asked_for_are_made_and_no_more_are_taken(void **state)
{
    (void)state;
    struct asset asset;
    give_plenty();
    struct asset_goal goal = goal_of(UINT32_MAX);
    goal.fit = false;
    goal.triangles = 1234;
    assert_int_equal(fit(&asset, &goal), 0);
    assert_int_equal(asset.model.triangle_count, 1234);
    assert_string_equal(said.text, ""); /* it was asked for */
    asset_free(&asset);
    made_up.fewest = 1235;
    assert_int_equal(fit(&asset, &goal), COMPLAINED);
    assert_non_null(strstr(said.text, "m.obj: 1235 of its triangles remain, not 1234; it cannot"));
    asset_free(&asset);
}

static void without_a_board_each_size_of_glass_is_measured_once(void **state)
{
    (void)state;
    struct asset asset;
    struct asset_goal goal = goal_of(UINT32_MAX);
    goal.fit = false;
    goal.board = board_list[1];
    board.scene_bytes = 0;
    stderr_capture_begin(&said);
    assert_int_equal(asset_fit_make(&asset, &model, &goal), 0);
    assert_int_equal(made_up.measured, 1);
    asset_free(&asset);
    made_up.measured = 0;
    goal.board = NULL;
    assert_int_equal(asset_fit_make(&asset, &model, &goal), 0);
    stderr_capture_end(&said);
    assert_int_equal(made_up.measured, (board_count + 3) / 4);
    asset_free(&asset);
}

static void an_error_ends_it(void **state)
{
    (void)state;
    struct asset asset;
    const struct asset_goal goal = goal_of(1000);
    made_up.fails = true;
    assert_int_equal(fit(&asset, &goal), COMPLAINED);
    assert_int_equal(made_up.made, 1);
    assert_int_equal(made_up.measured, 0);
    asset_free(&asset);
}

static void triangles_are_named_by_a_number_or_a_word(void **state)
{
    (void)state;
    struct asset_goal goal = {.fit = false};
    assert_true(asset_triangles_named("fit", &goal) && goal.fit);
    assert_int_equal(goal.triangles, UINT32_MAX);
    assert_true(asset_triangles_named("all", &goal) && !goal.fit);
    assert_int_equal(goal.triangles, UINT32_MAX);
    assert_true(asset_triangles_named("1", &goal) && !goal.fit);
    assert_int_equal(goal.triangles, 1);
    static const char *const wrong[] = {"0", "-1", "fits", "", "12x", "99999999999"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_false(asset_triangles_named(wrong[i], &goal));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(what_fits_stays_whole_and_nothing_is_said, fresh),
        cmocka_unit_test_setup(the_most_triangles_that_fit_are_found_to_one_in_32, fresh),
        cmocka_unit_test_setup(textures_are_counted_beside_the_triangles, fresh),
        cmocka_unit_test_setup(the_boards_memory_is_counted_as_well, fresh),
        cmocka_unit_test_setup(small_models_go_without_a_platter, fresh),
        cmocka_unit_test_setup(what_cannot_become_so_small_is_refused, fresh),
        cmocka_unit_test_setup(a_model_that_must_stay_whole_is_refused_with_what_would_fit, fresh),
        cmocka_unit_test_setup(textures_that_are_too_large_are_refused_with_the_size_that_fits, fresh),
        cmocka_unit_test_setup(as_many_triangles_as_asked_for_are_made_and_no_more_are_taken, fresh),
        cmocka_unit_test_setup(without_a_board_each_size_of_glass_is_measured_once, fresh),
        cmocka_unit_test_setup(an_error_ends_it, fresh),
        cmocka_unit_test_setup(triangles_are_named_by_a_number_or_a_word, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
