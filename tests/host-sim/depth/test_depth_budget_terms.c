/* depth_budget_terms: codes and their steps from the definitions of depth.h, in long double; and bounds for cameras
 * whose numbers can be worked out by hand. That nothing that is measured exceeds the bounds is shown by
 * test_depth_planes. */
#include "depth_budget_terms.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static struct depth_lab lab_of(double near_m, double far_m)
{
    return (struct depth_lab){.near_z = (fx_t)lround(near_m * 65536),
                              .far_z = (fx_t)lround(far_m * 65536),
                              .fov_deg = FX_INT(90),
                              .width = 320,
                              .height = 240,
                              .formats = UINT32_MAX};
}

static void near_to(double value, double expected, double relative)
{
    if (!(fabs(value - expected) <= relative * fabs(expected))) {
        fail_msg("%.17g is not %.17g", value, expected);
    }
}

/* F of depth.h, octave by octave from 1/2 down. */
static long double float_of(long double d, int e)
{
    const int octaves = (1 << e) - 2;
    const long double m = exp2l(16 - e);
    long double f = 2 * m * d + octaves * m, slope = 2 * m, top = .5L; /* in 1/2 .. 1 */
    long double at_top = (1 + octaves) * m;
    for (int k = 1; k <= octaves && d < top; k++) {
        slope *= 2;
        f = at_top - slope * (top - d);
        at_top -= slope * top / 2;
        top /= 2;
    }
    return f;
}

static double defined_code(const struct ph_depth_format *format, double n, double f, double z, int e)
{
    const long double head = e == 5 ? 1 - exp2l(-8) : e == 6 ? 1 - exp2l(-7) : 1 - exp2l(-9);
    const long double fixed_n = (1 - exp2l(-9)) * fminl((long double)n * f / (f - n), 8 * (long double)n);
    const long double fixed = fixed_n / z - fixed_n / f, other = head * n / z - head * n / f;
    if (format == PH_DEPTH_LINEAR_W) {
        return (double)(65408 * ((long double)f - z) / ((long double)f - n) + 16);
    }
    const bool is_fixed = format == PH_DEPTH_FIXED16 || format == PH_DEPTH_FIXED24;
    const bool has_24_bits = format == PH_DEPTH_FIXED24 || format == PH_DEPTH_FLOAT24;
    return (double)((has_24_bits ? 256 : 1) * (is_fixed ? 65536 * fixed + 16.25L : float_of(other, e) + 8));
}

static const struct ph_depth_format *const formats[] = {PH_DEPTH_FIXED16, PH_DEPTH_FLOAT16, PH_DEPTH_FIXED24,
                                                        PH_DEPTH_FLOAT24, PH_DEPTH_LINEAR_W};
enum { FORMATS = sizeof formats / sizeof formats[0] };

/* Ratios with 3, 4 and 5 bits of exponent, and one where N is 8 n. */
static const struct {
    double near_m, far_m;
    int exponent;
} cameras[] = {{.5, 32, 3}, {.5, 100, 4}, {.125, 2048, 4}, {.125, 4096, 5}, {8, 8.5, 3}};
enum { CAMERAS = sizeof cameras / sizeof cameras[0] };

static void codes_are_those_of_their_definition(void **state)
{
    (void)state;
    for (int c = 0; c < CAMERAS; c++) {
        const double n = cameras[c].near_m, f = cameras[c].far_m;
        struct depth_lab lab = lab_of(n, f);
        for (int k = 0; k <= 20; k++) {
            const double z = n * pow(f / n, k / 20.);
            for (int i = 0; i < FORMATS; i++) {
                const double code = depth_code_at(formats[i], &lab, z);
                near_to(code, defined_code(formats[i], n, f, z, cameras[c].exponent), 1e-9);
                near_to(depth_distance_of(formats[i], &lab, code), z, 1e-7);
            }
        }
        for (lab.exponent = 3; lab.exponent <= 6; lab.exponent++) {
            near_to(depth_code_at(PH_DEPTH_FLOAT16, &lab, 1.01 * n),
                    defined_code(PH_DEPTH_FLOAT16, n, f, 1.01 * n, lab.exponent), 1e-9);
            near_to(depth_code_of_float(PH_DEPTH_FLOAT24, &lab, .3), (double)(256 * (float_of(.3L, lab.exponent) + 8)),
                    1e-12);
        }
    }
}

