/* lab_probe: the codes of each format, against what lab_formats.h says of it in floating point; and those that are
 * drawn against depth.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "lab_probe.h"

#include <math.h>
#include <string.h>

static struct lab_probe probe;

static const struct lab_format *format_of(const char *name, int bits)
{
    for (uint32_t i = 0; i < lab_format_count; i++) {
        if (strcmp(lab_formats[i].name, name) == 0 && lab_formats[i].bits == bits) {
            return &lab_formats[i];
        }
    }
    fail_msg("no %s with %d bits", name, bits);
    return NULL;
}

static const double planes[][2] = {{.5, 100}, {.1, 1000}, {1, 30000}, {8, 8.5}, {.01, 30000}};

static void open_probe(const char *name, int bits, const double n_f[2])
{
    assert_int_equal(
        lab_probe_open(&probe, format_of(name, bits), (fx_t)lround(n_f[0] * 65536), (fx_t)lround(n_f[1] * 65536)), 0);
}

/* The near and the far plane, and distances between them; a code may be `off` from the value in doubles, rounded down.
 */
static void expect_codes(const char *name, int bits, double (*value)(double n, double f, double w, int bits),
                         double off)
{
    for (size_t i = 0; i < sizeof planes / sizeof planes[0]; i++) {
        open_probe(name, bits, planes[i]);
        const double n = probe.near_z, f = probe.far_z;
        for (int k = 0; k <= 200; k++) {
            const double w = floor(n * pow(f / n, k / 200.));
            const double expected = value(n, f, w, bits), code = lab_code(&probe, (fx_t)w);
            if (fabs(code + .5 - expected) > .5 + off) {
                fail_msg("%s %d bits at %g of %g .. %g: %g is not %g", name, bits, w, n, f, code, expected);
            }
        }
    }
}

static double largest(int bits)
{
    return exp2(bits) - 1;
}

static double linear(double n, double f, double w, int bits)
{
    return largest(bits) * (f - w) / (f - n);
}

/* The logarithm of a distance is rounded down at each step, and the quotient once more. */
static void linear_and_logarithmic_codes_are_those_of_their_formulas(void **state)
{
    (void)state;
    expect_codes("linear-w", 24, linear, 0);
    for (size_t i = 0; i < sizeof planes / sizeof planes[0]; i++) {
        for (int bits = 16; bits <= 24; bits += 8) {
            open_probe("log", bits, planes[i]);
            const double n = probe.near_z, f = probe.far_z;
            for (int k = 1; k <= 200; k++) {
                const double w = ceil(n * pow(f / n, k / 201.));
                const double code = largest(bits) * log(f / w) / log(f / n);
                assert_true(fabs(lab_code(&probe, (fx_t)w) + .5 - code) <= 1.51);
            }
            assert_int_equal(lab_code(&probe, probe.far_z), 0);
        }
    }
}

/* n/w in four bits of exponent: in 1/2 .. 1 the mantissa is 2^(bits - 3) (n/w - 1/2), and an octave is half as coarse.
 */
static double over_w(double n, double f, double w, int bits)
{
    int exponent;
    const double share = n / w, fraction = frexp(share, &exponent); /* 1/2 .. 1 */
    const double octave = fmin(-exponent, 14), mantissa = exp2(bits - 4);
    (void)f;
    if (share >= 1) {
        return largest(bits);
    }
    return -exponent > 14 ? ldexp(share, 15) * mantissa : (2 * fraction - 1) * mantissa + (15 - octave) * mantissa;
}

static void a_float_of_n_over_w_has_four_bits_of_exponent(void **state)
{
    (void)state;
    expect_codes("over-w", 16, over_w, 1e-6);
    expect_codes("over-w", 24, over_w, 1e-3);
}

/* ndc = f (w - n) / (w (f - n)), from 0 to 1, with what Q16.16 loses on the way: one of 65,536 of the quotient; the
 * product with a reciprocal loses w / 2^17, and so does that of clip. */
static double ndc(double n, double f, double w, int bits)
{
    return largest(bits) * (1 - f * (w - n) / (w * (f - n)));
}

static void fixed_codes_are_those_of_ndc(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof planes / sizeof planes[0]; i++) {
        static const char *const names[3] = {"ndc-q16", "clip-q16", "recip-q16"};
        for (int k = 0; k < 3; k++) {
            for (int bits = 16; bits <= 24; bits += 8) {
                open_probe(names[k], bits, planes[i]);
                const double n = probe.near_z, f = probe.far_z;
                for (int step = 0; step <= 100; step++) {
                    const double w = floor(n * pow(f / n, step / 100.)), unit = exp2(bits - 16);
                    /* scale and bias are half an LSB off: w / 2^17 and 1/2 of w, and then a quotient that is rounded */
                    const double off = unit * (1.5 + 32768 / w + .5 * (1 + f / (f - n))) +
                                       (k == 2 ? unit * (w / 65536 * f / (f - n) + 1) : 0);
                    assert_true(fabs(lab_code(&probe, (fx_t)w) - ndc(n, f, w, bits)) <= off + 1);
                }
            }
        }
    }
}

static void drawn_codes_are_those_of_depth_h(void **state)
{
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        for (int bits = 16; bits <= 24; bits += 8) {
            open_probe(bits == 16 ? "fixed16" : "fixed24", bits, planes[i]);
            const double n = probe.near_z / 65536., f = probe.far_z / 65536., head = 511 / 512. * n * f / (f - n);
            for (int k = 0; k <= 100; k++) {
                const fx_t w = (fx_t)floor(65536 * n * pow(f / n, k / 100.));
                const double d = head / (w / 65536.) - head / f,
                             code = bits == 16 ? 65536 * d + 16.25 : 16777216 * d + 4160;
                assert_true(fabs(lab_code(&probe, w) + .5 - code) < (bits == 16 ? .51 : 1.6));
            }
        }
    }
}

static void impossible_planes_are_refused(void **state)
{
    (void)state;
    assert_int_equal(lab_probe_open(&probe, format_of("fixed16", 16), 0, 5), PH_ERR_INVAL);
    assert_int_equal(lab_probe_open(&probe, format_of("fixed16", 16), -1, 5), PH_ERR_INVAL);
    assert_int_equal(lab_probe_open(&probe, format_of("log", 16), 5, 5), PH_ERR_INVAL);
    assert_int_equal(lab_probe_open(&probe, format_of("log", 16), 1, 2), 0);
    assert_int_equal(probe.largest, 65535);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_and_logarithmic_codes_are_those_of_their_formulas),
        cmocka_unit_test(a_float_of_n_over_w_has_four_bits_of_exponent),
        cmocka_unit_test(fixed_codes_are_those_of_ndc),
        cmocka_unit_test(drawn_codes_are_those_of_depth_h),
        cmocka_unit_test(impossible_planes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
