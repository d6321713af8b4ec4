/*
 * The teapot against its published control points, evaluated by de Casteljau's construction in double arithmetic;
 * closed, wound outwards, unit normals; the stated memory is what it takes.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "mesh_checks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct model teapot(uint32_t n)
{
    struct model m = {.arena = arena_of(MODEL_BYTES(MODEL_TEAPOT_VERTICES(n), MODEL_TEAPOT_TRIANGLES(n)))};
    assert_int_equal(model_teapot(&m.arena, &m.mesh, n), PH_OK);
    assert_int_equal(m.mesh.vertex_count, MODEL_TEAPOT_VERTICES(n));
    assert_int_equal(m.mesh.triangle_count, MODEL_TEAPOT_TRIANGLES(n));
    return m;
}

/* The patches of one quarter or half as published: x, y, z with z upwards. The others are their mirror images. */
static const double patches[10][4][4][3] = {
    {
        {{1.4, 0, 2.4}, {1.4, -0.784, 2.4}, {0.784, -1.4, 2.4}, {0, -1.4, 2.4}},
        {{1.3375, 0, 2.53125}, {1.3375, -0.749, 2.53125}, {0.749, -1.3375, 2.53125}, {0, -1.3375, 2.53125}},
        {{1.4375, 0, 2.53125}, {1.4375, -0.805, 2.53125}, {0.805, -1.4375, 2.53125}, {0, -1.4375, 2.53125}},
        {{1.5, 0, 2.4}, {1.5, -0.84, 2.4}, {0.84, -1.5, 2.4}, {0, -1.5, 2.4}},
    },
    {
        {{1.5, 0, 2.4}, {1.5, -0.84, 2.4}, {0.84, -1.5, 2.4}, {0, -1.5, 2.4}},
        {{1.75, 0, 1.875}, {1.75, -0.98, 1.875}, {0.98, -1.75, 1.875}, {0, -1.75, 1.875}},
        {{2, 0, 1.35}, {2, -1.12, 1.35}, {1.12, -2, 1.35}, {0, -2, 1.35}},
        {{2, 0, 0.9}, {2, -1.12, 0.9}, {1.12, -2, 0.9}, {0, -2, 0.9}},
    },
    {
        {{2, 0, 0.9}, {2, -1.12, 0.9}, {1.12, -2, 0.9}, {0, -2, 0.9}},
        {{2, 0, 0.45}, {2, -1.12, 0.45}, {1.12, -2, 0.45}, {0, -2, 0.45}},
        {{1.5, 0, 0.225}, {1.5, -0.84, 0.225}, {0.84, -1.5, 0.225}, {0, -1.5, 0.225}},
        {{1.5, 0, 0.15}, {1.5, -0.84, 0.15}, {0.84, -1.5, 0.15}, {0, -1.5, 0.15}},
    },
    {
        {{0, 0, 3.15}, {0, 0, 3.15}, {0, 0, 3.15}, {0, 0, 3.15}},
        {{0.8, 0, 3.15}, {0.8, -0.45, 3.15}, {0.45, -0.8, 3.15}, {0, -0.8, 3.15}},
        {{0, 0, 2.85}, {0, 0, 2.85}, {0, 0, 2.85}, {0, 0, 2.85}},
        {{0.2, 0, 2.7}, {0.2, -0.112, 2.7}, {0.112, -0.2, 2.7}, {0, -0.2, 2.7}},
    },
    {
        {{0.2, 0, 2.7}, {0.2, -0.112, 2.7}, {0.112, -0.2, 2.7}, {0, -0.2, 2.7}},
        {{0.4, 0, 2.55}, {0.4, -0.224, 2.55}, {0.224, -0.4, 2.55}, {0, -0.4, 2.55}},
        {{1.3, 0, 2.55}, {1.3, -0.728, 2.55}, {0.728, -1.3, 2.55}, {0, -1.3, 2.55}},
        {{1.3, 0, 2.4}, {1.3, -0.728, 2.4}, {0.728, -1.3, 2.4}, {0, -1.3, 2.4}},
    },
    {
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
        {{0, -1.425, 0}, {0.798, -1.425, 0}, {1.425, -0.798, 0}, {1.425, 0, 0}},
        {{0, -1.5, 0.075}, {0.84, -1.5, 0.075}, {1.5, -0.84, 0.075}, {1.5, 0, 0.075}},
        {{0, -1.5, 0.15}, {0.84, -1.5, 0.15}, {1.5, -0.84, 0.15}, {1.5, 0, 0.15}},
    },
    {
        {{-1.6, 0, 2.025}, {-1.6, -0.3, 2.025}, {-1.5, -0.3, 2.25}, {-1.5, 0, 2.25}},
        {{-2.3, 0, 2.025}, {-2.3, -0.3, 2.025}, {-2.5, -0.3, 2.25}, {-2.5, 0, 2.25}},
        {{-2.7, 0, 2.025}, {-2.7, -0.3, 2.025}, {-3, -0.3, 2.25}, {-3, 0, 2.25}},
        {{-2.7, 0, 1.8}, {-2.7, -0.3, 1.8}, {-3, -0.3, 1.8}, {-3, 0, 1.8}},
    },
    {
        {{-2.7, 0, 1.8}, {-2.7, -0.3, 1.8}, {-3, -0.3, 1.8}, {-3, 0, 1.8}},
        {{-2.7, 0, 1.575}, {-2.7, -0.3, 1.575}, {-3, -0.3, 1.35}, {-3, 0, 1.35}},
        {{-2.5, 0, 1.125}, {-2.5, -0.3, 1.125}, {-2.65, -0.3, 0.9375}, {-2.65, 0, 0.9375}},
        {{-2, 0, 0.9}, {-2, -0.3, 0.9}, {-1.9, -0.3, 0.6}, {-1.9, 0, 0.6}},
    },
    {
        {{1.7, 0, 1.425}, {1.7, -0.66, 1.425}, {1.7, -0.66, 0.6}, {1.7, 0, 0.6}},
        {{2.6, 0, 1.425}, {2.6, -0.66, 1.425}, {3.1, -0.66, 0.825}, {3.1, 0, 0.825}},
        {{2.3, 0, 2.1}, {2.3, -0.25, 2.1}, {2.4, -0.25, 2.025}, {2.4, 0, 2.025}},
        {{2.7, 0, 2.4}, {2.7, -0.25, 2.4}, {3.3, -0.25, 2.4}, {3.3, 0, 2.4}},
    },
    {
        {{2.7, 0, 2.4}, {2.7, -0.25, 2.4}, {3.3, -0.25, 2.4}, {3.3, 0, 2.4}},
        {{2.8, 0, 2.475}, {2.8, -0.25, 2.475}, {3.525, -0.25, 2.49375}, {3.525, 0, 2.49375}},
        {{2.9, 0, 2.475}, {2.9, -0.15, 2.475}, {3.45, -0.15, 2.5125}, {3.45, 0, 2.5125}},
        {{2.8, 0, 2.4}, {2.8, -0.15, 2.4}, {3.2, -0.15, 2.4}, {3.2, 0, 2.4}},
    },
};

