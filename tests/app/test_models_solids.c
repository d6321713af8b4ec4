/* Floors, boxes and surfaces of revolution (models_solids.c) against geometry in double precision. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "mesh_checks.h"
#include "status.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

static const struct model_point can[] = {{0, -FX_ONE},     {FX_ONE, -FX_ONE}, {FX_ONE, -FX_ONE},
                                         {FX_ONE, FX_ONE}, {FX_ONE, FX_ONE},  {0, FX_ONE}};
#define CAN_POINTS (sizeof(can) / sizeof(can[0]))

static void a_lathed_can_has_the_volume_of_its_prism(void **state)
{
    (void)state;
    for (uint32_t sides = 3; sides <= 64; sides += 7) {
        struct model m = {.arena = arena_of(MODEL_LATHE_BYTES(sides, CAN_POINTS, 1))};
        assert_int_equal(model_lathe(&m.arena, &m.mesh, can, CAN_POINTS, sides, 1, NULL), PH_OK);
        assert_int_equal(m.mesh.vertex_count, MODEL_LATHE_VERTICES(sides, CAN_POINTS));
        assert_int_equal(m.mesh.triangle_count, MODEL_LATHE_TRIANGLES(sides, CAN_POINTS));
        const double want = sides * sin(2 * PI / sides); /* n/2 sin(2 pi / n) r^2 times the height of 2 */
        assert_true(fabs(volume(&m.mesh) - want) < .0005);
        release(&m);
    }
}

static void a_lathed_can_s_normals_are_those_of_lid_and_side(void **state)
{
    (void)state;
    struct model m = {.arena = arena_of(MODEL_LATHE_BYTES(12, CAN_POINTS, 1))};
    assert_int_equal(model_lathe(&m.arena, &m.mesh, can, CAN_POINTS, 12, 1, NULL), PH_OK);
    for (uint32_t i = 0; i < m.mesh.vertex_count; i++) {
        const uint32_t ring = i / 12;
        const double angle = 2 * PI * (i % 12) / 12;
        const double lid[3] = {0, ring < 2 ? -1 : 1, 0};
        const double side[3] = {cos(angle), 0, -sin(angle)};
        assert_true(normal_error(&m.mesh, i, ring == 2 || ring == 3 ? side : lid) < 1.5);
    }
    release(&m);
}

static void stripes_share_the_sides_evenly_and_alternate(void **state)
{
    (void)state;
    struct model m = {.arena = arena_of(MODEL_LATHE_BYTES(12, CAN_POINTS, 4))};
    assert_int_equal(model_lathe(&m.arena, &m.mesh, can, CAN_POINTS, 12, 4, NULL), PH_OK);
    assert_int_equal(m.mesh.part_count, 4);
    for (uint32_t p = 0; p < 4; p++) {
        const struct ph_part *const part = &m.mesh.parts[p];
        assert_int_equal(part->material, p);
        assert_int_equal(part->count, m.mesh.triangle_count / 4);
        for (uint32_t i = part->first; i < part->first + part->count; i++) {
            const uint32_t column = m.mesh.triangles[i - (i - part->first) % 2][0] % 12;
            assert_int_equal(column % 4, p);
        }
    }
    release(&m);
}

/* The sides from 0 on of the whole can, with the same places and normals. */
static void an_arc_of_a_can_is_a_part_of_it(void **state)
{
    static const struct ph_material plain;
    (void)state;
    for (uint32_t seen = 1; seen < 12; seen++) {
        struct model whole = {.arena = arena_of(MODEL_LATHE_BYTES(12, CAN_POINTS, 1))},
                     m = {.arena = arena_of(1 << 16)};
        assert_int_equal(model_lathe(&whole.arena, &whole.mesh, can, CAN_POINTS, 12, 1, NULL), PH_OK);
        assert_int_equal(model_lathe_arc(&m.arena, &m.mesh, can, CAN_POINTS, 12, seen, &plain), PH_OK);
        assert_int_equal(m.mesh.vertex_count, (seen + 1) * CAN_POINTS);
        assert_int_equal(m.mesh.triangle_count, 2 * seen * (CAN_POINTS - 1));
        for (uint32_t i = 0; i < m.mesh.vertex_count; i++) {
            double p[3];
            position(&whole.mesh, i / (seen + 1) * 12 + i % (seen + 1), p);
            assert_true(position_error(&m.mesh, i, p) == 0);
        }
        for (uint32_t t = 0; t < m.mesh.triangle_count;
             t++) { /* outwards: away from the axis, up above and down below */
            double a[3], b[3], c[3];
            position(&m.mesh, m.mesh.triangles[t][0], a);
            position(&m.mesh, m.mesh.triangles[t][1], b);
            position(&m.mesh, m.mesh.triangles[t][2], c);
            const double solid = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                                 a[2] * (b[0] * c[1] - b[1] * c[0]);
            assert_true(solid > -1e-9);
        }
        assert_int_equal(m.mesh.materials == &plain, 1);
        release(&whole);
        release(&m);
    }
    struct model m = {.arena = arena_of(1 << 16)};
    assert_int_equal(model_lathe_arc(&m.arena, &m.mesh, can, CAN_POINTS, 12, 12, &plain), PH_ERR_INVAL);
    assert_int_equal(model_lathe_arc(&m.arena, &m.mesh, can, CAN_POINTS, 12, 0, &plain), PH_ERR_INVAL);
    release(&m);
}

