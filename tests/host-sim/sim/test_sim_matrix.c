/* sim_matrix: matrices as text; views and projections out of matrices that were worked out by hand for each convention,
 * with the planes z = 1 and z = 3. */
#define _XOPEN_SOURCE 700 /* open_memstream */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "sim_matrix.h"
#include "status.h"

#include <stdlib.h>
#include <string.h>

static void sixteen_numbers_are_read_row_by_row(void **state)
{
    (void)state;
    struct sim_matrix m;
    assert_true(sim_matrix_read("0,1,2,3,4,5,6,7,8,9,10,11,-12.5,+13,.25,32767.5", &m));
    for (int i = 0; i < 12; i++) {
        assert_true(m.m[i / 4][i % 4] == i);
    }
    assert_true(m.m[3][0] == -12.5 && m.m[3][1] == 13 && m.m[3][2] == 0.25 && m.m[3][3] == 32767.5);
    static const char *const wrong[] = {"",
                                        "0,1,2,3,4,5,6,7,8,9,10,11,12,13,14",
                                        "0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,",
                                        "0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,",
                                        "0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15 ",
                                        "0;1,2,3,4,5,6,7,8,9,10,11,12,13,14,15",
                                        " 0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15",
                                        "0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,32768",
                                        "0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,-32768",
                                        "0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,inf",
                                        "0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,-nan",
                                        "0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,0x1",
                                        "0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,-",
                                        "0,1,2,3,4,5,6,7,8,9,10,11,12,13,,15"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        m.m[0][0] = 4711;
        assert_false(sim_matrix_read(wrong[i], &m));
        assert_true(m.m[0][0] == 4711);
    }
}

static void expect_flat(const char *text, const fx_t rows[4][4])
{
    struct ph_mat4 m;
    assert_true(sim_matrix_flat(text, &m));
    assert_memory_equal(m.m, rows, sizeof m.m);
}

static void a_matrix_that_drops_the_depth_has_a_name(void **state)
{
    (void)state;
    const fx_t one = FX_ONE;
    expect_flat("kaist-4.7", (const fx_t[4][4]){{one}, {0, one}, {0}, {0, 0, 0, one}});
    expect_flat("kaist-4.11", (const fx_t[4][4]){{one}, {0, one}, {0}, {0, 0, one}});
    expect_flat("eece=4", (const fx_t[4][4]){{one}, {0, one}, {0, 0, one}, {0, 0, one / 4}});
    expect_flat("plane=0,0,7,2", (const fx_t[4][4]){{2 * one}, {0, 2 * one}, {0, 0, 2 * one}, {0, 0, -one}});
    static const char *const wrong[] = {"",        "kaist",       "kaist-4.70",    "eece=",         "eece=0",
                                        "eece=1x", "plane=0,0,1", "plane=0,0,0,1", "plane=0,0,1,0", "plane=0,0,1,2,",
                                        "eece",    "plane"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        struct ph_mat4 m = {{{4711}}};
        assert_false(sim_matrix_flat(wrong[i], &m));
        assert_int_equal(m.m[0][0], 4711);
    }
}

static const struct sim_matrix moved = {{{0, 0, 1, 1}, {0, 1, 0, -2}, {-1, 0, 0, 0.5}, {0, 0, 0, 1}}};

static void a_view_is_a_rotation_and_a_move(void **state)
{
    (void)state;
    struct ph_xform view;
    bool left_world = true;
    const int32_t unit = 1 << 30, r[3][3] = {{0, 0, unit}, {0, unit, 0}, {-unit, 0, 0}};
    assert_int_equal(sim_matrix_view(&moved, PH_GL, &view, &left_world), 0);
    assert_memory_equal(view.r, r, sizeof r);
    assert_true(view.t.x == FX_INT(1) && view.t.y == FX_INT(-2) && view.t.z == FX_ONE / 2);
    struct sim_matrix d3d = moved; /* looks along +z: its third row is the other way round */
    d3d.m[2][0] = 1;
    d3d.m[2][3] = -0.5;
    assert_int_equal(sim_matrix_view(&d3d, PH_D3D, &view, &left_world), 0);
    assert_memory_equal(view.r, r, sizeof r);
    assert_true(view.t.x == FX_INT(1) && view.t.y == FX_INT(-2) && view.t.z == FX_ONE / 2);
    assert_false(left_world);
    assert_int_equal(sim_matrix_view(&d3d, PH_GL, &view, &left_world), PH_ERR_INVAL);
}

