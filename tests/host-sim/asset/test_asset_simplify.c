/* asset_simplify: spheres and flat grids with fewer triangles: how many remain, of which vertices, and how far they lie
 * from the sphere, which geometry tells; what keeps its place, and what goes first. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "asset_mesh.h"
#include "models.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    LEVELS = 3,
    BALL_VERTICES = MODEL_ICOSPHERE_VERTICES(LEVELS),
    BALL_TRIANGLES = MODEL_ICOSPHERE_TRIANGLES(LEVELS)
};

static uint8_t memory[1 << 18] __attribute__((aligned(8)));
static struct ph_mesh meshes[4];
static struct model model;
static struct asset_rest rest;

static struct ph_mesh ball(void)
{
    static struct ph_mesh mesh;
    struct demo_arena arena = {.base = memory, .size = sizeof memory};
    assert_int_equal(model_icosphere(&arena, &mesh, LEVELS), 0);
    return mesh;
}

static void make_model(uint32_t count)
{
    model = (struct model){.meshes = meshes, .mesh_count = count};
    for (uint32_t m = 0; m < count; m++) {
        model.triangle_count += meshes[m].triangle_count;
        model.vertex_max = meshes[m].vertex_count > model.vertex_max ? meshes[m].vertex_count : model.vertex_max;
    }
}

static void simplify(uint32_t triangles)
{
    free(rest.indices);
    assert_int_equal(asset_simplify(&model, triangles, &rest), 0);
    assert_int_equal(rest.index_count % 3, 0);
}

static int freed(void **state)
{
    (void)state;
    free(rest.indices);
    rest.indices = NULL;
    return 0;
}

/* The vertex of a number through all meshes. */
static struct fx_vec3 place(unsigned number)
{
    uint32_t m = 0;
    while (number >= meshes[m].vertex_count) {
        number -= meshes[m++].vertex_count;
        assert_true(m < model.mesh_count);
    }
    return meshes[m].positions[number];
}

/* By how much the middles of the triangles lie inside of the unit sphere, at most. */
static double depth_inside(void)
{
    double most = 0;
    for (size_t i = 0; i < rest.index_count; i += 3) {
        double middle[3] = {0, 0, 0};
        for (int k = 0; k < 3; k++) {
            const struct fx_vec3 p = place(rest.indices[i + (size_t)k]);
            middle[0] += p.x / 3. / FX_ONE, middle[1] += p.y / 3. / FX_ONE, middle[2] += p.z / 3. / FX_ONE;
        }
        most = fmax(most, 1 - sqrt(middle[0] * middle[0] + middle[1] * middle[1] + middle[2] * middle[2]));
    }
    return most;
}

static void a_sphere_keeps_its_shape_and_tells_its_error(void **state)
{
    (void)state;
    meshes[0] = ball();
    make_model(1);
    for (uint32_t triangles = 400; triangles >= 100; triangles /= 2) {
        simplify(triangles);
        assert_in_range(rest.index_count, 3 * triangles * 9 / 10, 3 * triangles);
        assert_true(rest.is_simplified);
        const double inside = depth_inside();
        assert_true(inside < 12. / triangles); /* a regular one has 2.4 / n */
        assert_true(rest.error > inside / 4 && rest.error < inside * 4);
    }
    const double whole = rest.error;
    for (uint32_t i = 0; i < meshes[0].vertex_count; i++) { /* twice as large: so is the error, and nothing else */
        struct fx_vec3 *const p = (struct fx_vec3 *)(uintptr_t)&meshes[0].positions[i];
        *p = (struct fx_vec3){p->x * 2, p->y * 2, p->z * 2};
    }
    unsigned before[3 * 100];
    memcpy(before, rest.indices, sizeof *before * rest.index_count);
    simplify(100);
    assert_true(rest.error == whole * 2);
    assert_memory_equal(before, rest.indices, sizeof *before * rest.index_count);
}

