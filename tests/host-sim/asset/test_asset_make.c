/* asset_make: which triangles, vertices, textures and ramps remain of a model, and what is shared. Ordering and
 * simplifying are played by the test, which sees what they are given. */
#include "asset_mesh.h"
#include "complain.h"
#include "stderr_capture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static unsigned simplified[16];
static size_t simplified_count;
static uint32_t asked_triangles; /* 0: asset_simplify was not called */
static unsigned ordered[16][16]; /* the indices of each call */
static uint32_t order_count;

/* In place of asset_order.c and asset_simplify.c. The vertices stay as they are. */
bool asset_order(struct demo_arena *arena, const struct asset_shape *shape, struct ph_mesh *to)
{
    struct fx_vec3 *const positions = demo_alloc(arena, sizeof *positions * shape->vertex_count);
    int16_t(*const normals)[3] = demo_alloc(arena, sizeof *normals * shape->vertex_count);
    assert_true(positions != NULL && normals != NULL && shape->index_count <= 16);
    memcpy(positions, shape->positions, sizeof *positions * shape->vertex_count);
    memcpy(normals, shape->normals, sizeof *normals * shape->vertex_count);
    memcpy(ordered[order_count++ % 16], shape->indices, sizeof(unsigned) * shape->index_count);
    uint16_t(*const corners)[3] = demo_alloc(arena, sizeof(uint16_t) * shape->index_count);
    assert_non_null(corners);
    for (size_t i = 0; i < shape->index_count; i++) {
        corners[i / 3][i % 3] = (uint16_t)shape->indices[i];
    }
    to->triangles = (const uint16_t(*)[3])corners;
    to->positions = positions;
    to->normals = (const int16_t(*)[3])normals;
    to->uvs = NULL;
    to->colours = NULL;
    to->vertex_count = shape->vertex_count;
    to->triangle_count = (uint32_t)(shape->index_count / 3);
    return true;
}

double asset_fetches(const struct ph_mesh *mesh)
{
    return mesh->triangle_count * 2.5;
}

int asset_simplify(const struct model *model, uint32_t triangles, struct asset_rest *rest)
{
    assert_true(model->triangle_count > triangles);
    asked_triangles = triangles;
    *rest = (struct asset_rest){
        .indices = malloc(sizeof simplified), .index_count = simplified_count, .is_simplified = true, .error = .25};
    assert_non_null(rest->indices);
    memcpy(rest->indices, simplified, sizeof simplified);
    return 0;
}

/* Mesh 0 has five vertices and three triangles, of which the second is a line; mesh 1 one triangle, mesh 2 two. */
static const struct fx_vec3 places[6] = {
    {0, 0, 0}, {FX_ONE, 0, 0}, {0, FX_ONE, 0}, {FX_ONE, 0, 0}, {FX_ONE, FX_ONE, FX_ONE / 4}, {0, 0, FX_ONE}};
static int16_t normals[6][3];
static const uint16_t triangles[3][3] = {{0, 1, 2}, {0, 1, 3}, {1, 2, 4}}, one[1][3] = {{2, 0, 1}},
                      two[2][3] = {{0, 1, 2}, {4, 2, 1}};
static uint16_t ramps[2][PH_RAMP_SIZE];
static struct ph_material materials[3];
static const struct ph_part part = {.count = 1};
static struct ph_mesh meshes[3];
static struct model model;
static struct asset_limits limits;
static struct asset asset;

static int fresh(void **state)
{
    (void)state;
    memset(ramps, 0, sizeof ramps);
    ramps[1][PH_RAMP_SIZE - 1] = 1;
    for (int m = 0; m < 3; m++) {
        materials[m] = (struct ph_material){.shading = PH_SHADE_GOURAUD, .ramp = ramps[m == 1], .colour = (uint16_t)m};
        meshes[m] = (struct ph_mesh){.positions = places,
                                     .normals = (const int16_t(*)[3])normals,
                                     .parts = &part,
                                     .part_count = 1,
                                     .materials = &materials[m],
                                     .vertex_count = m == 1 ? 3 : 5,
                                     .triangles = m == 0   ? triangles
                                                  : m == 1 ? one
                                                           : two,
                                     .triangle_count = m == 0   ? 3
                                                       : m == 1 ? 1
                                                                : 2};
    }
    for (int i = 0; i < 5; i++) {
        memcpy(normals[i], (int16_t[3]){0, 0, 16384}, sizeof normals[i]);
    }
    model = (struct model){.meshes = meshes, .mesh_count = 3, .vertex_max = 5, .triangle_count = 6};
    limits = (struct asset_limits){.triangles = UINT32_MAX, .texture_log2 = 8, .file_name = "m.obj"};
    simplified_count = order_count = asked_triangles = 0;
    return 0;
}

