/* models_edges: the edges of meshes are all sides of their triangles, each once, and of quads all but the diagonals;
 * the stated memory is what they take. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "mesh_checks.h"

#include <stdlib.h>
#include <string.h>

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

/* A fan's triangles that share one corner, and a last one without a partner, are no quads. */
static void what_is_no_quad_keeps_all_edges(void **state)
{
    static const uint16_t triangles[3][3] = {{0, 1, 2}, {0, 3, 4}, {0, 5, 6}};
    (void)state;
    for (uint32_t n = 1; n <= 4; n++) {
        static const uint16_t strip[2][3] = {{0, 1, 2}, {3, 2, 4}}; /* they have one corner in common, too */
        struct ph_mesh mesh = {
            .triangles = n < 4 ? triangles : strip, .vertex_count = 7, .triangle_count = n < 4 ? n : 2};
        struct demo_arena arena = arena_of(1000);
        assert_int_equal(model_quad_edges(&arena, &mesh), PH_OK);
        assert_int_equal(mesh.edge_count, 3 * mesh.triangle_count);
        free(arena.base);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_are_the_sides_of_all_triangles_once),
        cmocka_unit_test(edges_of_a_hub_with_65534_spokes_take_linear_time),
        cmocka_unit_test(loose_triangles_have_three_edges_each),
        cmocka_unit_test(a_triangle_with_one_corner_twice_has_no_edge_of_no_length),
        cmocka_unit_test(quad_edges_leave_out_the_diagonals),
        cmocka_unit_test(what_is_no_quad_keeps_all_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