/* A step is what a distance changes by from code to code: in the middle of a code, where it is no kink of a float. */
static void a_step_is_the_distance_of_two_codes(void **state)
{
    (void)state;
    for (int c = 0; c < CAMERAS; c++) {
        const double n = cameras[c].near_m, f = cameras[c].far_m;
        const struct depth_lab lab = lab_of(n, f);
        for (int k = 1; k < 20; k++) {
            const double z = n * pow(f / n, (k + .03) / 20.);
            for (int i = 0; i < FORMATS; i++) {
                const double code = defined_code(formats[i], n, f, z, cameras[c].exponent), h = 1e-6 * z;
                const double slope = (defined_code(formats[i], n, f, z - h, cameras[c].exponent) - code) / h;
                near_to(depth_step_m(formats[i], &lab, z), 1 / slope, 1e-3);
            }
        }
    }
}

/* Under a parallel projection d is linear in z: 1 - 2^-9 over the range, with 16 or 24 bits. */
static void a_parallel_step_is_the_same_everywhere_but_of_a_float(void **state)
{
    const struct depth_lab lab = lab_of(1, 17);
    (void)state;
    near_to(depth_step_parallel_m(PH_DEPTH_FIXED16, &lab, 3), 16 / (511 / 512.) / 65536, 1e-12);
    near_to(depth_step_parallel_m(PH_DEPTH_FIXED24, &lab, 16), 16 / (511 / 512.) / 16777216, 1e-12);
    /* 3 bits of exponent: 13 of mantissa, for the octave of d from 1/2 to 1 */
    near_to(depth_step_parallel_m(PH_DEPTH_FLOAT16, &lab, 3), 16 / (511 / 512.) / 16384, 1e-12);
    near_to(depth_step_parallel_m(PH_DEPTH_FLOAT16, &lab, 11), 16 / (511 / 512.) / 32768, 1e-12);
}

/* 90 degrees: half of the picture's height is 1, of its width 4/3. */
static void the_picture_is_as_large_as_its_lens_says(void **state)
{
    const struct depth_lab lab = lab_of(1, 100);
    double along, across;
    (void)state;
    near_to(depth_pixel_slope(&lab), 2 / 240., 1e-12);
    depth_planes_extent(&lab, 0, &along, &across);
    assert_true(fabs(along - 1) < 1e-9 && fabs(across - 4 / 3.) < 1e-9);
    depth_planes_extent(&lab, -90, &along, &across);
    assert_true(fabs(along - 4 / 3.) < 1e-9 && fabs(across - 1) < 1e-9);
    depth_planes_extent(&lab, 30, &along, &across);
    near_to(along, sqrt(3) / 2 + 2 / 3., 1e-9);
    near_to(across, 4 / 3. * sqrt(3) / 2 + .5, 1e-9);
    depth_planes_extent(&lab, NAN, &along, &across);
    assert_true(fabs(along - 5 / 3.) < 1e-9 && along == across);
}

static void formats_that_are_asked_for_and_drawn_have_a_bit(void **state)
{
    struct depth_lab lab = lab_of(1, 100);
    (void)state;
    for (uint32_t i = 0; i < lab_format_count; i++) {
        assert_int_equal(depth_drawn_formats(&lab) >> i & 1, lab_formats[i].kind == LAB_DRAWN);
        lab.formats = (uint32_t)1 << i;
        assert_int_equal(depth_drawn_formats(&lab), lab_formats[i].kind == LAB_DRAWN ? lab.formats : 0);
        lab.formats = UINT32_MAX;
    }
}

