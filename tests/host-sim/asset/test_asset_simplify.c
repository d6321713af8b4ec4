/* asset_simplify: spheres and flat grids with fewer triangles: how many remain, of which vertices, and how far they lie
 * from the sphere, which geometry tells; and what each way to simplify is taken for. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "asset_mesh.h"
#include "meshopt_version.h"
#include "models.h"

#include <math.h>
#include <meshoptimizer.h> /* tests/run.sh skips this program where the library is not installed */
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
        assert_int_equal(rest.way, ASSET_KEPT);
        const double inside = depth_inside();
        assert_true(inside < (MESHOPTIMIZER_VERSION <= 180 ? 12. : 12.5) / triangles); /* a regular one has 2.4 / n */
        assert_true(rest.error > inside / 4 && rest.error < inside * 4);
    }
    const double whole = rest.error;
    for (uint32_t i = 0; i < meshes[0].vertex_count; i++) { /* half as large: so is the error */
        struct fx_vec3 *const p = (struct fx_vec3 *)(uintptr_t)&meshes[0].positions[i];
        *p = (struct fx_vec3){p->x / 2, p->y / 2, p->z / 2};
    }
    simplify(100);
    assert_true(rest.error > whole * .4 && rest.error < whole * .6);
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

/* Each triangle with vertices of its own, whose normals differ: only joining them lets edges go. */
static void creases_everywhere_are_joined(void **state)
{
    static struct fx_vec3 positions[3 * BALL_TRIANGLES];
    static uint16_t triangles[BALL_TRIANGLES][3], colours[3 * BALL_TRIANGLES];
    (void)state;
    const struct ph_mesh from = ball();
    for (uint32_t i = 0; i < 3 * BALL_TRIANGLES; i++) {
        positions[i] = from.positions[from.triangles[i / 3][i % 3]];
        triangles[i / 3][i % 3] = (uint16_t)i;
    }
    meshes[0] = (struct ph_mesh){.positions = positions,
                                 .normals = from.normals,
                                 .triangles = (const uint16_t(*)[3])triangles,
                                 .vertex_count = 3 * BALL_TRIANGLES,
                                 .triangle_count = BALL_TRIANGLES};
    make_model(1);
    simplify(200);
    assert_int_equal(rest.way, ASSET_JOINED);
    assert_in_range(rest.index_count, 3 * 160, 3 * 200);
    assert_true(depth_inside() < .06);
    for (uint32_t i = 0; i < 3 * BALL_TRIANGLES; i++) {
        colours[i] = (uint16_t)(i / 3); /* what differs in colour is not joined */
    }
    meshes[0].colours = colours;
    simplify(200);
    assert_int_equal(rest.way, ASSET_SLOPPY);
    assert_in_range(rest.index_count, 3, 3 * 200);
    meshes[1] = meshes[0];
    meshes[1].triangle_count = 3; /* whose share is less than a triangle */
    meshes[2] = meshes[0];
    meshes[2].triangle_count = BALL_TRIANGLES / 2;
    make_model(3);
    simplify(300);
    uint32_t of[3] = {0, 0, 0};
    for (size_t i = 0; i < rest.index_count; i++) {
        of[rest.indices[i] / (3 * BALL_TRIANGLES)]++;
    }
    assert_in_range(of[0], 3, 3 * 200);
    assert_int_equal(of[1], 0);
    assert_in_range(of[2], 3, 3 * 100);
    assert_true(rest.error > .01 && rest.error < 1);
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
        assert_true(rest.index_count == 6 && rest.way == ASSET_KEPT && rest.error == 0);
        assert_memory_equal(rest.indices, kept, sizeof kept);
    }
    assert_true(asset_can_simplify);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_sphere_keeps_its_shape_and_tells_its_error, freed),
        cmocka_unit_test_teardown(no_gap_opens_between_meshes, freed),
        cmocka_unit_test_teardown(creases_everywhere_are_joined, freed),
        cmocka_unit_test_teardown(what_need_not_be_simplified_is_kept_but_for_lines, freed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