static int freed(void **state)
{
    (void)state;
    asset_free(&asset);
    return 0;
}

static void make(void)
{
    assert_int_equal(asset_make(&asset, &model, &limits), 0);
}

static void a_name_is_letters_digits_and_dashes(void **state)
{
    static const char *const names[][2] = {
        {"a/b.c/my model.v2.obj", "my_model_v2"},
        {"plain", "plain"},
        {".hidden", "_hidden"},
        {"AZaz09-_.glb", "AZaz09-_"},
        {"[{@`:/", ""},
        {"@[`{/:.x", "_"},
        {"0123456789012345678901234567890123456789.obj", "012345678901234567890123456789012345678"},
        {"01234567890123456789012345678901234567.obj", "01234567890123456789012345678901234567"}};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        limits.file_name = names[i][0];
        make();
        assert_string_equal(asset.name, names[i][1]);
        asset_free(&asset);
    }
}

static void triangles_with_two_corners_in_one_place_go(void **state)
{
    static const unsigned first[6] = {0, 1, 2, 1, 2, 4}, second[3] = {2, 0, 1}, third[6] = {0, 1, 2, 4, 2, 1};
    (void)state;
    make();
    assert_true(!asset.is_simplified && asset.error == 0 && asked_triangles == 0);
    assert_int_equal(order_count, 3);
    assert_memory_equal(ordered[0], first, sizeof first);
    assert_memory_equal(ordered[1], second, sizeof second);
    assert_memory_equal(ordered[2], third, sizeof third);
    assert_true(asset.triangles_read == 6 && asset.vertices_read == 13);
    assert_true(asset.model.mesh_count == 3 && asset.model.triangle_count == 5 && asset.model.vertex_max == 5);
    assert_true(asset.fetched_read == 2.5 && asset.fetched == 2.5);
    for (uint32_t m = 0; m < 3; m++) {
        const struct ph_mesh *to = &asset.model.meshes[m];
        assert_true(to->materials == &asset.materials[m] && to->materials->colour == m && to->material_count == 1);
        assert_true(to->part_count == 1 && to->parts->count == (m == 1 ? 1 : 2) && to->parts->first == 0);
        assert_non_null(to->bounds);
    }
}

static void each_way_to_have_two_corners_in_one_place_is_seen(void **state)
{
    static const uint16_t corners[5][3] = {{1, 3, 0}, {0, 1, 3}, {1, 0, 3}, {0, 1, 2}, {0, 5, 1}};
    (void)state;
    for (int i = 0; i < 5; i++) {
        fresh(NULL);
        meshes[1].triangles = &corners[i];
        meshes[1].vertex_count = 6;
        make();
        assert_int_equal(asset.model.triangle_count, i < 3 ? 4 : 5);
        asset_free(&asset);
    }
}

/* Vertices are numbered through all meshes: those of mesh 1 begin at 5, those of mesh 2 at 8. */
static void what_remains_is_sorted_into_its_meshes(void **state)
{
    static const unsigned rest[9] = {8, 9, 10, 4, 2, 1, 12, 10, 9}, first[3] = {4, 2, 1}, third[6] = {0, 1, 2, 4, 2, 1};
    (void)state;
    normals[4][0] = 1; /* not flat */
    memcpy(simplified, rest, sizeof rest);
    simplified_count = 9;
    limits.triangles = 5;
    make();
    assert_true(asked_triangles == 5 && asset.is_simplified && asset.error == .25);
    assert_true(asset.model.mesh_count == 2 && asset.model.triangle_count == 3);
    assert_memory_equal(ordered[0], first, sizeof first);
    assert_memory_equal(ordered[1], third, sizeof third);
    assert_true(asset.materials[0].colour == 0 && asset.materials[1].colour == 2);
    assert_true(asset.first_ramps[0] == 0 && asset.first_ramps[1] == 0);
}

static void a_model_that_fits_is_not_simplified(void **state)
{
    (void)state;
    limits.triangles = 6;
    make();
    assert_int_equal(asked_triangles, 0);
}

/* Where each face of the model had one normal, corners that remain have vertices of their own, with the normals
 * 0, 0, -1 and 1/4, 1/4, -1 of the new faces. */
