/* asset_write_motion: the numbers of rig, skins, targets and clips in the C file are those of the model. */
#define _XOPEN_SOURCE 700 /* open_memstream */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "asset_write.h"
#include "c_text.h"
#include "made_asset.h"

#include <stdlib.h>
#include <string.h>

static char *text;

static void write_motion(const struct model *model)
{
    size_t n;
    free(text);
    FILE *const file = open_memstream(&text, &n);
    assert_non_null(file);
    asset_write_motion(file, model);
    fclose(file);
}

static int drop(void **state)
{
    (void)state;
    free(text);
    text = NULL;
    return 0;
}

static void expect(const char *part)
{
    if (strstr(text, part) == NULL) {
        fail_msg("no \"%s\" in:\n%s", part, text);
    }
}

/* parent, {rotation w x y z, translation, scale} of three nodes; a 0 before the weights, of which there may be none. */
static void the_rig_is_its_nodes_and_weights(void **state)
{
    (void)state;
    static const int32_t one = 1 << 30, size = 1 << 24,
                         nodes[] = {-1, one, 0, 0, 0, 100, 200, -300, size, size,     size,
                                    0,  one, 0, 0, 0, 101, 201, -301, size, size - 1, size + 1,
                                    1,  one, 0, 0, 0, 102, 202, -302, size, size - 2, size + 2},
                         weights[] = {0, 1000, 300, -400};
    const struct model *const model = &made_asset(true)->model;
    ((struct ph_rig_node *)(uintptr_t)model->motion->animation.rig.nodes)[0].rest.r = (struct fx_quat){one, 5, 6, 7};
    int32_t turned[33];
    memcpy(turned, nodes, sizeof turned);
    turned[2] = 5;
    turned[3] = 6;
    turned[4] = 7;
    write_motion(model);
    c_text_expect_i32(text, "nodes", turned, 33);
    c_text_expect_i32(text, "rest_weights", weights, 4);
    expect("\n    {-1, {{1073741824, 5, 6, 7}, {100, 200, -300}, {16777216, 16777216, 16777216}}},\n    {0, {{");
    expect("animation = {\n    .rig = {nodes, 3},\n    .root = {{{1073741824, 0, 0}, {0, 1073741824, 0}, {0, 0, "
           "1073741824}}, {-9, -8, 9}},\n    .clip = &clips[1],\n    .clips = clips,\n"
           "    .clip_count = 2,\n    .cross_fade = 12345,\n    .meshes = moving,\n    .mesh_count = 3,\n"
           "    .weight_count = 3,\n    .rest_weights = rest_weights,\n};\n");
    model->motion->animation.in_turn = true;
    write_motion(model);
    expect("    .cross_fade = 12345,\n    .in_turn = true,\n    .meshes = moving,\n");
}

static void skins_are_written_once(void **state)
{
    (void)state;
    static const uint16_t joints[] = {1, 2, 0};
    static const int32_t one = 1 << 30,
                         binds[] = {one, 0, 0,   0,  one, 0,   0,   0, one, 50, 51,  -50, one, 0, 0,   0,  one, 0,
                                    0,   0, one, 60, 61,  -60, one, 0, 0,   0,  one, 0,   0,   0, one, 70, 71,  -70};
    write_motion(&made_asset(true)->model);
    c_text_expect_u16(text, "joints_0", joints, 3);
    c_text_expect_u16(text, "joints_1", joints + 2, 1);
    c_text_expect_i32(text, "binds_0", binds, 36);
    expect(" binds_1[]");
    expect("joints_0[] = {\n    1, 2, 0,\n};");
    assert_null(strstr(text, "joints_2[]"));
    assert_null(strstr(text, "binds_2[]"));
}

static void vertices_are_written_with_targets_and_influences(void **state)
{
    (void)state;
    uint16_t shares[24];
    write_motion(&made_asset(true)->model);
    for (uint32_t i = 0; i < MADE_MOVING; i++) {
        static const char *const names[] = {"bound_0", "bound_1", "bound_2"};
        c_text_expect_i16(text, names[i], made_moving(i)->bound.positions[0],
                          3 * (size_t)made_moving(i)->bound.vertex_count);
    }
    for (uint16_t v = 0; v < 3; v++) {
        const uint16_t row[] = {v % 2, (v + 1) % 2, 0, 0, 20000 + v, 12768 - v, 0, 0};
        memcpy(shares + (size_t)8 * v, row, sizeof row);
    }
    c_text_expect_u16(text, "influences_0", shares, 24);
    c_text_expect_i16(text, "targets_1", made_moving(1)->morph.d_positions[0], 2 * 5 * 3);
    c_text_expect_i16(text, "target_normals_1", made_moving(1)->morph.d_normals[0], 2 * 5 * 3);
    c_text_expect_i16(text, "targets_2", made_moving(2)->morph.d_positions[0], 3 * 3);
    static const char *const none[] = {"influences_1", "influences_2", "targets_0", "target_normals_0",
                                       "target_normals_2"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        assert_null(strstr(text, none[i]));
    }
}