/* The same ball as two meshes with vertices of their own: no edge at their border moves away from its other half. */
static void no_gap_opens_between_meshes(void **state)
{
    (void)state;
    meshes[0] = ball();
    meshes[1] = meshes[0];
    meshes[0].triangle_count = BALL_TRIANGLES / 2;
    meshes[1].triangles += BALL_TRIANGLES / 2;
    meshes[1].triangle_count = BALL_TRIANGLES / 2;
    make_model(2);
    simplify(300);
    assert_in_range(rest.index_count, 3 * 260, 3 * 300);
    unsigned of_second = 0;
    for (size_t i = 0; i < rest.index_count; i += 3) {
        of_second += rest.indices[i] >= BALL_VERTICES;
        assert_true((rest.indices[i] >= BALL_VERTICES) == (rest.indices[i + 1] >= BALL_VERTICES));
        for (int k = 0; k < 3; k++) {
            const struct fx_vec3 a = place(rest.indices[i + (size_t)k]),
                                 b = place(rest.indices[i + (size_t)((k + 1) % 3)]);
            int partners = 0;
            for (size_t j = 0; j < rest.index_count; j++) {
                const struct fx_vec3 c = place(rest.indices[j]), d = place(rest.indices[j / 3 * 3 + (j % 3 + 1) % 3]);
                partners += memcmp(&a, &d, sizeof a) == 0 && memcmp(&b, &c, sizeof b) == 0;
            }
            assert_int_equal(partners, 1);
        }
    }
    assert_in_range(of_second, 100, 200);
}

/* Each triangle with vertices of its own, as formats without shared vertices have them. */
static void vertices_in_one_place_move_together(void **state)
{
    static struct fx_vec3 positions[3 * BALL_TRIANGLES];
    static int16_t normals[3 * BALL_TRIANGLES][3];
    static uint16_t triangles[BALL_TRIANGLES][3];
    (void)state;
    const struct ph_mesh from = ball();
    for (uint32_t i = 0; i < 3 * BALL_TRIANGLES; i++) {
        positions[i] = from.positions[from.triangles[i / 3][i % 3]];
        memcpy(normals[i], from.normals[from.triangles[i / 3][0]], sizeof normals[i]);
        triangles[i / 3][i % 3] = (uint16_t)i;
    }
    meshes[0] = (struct ph_mesh){.positions = positions,
                                 .normals = (const int16_t(*)[3])normals,
                                 .triangles = (const uint16_t(*)[3])triangles,
                                 .vertex_count = 3 * BALL_TRIANGLES,
                                 .triangle_count = BALL_TRIANGLES};
    make_model(1);
    simplify(200);
    assert_in_range(rest.index_count, 3 * 196, 3 * 200);
    assert_true(depth_inside() < .06);
}

/* A flat square of N x N quads, of which those of one half have other texture coordinates and those of a quarter
 * another colour. */
static void seams_stay_where_they_are(void **state)
{
    enum { N = 16, SIDE = N + 1 };
    static struct fx_vec3 positions[2 * SIDE * SIDE];
    static fx_t uvs[2 * SIDE * SIDE][2];
    static int16_t normals[2 * SIDE * SIDE][3];
    static uint16_t triangles[2 * N * N][3];
    (void)state;
    for (int half = 0; half < 2; half++) {
        for (int i = 0; i < SIDE * SIDE; i++) {
            const int v = half * SIDE * SIDE + i;
            positions[v] = (struct fx_vec3){i % SIDE * FX_ONE / N, i / SIDE * FX_ONE / N, 0};
            uvs[v][0] = half == 0 ? i % SIDE * FX_ONE / 64 : FX_ONE / 2;
            uvs[v][1] = half == 0 ? i / SIDE * FX_ONE / 64 : FX_ONE / 2 + i / SIDE * FX_ONE / 64;
            normals[v][2] = 16384;
        }
    }
    for (uint32_t t = 0; t < 2 * N * N; t++) {
        const uint32_t x = t / 2 % N, y = t / 2 / N, half = x >= N / 2, a = half * SIDE * SIDE + y * SIDE + x;
        const uint16_t corners[2][3] = {{(uint16_t)a, (uint16_t)(a + 1), (uint16_t)(a + SIDE)},
                                        {(uint16_t)(a + 1), (uint16_t)(a + SIDE + 1), (uint16_t)(a + SIDE)}};
        memcpy(triangles[t], corners[t % 2], sizeof triangles[t]);
    }
    meshes[0] = (struct ph_mesh){.positions = positions,
                                 .normals = (const int16_t(*)[3])normals,
                                 .uvs = (const fx_t(*)[2])uvs,
                                 .triangles = (const uint16_t(*)[3])triangles,
                                 .vertex_count = 2 * SIDE * SIDE,
                                 .triangle_count = 2 * N * N};
    make_model(1);
    simplify(20);
    assert_in_range(rest.index_count, 3, 3 * 20);
    double areas[2] = {0, 0};
    for (size_t i = 0; i < rest.index_count; i += 3) {
        const struct fx_vec3 a = place(rest.indices[i]), b = place(rest.indices[i + 1]), c = place(rest.indices[i + 2]);
        const int half = rest.indices[i] >= SIDE * SIDE;
        areas[half] += ((double)(b.x - a.x) * (c.y - a.y) - (double)(b.y - a.y) * (c.x - a.x)) / FX_ONE / FX_ONE / 2;
        for (int k = 0; k < 3; k++) {
            const fx_t x = place(rest.indices[i + (size_t)k]).x;
            assert_true(half == 0 ? x <= FX_HALF : x >= FX_HALF);
            assert_int_equal(rest.indices[i + (size_t)k] >= SIDE * SIDE, half);
        }
    }
    assert_true(fabs(areas[0] - .5) < 1e-9 && fabs(areas[1] - .5) < 1e-9); /* the square is covered, all of it once */
    assert_true(rest.error < 1e-6);
}

