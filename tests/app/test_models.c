/*
 * The benchmark's models against its formulas in double arithmetic (ref_scene.c); closed, wound outwards, unit normals;
 * the stated memory is what they take. The teapot, edges, the sphere: tests of their own.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "mesh_checks.h"
#include "ref.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI     3.14159265358979323846
#define Q28(v) ((int32_t)((v) * (1 << 28) + .5))

static struct model cube(void)
{
    struct model m = {.arena = arena_of(MODEL_CUBE_BYTES)};
    assert_int_equal(model_cube(&m.arena, &m.mesh), PH_OK);
    return m;
}

/* ---- the benchmark's models ------------------------------------------------------------------------------ */

static void assert_scene(const struct ph_mesh *mesh, enum ref_scene_id id)
{
    struct ref_scene scene;
    ref_scene_build(&scene, id);
    assert_int_equal(mesh->vertex_count, scene.vertex_count);
    assert_int_equal(mesh->triangle_count, scene.triangle_count);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        assert_true(position_error(mesh, i, scene.vertices[i].p) <= ROUNDED);
        assert_true(normal_error(mesh, i, scene.vertices[i].n) <= ROUNDED);
        for (int k = 0; k < 2 && mesh->uvs != NULL; k++) {
            assert_true(mesh->uvs[i][k] == (fx_t)lrint(scene.vertices[i].uv[k] * 65536));
        }
    }
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        for (int k = 0; k < 3; k++) {
            assert_int_equal(mesh->triangles[i][k], scene.triangles[i][k]);
        }
    }
    ref_scene_free(&scene);
}

static void torus_is_that_of_the_benchmark(void **state)
{
    (void)state;
    struct model m = torus();
    assert_scene(&m.mesh, REF_TORUS);
    release(&m);
}

static void cube_is_that_of_the_benchmark(void **state)
{
    (void)state;
    struct model m = cube();
    assert_non_null(m.mesh.uvs);
    assert_scene(&m.mesh, REF_CUBE);
    release(&m);
}

static void ground_is_that_of_the_benchmark(void **state)
{
    (void)state;
    struct model m = ground();
    assert_scene(&m.mesh, REF_GROUND);
    release(&m);
}

/* ---- surfaces ---------------------------------------------------------------------------------------------- */

static void closed_models_have_two_triangles_at_each_edge(void **state)
{
    (void)state;
    struct model m = torus();
    assert_closed(&m.mesh);
    release(&m);
    m = cube();
    assert_closed(&m.mesh);
    release(&m);
    for (uint32_t levels = 0; levels <= 4; levels++) {
        m = sphere(levels);
        assert_closed(&m.mesh);
        release(&m);
    }
}

static void models_have_their_volume_and_so_are_wound_outwards(void **state)
{
    (void)state;
    struct model m = cube();
    assert_true(fabs(volume(&m.mesh) - 8) < 1e-9);
    release(&m);
    m = sphere(5);
    assert_true(fabs(volume(&m.mesh) - 4 * PI / 3) < .003 * 4 * PI / 3);
    release(&m);
    m = torus();
    const double smooth = 2 * PI * PI * .16;
    assert_true(volume(&m.mesh) < smooth && volume(&m.mesh) > .95 * smooth);
    release(&m);
}

static void normals_are_unit_vectors_to_the_outer_side(void **state)
{
    (void)state;
    struct model m = torus();
    assert_normals(&m.mesh, 0, m.mesh.triangle_count);
    release(&m);
    m = sphere(3);
    assert_normals(&m.mesh, 0, m.mesh.triangle_count);
    release(&m);
    m = cube();
    assert_normals(&m.mesh, 0, m.mesh.triangle_count);
    release(&m);
    m = ground();
    assert_normals(&m.mesh, 0, m.mesh.triangle_count);
    release(&m);
}

/* ---- memory and arguments ------------------------------------------------------------------------------------- */

