/* model_meshes: a scene that is made here as meshes in the unit sphere: how it is fitted, split, turned over and
 * coloured, with numbers worked out by hand. */
#include "model_meshes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define Q16(x) ((fx_t)lround((x)*65536))

static uint8_t *memory;
static const size_t memory_bytes = 4 << 20;
static struct model_shared shared;
static struct model_scene scene;
static struct model_mesh meshes[2];
static struct model_node nodes[2];
static struct model_material materials[2];
/* Their box has its middle at 3, 4, 0, from which two corners are 5 away. */
static float positions[4][3] = {{0, 0, 0}, {6, 8, 0}, {0, 4, 0}, {3, 4, 0}}, normals[4][3] = {{0, 0, 2}, {4, 3, 0}};
static float uvs[4][2] = {{0, .5f}, {40000, -40000}, {NAN, 1}}, colours[4][3];
static uint32_t triangles[2][3] = {{0, 1, 2}, {2, 1, 3}};
static const struct ph_texture texture;
static struct ph_blend blend;

static int fresh(void **state)
{
    static const float unit[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    (void)state;
    shared = (struct model_shared){.arena = {.base = memory, .size = memory_bytes}};
    memset(materials, 0, sizeof materials);
    materials[0].surface = materials[1].surface =
        (struct ph_material){.shading = PH_SHADE_GOURAUD, .colour = ph_rgb565(255, 0, 0)};
    materials[0].glow =
        (struct ph_material){.shading = PH_SHADE_UNLIT, .colour = ph_rgb565(0, 0, 255), .blend = &blend};
    blend = (struct ph_blend){.kind = PH_BLEND_ADD};
    memset(meshes, 0, sizeof meshes);
    meshes[0] =
        (struct model_mesh){.positions = positions, .triangles = triangles, .vertex_count = 3, .triangle_count = 1};
    for (int i = 0; i < 2; i++) {
        nodes[i] = (struct model_node){.parent = MODEL_NONE,
                                       .child = MODEL_NONE,
                                       .next = MODEL_NONE,
                                       .skin = MODEL_NONE,
                                       .first_mesh = (uint32_t)i,
                                       .mesh_count = 1,
                                       .is_shown = true};
        memcpy(nodes[i].m, unit, sizeof unit);
    }
    scene = (struct model_scene){.materials = materials,
                                 .meshes = meshes,
                                 .nodes = nodes,
                                 .material_count = 2,
                                 .mesh_count = 2,
                                 .node_count = 2};
    memcpy(scene.root, unit, sizeof unit);
    return 0;
}

static const struct ph_mesh *read_good(void)
{
    if (!model_meshes_read(&shared, &scene)) {
        fail_msg("%s", shared.error);
    }
    return shared.model.meshes;
}

static void expect_at(const struct ph_mesh *mesh, uint32_t i, double x, double y, double z)
{
    assert_int_equal(mesh->positions[i].x, Q16(x));
    assert_int_equal(mesh->positions[i].y, Q16(y));
    assert_int_equal(mesh->positions[i].z, Q16(z));
}

static void expect_normal(const struct ph_mesh *mesh, uint32_t i, int x, int y, int z)
{
    assert_int_equal(mesh->normals[i][0], x);
    assert_int_equal(mesh->normals[i][1], y);
    assert_int_equal(mesh->normals[i][2], z);
}

static void the_middle_of_the_box_becomes_the_origin_and_the_farthest_point_touches(void **state)
{
    (void)state;
    const struct ph_mesh *m = read_good();
    assert_int_equal(shared.model.mesh_count, 1);
    expect_at(m, 0, -.6, -.8, 0);
    expect_at(m, 1, .6, .8, 0);
    expect_at(m, 2, -.6, 0, 0);
    assert_true(m->vertex_count == 3 && m->triangle_count == 1 && shared.model.vertex_max == 3);
    assert_true(m->part_count == 1 && m->parts->first == 0 && m->parts->count == 1 && m->parts->material == 0);
    assert_false(shared.model.has_camera);
}

/* The second node stands 6 to the right: the box is 0 to 12 wide, and 8 high; 2 deep, it reaches 7.28 = sqrt 53. */
static void all_nodes_count_for_the_box(void **state)
{
    (void)state;
    nodes[0].next = 1, nodes[1].first_mesh = 0, nodes[1].m[0][3] = 6, nodes[1].m[2][3] = -2;
    const struct ph_mesh *m = read_good();
    const double scale = 1 / sqrt(53);
    assert_int_equal(shared.model.mesh_count, 2);
    expect_at(m, 0, -6 * scale, -4 * scale, scale);
    expect_at(m + 1, 1, 6 * scale, 4 * scale, -scale);
    assert_int_equal(shared.model.triangle_count, 2);
}

static void without_normals_each_triangle_is_flat(void **state)
{
    (void)state;
    positions[3][2] = 5;
    meshes[0].vertex_count = 4, meshes[0].triangle_count = 2;
    const struct ph_mesh *m = read_good();
    assert_true(m->vertex_count == 6 && m->triangle_count == 2);
    for (uint32_t i = 0; i < 6; i++) {
        assert_int_equal(m->triangles[i / 3][i % 3], i);
    }
    expect_normal(m, 0, 0, 0, 16384); /* 6, 8, 0 x 0, 4, 0 */
    /* 6, 4, 0 x 3, 0, 5 = 20, -30, -12, of which 1444 is the square of the length 38 */
    for (uint32_t i = 3; i < 6; i++) {
        expect_normal(m, i, (int)lround(16384 * 20 / 38.), (int)lround(16384 * -30 / 38.),
                      (int)lround(16384 * -12 / 38.));
    }
    positions[3][2] = 0;
}

static void normals_of_the_file_have_length_one(void **state)
{
    (void)state;
    meshes[0].normals = normals;
    const struct ph_mesh *m = read_good();
    expect_normal(m, 0, 0, 0, 16384);
    expect_normal(m, 1, 13107, 9830, 0);
    expect_normal(m, 2, 0, 0, 0);
    assert_true(m->triangles[0][0] == 0 && m->triangles[0][1] == 1 && m->triangles[0][2] == 2);
}

/* Mirrored along x, the triangle is turned over, so that it looks outwards again. */
static void what_a_node_mirrors_is_turned_over(void **state)
{
    (void)state;
    nodes[0].m[0][0] = -1;
    meshes[0].normals = normals;
    const struct ph_mesh *m = read_good();
    expect_at(m, 0, .6, -.8, 0);
    assert_true(m->triangles[0][0] == 2 && m->triangles[0][1] == 1 && m->triangles[0][2] == 0);
    expect_normal(m, 0, 0, 0, 16384);
    expect_normal(m, 1, -13107, 9830, 0);
    fresh(NULL);
    nodes[0].m[0][0] = -1;
    m = read_good();
    assert_true(m->triangles[0][0] == 2 && m->triangles[0][2] == 0);
    expect_normal(m, 0, 0, 0, 16384);
}

static void flat_meshes_are_split_at_21845_triangles(void **state)
{
    uint32_t(*many)[3] = malloc(21846 * sizeof *many);
    (void)state;
    assert_non_null(many);
    for (uint32_t t = 0; t < 21846; t++) {
        memcpy(many[t], triangles[t == 21845], sizeof *many);
    }
    meshes[0].triangles = many, meshes[0].triangle_count = 21845, meshes[0].vertex_count = 4;
    assert_int_equal(read_good()->vertex_count, 65535);
    assert_int_equal(shared.model.mesh_count, 1);
    shared = (struct model_shared){.arena = {.base = memory, .size = memory_bytes}};
    meshes[0].triangle_count = 21846;
    const struct ph_mesh *m = read_good();
    assert_int_equal(shared.model.mesh_count, 2);
    assert_true(m[0].vertex_count == 65535 && m[0].triangle_count == 21845 && m[1].vertex_count == 3);
    expect_at(&m[1], 2, 0, 0, 0); /* vertex 3 */
    assert_true(shared.model.vertex_max == 65535 && shared.model.triangle_count == 21846);
    free(many);
}

static void colours_of_vertices_stay_where_they_differ_from_the_material(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        memcpy(colours[i], (float[3]){1, 0, 0}, sizeof colours[i]);
    }
    meshes[0].colours = colours;
    assert_null(read_good()->colours);
    fresh(NULL);
    meshes[0].colours = colours;
    colours[2][1] = .5f;
    const struct ph_mesh *m = read_good();
    assert_int_equal(m->colours[0], ph_rgb565(255, 0, 0));
    assert_int_equal(m->colours[2], ph_rgb565(255, 128, 0));
    fresh(NULL);
    meshes[0].colours = colours;
    meshes[0].uvs = uvs;
    materials[0].surface.texture = &texture;
    assert_null(read_good()->colours);
    assert_string_equal(shared.note, "vertex colours of textured meshes that are not opaque are ignored");
}