static void a_box_is_closed_and_has_its_volume(void **state)
{
    (void)state;
    struct model m = {.arena = arena_of(MODEL_BOX_BYTES)};
    assert_int_equal(model_box(&m.arena, &m.mesh, FX_ONE / 2, FX_ONE * 2, FX_ONE * 3), PH_OK);
    assert_closed(&m.mesh);
    assert_normals(&m.mesh, 0, m.mesh.triangle_count);
    assert_true(fabs(volume(&m.mesh) - 8 * .5 * 2 * 3) < 1e-9);
    release(&m);
}

/* Which square the triangle's middle is in, counted from the floor's corner. */
static void square_of(const struct ph_mesh *mesh, uint32_t triangle, uint32_t cells, int *column, int *row)
{
    double x = 1e9, z = 1e9;
    for (int k = 0; k < 3; k++) {
        double p[3];
        position(mesh, mesh->triangles[triangle][k], p);
        assert_true(p[1] == 0);
        x = p[0] < x ? p[0] : x;
        z = p[2] < z ? p[2] : z;
    }
    *column = (int)lrint(x + cells / 2.);
    *row = (int)lrint(z + cells / 2.);
}

static void a_floor_is_a_chessboard_that_faces_up(void **state)
{
    (void)state;
    for (uint32_t cells = 1; cells < 8; cells++) {
        struct model m = {.arena = arena_of(MODEL_FLOOR_BYTES(cells))};
        assert_int_equal(model_floor(&m.arena, &m.mesh, cells, NULL), PH_OK);
        int times[64] = {0};
        for (uint32_t i = 0; i < m.mesh.triangle_count; i++) {
            int column, row;
            square_of(&m.mesh, i, cells, &column, &row);
            times[8 * row + column]++;
            assert_int_equal((column + row) & 1, i < m.mesh.parts[0].count ? 0 : 1);
        }
        for (uint32_t i = 0; i < 64; i++) {
            assert_int_equal(times[i], i % 8 < cells && i / 8 < cells ? 2 : 0);
        }
        assert_normals(&m.mesh, 0, m.mesh.triangle_count);
        release(&m);
    }
}

static void what_is_out_of_range_or_too_large_is_refused(void **state)
{
    (void)state;
    struct model m = {.arena = arena_of(MODEL_LATHE_BYTES(12, CAN_POINTS, 1) - 8)};
    assert_int_equal(model_lathe(&m.arena, &m.mesh, can, CAN_POINTS, 12, 1, NULL), PH_ERR_NOMEM);
    assert_int_equal(model_lathe(&m.arena, &m.mesh, can, 1, 12, 1, NULL), PH_ERR_INVAL);
    assert_int_equal(model_lathe(&m.arena, &m.mesh, can, CAN_POINTS, 2, 1, NULL), PH_ERR_INVAL);
    assert_int_equal(model_lathe(&m.arena, &m.mesh, can, CAN_POINTS, 65, 1, NULL), PH_ERR_INVAL);
    assert_int_equal(model_lathe(&m.arena, &m.mesh, can, CAN_POINTS, 12, 0, NULL), PH_ERR_INVAL);
    assert_int_equal(model_lathe(&m.arena, &m.mesh, can, CAN_POINTS, 12, 5, NULL), PH_ERR_INVAL);
    assert_int_equal(model_floor(&m.arena, &m.mesh, 0, NULL), PH_ERR_INVAL);
    assert_int_equal(model_floor(&m.arena, &m.mesh, 256, NULL), PH_ERR_INVAL);
    m.arena.used = m.arena.size;
    assert_int_equal(model_floor(&m.arena, &m.mesh, 3, NULL), PH_ERR_NOMEM);
    assert_int_equal(model_box(&m.arena, &m.mesh, 1, 1, 1), PH_ERR_NOMEM);
    release(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_lathed_can_has_the_volume_of_its_prism),
        cmocka_unit_test(a_lathed_can_s_normals_are_those_of_lid_and_side),
        cmocka_unit_test(stripes_share_the_sides_evenly_and_alternate),
        cmocka_unit_test(an_arc_of_a_can_is_a_part_of_it),
        cmocka_unit_test(a_box_is_closed_and_has_its_volume),
        cmocka_unit_test(a_floor_is_a_chessboard_that_faces_up),
        cmocka_unit_test(what_is_out_of_range_or_too_large_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
