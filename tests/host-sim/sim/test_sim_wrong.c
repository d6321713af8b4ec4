/* sim_wrong: what is said of matrices that are no camera, by hand for n = 2, f = 10 and for what the documents print;
 * and where points fall that are drawn through them, against the matrices' own products in doubles. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_random.h"
#include "sim_wrong.h"
#include "status.h"

#include <math.h>
#include <string.h>

struct wrong {
    enum ph_convention convention;
    const char *matrix, *said;
};

static void expect(const struct wrong *cases, size_t count,
                   void (*tell)(const struct sim_matrix *, enum ph_convention, char text[SIM_WRONG_TEXT]))
{
    for (size_t i = 0; i < count; i++) {
        struct sim_matrix m;
        char text[SIM_WRONG_TEXT] = "";
        assert_true(sim_matrix_read(cases[i].matrix, &m));
        tell(&m, cases[i].convention, text);
        assert_string_equal(text, cases[i].said);
    }
}

/* Depths by hand: GL (-1.5 z + 5) / -z at z = -2 is 4 and at -10 is 2; (1.5 z - 5) / -z is -4 and -2. EECE's
 * orthographic matrix with n = 2, f = 10: -z / 4 + 1.5 is 2 and 4; with n = 1, f = 9: -z / 4 + 1.25 is 1.5 and 3.5.
 * D3D: 1.25 - 2.5 / z is 0 and 1; with + it is 2.5 and 1.5. LMU: (-1.5 z + 5) / z is -4 and -2. */
