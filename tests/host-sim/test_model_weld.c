/* model_weld: equal vertices become one, in the order in which they come, and no mesh has too many. */
#include "model_weld.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Two triangles of a square: corners 1 and 2 of the first are corners 0 and 2 of the other. */
static const struct model_vertex square[6] = {
    {{0, 0, 0}, {0, 0, 1}, {0, 1}, {1, 0, 0}, 10}, {{1, 0, 0}, {0, 0, 1}, {1, 1}, {0, 1, 0}, 11},
    {{0, 1, 0}, {0, 0, 1}, {0, 0}, {0, 0, 1}, 12}, {{1, 0, 0}, {0, 0, 1}, {1, 1}, {0, 1, 0}, 11},
    {{1, 1, 0}, {0, 0, 1}, {1, 0}, {1, 1, 0}, 13}, {{0, 1, 0}, {0, 0, 1}, {0, 0}, {0, 0, 1}, 12}};

static void corner_of(const void *context, size_t i, struct model_vertex *to)
{
    static const struct model_vertex zero;
    assert_memory_equal(to, &zero, sizeof zero);
    *to = ((const struct model_vertex *)context)[i];
}

static struct model_triangles triangles_of(const struct model_vertex *vertices, uint32_t count)
{
    return (struct model_triangles){.count = count,
                                    .material = 3,
                                    .has_normals = true,
                                    .has_uvs = true,
                                    .has_colours = true,
                                    .corner = corner_of,
                                    .context = vertices};
}

static void free_mesh(struct model_mesh *mesh)
{
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->uvs);
    free(mesh->colours);
    free(mesh->triangles);
    free(mesh->moved.sources);
}

static void a_square_of_six_corners_has_four_vertices(void **state)
{
    static const uint32_t triangles[2][3] = {{0, 1, 2}, {1, 3, 2}}, kept[4] = {0, 1, 2, 4};
    struct model_scene scene = {0};
    float joints[1];
    (void)state;
    struct model_triangles from = triangles_of(square, 2);
    from.moved.joints = joints;
    assert_true(model_weld(&scene, &from));
    assert_int_equal(scene.mesh_count, 1);
    struct model_mesh *mesh = scene.meshes;
    assert_int_equal(mesh->material, 3);
    assert_int_equal(mesh->triangle_count, 2);
    assert_int_equal(mesh->vertex_count, 4);
    assert_memory_equal(mesh->triangles, triangles, sizeof triangles);
    assert_ptr_equal(mesh->moved.joints, joints);
    for (int i = 0; i < 4; i++) {
        const struct model_vertex *v = &square[kept[i]];
        assert_memory_equal(mesh->positions[i], v->position, sizeof v->position);
        assert_memory_equal(mesh->normals[i], v->normal, sizeof v->normal);
        assert_memory_equal(mesh->uvs[i], v->uv, sizeof v->uv);
        assert_memory_equal(mesh->colours[i], v->colour, sizeof v->colour);
        assert_int_equal(mesh->moved.sources[i], v->source);
    }
    free_mesh(mesh);
    free(scene.meshes);
}

/* Each property alone keeps two vertices apart; 0 and -0 are other bits. */
static void vertices_that_differ_in_one_property_stay_apart(void **state)
{
    (void)state;
    for (int k = 0; k < 6; k++) {
        struct model_scene scene = {0};
        struct model_vertex vertices[3] = {0};
        vertices[1].position[2] = (float)(k == 0);
        vertices[1].normal[2] = (float)(k == 1);
        vertices[1].uv[1] = (float)(k == 2);
        vertices[1].colour[2] = (float)(k == 3);
        vertices[1].source = k == 4;
        vertices[1].position[0] = k == 5 ? -0.0f : 0;
        const struct model_triangles from = triangles_of(vertices, 1);
        assert_true(model_weld(&scene, &from));
        assert_int_equal(scene.meshes->vertex_count, 2);
        assert_int_equal(scene.meshes->triangles[0][1], 1);
        assert_int_equal(scene.meshes->triangles[0][2], 0);
        free_mesh(scene.meshes);
        free(scene.meshes);
    }
}