static void halfway(double t, const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[k] + t * (b[k] - a[k]);
    }
}

/* de Casteljau: the point of a cubic curve at t, and the direction there. */
static void curve(double t, const double p[4][3], double point[3], double direction[3])
{
    double q[3][3], r[2][3];
    for (int i = 0; i < 3; i++) {
        halfway(t, p[i], p[i + 1], q[i]);
    }
    halfway(t, q[0], q[1], r[0]);
    halfway(t, q[1], q[2], r[1]);
    halfway(t, r[0], r[1], point);
    for (int k = 0; k < 3; k++) {
        direction[k] = r[1][k] - r[0][k];
    }
}

/* Point and unit normal (either sign; zero where the patch has none) of a patch, in the model's coordinates. */
static void patch_point(const double patch[4][4][3], double s, double t, double point[3], double normal[3])
{
    double rows[4][3], columns[4][3], along[3], across[3], unused[3], p[3];
    for (int i = 0; i < 4; i++) {
        double column[4][3];
        curve(t, patch[i], rows[i], unused);
        for (int j = 0; j < 4; j++) {
            memcpy(column[j], patch[j][i], sizeof(column[j]));
        }
        curve(s, column, columns[i], unused);
    }
    curve(s, rows, p, along);
    curve(t, columns, p, across);
    double n[3], square = 0;
    for (int k = 0; k < 3; k++) {
        n[k] = along[(k + 1) % 3] * across[(k + 2) % 3] - along[(k + 2) % 3] * across[(k + 1) % 3];
        square += n[k] * n[k];
    }
    const double scale = square > 1e-20 ? 1 / sqrt(square) : 0;
    point[0] = .4 * p[0];
    point[1] = .4 * (p[2] - 1.575);
    point[2] = -.4 * p[1];
    normal[0] = n[0] * scale;
    normal[1] = n[2] * scale;
    normal[2] = -n[1] * scale;
}

static bool same_normal(const struct ph_mesh *mesh, uint32_t i, const double p[3], const double n[3])
{
    const double back[3] = {-n[0], -n[1], -n[2]};
    const double pole[3] = {0, p[1] > 0 ? 1 : -1, 0};
    if (n[0] == 0 && n[1] == 0 && n[2] == 0) {
        return normal_error(mesh, i, pole) == 0;
    }
    return fmin(normal_error(mesh, i, n), normal_error(mesh, i, back)) <= ROUNDED;
}

/* There is a vertex with this point and normal; it is marked as met. (The handle's end touches one of the pot's.) */
static void assert_patch_vertex(const struct ph_mesh *mesh, const double p[3], const double n[3], uint8_t *met)
{
    uint32_t i = 0;
    while (i < mesh->vertex_count && (position_error(mesh, i, p) > ROUNDED || !same_normal(mesh, i, p, n))) {
        i++;
    }
    assert_true(i < mesh->vertex_count);
    met[i] = 1;
}

