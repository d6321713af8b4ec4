/* sim_point: a vertex at every stage, against fractions of whole numbers that the test works out from the documents'
 * formulas in each convention. */
#define _XOPEN_SOURCE 700 /* open_memstream */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_random.h"
#include "render.h"
#include "sim_point.h"
#include "status.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static char *printed;

static int print(struct fx_vec3 point, const struct ph_xform *object, const struct ph_xform *view,
                 const struct ph_projection *p, struct sim_matrix_writing writing)
{
    size_t length;
    free(printed);
    printed = NULL;
    FILE *const file = open_memstream(&printed, &length);
    assert_non_null(file);
    const int status = sim_point_print(file, point, object, view, p, 200, 100, writing);
    fclose(file);
    return status;
}

/* Holds a line to over / under, its decimal and error to its fraction, and its error to a bound in steps. */
static void expect(const char *name, int64_t over, int64_t under, double bound)
{
    char label[32];
    snprintf(label, sizeof label, "%s ", name);
    const char *line = printed;
    while (line != NULL && strncmp(line, label, strlen(label)) != 0) {
        line = strchr(line, '\n');
        line += line != NULL;
    }
    assert_non_null(line);
    long long a, b = 1;
    double decimal, error;
    long code;
    line += strlen(label);
    if (sscanf(line, "%lld/%lld %lf %ld %lf", &a, &b, &decimal, &code, &error) != 5) {
        b = 1;
        assert_int_equal(sscanf(line, "%lld %lf %ld %lf", &a, &decimal, &code, &error), 4);
    }
    if (a * under != over * b || b < 1) {
        fail_msg("%s is %lld/%lld, not %lld/%lld", name, a, b, (long long)over, (long long)under);
    }
    const double exact = (double)over / (double)under;
    assert_true(fabs(decimal - exact) <= 1e-11 * fmax(1, fabs(exact)));
    assert_true(fabs((double)code - exact * 65536 - error) < 1e-3);
    assert_true(fabs(error) <= bound);
}

static struct fx_vec3 whole(const int v[3])
{
    return (struct fx_vec3){FX_INT(v[0]), FX_INT(v[1]), FX_INT(v[2])};
}

/* The depth in NDC at the distance d, as over / under. n, f: distances. */
static void depth_of(enum ph_convention convention, bool parallel, int64_t d, int64_t n, int64_t f, int64_t *over,
                     int64_t *under)
{
    const int64_t gl = parallel ? 2 * d - f - n : (f + n) * d - 2 * f * n, d3d = parallel ? d - n : f * d - f * n;
    *under = (f - n) * (parallel ? 1 : d);
    *over = convention == PH_GL ? gl : convention == PH_LMU ? -gl : convention == PH_D3D ? d3d : *under - d3d;
}

static void every_stage_is_the_documents_fraction(void **state)
{
    (void)state;
    for (int i = 0; i < 4000; i++) {
        const enum ph_convention convention = (enum ph_convention)(i % 4);
        const bool parallel = i % 8 >= 4, left_world = convention == PH_D3D && i % 16 == 1;
        int p[3], at[3], eye[3];
        for (int k = 0; k < 3; k++) {
            p[k] = (int)ref_uniform(-9, 9), at[k] = (int)ref_uniform(-9, 9), eye[k] = (int)ref_uniform(-9, 9);
        }
        const int n = (int)ref_uniform(1, 5), f = n + (int)ref_uniform(1, 90);
        eye[2] = p[2] + at[2] + (int)ref_uniform(1, 20); /* the point lies before the eye */
        const int64_t x = p[0] + at[0] - eye[0], y = p[1] + at[1] - eye[1], d = eye[2] - p[2] - at[2];
        const struct ph_projection lens = {.kind = parallel ? PH_ORTHOGRAPHIC : PH_PERSPECTIVE,
                                           .scale_x_q20 = 3 << 18, /* 3/4 */
                                           .scale_y_q20 = 3 << 19, /* 3/2 */
                                           .shift_x = FX_ONE / 4,
                                           .shift_y = -FX_HALF,
                                           .near_z = FX_INT(n),
                                           .far_z = FX_INT(f)};
        const struct ph_xform object = ph_xform_translate(FX_INT(at[0]), FX_INT(at[1]), FX_INT(at[2])),
                              view = ph_xform_translate(FX_INT(-eye[0]), FX_INT(-eye[1]), FX_INT(-eye[2]));
        assert_int_equal(print(whole(p), &object, &view, &lens, (struct sim_matrix_writing){convention, left_world}),
                         0);
        const int64_t side = convention == PH_LMU && !parallel ? -1 : 1, w = parallel ? 1 : d;
        int64_t over, under;
        depth_of(convention, parallel, d, n, f, &over, &under);
        expect("object.x", p[0], 1, 0);
        expect("object.z", p[2], 1, 0);
        expect("world.y", p[1] + at[1], 1, 0);
        expect("world.z", (p[2] + at[2]) * (left_world ? -1 : 1), 1, 0);
        expect("view.x", x, 1, 0);
        expect("view.z", convention == PH_D3D ? d : -d, 1, 0);
        expect("clip.x", side * (3 * x - w), 4, .5);
        expect("clip.y", side * (3 * y + w), 2, .5);
        expect("clip.z", side * over * w, under, 60); /* an element is off by 1/2, and z is up to 38 */
        expect("clip.w", side * w, 1, 0);
        expect("ndc.x", 3 * x - w, 4 * w, 2);
        expect("ndc.y", 3 * y + w, 2 * w, 2);
        expect("ndc.z", over, under, 60);
        expect("pixel.x", (3 * x + 3 * w) * 100, 4 * w, 200);
        expect("pixel.y", (convention == PH_LMU ? 3 * y + 3 * w : w - 3 * y) * 50, 2 * w, 200);
    }
}