/* 4600's world may be left-handed, as its camera is. A point that lies at (x, y, z) in its world lies at (x, y, -z) in
 * ours, and one at (x, y, z) before its camera at (x, y, -z) before ours: each row of the product is worked out so. */
static void a_left_handed_world_is_ours_with_z_turned_round(void **state)
{
    (void)state;
    struct ph_xform view;
    bool left_world = false;
    const int32_t unit = 1 << 30, r[3][3] = {{0, 0, -unit}, {0, unit, 0}, {unit, 0, 0}};
    assert_int_equal(sim_matrix_view(&moved, PH_D3D, &view, &left_world), 0);
    assert_true(left_world);
    assert_memory_equal(view.r, r, sizeof r);
    assert_true(view.t.x == FX_INT(1) && view.t.y == FX_INT(-2) && view.t.z == FX_ONE / -2);
    const struct ph_mat4 as_typed = sim_matrix_of_view(&view, (struct sim_matrix_writing){PH_D3D, true});
    for (int i = 0; i < 16; i++) {
        assert_int_equal(as_typed.m[i / 4][i % 4], (int)(moved.m[i / 4][i % 4] * FX_ONE));
    }
    for (int c = PH_GL; c <= PH_REVERSED; c++) { /* the others have one hand */
        struct sim_matrix mirrored = moved;
        mirrored.m[1][1] = -1;
        assert_int_equal(sim_matrix_view(&mirrored, (enum ph_convention)c, &view, &left_world),
                         c == PH_D3D ? 0 : PH_ERR_INVAL);
        assert_false(left_world);
    }
}

static void what_is_not_rigid_is_no_view(void **state)
{
    (void)state;
    static const struct {
        int row, column;
        double value;
    } wrong[] = {{0, 2, 1.0002}, {1, 1, 0.9998}, {2, 0, -0.5},   {0, 0, 0.001}, {1, 0, 0.001},
                 {2, 1, 0.001},  {3, 0, 0.001},  {3, 1, 0.001},  {3, 2, 0.001}, {3, 3, 0.999},
                 {0, 3, 32768},  {1, 3, 32768},  {2, 3, -32769}, {1, 1, -1}};
    struct ph_xform view;
    bool left_world;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        struct sim_matrix m = moved;
        m.m[wrong[i].row][wrong[i].column] = wrong[i].value;
        assert_int_equal(sim_matrix_view(&m, PH_GL, &view, &left_world), PH_ERR_INVAL);
    }
    struct sim_matrix m = moved; /* within 1/10000 */
    m.m[1][1] = 0.99997;
    assert_int_equal(sim_matrix_view(&m, PH_GL, &view, &left_world), 0);
    assert_int_equal(view.r[1][1], 1073709612); /* 0.99997 2^30 = 1073709611.6 */
}

static const struct sim_matrix perspectives[] = {
    [PH_GL] = {{{1, 0, 0.25, 0}, {0, 2, -0.5, 0}, {0, 0, -2, -3}, {0, 0, -1, 0}}},
    [PH_D3D] = {{{1, 0, -0.25, 0}, {0, 2, 0.5, 0}, {0, 0, 1.5, -1.5}, {0, 0, 1, 0}}},
    [PH_LMU] = {{{-1, 0, -0.25, 0}, {0, -2, 0.5, 0}, {0, 0, -2, -3}, {0, 0, 1, 0}}},
    [PH_REVERSED] = {{{1, 0, 0.25, 0}, {0, 2, -0.5, 0}, {0, 0, 0.5, 1.5}, {0, 0, -1, 0}}},
};

static void a_perspective_is_read_in_each_convention(void **state)
{
    (void)state;
    for (int c = PH_GL; c <= PH_REVERSED; c++) {
        for (int by = 1; by < 4; by++) {
            struct sim_matrix m = perspectives[c];
            struct ph_projection p;
            for (int i = 0; i < 16; i++) {
                m.m[i / 4][i % 4] *= by;
            }
            assert_int_equal(sim_matrix_projection(&m, (enum ph_convention)c, &p), 0);
            assert_int_equal(p.kind, PH_PERSPECTIVE);
            assert_true(p.scale_x_q20 == 1 << 20 && p.scale_y_q20 == 2 << 20);
            assert_true(p.shift_x == FX_ONE / 4 && p.shift_y == -FX_ONE / 2);
            assert_true(p.near_z == FX_INT(1) && p.far_z == FX_INT(3));
        }
    }
}

