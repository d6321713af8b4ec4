/*
 * The benchmark's models against its formulas in double arithmetic (ref_scene.c); closed, wound outwards, unit normals;
 * edges; the stated memory is what they take. The teapot: test_teapot.c.
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

static struct model torus(void)
{
    struct model m = {.arena = arena_of(MODEL_BYTES(512, 1024))};
    assert_int_equal(model_torus(&m.arena, &m.mesh, 32, 16, Q28(1), Q28(.4)), PH_OK);
    return m;
}

static struct model sphere(uint32_t levels)
{
    struct model m = {.arena =
                          arena_of(MODEL_BYTES(MODEL_ICOSPHERE_VERTICES(levels), MODEL_ICOSPHERE_TRIANGLES(levels)))};
    assert_int_equal(model_icosphere(&m.arena, &m.mesh, levels), PH_OK);
    assert_int_equal(m.mesh.vertex_count, MODEL_ICOSPHERE_VERTICES(levels));
    assert_int_equal(m.mesh.triangle_count, MODEL_ICOSPHERE_TRIANGLES(levels));
    return m;
}

static struct model cube(void)
{
    struct model m = {.arena = arena_of(MODEL_CUBE_BYTES)};
    assert_int_equal(model_cube(&m.arena, &m.mesh), PH_OK);
    return m;
}

static struct model ground(void)
{
    struct model m = {.arena = arena_of(MODEL_BYTES(441, 800))};
    assert_int_equal(model_ground(&m.arena, &m.mesh, 20), PH_OK);
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

static int same_corners(const struct ph_mesh *mesh, uint32_t t, const int want[3])
{
    int found = 0;
    for (int turn = 0; turn < 3; turn++) {
        found |= mesh->triangles[t][turn] == want[0] && mesh->triangles[t][(turn + 1) % 3] == want[1] &&
                 mesh->triangles[t][(turn + 2) % 3] == want[2];
    }
    return found;
}

/* The benchmark fixes no order of vertices: each vertex and each triangle of the reference must be there once. */
static void icosphere_is_that_of_the_benchmark_in_some_order(void **state)
{
    (void)state;
    struct model m = sphere(4);
    struct ref_scene scene;
    ref_scene_build(&scene, REF_SPHERE);
    assert_int_equal(m.mesh.vertex_count, scene.vertex_count);
    assert_int_equal(m.mesh.triangle_count, scene.triangle_count);
    uint8_t *const used = calloc(m.mesh.vertex_count, 1);
    int *const ours = calloc(m.mesh.vertex_count, sizeof(*ours));
    assert_non_null(used);
    assert_non_null(ours);
    for (int v = 0; v < scene.vertex_count; v++) {
        uint32_t i = 0;
        while (i < m.mesh.vertex_count && position_error(&m.mesh, i, scene.vertices[v].p) > ROUNDED) {
            i++;
        }
        assert_true(i < m.mesh.vertex_count);
        assert_int_equal(used[i]++, 0);
        assert_true(normal_error(&m.mesh, i, scene.vertices[v].p) <= ROUNDED);
        ours[v] = (int)i;
    }
    for (int t = 0; t < scene.triangle_count; t++) {
        const int *const theirs = scene.triangles[t];
        const int want[3] = {ours[theirs[0]], ours[theirs[1]], ours[theirs[2]]};
        uint32_t i = 0;
        while (i < m.mesh.triangle_count && !same_corners(&m.mesh, i, want)) {
            i++;
        }
        assert_true(i < m.mesh.triangle_count);
    }
    free(used);
    free(ours);
    ref_scene_free(&scene);
    release(&m);
}