/* A quarter turn: the object's z axis points at +x, and so its (0, 0, 2) lies at x + 2. */
static void an_object_that_looks_turns_its_point(void **state)
{
    (void)state;
    const int at[3] = {1, 0, 0}, target[3] = {5, 0, 0}, p[3] = {0, 3, 2};
    const struct fx_vec3 up = {0, FX_ONE, 0};
    const struct ph_xform object = ph_object_look_at(whole(at), whole(target), up),
                          view = ph_xform_translate(0, 0, FX_INT(-4));
    const struct ph_projection lens = {
        .scale_x_q20 = 1 << 20, .scale_y_q20 = 1 << 20, .near_z = FX_ONE, .far_z = FX_INT(9)};
    assert_int_equal(print(whole(p), &object, &view, &lens, (struct sim_matrix_writing){PH_GL, false}), 0);
    expect("world.x", 3, 1, 0);
    expect("world.y", 3, 1, 0);
    expect("world.z", 0, 1, 0);
    expect("ndc.x", 3, 4, 0);
    /* fixed16 by depth.h: floor(2^16 d + 16 1/4), d = N/w - N/f, N = (1 - 2^-9) 9/8: 10220 + 16 1/4 */
    assert_non_null(strstr(printed, "\ndepth.fixed16 10236 "));
    for (int i = 0; i < PH_DEPTH_FORMATS; i++) {
        char label[40];
        snprintf(label, sizeof label, "\ndepth.%s ", ph_depth_formats[i]->name);
        assert_true((strstr(printed, label) != NULL) == (ph_depth_formats[i] != PH_DEPTH_AUTO));
    }
}

static void a_point_beside_the_eye_has_no_picture(void **state)
{
    (void)state;
    const int p[3] = {1, 0, 0};
    const struct ph_projection lens = {
        .scale_x_q20 = 1 << 20, .scale_y_q20 = 1 << 20, .near_z = FX_ONE, .far_z = FX_INT(9)};
    const struct sim_matrix_writing gl = {PH_GL, false};
    assert_int_equal(print(whole(p), &ph_xform_identity, &ph_xform_identity, &lens, gl), PH_ERR_RANGE);
    assert_string_equal(printed, "");
}

/* Reads a line that has no fraction. */
static void read_decimal(const char *name, double *decimal, double *code)
{
    char label[32];
    snprintf(label, sizeof label, "\n%s - ", name);
    const char *const line = strstr(printed, label);
    assert_non_null(line);
    assert_int_equal(sscanf(line + strlen(label), "%lf %lf", decimal, code), 2);
}

static void expect_decimal(const char *name, double exact, double within, double code_within)
{
    double decimal, code;
    read_decimal(name, &decimal, &code);
    if (fabs(decimal - exact) > within || fabs(code / 65536 - exact) > code_within) {
        fail_msg("%s is %.9f, code %.9f, not %.9f", name, decimal, code / 65536, exact);
    }
}

/* On 100 lines: the radius is the angle's share of the field of view, times 100 px. The lens holds that scale
 * within 2^-20 of itself, and places are within 1/256 px. */