/* The mesh once more, with its vertices' colours, which are multiplied; white ones change nothing. */
static void colours_of_vertices_are_drawn_over_a_texture(void **state)
{
    (void)state;
    for (int white = 0; white < 2; white++) {
        fresh(NULL);
        for (int i = 0; i < 3; i++) {
            memcpy(colours[i], (float[3]){1, white || i > 0 ? 1 : .5f, 1}, sizeof colours[i]);
        }
        meshes[0].colours = colours;
        meshes[0].uvs = uvs;
        materials[0].surface.texture = &texture;
        materials[0].tint = (struct ph_material){.shading = PH_SHADE_UNLIT, .colour = 0xffff, .depth_bias = 8};
        materials[0].can_tint = true;
        const struct ph_mesh *m = read_good();
        assert_true(m[0].materials->texture == &texture && m[0].colours == NULL);
        assert_int_equal(shared.model.mesh_count, white ? 1 : 2);
        if (!white) {
            assert_int_equal(m[1].materials->depth_bias, 8);
            assert_true(m[1].triangle_count == m[0].triangle_count && m[1].uvs == NULL);
            assert_memory_equal(m[1].positions, m[0].positions, sizeof *m->positions * m->vertex_count);
            assert_int_equal(m[1].colours[0], ph_rgb565(255, 128, 255));
            assert_int_equal(m[1].colours[2], 0xffff);
        }
        assert_string_equal(shared.note, "");
    }
    materials[0].can_tint = false;
}

