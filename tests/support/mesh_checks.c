/* See mesh_checks.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "mesh_checks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct demo_arena arena_of(size_t size)
{
    struct demo_arena arena = {malloc(size + 1), size, 0};
    assert_non_null(arena.base);
    return arena;
}

void release(struct model *m)
{
    free(m->arena.base);
}

void position(const struct ph_mesh *mesh, uint32_t i, double p[3])
{
    p[0] = mesh->positions[i].x / 65536.;
    p[1] = mesh->positions[i].y / 65536.;
    p[2] = mesh->positions[i].z / 65536.;
}

double position_error(const struct ph_mesh *mesh, uint32_t i, const double p[3])
{
    double got[3], worst = 0;
    position(mesh, i, got);
    for (int k = 0; k < 3; k++) {
        worst = fmax(worst, fabs(got[k] - p[k]) * 65536);
    }
    return worst;
}

double normal_error(const struct ph_mesh *mesh, uint32_t i, const double n[3])
{
    double worst = 0;
    for (int k = 0; k < 3; k++) {
        worst = fmax(worst, fabs(mesh->normals[i][k] - n[k] * 16384));
    }
    return worst;
}

uint32_t *places(const struct ph_mesh *mesh)
{
    uint32_t *const place = calloc(mesh->vertex_count, sizeof(*place));
    assert_non_null(place);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        while (memcmp(&mesh->positions[place[i]], &mesh->positions[i], sizeof(mesh->positions[i])) != 0) {
            place[i]++;
        }
    }
    return place;
}

static int compare_u64(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a;
    const uint64_t y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

void assert_closed(const struct ph_mesh *mesh)
{
    const size_t count = 3 * (size_t)mesh->triangle_count;
    uint32_t *const place = places(mesh);
    uint64_t *const edges = calloc(2 * count, sizeof(*edges));
    assert_non_null(edges);
    uint64_t *const opposite = edges + count;
    for (size_t i = 0; i < count; i++) {
        const uint64_t a = place[mesh->triangles[i / 3][i % 3]];
        const uint64_t b = place[mesh->triangles[i / 3][(i + 1) % 3]];
        edges[i] = a << 32 | b;
        opposite[i] = b << 32 | a;
    }
    qsort(edges, count, sizeof(*edges), compare_u64);
    qsort(opposite, count, sizeof(*opposite), compare_u64);
    for (size_t i = 0; i < count; i++) {
        assert_true(edges[i] == opposite[i]);
        assert_true(i == 0 || edges[i] != edges[i - 1]);
    }
    free(edges);
    free(place);
}

/* Twice the area's vector of a triangle. */
static void face_normal(const struct ph_mesh *mesh, uint32_t t, double n[3])
{
    double p[3][3], u[3], v[3];
    for (int k = 0; k < 3; k++) {
        position(mesh, mesh->triangles[t][k], p[k]);
    }
    for (int k = 0; k < 3; k++) {
        u[k] = p[1][k] - p[0][k];
        v[k] = p[2][k] - p[0][k];
    }
    for (int k = 0; k < 3; k++) {
        n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    }
}

double volume(const struct ph_mesh *mesh)
{
    double sum = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        double p[3], n[3];
        position(mesh, mesh->triangles[t][0], p);
        face_normal(mesh, t, n);
        sum += (p[0] * n[0] + p[1] * n[1] + p[2] * n[2]) / 6;
    }
    return sum;
}

void assert_normals(const struct ph_mesh *mesh, uint32_t first, uint32_t end)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const int16_t *const n = mesh->normals[i];
        const double length = sqrt((double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2]);
        assert_true(fabs(length - 16384) < 1);
    }
    for (uint32_t t = first; t < end; t++) {
        double face[3], sum = 0;
        face_normal(mesh, t, face);
        for (int k = 0; k < 9; k++) {
            sum += face[k / 3] * mesh->normals[mesh->triangles[t][k % 3]][k / 3];
        }
        assert_true(sum > 0);
    }
}

struct model torus(void)
{
    struct model m = {.arena = arena_of(MODEL_BYTES(512, 1024))};
    assert_int_equal(model_torus(&m.arena, &m.mesh, 32, 16, 1 << 28, (int32_t)(.4 * (1 << 28) + .5)), PH_OK);
    return m;
}

struct model sphere(uint32_t levels)
{
    struct model m = {.arena =
                          arena_of(MODEL_BYTES(MODEL_ICOSPHERE_VERTICES(levels), MODEL_ICOSPHERE_TRIANGLES(levels)))};
    assert_int_equal(model_icosphere(&m.arena, &m.mesh, levels), PH_OK);
    assert_int_equal(m.mesh.vertex_count, MODEL_ICOSPHERE_VERTICES(levels));
    assert_int_equal(m.mesh.triangle_count, MODEL_ICOSPHERE_TRIANGLES(levels));
    return m;
}

struct model ground(void)
{
    struct model m = {.arena = arena_of(MODEL_BYTES(441, 800))};
    assert_int_equal(model_ground(&m.arena, &m.mesh, 20), PH_OK);
    return m;
}