static void a_model_that_does_not_fit_is_refused(void **state)
{
    (void)state;
    struct ph_mesh mesh;
    struct demo_arena arena = arena_of(MODEL_BYTES(512, 1024) - 8);
    assert_int_equal(model_torus(&arena, &mesh, 32, 16, Q28(1), Q28(.4)), PH_ERR_NOMEM);
    free(arena.base);
    arena = arena_of(MODEL_CUBE_BYTES - 8);
    assert_int_equal(model_cube(&arena, &mesh), PH_ERR_NOMEM);
    free(arena.base);
    arena = arena_of(MODEL_BYTES(441, 800) - 8);
    assert_int_equal(model_ground(&arena, &mesh, 20), PH_ERR_NOMEM);
    free(arena.base);
    arena = arena_of(MODEL_BYTES(162, 320) - 8);
    assert_int_equal(model_icosphere(&arena, &mesh, 2), PH_ERR_NOMEM);
    free(arena.base);
}

static void scratch_is_given_back(void **state)
{
    (void)state;
    struct model m = torus();
    struct demo_arena arena = arena_of(50000);
    assert_int_equal(model_edges(&arena, &m.mesh), PH_OK);
    assert_int_equal(arena.size, 50000);
    assert_int_equal(arena.used, MODEL_EDGES_BYTES(1536));
    free(arena.base);
    release(&m);
}

static void arguments_out_of_range_are_refused(void **state)
{
    (void)state;
    struct ph_mesh mesh;
    struct demo_arena arena = arena_of(100000);
    assert_int_equal(model_torus(&arena, &mesh, 2, 16, Q28(1), Q28(.5)), PH_ERR_INVAL);
    assert_int_equal(model_torus(&arena, &mesh, 32, 257, Q28(1), Q28(.5)), PH_ERR_INVAL);
    assert_int_equal(model_torus(&arena, &mesh, 32, 16, Q28(7), Q28(1)), PH_ERR_INVAL);
    assert_int_equal(model_torus(&arena, &mesh, 32, 16, Q28(-1), Q28(1)), PH_ERR_INVAL);
    assert_int_equal(model_icosphere(&arena, &mesh, 6), PH_ERR_INVAL);
    assert_int_equal(model_ground(&arena, &mesh, 0), PH_ERR_INVAL);
    assert_int_equal(model_ground(&arena, &mesh, 256), PH_ERR_INVAL);
    assert_int_equal(arena.used, 0);
    free(arena.base);
}

static void a_material_covers_all_triangles(void **state)
{
    (void)state;
    struct model m = {.arena = arena_of(MODEL_CUBE_BYTES + 16)};
    const struct ph_material material = {.shading = PH_SHADE_UNLIT};
    assert_int_equal(model_cube(&m.arena, &m.mesh), PH_OK);
    assert_int_equal(model_material(&m.arena, &m.mesh, &material), PH_OK);
    assert_int_equal(m.mesh.part_count, 1);
    assert_int_equal(m.mesh.parts[0].first, 0);
    assert_int_equal(m.mesh.parts[0].count, 12);
    assert_int_equal(m.mesh.parts[0].material, 0);
    assert_ptr_equal(m.mesh.materials, &material);
    release(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(torus_is_that_of_the_benchmark),
        cmocka_unit_test(cube_is_that_of_the_benchmark),
        cmocka_unit_test(ground_is_that_of_the_benchmark),
        cmocka_unit_test(closed_models_have_two_triangles_at_each_edge),
        cmocka_unit_test(models_have_their_volume_and_so_are_wound_outwards),
        cmocka_unit_test(normals_are_unit_vectors_to_the_outer_side),
        cmocka_unit_test(a_model_that_does_not_fit_is_refused),
        cmocka_unit_test(scratch_is_given_back),
        cmocka_unit_test(arguments_out_of_range_are_refused),
        cmocka_unit_test(a_material_covers_all_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