static void a_texture_needs_coordinates(void **state)
{
    (void)state;
    materials[0].surface.texture = &texture;
    shared.texture = &texture;
    const struct ph_mesh *m = read_good();
    assert_true(m->materials->texture == NULL && m->uvs == NULL && m->materials->shading == PH_SHADE_GOURAUD);
    assert_string_equal(shared.note, "what has no texture coordinates keeps its colour");
    fresh(NULL);
    materials[0].surface.texture = &texture;
    meshes[0].uvs = uvs;
    m = read_good();
    assert_true(m->materials->texture == &texture && m->materials->shading == PH_SHADE_TEXTURE_GOURAUD);
    assert_true(m->uvs[0][0] == 0 && m->uvs[0][1] == 32768);
    assert_true(m->uvs[1][0] == FX_MAX && m->uvs[1][1] == FX_MIN && m->uvs[2][0] == 0 && m->uvs[2][1] == 65536);
    assert_string_equal(shared.note, "");
    fresh(NULL);
    materials[0].surface.texture = &texture;
    materials[0].surface.shading = PH_SHADE_UNLIT;
    meshes[0].uvs = uvs;
    assert_ptr_equal(read_good()->materials->shading, PH_SHADE_TEXTURE);
    fresh(NULL);
    meshes[0].uvs = uvs;
    assert_null(read_good()->uvs);
}

static void alphas_need_coordinates_and_a_blend_does_not(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        fresh(NULL);
        materials[0].surface.blend = &blend;
        blend = (struct ph_blend){.kind = PH_BLEND_ALPHA, .alphas = i == 0 ? NULL : &texture};
        meshes[0].uvs = i == 2 ? uvs : NULL;
        const struct ph_mesh *m = read_good();
        assert_ptr_equal(m->materials->blend, i == 1 ? NULL : &blend);
        assert_int_equal(m->uvs != NULL, i == 2);
    }
}