static void flat_triangles_have_new_normals(void **state)
{
    static const unsigned rest[6] = {0, 2, 1, 1, 2, 4};
    (void)state;
    for (int is_flat = 0; is_flat < 2; is_flat++) {
        fresh(NULL);
        normals[4][0] = (int16_t)(is_flat ? 0 : 1); /* the last corner of a triangle */
        memcpy(simplified, rest, sizeof rest);
        simplified_count = 6;
        limits.triangles = 2;
        make();
        const struct ph_mesh *const to = asset.model.meshes;
        assert_int_equal(to->vertex_count, is_flat ? 6 : 5);
        for (unsigned i = 0; i < 6; i++) {
            assert_int_equal(ordered[0][i], is_flat ? i : rest[i]);
            assert_memory_equal(&to->positions[ordered[0][i]], &places[rest[i]], sizeof places[0]);
        }
        if (is_flat) {
            assert_true(to->normals[0][2] == -16384 && to->normals[0][0] == 0 && to->normals[1][0] == 0);
            assert_true(to->normals[5][0] == 3862 && to->normals[5][1] == 3862 && to->normals[5][2] == -15447);
        } else {
            assert_memory_equal(to->normals, normals, sizeof normals[0] * 5);
        }
        asset_free(&asset);
    }
}

/* tests/run.sh fills memory that nobody has set (MALLOC_PERTURB_). */
static void what_stands_still_has_bounds_and_what_moves_has_none(void **state)
{
    static const int16_t bind[3][3] = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
    static const struct animation_mesh moving = {.mesh = 1, .bound = {.positions = bind, .vertex_count = 3}};
    static struct model_motion motion = {.animation = {.meshes = &moving, .mesh_count = 1}};
    (void)state;
    model.motion = &motion;
    make();
    assert_int_equal(asset.model.mesh_count, 3);
    for (uint32_t m = 0; m < 3; m++) {
        const struct ph_mesh *const mesh = &asset.model.meshes[m];
        assert_int_equal(mesh->bounds != NULL, m != 1);
        assert_true(mesh->edges == NULL && mesh->edge_count == 0);
    }
    assert_true(asset.model.meshes[0].bounds != NULL && asset.model.meshes[0].bounds->radius > FX_HALF);
    assert_memory_equal(asset.model.motion->animation.meshes->bound.positions, bind, sizeof bind);
}

static void without_a_triangle_there_is_no_asset(void **state)
{
    struct stderr_capture said;
    (void)state;
    limits.triangles = 1;
    stderr_capture_begin(&said);
    const int status = asset_make(&asset, &model, &limits);
    stderr_capture_end(&said);
    assert_int_equal(status, COMPLAINED);
    assert_non_null(strstr(said.text, "no triangle remains of the model: too few are allowed"));
}

static void a_camera_of_the_file_is_kept_unless_it_turns(void **state)
{
    (void)state;
    for (int i = 0; i < 8; i++) {
        fresh(NULL);
        model.has_camera = (i & 1) != 0, limits.is_on_turntable = (i & 2) != 0, limits.is_bare = (i & 4) != 0;
        model.camera.lens.near_z = 77;
        make();
        assert_int_equal(asset.model.has_camera, (i & 3) == 1);
        assert_int_equal(asset.is_bare, i >= 4 && (i & 3) != 1); /* before a camera there is no platter */
        assert_int_equal(asset.model.camera.lens.near_z, 77);
        asset_free(&asset);
    }
}

/* ---- textures --------------------------------------------------------------------------------------------------- */

static uint16_t wire(unsigned red, unsigned green, unsigned blue)
{
    const uint8_t bytes[2] = {(uint8_t)(red << 3 | green >> 3), (uint8_t)(green << 5 | blue)};
    uint16_t texel;
    memcpy(&texel, bytes, sizeof texel);
    return texel;
}

static uint16_t texels[32 + 8 + 2 + 1];
static struct ph_texture texture;

/* 8 x 4 texels; each block of 2 x 2 has 1, 2, 3 and 4 of red, and green and blue of its column and row. */
static void make_texture(void)
{
    for (unsigned i = 0; i < 32; i++) {
        const unsigned x = i % 8, y = i / 8;
        texels[i] = wire(1 + x % 2 + 2 * (y % 2), 16 * (x / 2), 8 * (y / 2));
    }
    texture = (struct ph_texture){.texels = texels, .log2_width = 3, .log2_height = 2, .wrap = PH_WRAP_CLAMP};
}

/* (1 + 2 + 3 + 4) / 4 is 2.5, which is rounded up. */
static void a_texture_is_shrunk_to_its_means_once_for_all_that_have_it(void **state)
{
    (void)state;
    make_texture();
    materials[0].texture = materials[2].texture = &texture;
    limits.texture_log2 = 2;
    make();
    const struct ph_texture *const small = asset.materials[0].texture;
    assert_ptr_equal(asset.materials[2].texture, small);
    assert_null(asset.materials[1].texture);
    assert_true(small->log2_width == 2 && small->log2_height == 2 && small->levels == 0 &&
                small->wrap == PH_WRAP_CLAMP);
    for (unsigned i = 0; i < 16; i++) { /* 4 x 4: means of two texels in a row */
        const unsigned x = i % 4, y = i / 4;
        assert_int_equal(small->texels[i], wire(y % 2 == 0 ? 2 : 4, 16 * x, 8 * (y / 2)));
    }
    asset_free(&asset);
    limits.texture_log2 = 1;
    make();
    assert_true(asset.materials[0].texture->log2_width == 1 && asset.materials[0].texture->log2_height == 1);
    assert_int_equal(asset.materials[0].texture->texels[1], wire(3, 40, 0)); /* 32 and 48 of green */
    assert_int_equal(asset.materials[0].texture->texels[2], wire(3, 8, 8));
    asset_free(&asset);
    limits.texture_log2 = 2;
    texture.log2_height = 1;
    make();
    assert_true(asset.materials[0].texture->log2_width == 2 && asset.materials[0].texture->log2_height == 1);
}

