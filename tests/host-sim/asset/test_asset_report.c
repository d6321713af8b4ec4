/* asset_report: bytes of flash counted by hand, and the lines of a report. Boards are measured by a function of the
 * test: the list of the board number i, the first with its glass, has 100 + i triangles, of 10 bytes each. */
#define _XOPEN_SOURCE 700 /* open_memstream */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "made_asset.h"

#include <stdlib.h>
#include <string.h>

enum { BANDS = 5000, AT_BUDGET = 1, OVER_BUDGET = 2 }; /* two boards whose frames take what there is, or 1 more */

static uint32_t measured, fails_at;

static uint32_t number_of(const struct board *board)
{
    uint32_t i = 0;
    while (board_list[i] != board) {
        i++;
    }
    return i;
}

int asset_measure(struct asset *asset, const struct board *board)
{
    assert_int_equal(asset->listed, 0);
    asset->listed = 100 + number_of(board);
    return ++measured == fails_at ? COMPLAINED : 0;
}

uint32_t asset_first_glass(uint32_t board)
{
    return board - board % 3; /* three in a row are alike */
}

uint64_t asset_frame_bytes(const struct asset *asset, const struct board *board, bool is_binary)
{
    assert_true(is_binary && board != NULL);
    return number_of(board) == AT_BUDGET || number_of(board) == OVER_BUDGET
               ? board->scene_bytes + (number_of(board) == OVER_BUDGET)
               : BANDS + 10 * (uint64_t)asset->listed;
}

uint64_t asset_band_bytes(const struct board *board)
{
    assert_non_null(board);
    return BANDS;
}

/* ---- flash ------------------------------------------------------------------------------------------------------ */

static void flash_is_counted_array_by_array(void **state)
{
    (void)state;
    struct asset *asset = made_asset(false);
    struct asset_sizes s = asset_sizes(asset);
    assert_int_equal(s.positions, 12 * (3 + 4 + 5 + 3));
    assert_int_equal(s.normals, 6 * (3 + 4 + 5 + 3));
    assert_int_equal(s.uvs, 8 * (4 + 5 + 3));
    assert_int_equal(s.colours, 2 * 3);
    assert_int_equal(s.triangles, 6 * (1 + 2 + 3 + 1));
    /* the demo; a mesh, a material and a part for each of 4; three ramps; two blends */
    assert_int_equal(s.tables, 64 + 4 * (52 + 36 + 12) + 3 * 256 + 2 * 12);
    assert_int_equal(s.textures, (8 + 2 * (16 + 4 + 1)) + (8 + 2 * 8));
    assert_int_equal(s.motion, 0);
    const uint64_t flash = 180 + 90 + 96 + 6 + 42 + 1256 + 74;
    assert_int_equal(asset_flash_bytes(asset), flash);
    asset->model.has_camera = true;
    assert_int_equal(asset_flash_bytes(asset), flash + 76);
    asset = made_asset(true);
    s = asset_sizes(asset);
    assert_int_equal(s.positions, 6 * (3 + 5 + 3) + 12 * 4);
    assert_int_equal(s.motion, asset_motion_bytes(&asset->model));
    assert_int_equal(asset_flash_bytes(asset), flash - 6 * (3 + 5 + 3) + s.motion);
}

static void smaller_textures_take_less(void **state)
{
    (void)state;
    const struct asset *const asset = made_asset(false);
    assert_int_equal(asset_texture_bytes(asset, 10), 50 + 24);
    assert_int_equal(asset_texture_bytes(asset, 2), 50 + 24);
    assert_int_equal(asset_texture_bytes(asset, 1), 8 + 2 * (4 + 1) + 8 + 2 * 4);
    assert_int_equal(asset_texture_bytes(asset, 0), 8 + 2 + 8 + 2);
    made_material(0)->texture = made_material(1)->texture; /* of three meshes now: it is there once */
    assert_int_equal(asset_texture_bytes(asset, 10), 50 + 24);
    struct ph_texture *const t = (struct ph_texture *)(uintptr_t)made_material(1)->texture;
    t->levels = 0;
    t->log2_height = 4;
    assert_int_equal(asset_texture_bytes(asset, 10), 8 + 2 * 64 + 24);
    t->levels = 4;
    assert_int_equal(asset_texture_bytes(asset, 3), 8 + 2 * (4 * 8 + 2 * 4 + 2 + 1) + 24);
}

/* ---- the report ------------------------------------------------------------------------------------------------- */

static char *text;

static int report_of(const struct asset *asset, const struct board *board)
{
    size_t n;
    free(text);
    FILE *const file = open_memstream(&text, &n);
    assert_non_null(file);
    measured = 0;
    const int status = asset_report(file, asset, board);
    fclose(file);
    return status;
}

static int drop(void **state)
{
    (void)state;
    free(text);
    text = NULL;
    return 0;
}

static void expect(const char *line)
{
    if (strstr(text, line) == NULL) {
        fail_msg("no \"%s\" in:\n%s", line, text);
    }
}