static const struct sim_matrix parallel = {{{0.5, 0, 0, 0.25}, {0, 0.75, 0, -0.5}, {0, 0, -1, -2}, {0, 0, 0, 1}}};

static void a_parallel_projection_has_its_shift_in_the_last_column(void **state)
{
    (void)state;
    struct ph_projection p;
    assert_int_equal(sim_matrix_projection(&parallel, PH_GL, &p), 0);
    assert_int_equal(p.kind, PH_ORTHOGRAPHIC);
    assert_true(p.scale_x_q20 == 1 << 19 && p.scale_y_q20 == 3 << 18);
    assert_true(p.shift_x == -FX_ONE / 4 && p.shift_y == FX_ONE / 2);
    assert_true(p.near_z == FX_INT(1) && p.far_z == FX_INT(3));
    struct sim_matrix behind = parallel; /* planes at -1 and 1: an eye is nowhere */
    behind.m[2][3] = 0;
    assert_int_equal(sim_matrix_projection(&behind, PH_GL, &p), 0);
    assert_true(p.near_z == FX_INT(-1) && p.far_z == FX_INT(1));
}

static void what_no_camera_makes_is_no_projection(void **state)
{
    (void)state;
    static const struct {
        int row, column;
        double value;
    } wrong[] = {{0, 1, 0.1}, {0, 3, 0.1}, {1, 0, 0.1},  {1, 3, 0.1},  {2, 0, 0.1}, {2, 1, 0.1},
                 {3, 0, 0.1}, {3, 1, 0.1}, {3, 3, 0.1},  {3, 2, 1},    {0, 0, -1},  {1, 1, 0},
                 {2, 3, 3},   {2, 2, 0},   {0, 0, 4096}, {0, 2, 32768}};
    struct ph_projection p;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        struct sim_matrix m = perspectives[PH_GL];
        m.m[wrong[i].row][wrong[i].column] = wrong[i].value;
        assert_int_equal(sim_matrix_projection(&m, PH_GL, &p), PH_ERR_INVAL);
    }
    struct sim_matrix negative = perspectives[PH_GL]; /* only a positive multiple is the camera's */
    for (int i = 0; i < 16; i++) {
        negative.m[i / 4][i % 4] *= -1;
    }
    assert_int_equal(sim_matrix_projection(&negative, PH_GL, &p), PH_ERR_INVAL);
    for (int column = 0; column < 3; column++) {
        struct sim_matrix m = parallel;
        m.m[column == 2 ? 0 : 3][column] = 0.1;
        assert_int_equal(sim_matrix_projection(&m, PH_GL, &p), PH_ERR_INVAL);
    }
}

static void matrices_are_printed_row_by_row(void **state)
{
    (void)state;
    const struct ph_projection p = {
        .scale_x_q20 = 1 << 20, .scale_y_q20 = 2 << 20, .near_z = FX_INT(1), .far_z = FX_INT(3)};
    struct ph_projection fisheye = p;
    char *text = NULL;
    size_t n = 0;
    FILE *const file = open_memstream(&text, &n);
    assert_non_null(file);
    fisheye.kind = PH_FISHEYE;
    const struct sim_matrix_writing gl = {PH_GL, false};
    assert_int_equal(sim_matrix_print(file, &ph_xform_identity, &fisheye, 4, 2, gl), PH_ERR_INVAL);
    assert_int_equal(sim_matrix_print(file, &ph_xform_identity, &p, 4, 2, gl), 0);
    fclose(file);
    assert_string_equal(text, "view\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
                              "projection\n1 0 0 0\n0 2 0 0\n0 0 -2 -3\n0 0 -1 0\n"
                              "viewport\n2 0 0 2\n0 -1 0 1\n0 0 1 0\n0 0 0 1\n");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sixteen_numbers_are_read_row_by_row),
        cmocka_unit_test(a_matrix_that_drops_the_depth_has_a_name),
        cmocka_unit_test(a_view_is_a_rotation_and_a_move),
        cmocka_unit_test(a_left_handed_world_is_ours_with_z_turned_round),
        cmocka_unit_test(what_is_not_rigid_is_no_view),
        cmocka_unit_test(a_perspective_is_read_in_each_convention),
        cmocka_unit_test(a_parallel_projection_has_its_shift_in_the_last_column),
        cmocka_unit_test(what_no_camera_makes_is_no_projection),
        cmocka_unit_test(matrices_are_printed_row_by_row),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
