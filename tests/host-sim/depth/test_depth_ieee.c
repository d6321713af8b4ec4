/* depth_ieee: the counts that N. Reed published for float32, and every pair of a short row of distances, whose depths
 * are worked out here in doubles with a rounding of its own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "depth_ieee.h"

#include <math.h>
#include <string.h>

/* What the program of Visualizing Depth Precision (2015) finds: pairs of 10,000 between .1 and 10,000 m that are equal,
 * or swapped. */
static const struct {
    const char *name;
    uint32_t equal, swap;
} published[] = {{"ieee32-standard", 7720, 1},         {"ieee32-infinite", 7575, 1}, {"ieee32-reversed", 0, 0},
                 {"ieee32-infinite-reversed", 0, 0},   {"ieee32-gl", 7734, 0},       {"ieee32-gl-infinite", 7663, 0},
                 {"int24-standard", 7720, 1},          {"int24-infinite", 7575, 1},  {"int24-reversed", 7577, 0},
                 {"int24-infinite-reversed", 7578, 0}, {"int24-gl", 7734, 0},        {"int24-gl-infinite", 7663, 0}};

static void counts_are_those_that_were_published(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < DEPTH_IEEE_FORMATS; i++) {
        struct depth_ieee_count found;
        assert_string_equal(depth_ieee_name(i), published[i].name);
        assert_int_equal(depth_ieee_pairs(i, .1, 10000, LAB_LINEAR_SPACED, 10000, &found), 0);
        assert_int_equal(found.equal, published[i].equal);
        assert_int_equal(found.swap, published[i].swap);
    }
}

/* A double to 24 bits, to the nearest, ties to even: what a float32 holds of it. */
static double to_24_bits(double v)
{
    int exponent;
    const double mantissa = frexp(v, &exponent);
    return ldexp(rint(ldexp(mantissa, 24)), exponent - 24);
}

/* Depth at z: d = (z scale + bias) / z, each step to 24 bits; larger is farther. */
static double depth_at(const char *name, double n, double f, double z)
{
    const bool infinite = strstr(name, "infinite") != NULL, gl = strstr(name, "gl") != NULL;
    const bool reversed = strstr(name, "reversed") != NULL;
    double scale = infinite ? 1 : gl ? (f + n) / (f - n) : f / (f - n);
    double bias = -n * (gl ? 2 : 1) * (infinite ? 1 : f / (f - n));
    if (reversed) { /* 1 - d */
        scale = infinite ? 0 : 1 - scale;
        bias = -bias;
    }
    double d = to_24_bits(to_24_bits(to_24_bits(z * to_24_bits(scale)) + to_24_bits(bias)) / z);
    d = gl ? to_24_bits(to_24_bits(d * .5) + .5) : d;
    d = name[0] == 'i' && name[1] == 'n' ? floor(d * 16777215 + .5) : d;
    return reversed ? -d : d;
}

static void each_pair_is_told_as_doubles_have_it(void **state)
{
    enum { COUNT = 300 };
    (void)state;
    for (uint32_t i = 0; i < DEPTH_IEEE_FORMATS * 2; i++) {
        const uint32_t format = i / 2;
        const uint8_t spacing = i % 2 == 0 ? LAB_LINEAR_SPACED : LAB_LOG_SPACED;
        const double n = .25, f = 40000;
        double z[COUNT + 1], d[COUNT + 1], widest = 0;
        struct depth_ieee_count found, count = {0, 0, 0};
        for (int k = 0; k <= COUNT; k++) {
            const double part = to_24_bits((double)k / COUNT);
            z[k] = to_24_bits(spacing == LAB_LOG_SPACED ? n * pow(f / n, (double)k / COUNT)
                                                        : n + to_24_bits((f - n) * part));
            d[k] = depth_at(depth_ieee_name(format), n, f, z[k]);
            count.equal += k > 0 && d[k] == d[k - 1];
            count.swap += k > 0 && d[k] < d[k - 1];
            for (int j = 0; j < k; j++) {
                widest = d[k] <= d[j] ? fmax(widest, z[k] - z[j]) : widest;
            }
        }
        assert_int_equal(depth_ieee_pairs(format, n, f, spacing, COUNT, &found), 0);
        assert_true(found.equal == count.equal && found.swap == count.swap && found.max_wrong == widest);
    }
}

/* The percentages of the article, equal and swapped. Where view and projection are one matrix it does not tell the
 * order of the sums, so only both together are compared. */
static void a_view_in_float32_costs_what_he_found(void **state)
{
    static const struct {
        unsigned composed, separate[2];
    } article[6] = {{45 + 18, {77, 0}}, {45 + 18, {76, 0}}, {0, {0, 0}},
                    {0, {0, 0}},        {56 + 12, {77, 0}}, {59 + 10, {77, 0}}};
    (void)state;
    for (uint32_t i = 0; i < DEPTH_IEEE_FORMATS; i++) {
        struct depth_ieee_count one, two;
        const bool is_76 = i == 8 || i == 9; /* int24, reversed */
        depth_ieee_view_pairs(i, .1, 10000, 10000, true, &one);
        depth_ieee_view_pairs(i, .1, 10000, 10000, false, &two);
        assert_true(fabs((one.equal + one.swap) / 100. - (is_76 ? 76 : article[i % 6].composed)) <= 5);
        assert_true(fabs(two.equal / 100. - (is_76 ? 76 : article[i % 6].separate[0])) <= 1.5);
        assert_true(fabs(two.swap / 100. - article[i % 6].separate[1]) <= 1.5);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counts_are_those_that_were_published),
        cmocka_unit_test(each_pair_is_told_as_doubles_have_it),
        cmocka_unit_test(a_view_in_float32_costs_what_he_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