/* Whatever the hash, so many vertices meet in a table of so few places. */
static void many_vertices_of_one_position_stay_apart(void **state)
{
    enum { COUNT = 600 };
    struct model_scene scene = {0};
    static struct model_vertex vertices[COUNT];
    (void)state;
    for (uint32_t i = 0; i < COUNT; i++) {
        vertices[i].source = i / 2;
    }
    const struct model_triangles from = triangles_of(vertices, COUNT / 3);
    assert_true(model_weld(&scene, &from));
    assert_int_equal(scene.meshes->vertex_count, COUNT / 2);
    for (uint32_t i = 0; i < COUNT; i++) {
        assert_int_equal(scene.meshes->triangles[i / 3][i % 3], i / 2);
    }
    free_mesh(scene.meshes);
    free(scene.meshes);
}

static void arrays_that_the_triangles_lack_are_not_made(void **state)
{
    (void)state;
    for (int k = 0; k < 5; k++) {
        struct model_scene scene = {0};
        struct model_triangles from = triangles_of(square, 2);
        from.has_normals = k == 0;
        from.has_uvs = k == 1;
        from.has_colours = k == 2;
        from.moved.target_count = k == 3;
        assert_true(model_weld(&scene, &from));
        const struct model_mesh *mesh = scene.meshes;
        assert_int_equal(mesh->normals != NULL, k == 0);
        assert_int_equal(mesh->uvs != NULL, k == 1);
        assert_int_equal(mesh->colours != NULL, k == 2);
        assert_int_equal(mesh->moved.sources != NULL, k == 3);
        free_mesh(scene.meshes);
        free(scene.meshes);
    }
}

static void more_triangles_are_added_behind_the_meshes_that_are_there(void **state)
{
    struct model_scene scene = {0};
    (void)state;
    const struct model_triangles from = triangles_of(square, 2), none = triangles_of(square, 0);
    for (uint32_t i = 0; i < 20; i++) {
        assert_true(model_weld(&scene, &from));
        assert_true(model_weld(&scene, &none)); /* it adds no empty mesh */
        assert_int_equal(scene.mesh_count, i + 1);
    }
    for (uint32_t i = 0; i < 20; i++) {
        assert_int_equal(scene.meshes[i].vertex_count, 4);
        free_mesh(&scene.meshes[i]);
    }
    free(scene.meshes);
}

/* Corner i is a vertex of its own, but those of the first triangle are one if the context says so. */
static void new_corner(const void *context, size_t i, struct model_vertex *to)
{
    const bool *is_point_first = context;
    to->position[0] = i < 3 && *is_point_first ? 0 : (float)i;
}

/* 65,535 vertices are 21,845 triangles; behind a triangle that is a point, 21,844 have room. */
static void a_mesh_is_split_at_65535_vertices(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < 2; k++) {
        const bool is_point_first = k == 1;
        const uint32_t triangles[] = {21845, 21845, 6310}, vertices[] = {k == 1 ? 65533 : 65535, 65535, 18930};
        struct model_scene scene = {0};
        struct model_triangles from = {.count = 50000, .corner = new_corner, .context = &is_point_first};
        assert_true(model_weld(&scene, &from));
        assert_int_equal(scene.mesh_count, 3);
        size_t corner = 0;
        for (uint32_t m = 0; m < scene.mesh_count; m++) {
            struct model_mesh *mesh = &scene.meshes[m];
            assert_int_equal(mesh->triangle_count, triangles[m]);
            assert_int_equal(mesh->vertex_count, vertices[m]);
            for (uint32_t i = 0; i < 3 * mesh->triangle_count; i++, corner++) {
                struct model_vertex v = {0};
                new_corner(&is_point_first, corner, &v);
                assert_true(mesh->positions[mesh->triangles[i / 3][i % 3]][0] == v.position[0]);
            }
            free_mesh(mesh);
        }
        free(scene.meshes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_square_of_six_corners_has_four_vertices),
        cmocka_unit_test(vertices_that_differ_in_one_property_stay_apart),
        cmocka_unit_test(many_vertices_of_one_position_stay_apart),
        cmocka_unit_test(arrays_that_the_triangles_lack_are_not_made),
        cmocka_unit_test(more_triangles_are_added_behind_the_meshes_that_are_there),
        cmocka_unit_test(a_mesh_is_split_at_65535_vertices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