/* A tiny ball beside a large one goes whole before the large one is spoilt; one that is not so small stays. */
static void small_pieces_go_first(void **state)
{
    static struct fx_vec3 positions[BALL_VERTICES];
    (void)state;
    meshes[0] = ball();
    for (int i = 0; i < 2; i++) {
        for (uint32_t v = 0; v < BALL_VERTICES; v++) {
            const struct fx_vec3 p = meshes[0].positions[v];
            const fx_t less = i == 0 ? 64 : 3;
            positions[v] = (struct fx_vec3){p.x / less + 3 * FX_ONE, p.y / less, p.z / less};
        }
        meshes[1] = meshes[0];
        meshes[1].positions = positions;
        make_model(2);
        simplify(200);
        uint32_t of_small = 0;
        for (size_t k = 0; k < rest.index_count; k++) {
            of_small += rest.indices[k] >= BALL_VERTICES;
        }
        assert_in_range(of_small / 3, i == 0 ? 0 : 8, i == 0 ? 0 : 100);
        assert_true(i == 0 || rest.error < .2);
    }
}

static void a_few_triangles_are_left_of_anything(void **state)
{
    (void)state;
    meshes[0] = ball();
    make_model(1);
    for (uint32_t most = 50; most >= 4; most /= 2) {
        simplify(most);
        assert_in_range(rest.index_count, 3, 3 * most);
    }
}

static void what_need_not_be_simplified_is_kept_but_for_lines(void **state)
{
    static const struct fx_vec3 positions[5] = {
        {0, 0, 0}, {FX_ONE, 0, 0}, {0, FX_ONE, 0}, {FX_ONE, 0, 0}, {0, 0, FX_ONE}};
    static const uint16_t triangles[5][3] = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {3, 0, 1}, {1, 2, 4}};
    static const unsigned kept[6] = {0, 1, 2, 1, 2, 4};
    (void)state;
    meshes[0] =
        (struct ph_mesh){.positions = positions, .triangles = triangles, .vertex_count = 5, .triangle_count = 5};
    make_model(1);
    for (uint32_t most = 2; most < 5; most++) {
        simplify(most);
        assert_true(rest.index_count == 6 && rest.error == 0);
        assert_memory_equal(rest.indices, kept, sizeof kept);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_sphere_keeps_its_shape_and_tells_its_error, freed),
        cmocka_unit_test_teardown(no_gap_opens_between_meshes, freed),
        cmocka_unit_test_teardown(vertices_in_one_place_move_together, freed),
        cmocka_unit_test_teardown(seams_stay_where_they_are, freed),
        cmocka_unit_test_teardown(small_pieces_go_first, freed),
        cmocka_unit_test_teardown(a_few_triangles_are_left_of_anything, freed),
        cmocka_unit_test_teardown(what_need_not_be_simplified_is_kept_but_for_lines, freed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