static void simple_shares_are_those_of_their_formulas(void **state)
{
    const struct depth_lab lab = lab_of(1, 100);
    (void)state;
    for (double z = 1; z <= 64; z *= 4) {
        near_to(depth_share_m(DEPTH_SHARE_INPUT, PH_DEPTH_FIXED16, &lab, z), 1 / 65536., 1e-12);
        near_to(depth_share_m(DEPTH_SHARE_MATRIX, PH_DEPTH_FIXED16, &lab, z), 1 / 65536. + 2.6 * z / 268435456, 1e-12);
        near_to(depth_share_m(DEPTH_SHARE_DIVIDE, PH_DEPTH_FIXED16, &lab, z), 3 * z / 1073741824, 1e-12);
        near_to(depth_subpixel_m(&lab, 8, z), 1.4142135623730951 / 256 * z / 120, 1e-12);
        near_to(depth_subpixel_m(&lab, 4, z), 1.4142135623730951 / 16 * z / 120, 1e-12);
        /* the lens's focal length of 120 px lies below 2^8, which reaches over 320 px: 256 / 120 */
        near_to(depth_share_m(DEPTH_SHARE_SUBPIXEL, PH_DEPTH_FIXED16, &lab, z),
                1.4142135623730951 * (z / 120 / 256 + 256 / 120. / 65536 + 256 / 120. * z / 16777216), 1e-12);
    }
    near_to(depth_s_min_m(3, 4, 0), 5, 1e-12);
    near_to(depth_s_min_m(0, 4, .75), 5, 1e-12);
    near_to(depth_s_min_m(1, 2, 2), sqrt(29), 1e-12);
}

/* A plateau of codes is a step, and what the grid of w and the quotients add; it grows with the step. */
static void the_share_of_storing_is_a_step_and_little_more(void **state)
{
    (void)state;
    for (int c = 0; c < CAMERAS - 1; c++) {
        const struct depth_lab lab = lab_of(cameras[c].near_m, cameras[c].far_m);
        for (int i = 0; i < FORMATS; i++) {
            for (double z = 2 * cameras[c].near_m; z < cameras[c].far_m / 2; z *= 3) {
                const double step = depth_step_m(formats[i], &lab, z),
                             share = depth_share_m(DEPTH_SHARE_STORE, formats[i], &lab, z);
                const double grid = 1 / 65536., grain = ldexp(z * z / cameras[c].near_m, -28);
                assert_true(share >= fmax(.45 * step, grid)); /* beside the border of an octave it is half as long */
                assert_true(share <= 1.2 * step + 4 * grid + 4 * grain);
            }
        }
    }
}

/* fixed24 and linear-w at 45 degrees: 90 degrees of lens, so that the near edge is half as far as the far one. */
static void interpolation_is_the_longest_way_in_units(void **state)
{
    const struct depth_lab lab = lab_of(1, 1024);
    const double z = 64, head = 511 / 512., edge = 4 / 3. * 2 * 120, half = 200; /* of the diagonal of 400 px */
    const double way = hypot(120, edge + fmin(edge, half)) / sqrt(2);
    (void)state;
    const struct planes_lean lean = {z, 45, 0};
    near_to(depth_interpolation_m(PH_DEPTH_FIXED24, &lab, lean, z),
            (2 * way + 4) / 4294967296. * z * z / (head * 1024 / 1023) + 3 * z / 1073741824, 1e-9);
    near_to(depth_interpolation_m(PH_DEPTH_FIXED16, &lab, lean, z),
            (2 * way + 514) / 4294967296. * z * z / (head * 1024 / 1023) + 3 * z / 1073741824, 1e-9);
    /* N/w of the near edge, head / 32, is in the octave below 1/32 */
    near_to(depth_interpolation_m(PH_DEPTH_LINEAR_W, &lab, lean, z),
            (2 * way + 8) * ldexp(1, -6 - 28) * z * z / head + 3 * z / 1073741824 + 2 * 1024 / 1073741824., 1e-9);
    near_to(depth_share_m(DEPTH_SHARE_INTERPOLATION, PH_DEPTH_FIXED24, &lab, z),
            depth_interpolation_m(PH_DEPTH_FIXED24, &lab, lean, z), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(codes_are_those_of_their_definition),
        cmocka_unit_test(a_step_is_the_distance_of_two_codes),
        cmocka_unit_test(a_parallel_step_is_the_same_everywhere_but_of_a_float),
        cmocka_unit_test(the_picture_is_as_large_as_its_lens_says),
        cmocka_unit_test(formats_that_are_asked_for_and_drawn_have_a_bit),
        cmocka_unit_test(simple_shares_are_those_of_their_formulas),
        cmocka_unit_test(the_share_of_storing_is_a_step_and_little_more),
        cmocka_unit_test(interpolation_is_the_longest_way_in_units),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