static void a_fisheye_has_the_angle_for_its_radius(void **state)
{
    (void)state;
    const double pi = acos(-1);
    uint32_t seen = 0;
    for (int i = 0; i < 4000; i++) {
        const int x = (int)ref_uniform(-9, 9), y = (int)ref_uniform(-9, 9), z = (int)ref_uniform(-9, 9);
        const int fov = (int)ref_uniform(40, 240), p[3] = {x, y, z + 5};
        const enum ph_convention convention = (enum ph_convention)(i % 4);
        const double aside = hypot(x, y), away = hypot(aside, z), angle = atan2(aside, -z);
        const struct ph_xform view = ph_xform_translate(0, 0, FX_INT(-5));
        struct ph_projection lens;
        assert_int_equal(ph_projection_fisheye(&lens, FX_INT(fov), FX_ONE, FX_INT(9)), 0);
        const bool is_near = away<1, is_far = away> 9, is_behind = angle > 170 * pi / 180;
        const int status =
            print(whole(p), &ph_xform_identity, &view, &lens, (struct sim_matrix_writing){convention, false});
        assert_int_equal(status, is_near || is_far || is_behind ? PH_ERR_RANGE : 0);
        if (status != 0) {
            assert_string_equal(printed, "");
            continue;
        }
        seen++;
        const double scale = 100 / (fov * pi / 180), radius = angle * scale, per = aside > 0 ? radius / aside : 0;
        const double held = 4e-6 * (1 + radius), drawn = held + 1.0 / 256;
        expect("object.z", z + 5, 1, 0);
        expect("view.z", convention == PH_D3D ? -z : z, 1, 0);
        expect("angle.scale", lens.scale_y_q20 * (int64_t)50, 1 << 20, 32);
        expect_decimal("distance", away, 1e-9, 1.0 / 65536);
        expect_decimal("angle.degrees", angle * 180 / pi, 1e-9, drawn / scale * 180 / pi);
        expect_decimal("angle.radians", angle, 1e-9, drawn / scale);
        expect_decimal("radius", radius, held, drawn);
        expect_decimal("pixel.x", 100 + x * per, held, drawn);
        expect_decimal("pixel.y", 50 + (convention == PH_LMU ? y : -y) * per, held, drawn);
        assert_null(strstr(printed, "clip"));
        assert_null(strstr(printed, "depth"));
    }
    assert_in_range(seen, 1000, 3500);
}

static void flatten(const int p[3], const struct ph_mat4 *flat, enum ph_convention convention)
{
    const struct ph_xform object = ph_xform_translate(FX_ONE, 0, 0), view = ph_xform_translate(0, 0, FX_INT(-4));
    size_t length;
    free(printed);
    FILE *const file = open_memstream(&printed, &length);
    assert_non_null(file);
    sim_point_flatten(file, whole(p), &object, &view, flat, (struct sim_matrix_writing){convention, false});
    fclose(file);
}

/* KAIST 4.11: w = z; HAW: onto the plane 3 before the eye; the point (1 + 1, 4, 2 - 4) in the camera's coordinates. */
static void a_flattened_point_is_divided_by_its_w(void **state)
{
    (void)state;
    const int p[3] = {1, 4, 2}, beside[3] = {1, 4, 4};
    const struct ph_mat4 kaist = {{{FX_ONE}, {0, FX_ONE}, {0}, {0, 0, FX_ONE, 0}}};
    const struct ph_mat4 haw = ph_matrix_plane((struct fx_vec3){0, 0, 1 << 30}, FX_INT(3));
    flatten(p, &kaist, PH_GL);
    expect("flatten.x", 2, 1, 0), expect("flatten.y", 4, 1, 0), expect("flatten.z", 0, 1, 0);
    expect("flatten.w", -2, 1, 0), expect("divided.x", -1, 1, 0), expect("divided.y", -2, 1, 0);
    expect("divided.z", 0, 1, 0);
    flatten(p, &kaist, PH_D3D);
    expect("flatten.w", 2, 1, 0), expect("divided.x", 1, 1, 0), expect("divided.y", 2, 1, 0);
    flatten(p, &haw, PH_GL);
    expect("flatten.x", 6, 1, 0), expect("flatten.y", 12, 1, 0), expect("flatten.z", -6, 1, 0);
    expect("flatten.w", 2, 1, 0), expect("divided.x", 3, 1, 0), expect("divided.y", 6, 1, 0);
    expect("divided.z", -3, 1, 0);
    flatten(beside, &kaist, PH_GL);
    expect("flatten.w", 0, 1, 0);
    assert_null(strstr(printed, "divided"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_stage_is_the_documents_fraction),
        cmocka_unit_test(an_object_that_looks_turns_its_point),
        cmocka_unit_test(a_point_beside_the_eye_has_no_picture),
        cmocka_unit_test(a_fisheye_has_the_angle_for_its_radius),
        cmocka_unit_test(a_flattened_point_is_divided_by_its_w),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