static void icosphere_vertices_lie_on_the_sphere_at_every_level(void **state)
{
    (void)state;
    for (uint32_t levels = 0; levels <= MODEL_ICOSPHERE_LEVELS_MAX; levels++) {
        struct model m = sphere(levels);
        for (uint32_t i = 0; i < m.mesh.vertex_count; i++) {
            double p[3];
            position(&m.mesh, i, p);
            assert_true(fabs(sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1) < 1. / 65536);
        }
        release(&m);
    }
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

/* ---- edges ------------------------------------------------------------------------------------------------------ */

static uint64_t edge_key(uint16_t a, uint16_t b)
{
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

static int compare_u64(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a;
    const uint64_t y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

/* Sorts the sides of all triangles. Returns how many different ones there are. */
static size_t sides(const struct ph_mesh *mesh, uint64_t *keys)
{
    const size_t count = 3 * (size_t)mesh->triangle_count;
    size_t unique = 0;
    for (size_t i = 0; i < count; i++) {
        keys[i] = edge_key(mesh->triangles[i / 3][i % 3], mesh->triangles[i / 3][(i + 1) % 3]);
    }
    qsort(keys, count, sizeof(*keys), compare_u64);
    for (size_t i = 0; i < count; i++) {
        if (i == 0 || keys[i] != keys[i - 1]) {
            keys[unique++] = keys[i];
        }
    }
    return unique;
}

/* mesh->edges are all sides of triangles, each once, in exactly the stated memory. */
static void assert_edges(struct ph_mesh *mesh)
{
    uint64_t *const want = calloc(6 * (size_t)mesh->triangle_count, sizeof(*want));
    assert_non_null(want);
    uint64_t *const got = want + 3 * (size_t)mesh->triangle_count;
    const size_t count = sides(mesh, want);
    struct demo_arena arena =
        arena_of(MODEL_EDGES_SCRATCH(mesh->vertex_count, mesh->triangle_count) + MODEL_EDGES_BYTES(count));
    assert_int_equal(model_edges(&arena, mesh), PH_OK);
    assert_true(arena.used <= MODEL_EDGES_BYTES(count));
    assert_int_equal(mesh->edge_count, count);
    for (size_t i = 0; i < count; i++) {
        got[i] = edge_key(mesh->edges[i][0], mesh->edges[i][1]);
    }
    qsort(got, count, sizeof(*got), compare_u64);
    assert_memory_equal(got, want, count * sizeof(*got));
    arena.size -= 8; /* short by two edges, then with room for none */
    arena.used = 0;
    assert_int_equal(model_edges(&arena, mesh), PH_ERR_NOMEM);
    arena.size -= MODEL_EDGES_BYTES(count) - 8;
    memset(arena.base + arena.size, 0xA5, MODEL_EDGES_BYTES(count));
    assert_int_equal(model_edges(&arena, mesh), PH_ERR_NOMEM);
    for (size_t i = 0; i < MODEL_EDGES_BYTES(count); i++) {
        assert_int_equal(arena.base[arena.size + i], 0xA5);
    }
    free(arena.base);
    free(want);
}

static void edges_are_the_sides_of_all_triangles_once(void **state)
{
    (void)state;
    struct model m = torus();
    assert_edges(&m.mesh);
    assert_int_equal(m.mesh.edge_count, 3 * 1024 / 2);
    release(&m);
    m = sphere(2);
    assert_edges(&m.mesh);
    assert_int_equal(m.mesh.edge_count, 480);
    release(&m);
    m = ground(); /* open: edges at the border have one triangle */
    assert_edges(&m.mesh);
    assert_int_equal(m.mesh.edge_count, 2 * 20 * 21 + 400);
    release(&m);
}

/* If lists were searched edge by edge this would take two milliards of steps. */
static void edges_of_a_hub_with_65534_spokes_take_linear_time(void **state)
{
    (void)state;
    const uint32_t spokes = 65534;
    uint16_t(*const triangles)[3] = calloc(spokes, sizeof(*triangles));
    assert_non_null(triangles);
    for (uint32_t i = 0; i < spokes; i++) {
        triangles[i][1] = (uint16_t)(1 + i);
        triangles[i][2] = (uint16_t)(1 + (i + 1) % spokes);
    }
    struct ph_mesh mesh = {
        .triangles = (const uint16_t(*)[3])triangles, .vertex_count = spokes + 1, .triangle_count = spokes};
    assert_edges(&mesh);
    assert_int_equal(mesh.edge_count, 2 * spokes);
    free(triangles);
}

/* Three edges a triangle are the most there can be: they must not grow into the scratch memory. */
static void loose_triangles_have_three_edges_each(void **state)
{
    (void)state;
    uint16_t triangles[1000][3];
    for (uint16_t i = 0; i < 3000; i++) {
        triangles[i / 3][i % 3] = i;
    }
    struct ph_mesh mesh = {.triangles = (const uint16_t(*)[3])triangles, .vertex_count = 3000, .triangle_count = 1000};
    assert_edges(&mesh);
    assert_int_equal(mesh.edge_count, 3000);
}

static void a_triangle_with_one_corner_twice_has_no_edge_of_no_length(void **state)
{
    (void)state;
    const uint16_t triangles[1][3] = {{4, 7, 7}};
    struct ph_mesh mesh = {.triangles = triangles, .vertex_count = 8, .triangle_count = 1};
    struct demo_arena arena = arena_of(1000);
    assert_int_equal(model_edges(&arena, &mesh), PH_OK);
    assert_int_equal(mesh.edge_count, 1);
    assert_true(mesh.edges[0][0] == 4 && mesh.edges[0][1] == 7);
    free(arena.base);
}

static void quad_edges_leave_out_the_diagonals(void **state)
{
    (void)state;
    struct model m = torus();
    struct demo_arena arena = arena_of(100000);
    assert_int_equal(model_quad_edges(&arena, &m.mesh), PH_OK);
    assert_int_equal(m.mesh.edge_count, 2 * 512);
    for (uint32_t i = 0; i < m.mesh.edge_count; i++) {
        const int a = m.mesh.edges[i][0];
        const int b = m.mesh.edges[i][1];
        assert_true((a / 16 == b / 16) != (a % 16 == b % 16)); /* along a row or a column, not both */
    }
    free(arena.base);
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
        cmocka_unit_test(icosphere_is_that_of_the_benchmark_in_some_order),
        cmocka_unit_test(icosphere_vertices_lie_on_the_sphere_at_every_level),
        cmocka_unit_test(closed_models_have_two_triangles_at_each_edge),
        cmocka_unit_test(models_have_their_volume_and_so_are_wound_outwards),
        cmocka_unit_test(normals_are_unit_vectors_to_the_outer_side),
        cmocka_unit_test(edges_are_the_sides_of_all_triangles_once),
        cmocka_unit_test(edges_of_a_hub_with_65534_spokes_take_linear_time),
        cmocka_unit_test(loose_triangles_have_three_edges_each),
        cmocka_unit_test(a_triangle_with_one_corner_twice_has_no_edge_of_no_length),
        cmocka_unit_test(quad_edges_leave_out_the_diagonals),
        cmocka_unit_test(a_model_that_does_not_fit_is_refused),
        cmocka_unit_test(scratch_is_given_back),
        cmocka_unit_test(arguments_out_of_range_are_refused),
        cmocka_unit_test(a_material_covers_all_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