static void what_is_wrong_with_a_lens_has_its_element(void **state)
{
    (void)state;
    static const struct wrong cases[] = {
        {PH_GL, ".5,0,0,0,0,1,0,0,0,0,-1.5,5,0,0,-1,0",
         "row 2, column 3 has the other sign: near goes to 4, not -1, and far to 2, not 1"},
        {PH_GL, ".5,0,0,0,0,1,0,0,0,0,1.5,-5,0,0,-1,0",
         "row 2, column 2 has the other sign: near goes to -4, not -1, and far to -2, not 1"},
        {PH_D3D, ".5,0,0,0,0,1,0,0,0,0,1.25,2.5,0,0,1,0",
         "row 2, column 3 has the other sign: near goes to 2.5, not 0, and far to 1.5, not 1"},
        {PH_LMU, "-.5,0,0,0,0,-1,0,0,0,0,-1.5,5,0,0,1,0",
         "row 2, column 3 has the other sign: near goes to -4, not 1, and far to -2, not -1"},
        {PH_GL, ".5,0,0,0,0,1,0,0,0,0,-.25,1.25,0,0,0,1",
         "row 2, column 3 has the other sign: near goes to 1.5, not -1, and far to 3.5, not 1"},
        {PH_GL, ".5,0,0,.25,0,1,0,0,0,0,-.25,1.5,0,0,0,1",
         "row 2, column 3 has the other sign: near goes to 2, not -1, and far to 4, not 1; rows 0 and 1 may have it, "
         "too: EECE 478 prints all three so"},
        {PH_GL, "-.5,0,0,0,0,1,0,0,0,0,-1.5,-5,0,0,-1,0",
         "row 0, column 0 has the other sign: the picture is mirrored left to right"},
        {PH_GL, "-.5,0,0,0,0,-1,0,0,0,0,-1.5,-5,0,0,-1,0",
         "row 0, column 0 has the other sign: the picture is mirrored left to right; row 1, column 1 has the other "
         "sign: the picture is upside down"},
        {PH_GL, ".5,0,0,0,0,1,0,0,0,0,-1.5,-5,0,0,1,0",
         "row 3, column 2 has the other sign: w is below 0 for what lies before the camera"},
        {PH_GL, ".5,0,0,0,0,1,0,0,0,0,-1.5,-1,0,0,-5,0",
         "transposed: row 3 must have what column 3 has, and column 3 what row 3 has"},
        {PH_GL, ".5,0,0,0,0,1,0,0,0,0,1.5,5,0,0,-1,0", "near and far are swapped: near would be at 10 and far at 2"},
        {PH_D3D, ".5,0,0,0,0,1,0,0,0,0,-.25,2.5,0,0,1,0", "near and far are swapped: near would be at 10 and far at 2"},
        {PH_GL, ".5,0,0,0,0,1,0,0,0,0,1.25,-2.5,0,0,1,0",
         "is a lens as another convention writes it; give --convention d3d"},
        {PH_GL, "-.5,0,0,0,0,-1,0,0,0,0,-1.5,-5,0,0,1,0",
         "is a lens as another convention writes it; give --convention lmu"},
        {PH_GL, ".5,0,0,0,0,1,0,0,0,0,.25,2.5,0,0,-1,0",
         "is a lens as another convention writes it; give --convention reversed"},
        {PH_GL, "-.5,0,0,0,0,-1,0,0,0,0,-1.5,5,0,0,-1,0",
         "row 0, column 0 has the other sign: the picture is mirrored left to right; row 1, column 1 has the other "
         "sign: the picture is upside down; row 2, column 3 has the other sign: near goes to 4, not -1, and far to 2, "
         "not 1"},
        {PH_LMU, ".5,0,0,0,0,1,0,0,0,0,.25,1.5,0,0,0,-1",
         "row 3, column 3 has the other sign: w is below 0 for what lies before the camera"},
        {PH_GL, ".5,.125,0,0,0,1,0,0,0,0,-1.5,-5,0,0,-1,0", "row 0, column 1 is 0.125 and must be 0"},
        {PH_GL, ".5,0,0,0,0,1,0,0,0,0,-1.5,-5,.125,0,-1,0", "row 3, column 0 is 0.125 and must be 0"},
        {PH_GL, ".5,0,0,0,0,1,0,0,0,0,-1,-4,0,0,-1,0", "the far plane is infinitely far away, and Pinhole's is not"},
        {PH_GL, "1,0,0,0,0,1,0,0,0,0,0,0,0,0,0,1", "flattens: no depth, every point gets 0"},   /* KAIST 4.7 */
        {PH_GL, "1,0,0,0,0,1,0,0,0,0,0,0,0,0,1,0", "flattens: no depth, every point gets 0"},   /* KAIST 4.11 */
        {PH_GL, "1,0,0,0,0,1,0,0,0,0,1,0,0,0,.25,0", "flattens: no depth, every point gets 4"}, /* EECE, d = 4 */
        {PH_GL, "2,0,0,0,0,2,0,0,0,0,2,0,0,0,-1,0", "flattens: no depth, every point gets -2"}, /* HAW, n = 2 */
        {PH_GL, "2,0,0,0,0,2,0,0,0,0,2,0,0,-1,0,0",
         "flattens: its determinant is 0, so that no depth is left"}, /* HAW, the plane y = 2 */
        {PH_GL, "1,2,3,4,5,6,7,8,9,10,11,13,13,14,16,17",
         "is not a lens of the --convention, which gives w its sign and the depth its range; see camera.h"},
    };
    expect(cases, sizeof cases / sizeof cases[0], sim_wrong_lens);
}

static void what_is_wrong_with_a_view_is_told(void **state)
{
    (void)state;
    static const struct wrong cases[] = {
        {PH_GL, "1,0,0,0,0,1,0,0,0,0,1,0,0,0,-5,1",
         "transposed: the way to the eye stands in row 3; it belongs in column 3"},
        {PH_GL, "1,0,0,0,0,1,0,0,0,0,-1,-5,0,0,0,1",
         "handedness: determinant -1, so it mirrors; a camera of this convention has 1. With d3d both hands are "
         "cameras"},
        {PH_GL, "2,0,0,0,0,2,0,0,0,0,2,0,0,0,0,1", "scales by 2: a camera's rows have the length 1"},
        {PH_GL, "1,0,0,0,0,2,0,0,0,0,1,0,0,0,0,1", "row 1 has the length 2, not 1"},
        {PH_D3D, "1,0,0,0,0,1,0,0,.6,0,.8,0,0,0,0,1",
         "shears: rows 0 and 2 are not at right angles, their product is 0.6, not 0"},
        {PH_GL, "1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2", "row 3 is 0,0,0,2, not 0,0,0,1"},
        {PH_GL, "1,0,0,0,0,1,0,0,0,0,0,-5,0,0,0,1", "flattens: the determinant of its rotation is 0"},
    };
    expect(cases, sizeof cases / sizeof cases[0], sim_wrong_view);
}