static void it_says_how_the_model_was_simplified(void **state)
{
    (void)state;
    static const char *const lines[] = {
        "\ntriangles  7 of 9: as in the file, without those that have no area\n",
        "\ntriangles  7 of 9: simplified; the surface moved by about 1.24 % of the model's radius\n"};
    struct asset *const asset = made_asset(false);
    asset->error = .0124;
    for (int i = 0; i < 2; i++) {
        asset->is_simplified = i == 1;
        assert_int_equal(report_of(asset, board_list[0]), 0);
        expect(lines[i]);
    }
    asset->is_simplified = false;
    asset->triangles_read = 7;
    report_of(asset, board_list[0]);
    expect("model      made-by_hand\ntriangles  7 of 7: as in the file\nvertices   15 of 20 (equal ones are one), 5 in "
           "the largest of 4 meshes\ncamera     turntable\n");
    assert_null(strstr(text, "rounding"));
    asset->vertices_read = 15;
    asset->fetched = .625;
    asset->fetched_read = 1.254;
    asset->is_bare = true;
    report_of(asset, board_list[0]);
    expect("\nvertices   15 of 15, 5 in the largest of 4 meshes\nreuse      0.62 vertices fetched a triangle, 1.25 "
           "before (16 at hand)\ncamera     turntable without its platter\n");
    asset->model.has_camera = true;
    report_of(asset, board_list[0]);
    expect("\ncamera     the file's\n");
}

static void it_names_the_clips_and_how_numbers_were_rounded(void **state)
{
    (void)state;
    struct asset *const asset = made_asset(true);
    asset->model.motion->rounding = (struct model_rounding){.011, .012, .013, .014, .015, .016, .017, .018};
    report_of(asset, board_list[0]);
    expect("\nmotion     3 nodes, 2 clips: stand (0.50 s), walk \"2/3\" (3.00 s) plays\n"
           "rounding   positions 0.011, morph targets 0.012, keys of translation 0.013 of the model's radius, of "
           "rotation 0.014 degrees,\n           of scale 0.015, of weights 0.016, their times 0.018 s, shares of "
           "joints 0.017, at most\n");
    asset->model.motion->animation.in_turn = true;
    report_of(asset, board_list[0]);
    expect(" clips: stand (0.50 s), walk \"2/3\" (3.00 s), in turn\n");
    asset->model.motion->animation.in_turn = false;
    asset->model.motion->animation.clip_count = 1;
    asset->model.motion->animation.clip = asset->model.motion->animation.clips;
    report_of(asset, board_list[0]);
    expect(" 1 clips: stand (0.50 s)\n"); /* which plays needs no word */
}

static void it_lists_the_bytes_of_flash(void **state)
{
    (void)state;
    report_of(made_asset(false), board_list[0]);
    expect("\nflash      positions       180 bytes\n           normals          90 bytes\n"
           "           uvs              96 bytes\n           colours           6 bytes\n"
           "           triangles        42 bytes\n           tables         1256 bytes\n"
           "           textures         74 bytes\n           motion            0 bytes\n"
           "           in all         1744 bytes\n\nboard: bytes for a frame    picture   bands  triangles    scene   "
           "in all    budget\n");
}

/* The line of a board, word by word. */
static void expect_board(const struct board *board, uint32_t listed)
{
    char name[64], picture[16], line[80];
    unsigned bands, triangles, scene, all, budget;
    snprintf(line, sizeof line, "\n%s ", board->name);
    const char *const at = strstr(text, line);
    assert_non_null(at);
    assert_int_equal(sscanf(at, " %63s %15s %u %u %u %u %u  %79[^\n]", name, picture, &bands, &triangles, &scene, &all,
                            &budget, line),
                     8);
    snprintf(name, sizeof name, "%ux%u", (unsigned)panel_width(board->panel, board->rotation),
             (unsigned)panel_height(board->panel, board->rotation));
    assert_string_equal(picture, name);
    assert_int_equal(bands, BANDS);
    assert_int_equal(triangles, listed);
    assert_int_equal(budget, board->scene_bytes);
    const uint32_t i = number_of(board);
    assert_int_equal(all, i == AT_BUDGET ? budget : i == OVER_BUDGET ? budget + 1 : BANDS + 10 * listed);
    assert_int_equal(scene, all - BANDS);
    snprintf(name, sizeof name, "%u too many", all > budget ? all - budget : 0);
    assert_string_equal(line, all <= budget ? "fits" : name);
}

static void one_board_is_measured_alone(void **state)
{
    (void)state;
    struct board board = *board_list[4];
    const struct board *const listed = board_list[4];
    assert_int_equal(report_of(made_asset(false), listed), 0);
    assert_int_equal(measured, 1);
    expect_board(listed, 104);
    assert_null(strstr(text, board_list[3]->name));
    assert_int_equal(report_of(made_asset(false), &board), 0); /* none of the list */
    assert_int_equal(measured, 0);
}

static void all_boards_are_measured_once_a_glass(void **state)
{
    (void)state;
    const struct asset *const asset = made_asset(false);
    assert_int_equal(report_of(asset, NULL), 0);
    assert_int_equal(measured, (board_count + 2) / 3);
    for (uint32_t i = 0; i < board_count; i++) {
        expect_board(board_list[i], 100 + i - i % 3);
    }
    assert_int_equal(asset->listed, 77);
}

static void an_error_ends_it(void **state)
{
    (void)state;
    fails_at = 2;
    assert_int_equal(report_of(made_asset(false), NULL), COMPLAINED);
    fails_at = 0;
    assert_int_equal(measured, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flash_is_counted_array_by_array),
        cmocka_unit_test(smaller_textures_take_less),
        cmocka_unit_test_teardown(it_says_how_the_model_was_simplified, drop),
        cmocka_unit_test_teardown(it_names_the_clips_and_how_numbers_were_rounded, drop),
        cmocka_unit_test_teardown(it_lists_the_bytes_of_flash, drop),
        cmocka_unit_test_teardown(one_board_is_measured_alone, drop),
        cmocka_unit_test_teardown(all_boards_are_measured_once_a_glass, drop),
        cmocka_unit_test_teardown(an_error_ends_it, drop),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
