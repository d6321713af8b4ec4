/* models_icosphere: the sphere against that of the benchmark (ref_scene.c) and against the unit sphere, closed and
 * wound outwards at every level. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "mesh_checks.h"
#include "ref.h"

#include <math.h>
#include <stdlib.h>

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

/* The volume of a sphere that is inscribed grows towards 4/3 pi: the error falls by four with each level. */
static void icosphere_is_closed_and_grows_towards_the_sphere(void **state)
{
    double missing = 2;
    (void)state;
    for (uint32_t levels = 0; levels <= 4; levels++) {
        struct model m = sphere(levels);
        assert_closed(&m.mesh);
        assert_normals(&m.mesh, 0, m.mesh.triangle_count);
        const double now = 4 / 3. * 3.14159265358979323846 - volume(&m.mesh);
        assert_true(now > 0 && now < missing / (levels == 0 ? 1 : 3));
        missing = now;
        release(&m);
    }
}

static void levels_and_memory_have_their_bounds(void **state)
{
    struct model m = {.arena = arena_of(MODEL_BYTES(MODEL_ICOSPHERE_VERTICES(1), MODEL_ICOSPHERE_TRIANGLES(1)))};
    (void)state;
    assert_int_equal(model_icosphere(&m.arena, &m.mesh, MODEL_ICOSPHERE_LEVELS_MAX + 1), PH_ERR_INVAL);
    assert_int_equal(model_icosphere(&m.arena, &m.mesh, 2), PH_ERR_NOMEM);
    m.arena.used = 0;
    assert_int_equal(model_icosphere(&m.arena, &m.mesh, 1), PH_OK);
    assert_int_equal(m.mesh.vertex_count, 42);
    assert_int_equal(m.mesh.triangle_count, 80);
    release(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(icosphere_is_that_of_the_benchmark_in_some_order),
        cmocka_unit_test(icosphere_vertices_lie_on_the_sphere_at_every_level),
        cmocka_unit_test(icosphere_is_closed_and_grows_towards_the_sphere),
        cmocka_unit_test(levels_and_memory_have_their_bounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