static double real(fx_t x)
{
    return x / (double)FX_ONE;
}

/* Where a point falls, by the camera that draws a matrix: x, y, and its distance. */
static void seen(const struct ph_xform *view, const struct ph_projection *p, const double point[3], double out[3])
{
    double v[3];
    const double t[3] = {real(view->t.x), real(view->t.y), real(view->t.z)};
    for (int i = 0; i < 3; i++) {
        v[i] = t[i];
        for (int j = 0; j < 3; j++) {
            v[i] += view->r[i][j] / (double)(1 << 30) * point[j];
        }
    }
    const double w = p->kind == PH_PERSPECTIVE ? -v[2] : 1;
    out[0] = p->scale_x_q20 / (double)(1 << 20) * v[0] / w;
    out[1] = p->scale_y_q20 / (double)(1 << 20) * v[1] / w;
    out[2] = -v[2];
}

static const double unit[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

static void any_matrix_draws_its_own_x_and_y(void **state)
{
    (void)state;
    int tested = 0;
    for (int i = 0; i < 3000; i++) {
        const enum ph_convention convention = (enum ph_convention)(i % 4);
        const double side = convention == PH_LMU && i % 8 < 4 ? -1 : 1; /* of w where it is seen */
        struct sim_matrix view, lens;
        struct ph_xform drawn;
        struct ph_projection p;
        for (int k = 0; k < 16; k++) {
            view.m[k / 4][k % 4] = unit[k] + ref_uniform(-.5, .5);
            lens.m[k / 4][k % 4] = unit[k] + ref_uniform(-.5, .5);
        }
        for (int k = 0; k < 4; k++) {
            view.m[3][k] = unit[12 + k];
            lens.m[3][k] = i % 8 < 4 ? (k == 2 ? (convention == PH_D3D ? 1 : side * -1) : 0) : unit[12 + k];
        }
        if (sim_wrong_camera(&view, &lens, convention, &drawn, &p) != 0) {
            continue;
        }
        for (int n = 0; n < 5; n++) {
            const double point[4] = {ref_uniform(-3, 3), ref_uniform(-3, 3), ref_uniform(-9, 9), 1};
            double camera[4] = {0}, clip[4] = {0}, got[3];
            for (int k = 0; k < 16; k++) {
                camera[k / 4] += view.m[k / 4][k % 4] * point[k % 4];
            }
            for (int k = 0; k < 16; k++) {
                clip[k / 4] += lens.m[k / 4][k % 4] * camera[k % 4];
            }
            if (clip[3] * side < .5) {
                continue;
            }
            seen(&drawn, &p, point, got);
            assert_true(fabs(got[0] - clip[0] / clip[3]) < 1e-3 && fabs(got[1] - clip[1] / clip[3]) < 1e-3);
            tested++;
        }
    }
    assert_true(tested > 2000);
}

/* n = 1, f = 3: the camera that draws a lens is the lens itself, in every convention, with a view that is none. */
static void a_right_lens_is_drawn_as_it_is(void **state)
{
    (void)state;
    static const char *const lenses[] = {
        [PH_GL] = "1,0,0,0,0,2,0,0,0,0,-2,-3,0,0,-1,0",
        [PH_D3D] = "1,0,0,0,0,2,0,0,0,0,1.5,-1.5,0,0,1,0",
        [PH_LMU] = "-1,0,0,0,0,-2,0,0,0,0,-2,-3,0,0,1,0",
        [PH_REVERSED] = "1,0,0,0,0,2,0,0,0,0,.5,1.5,0,0,-1,0",
    };
    for (int c = PH_GL; c <= PH_REVERSED; c++) {
        struct sim_matrix lens, view = {{{1}, {0, 1}, {0, 0, c == PH_D3D ? -1 : 1}, {0, 0, 0, 1}}};
        struct ph_xform drawn;
        struct ph_projection p;
        assert_true(sim_matrix_read(lenses[c], &lens));
        assert_int_equal(sim_wrong_camera(&view, &lens, (enum ph_convention)c, &drawn, &p), 0);
        assert_true(p.kind == PH_PERSPECTIVE && p.near_z == FX_ONE && p.far_z == FX_INT(3));
        assert_true(p.scale_x_q20 == 1 << 20 && p.scale_y_q20 == 2 << 20);
        assert_memory_equal(&drawn, &ph_xform_identity, sizeof drawn);
    }
    struct sim_matrix lens, view = {{{1}, {0, 1}, {0, 0, 1}, {0, 0, 0, 1}}};
    struct ph_xform drawn;
    struct ph_projection p;
    const double points[2][3] = {{0, 0, -2}, {0, 0, -10}}; /* parallel, n = 2 and f = 10 */
    double near[3], far[3];
    assert_true(sim_matrix_read(".5,0,0,0,0,1,0,0,0,0,-.25,-1.5,0,0,0,1", &lens));
    assert_int_equal(sim_wrong_camera(&view, &lens, PH_GL, &drawn, &p), 0);
    seen(&drawn, &p, points[0], near);
    seen(&drawn, &p, points[1], far);
    assert_true(p.kind == PH_ORTHOGRAPHIC && fabs(near[2] - real(p.near_z)) < 1e-4 &&
                fabs(far[2] - real(p.far_z)) < 1e-4);
}

static void a_depth_that_is_nowhere_in_range_draws_nothing(void **state)
{
    (void)state;
    struct sim_matrix lens, view = {{{1}, {0, 1}, {0, 0, 1}, {0, 0, 0, 1}}};
    struct ph_xform drawn;
    struct ph_projection p;
    assert_true(sim_matrix_read(".5,0,0,0,0,1,0,0,0,0,-1.5,5,0,0,-1,0", &lens)); /* 1.5 + 5 / w > 1 */
    assert_int_equal(sim_wrong_camera(&view, &lens, PH_GL, &drawn, &p), 1);
    assert_true(sim_matrix_read("1,0,0,0,0,1,0,0,0,0,-1,0,0,0,0,-1", &lens));
    assert_int_equal(sim_wrong_camera(&view, &lens, PH_GL, &drawn, &p), 1);
    assert_true(sim_matrix_read(".5,0,0,0,0,1,0,0,0,0,-1,-4,0,0,-1,0", &lens)); /* 1 - 4 / w: from 2 on */
    assert_int_equal(sim_wrong_camera(&view, &lens, PH_GL, &drawn, &p), 0);
    assert_true(p.near_z == FX_INT(2) && p.far_z == FX_INT(32767));
    assert_true(sim_matrix_read("2,0,0,0,0,2,0,0,0,0,2,0,0,0,-1,0", &lens)); /* -2 everywhere: .1 is 6553.6 steps */
    assert_int_equal(sim_wrong_camera(&view, &lens, PH_GL, &drawn, &p), 0);
    assert_true(p.near_z == 6554 && p.far_z == FX_INT(1000));
    assert_true(sim_matrix_read("5000,0,0,0,0,1,0,0,0,0,-1.5,-5,0,0,-1,0", &lens)); /* 5000 is not in Q12.20 */
    assert_int_equal(sim_wrong_camera(&view, &lens, PH_GL, &drawn, &p), PH_ERR_RANGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_wrong_with_a_lens_has_its_element),
        cmocka_unit_test(what_is_wrong_with_a_view_is_told),
        cmocka_unit_test(any_matrix_draws_its_own_x_and_y),
        cmocka_unit_test(a_right_lens_is_drawn_as_it_is),
        cmocka_unit_test(a_depth_that_is_nowhere_in_range_draws_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