/* All (n + 1)^2 points of a patch, or of its mirror image in x (1), z (2) or both (3). */
static void assert_patch(const struct ph_mesh *mesh, int patch, int mirror, uint32_t n, uint8_t *met)
{
    const double sign[3] = {mirror & 1 ? -1 : 1, 1, mirror & 2 ? -1 : 1};
    for (uint32_t k = 0; k < (n + 1) * (n + 1); k++) {
        double p[3], normal[3];
        patch_point(patches[patch], k / (n + 1) / (double)n, k % (n + 1) / (double)n, p, normal);
        for (int axis = 0; axis < 3; axis++) {
            p[axis] *= sign[axis];
            normal[axis] *= sign[axis];
        }
        assert_patch_vertex(mesh, p, normal, met);
    }
}

static void teapot_vertices_are_points_of_all_published_patches(void **state)
{
    (void)state;
    for (uint32_t segments = 2; segments <= 6; segments++) {
        struct model m = teapot(segments);
        uint8_t *const met = calloc(m.mesh.vertex_count, 1);
        assert_non_null(met);
        for (int i = 0; i < 32; i++) { /* 6 patches of a quarter, 4 of a half (those on both sides of z = 0) */
            const int patch = i < 24 ? i / 4 : 6 + (i - 24) / 2;
            const int mirror = i < 24 ? i % 4 : i % 2 * 2;
            assert_patch(&m.mesh, patch, mirror, segments, met);
        }
        for (uint32_t i = 0; i < m.mesh.vertex_count; i++) {
            assert_int_equal(met[i], 1);
        }
        free(met);
        release(&m);
    }
}

static void teapot_stands_upright_within_its_stated_size(void **state)
{
    (void)state;
    struct model m = teapot(6);
    double low = 0, high = 0, spout = 0, reach = 0;
    for (uint32_t i = 0; i < m.mesh.vertex_count; i++) {
        double p[3];
        position(&m.mesh, i, p);
        low = fmin(low, p[1]);
        high = fmax(high, p[1]);
        spout = fmax(spout, p[0]);
        reach = fmax(reach, sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]));
    }
    assert_true(fabs(low + .63) < 2e-5 && fabs(high - .63) < 2e-5);
    assert_true(spout > 1.35 && reach < 1.42);
    /* 1.6 is the volume of the upright cylinder of its height and its mean radius of about .63. */
    assert_true(volume(&m.mesh) > 1.2 && volume(&m.mesh) < 2);
    release(&m);
}

static void teapot_has_no_vertex_twice(void **state)
{
    (void)state;
    struct model m = teapot(5);
    for (uint32_t i = 0; i < m.mesh.vertex_count; i++) {
        for (uint32_t j = 0; j < i; j++) {
            assert_true(memcmp(&m.mesh.positions[i], &m.mesh.positions[j], sizeof(m.mesh.positions[i])) != 0 ||
                        memcmp(m.mesh.normals[i], m.mesh.normals[j], sizeof(m.mesh.normals[i])) != 0);
        }
    }
    release(&m);
}

static void teapot_is_closed_and_its_normals_point_outwards(void **state)
{
    (void)state;
    for (uint32_t n = 2; n <= 8; n++) {
        struct model m = teapot(n);
        assert_closed(&m.mesh);
        /* The ring between lid and rim and the tubes' covers are left out: they share the normals of their neighbours.
         */
        const uint32_t ring = 4 * n + 8 * n * (2 * n - 1);
        assert_normals(&m.mesh, 0, ring);
        assert_normals(&m.mesh, ring + 8 * n, 48 * n * n);
        release(&m);
    }
}

static void teapot_drawn_as_quads_has_the_stated_edges(void **state)
{
    (void)state;
    for (uint32_t n = 2; n <= 8; n++) {
        struct model m = teapot(n);
        struct demo_arena arena =
            arena_of(MODEL_EDGES_SCRATCH(m.mesh.vertex_count, m.mesh.triangle_count) + MODEL_EDGES_BYTES(4220));
        assert_int_equal(model_quad_edges(&arena, &m.mesh), PH_OK);
        assert_int_equal(m.mesh.edge_count, MODEL_TEAPOT_QUAD_EDGES(n));
        free(arena.base);
        release(&m);
    }
}

static void teapot_that_does_not_fit_is_refused(void **state)
{
    (void)state;
    struct ph_mesh mesh;
    struct demo_arena arena = arena_of(MODEL_BYTES(MODEL_TEAPOT_VERTICES(3), MODEL_TEAPOT_TRIANGLES(3)) - 8);
    assert_int_equal(model_teapot(&arena, &mesh, 3), PH_ERR_NOMEM);
    assert_int_equal(model_teapot(&arena, &mesh, 1), PH_ERR_INVAL);
    assert_int_equal(model_teapot(&arena, &mesh, 9), PH_ERR_INVAL);
    free(arena.base);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(teapot_vertices_are_points_of_all_published_patches),
        cmocka_unit_test(teapot_stands_upright_within_its_stated_size),
        cmocka_unit_test(teapot_has_no_vertex_twice),
        cmocka_unit_test(teapot_is_closed_and_its_normals_point_outwards),
        cmocka_unit_test(teapot_drawn_as_quads_has_the_stated_edges),
        cmocka_unit_test(teapot_that_does_not_fit_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