static void each_level_is_the_mean_of_what_is_below_it(void **state)
{
    (void)state;
    make_texture();
    texture.filter = PH_FILTER_MIPMAP, texture.levels = 3;
    materials[0].texture = &texture;
    make();
    const struct ph_texture *const to = asset.materials[0].texture;
    assert_int_equal(to->levels, 3);
    assert_memory_equal(to->texels, texels, 32 * sizeof texels[0]);
    for (unsigned i = 0; i < 8; i++) {
        assert_int_equal(to->texels[32 + i], wire(3, 16 * (i % 4), 8 * (i / 4)));
    }
    assert_int_equal(to->texels[40], wire(3, 8, 4));
    assert_int_equal(to->texels[42], wire(3, 24, 4));
}

static void a_blend_is_shrunk_once_with_its_alphas(void **state)
{
    const struct ph_blend blends[2] = {{.kind = PH_BLEND_ALPHA, .alpha = 9, .alphas = &texture},
                                       {.kind = PH_BLEND_ADD}};
    (void)state;
    make_texture();
    materials[0].blend = materials[1].blend = &blends[0];
    materials[2].blend = &blends[1];
    limits.texture_log2 = 0;
    make();
    const struct ph_blend *const to = asset.materials[0].blend;
    assert_true(to != &blends[0] && asset.materials[1].blend == to && to->alpha == 9 && to->kind == PH_BLEND_ALPHA);
    assert_true(to->alphas->log2_width == 0 && to->alphas->texels[0] == wire(3, 24, 4));
    assert_true(asset.materials[2].blend->alphas == NULL && asset.materials[2].blend->kind == PH_BLEND_ADD);
    assert_true(asset_first_blend(&asset.model, 1) == 0 && asset_first_blend(&asset.model, 2) == 2);
}

/* Meshes 0 and 2 have one ramp; then those of 1 and 2, in two places, are equal, but for the last colour. */
static void equal_ramps_have_one_number(void **state)
{
    static uint16_t copy[PH_RAMP_SIZE];
    (void)state;
    make();
    assert_true(asset.first_ramps[0] == 0 && asset.first_ramps[1] == 1 && asset.first_ramps[2] == 0);
    asset_free(&asset);
    memcpy(copy, ramps[1], sizeof copy);
    materials[2].ramp = copy;
    make();
    assert_true(asset.first_ramps[0] == 0 && asset.first_ramps[1] == 1 && asset.first_ramps[2] == 1);
    asset_free(&asset);
    copy[PH_RAMP_SIZE - 1]++;
    make();
    assert_int_equal(asset.first_ramps[2], 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_name_is_letters_digits_and_dashes, fresh),
        cmocka_unit_test_setup_teardown(triangles_with_two_corners_in_one_place_go, fresh, freed),
        cmocka_unit_test_setup(each_way_to_have_two_corners_in_one_place_is_seen, fresh),
        cmocka_unit_test_setup_teardown(what_remains_is_sorted_into_its_meshes, fresh, freed),
        cmocka_unit_test_setup_teardown(a_model_that_fits_is_not_simplified, fresh, freed),
        cmocka_unit_test_setup(flat_triangles_have_new_normals, fresh),
        cmocka_unit_test_setup_teardown(what_stands_still_has_bounds_and_what_moves_has_none, fresh, freed),
        cmocka_unit_test_setup_teardown(without_a_triangle_there_is_no_asset, fresh, freed),
        cmocka_unit_test_setup(a_camera_of_the_file_is_kept_unless_it_turns, fresh),
        cmocka_unit_test_setup_teardown(a_texture_is_shrunk_to_its_means_once_for_all_that_have_it, fresh, freed),
        cmocka_unit_test_setup_teardown(each_level_is_the_mean_of_what_is_below_it, fresh, freed),
        cmocka_unit_test_setup_teardown(a_blend_is_shrunk_once_with_its_alphas, fresh, freed),
        cmocka_unit_test_setup_teardown(equal_ramps_have_one_number, fresh, freed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