static void a_glow_is_a_mesh_of_its_own_without_colours(void **state)
{
    (void)state;
    materials[0].glows = true;
    meshes[0].colours = colours;
    colours[0][2] = 1;
    const struct ph_mesh *m = read_good();
    assert_true(shared.model.mesh_count == 2 && shared.model.triangle_count == 2);
    assert_true(m[0].materials->shading == PH_SHADE_GOURAUD && m[0].colours != NULL);
    assert_true(m[1].materials->shading == PH_SHADE_UNLIT && m[1].colours == NULL);
    expect_at(&m[1], 1, .6, .8, 0);
}

static void each_mesh_has_the_material_that_it_names(void **state)
{
    (void)state;
    meshes[1] = meshes[0];
    meshes[1].material = 1;
    materials[1].surface.colour = 7;
    nodes[0].mesh_count = 2;
    const struct ph_mesh *m = read_good();
    assert_true(shared.model.mesh_count == 2 && m[0].materials->colour != 7 && m[1].materials->colour == 7);
}

static void refuse(const char *reason)
{
    assert_false(model_meshes_read(&shared, &scene));
    assert_string_equal(shared.error, reason);
    fresh(NULL);
}

static void what_cannot_be_a_model_is_told(void **state)
{
    static const char no_numbers[] = "has coordinates that are no numbers, or all points in one place";
    static const float odd[3] = {NAN, INFINITY, -INFINITY};
    static float same[3][3] = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, line[3][3] = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
    (void)state;
    for (int i = 0; i < 9; i++) {
        positions[i / 3][1] = odd[i % 3];
        refuse(no_numbers);
        positions[i / 3][1] = i / 3 == 0 ? 0 : i / 3 == 1 ? 8 : 4;
    }
    meshes[0].positions = same;
    refuse(no_numbers);
    meshes[0].positions = line;
    refuse("has no triangle with an area");
    meshes[0].triangle_count = 0;
    refuse("has no triangles");
    nodes[0].mesh_count = 0;
    refuse(no_numbers);
    float(*const many)[3] = calloc(65536, sizeof *many);
    assert_non_null(many);
    memcpy(many, positions, sizeof positions);
    meshes[0].positions = meshes[0].normals = many, meshes[0].vertex_count = 65536;
    refuse("is broken: a mesh of 65536 vertices");
    meshes[0].positions = meshes[0].normals = many, meshes[0].vertex_count = 65535;
    assert_int_equal(read_good()->vertex_count, 65535);
    free(many);
    fresh(NULL);
    read_good();
    const size_t used = shared.arena.used;
    for (size_t size = 0; size < used; size += 8) {
        fresh(NULL);
        shared.arena.size = size;
        refuse("needs too much memory");
    }
}

static int begin(void **state)
{
    (void)state;
    memory = malloc(memory_bytes);
    return memory == NULL;
}

static int end(void **state)
{
    (void)state;
    free(memory);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(the_middle_of_the_box_becomes_the_origin_and_the_farthest_point_touches, fresh),
        cmocka_unit_test_setup(all_nodes_count_for_the_box, fresh),
        cmocka_unit_test_setup(without_normals_each_triangle_is_flat, fresh),
        cmocka_unit_test_setup(normals_of_the_file_have_length_one, fresh),
        cmocka_unit_test_setup(what_a_node_mirrors_is_turned_over, fresh),
        cmocka_unit_test_setup(flat_meshes_are_split_at_21845_triangles, fresh),
        cmocka_unit_test_setup(colours_of_vertices_stay_where_they_differ_from_the_material, fresh),
        cmocka_unit_test_setup(colours_of_vertices_are_drawn_over_a_texture, fresh),
        cmocka_unit_test_setup(a_texture_needs_coordinates, fresh),
        cmocka_unit_test_setup(alphas_need_coordinates_and_a_blend_does_not, fresh),
        cmocka_unit_test_setup(a_glow_is_a_mesh_of_its_own_without_colours, fresh),
        cmocka_unit_test_setup(each_mesh_has_the_material_that_it_names, fresh),
        cmocka_unit_test_setup(what_cannot_be_a_model_is_told, fresh),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