static void meshes_name_their_arrays(void **state)
{
    (void)state;
    write_motion(&made_asset(true)->model);
    expect("moving[] = {\n    {.mesh = 0, .bound = {.positions = bound_0, .normals = normals_0, .influences = "
           "influences_0, .vertex_count = 3, .frac = 14},\n     .skin = {joints_0, binds_0, 3}},\n    {.mesh = 2, "
           ".bound = {.positions = bound_1, .normals = normals_2, .vertex_count = 5, .frac = 15},\n     .skin = "
           "{joints_1, binds_1, 1},\n     .morph = {.positions = bound_1, .normals = normals_2, .d_positions = "
           "targets_1, .vertex_count = 5,\n               .target_count = 2, .d_normals = target_normals_1},\n     "
           ".first_weight = 1},\n    {.mesh = 3, ");
    expect("     .skin = {joints_0, binds_0, 3},\n     .morph = {.positions = bound_2, .normals = normals_3, "
           ".d_positions = targets_2, .vertex_count = 3,\n               .target_count = 1},\n     .first_weight = "
           "0},\n};\n");
}

static void clips_are_their_tracks_and_keys(void **state)
{
    (void)state;
    const struct model *const model = &made_asset(true)->model;
    const struct ph_clip *const clips = model->motion->animation.clips;
    write_motion(model);
    for (unsigned c = 0; c < MADE_CLIPS; c++) {
        for (unsigned i = 0; i < clips[c].track_count; i++) {
            const struct ph_track *const t = &clips[c].tracks[i];
            const size_t n = t->key_count, numbers = n * t->width * (t->interpolation == PH_KEYS_CUBIC ? 3 : 1);
            char name[40], row[100];
            const unsigned first = c == 1 && i == 1 ? 0 : i; /* two tracks of the walk share theirs */
            snprintf(name, sizeof name, "times_%u_%u", c, first);
            c_text_expect_i32(text, name, t->times, n);
            snprintf(name, sizeof name, "keys_%u_%u", c, i);
            c_text_expect_i16(text, name, t->keys, numbers);
            snprintf(row, sizeof row, "    {%u, %u, %u, %u, %u, %u, times_%u_%u, keys_%u_%u},\n", t->node, t->path,
                     t->interpolation, t->width, t->frac, (unsigned)n, c, first, c, i);
            expect(row);
        }
    }
    assert_null(strstr(text, "times_1_1[]"));
    expect(" keys_1_0[] = {\n    464, 471, 478, 485, 492, 499,\n};");
    expect(" tracks_0[] = {\n    {");
    expect(" tracks_1[] = {\n    {");
    expect("clips[] = {\n    {\"stand\", tracks_0, 1, 32768},\n    {\"walk _2_3_\", tracks_1, 3, 196608},\n};\n");
}

static void names_keep_letters_digits_space_and_minus(void **state)
{
    (void)state;
    const struct model *const model = &made_asset(true)->model;
    ((struct ph_clip *)(uintptr_t)model->motion->animation.clips)[0].name = "azAZ09 -_@[`{/:\\\"\n\x80";
    write_motion(model);
    expect("    {\"azAZ09 -___________\", tracks_0,");
}

/* C has no empty arrays. */
static void a_clip_without_tracks_has_a_row_of_zeros(void **state)
{
    (void)state;
    const struct model *const model = &made_asset(true)->model;
    struct model_motion *const m = model->motion;
    ((struct ph_clip *)(uintptr_t)m->animation.clips)[0].track_count = 0;
    write_motion(model);
    expect("tracks_0[] = {\n    {0}};\n");
    m->animation.clip = NULL;
    m->animation.clip_count = 0;
    write_motion(model);
    assert_null(strstr(text, "clips"));
    assert_null(strstr(text, ".clip"));
    expect("{-9, -8, 9}},\n    .meshes = moving,\n");
}

static void the_outline_is_written_where_there_is_one(void **state)
{
    (void)state;
    static const struct fx_vec3 outline[] = {{1, -2, 3}, {-400000, 500000, -600000}};
    static const int32_t numbers[] = {1, -2, 3, -400000, 500000, -600000};
    const struct model *const model = &made_asset(true)->model;
    write_motion(model);
    assert_null(strstr(text, "outline"));
    model->motion->animation.outline = outline;
    model->motion->animation.outline_count = 2;
    write_motion(model);
    c_text_expect_i32(text, "outline", numbers, 6);
    expect("\nstatic const struct fx_vec3 outline[] = {\n");
    expect("    .weight_count = 3,\n    .outline = outline,\n    .outline_count = 2,\n    .rest_weights = ");
}

/* Of three meshes that move the second has it. */
static void a_mesh_says_that_its_joints_scale_axes(void **state)
{
    (void)state;
    const struct model *const model = &made_asset(true)->model;
    write_motion(model);
    assert_null(strstr(text, "scales_axes"));
    ((struct animation_mesh *)(uintptr_t)model->motion->animation.meshes)[1].bound.scales_axes = true;
    write_motion(model);
    expect("    {.mesh = 2, .bound = {.positions = bound_1, .normals = normals_2, .scales_axes = true, "
           ".vertex_count = 5, .frac = 15},\n");
    assert_null(strstr(strstr(text, "scales_axes") + 1, "scales_axes"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(the_rig_is_its_nodes_and_weights, drop),
        cmocka_unit_test_teardown(the_outline_is_written_where_there_is_one, drop),
        cmocka_unit_test_teardown(a_mesh_says_that_its_joints_scale_axes, drop),
        cmocka_unit_test_teardown(skins_are_written_once, drop),
        cmocka_unit_test_teardown(vertices_are_written_with_targets_and_influences, drop),
        cmocka_unit_test_teardown(meshes_name_their_arrays, drop),
        cmocka_unit_test_teardown(clips_are_their_tracks_and_keys, drop),
        cmocka_unit_test_teardown(names_keep_letters_digits_space_and_minus, drop),
        cmocka_unit_test_teardown(a_clip_without_tracks_has_a_row_of_zeros, drop),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
