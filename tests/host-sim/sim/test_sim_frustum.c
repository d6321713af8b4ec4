/* sim_frustum: what a projection sees, against fractions of whole numbers and angles that are known. */
#define _XOPEN_SOURCE 700 /* open_memstream */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_random.h"
#include "sim_frustum.h"
#include "status.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static char *printed;

static int print(const struct ph_projection *p, fx_t distance, fx_t height)
{
    size_t length;
    free(printed);
    FILE *const file = open_memstream(&printed, &length);
    assert_non_null(file);
    const int status = sim_frustum_print(file, p, distance, height);
    fclose(file);
    return status;
}

/* Returns the rest of the line with that name, or NULL. */
static const char *line_of(const char *name)
{
    char label[32];
    snprintf(label, sizeof label, "\n%s ", name);
    const char *const line = strncmp(printed, label + 1, strlen(label + 1)) == 0 ? printed - 1 : strstr(printed, label);
    return line != NULL ? line + strlen(label) : NULL;
}

static void expect(const char *name, int64_t over, int64_t under, double most)
{
    long long a, b = 1;
    double decimal, error;
    long code;
    const char *const line = line_of(name);
    assert_non_null(line);
    if (sscanf(line, "%lld/%lld %lf %ld %lf", &a, &b, &decimal, &code, &error) != 5) {
        b = 1;
        assert_int_equal(sscanf(line, "%lld %lf %ld %lf", &a, &decimal, &code, &error), 4);
    }
    if (b < 1 || (__int128)a * under != (__int128)over * b) {
        fail_msg("%s is %lld/%lld, not %lld/%lld", name, a, b, (long long)over, (long long)under);
    }
    assert_true(fabs(decimal * (double)under - (double)over) <= 1e-9 * fabs((double)over));
    assert_true(fabs((double)code - decimal * 65536 - error) < 1e-3 && fabs(error) <= most);
}

static void expect_degrees(const char *name, double degrees)
{
    double decimal, error;
    long code;
    const char *const line = line_of(name);
    assert_non_null(line);
    assert_int_equal(sscanf(line, "- %lf %ld %lf", &decimal, &code, &error), 3);
    assert_true(fabs(decimal - degrees) < 1e-9 && fabs((double)code - degrees * 65536 - error) < 2e-3);
    assert_true(fabs(error) <= .52);
}

/* HAW: w_n / 2n = tan(theta_x / 2), a = w_n / h_n. The scales are sx / 64 and sy / 64. */
static void sizes_are_fractions_of_the_scales(void **state)
{
    (void)state;
    for (int i = 0; i < 2000; i++) {
        const int64_t sx = (int64_t)ref_uniform(1, 500), sy = (int64_t)ref_uniform(1, 500);
        const int64_t z = (int64_t)ref_uniform(1, 200), h = (int64_t)ref_uniform(1, 50);
        const bool parallel = i % 2 == 1;
        const struct ph_projection p = {.kind = parallel ? PH_ORTHOGRAPHIC : PH_PERSPECTIVE,
                                        .scale_x_q20 = (int32_t)(sx << 14),
                                        .scale_y_q20 = (int32_t)(sy << 14),
                                        .near_z = FX_ONE,
                                        .far_z = FX_INT(300)};
        assert_int_equal(print(&p, FX_INT(z), FX_INT(h)), 0);
        expect("aspect", sy, sx, .5);
        expect("size.x", 128 * (parallel ? 1 : z), sx, .501);
        expect("size.y", 128 * (parallel ? 1 : z), sy, .501);
        assert_true((line_of("fov.x") == NULL) == parallel && (line_of("fill.fov") == NULL) == parallel);
        if (!parallel) {
            const double degrees = 360 / acos(-1);
            expect_degrees("fov.x", degrees * atan2(64, (double)sx));
            expect_degrees("fov.y", degrees * atan2(64, (double)sy));
            expect_degrees("fill.fov", degrees * atan2((double)h, 2 * (double)z));
            /* the angle is off by .52 steps, and d(h/2 cot(fov/2)) / d(fov) is h/4 (1 + cot^2) */
            const double cot = (double)sy / 64, angle = (double)h / 4 * (1 + cot * cot) * .52 / degrees * 2;
            expect("fill.distance", h * sy, 128, .5 + (double)h / 64 + angle);
        }
    }
}

/* LMU: a height of 2 fills 90 degrees at the distance 1, and 2 atan(1 / 2) at twice that. */
static void the_same_size_from_half_the_distance(void **state)
{
    (void)state;
    struct ph_projection p = {.scale_x_q20 = 1 << 20, .scale_y_q20 = 2 << 20, .near_z = FX_ONE, .far_z = FX_INT(9)};
    assert_int_equal(print(&p, FX_ONE, 2 * FX_ONE), 0);
    expect_degrees("fov.x", 90);
    expect_degrees("fov.y", 53.13010235415598);
    expect_degrees("fill.fov", 90);
    expect("fill.distance", 2, 1, 1);
    assert_int_equal(print(&p, FX_ONE, 0), 0);
    assert_null(line_of("fill.fov"));
    p.kind = PH_FISHEYE;
    assert_int_equal(print(&p, FX_ONE, 0), PH_ERR_INVAL);
    assert_string_equal(printed, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_are_fractions_of_the_scales),
        cmocka_unit_test(the_same_size_from_half_the_distance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
