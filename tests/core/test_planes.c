/* Planes of a triangle at the ends of their range: no gradient changes its sign, no sum overflows. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "../../firmware/core/render/planes.c" /* NOLINT(bugprone-suspicious-include): for times_wide */
#include "vertex.h"

/* The gradient of a triangle whose second corner is 64 px above, and whose third is dx2 / 256 px to the right and d2
 * nearer. */
static int32_t gradient(int32_t dx2, uint32_t d2)
{
    const struct ph_vertex first = {0};
    const struct ph_sides sides = {.dy1 = 1 << 14, .dx2 = dx2, .area = 1};
    const uint32_t d[3] = {0, 0, d2};
    struct ph_plane plane;
    ph_depth_plane(&plane, &first, &sides, d);
    return (int32_t)plane.gx;
}

static void gradients_that_round_up_to_half_the_range_keep_their_sign(void **state)
{
    (void)state;
    for (int32_t dx2 = 257; dx2 < 512; dx2++) {
        int shift;
        const uint32_t reciprocal = (uint32_t)ph_wide_reciprocal((uint32_t)dx2 << 14, &shift);
        const uint32_t d2 = (uint32_t)(((uint64_t)1 << 60) / reciprocal) * 2; /* its product is just below 2^61 */
        assert_true(gradient(dx2, d2) > INT32_MAX - 8);
    }
}

/* Every length of a side with the ends of each carry. d n is linear in d between two ends. */
static void wide_products_are_exact_for_every_side(void **state)
{
    (void)state;
    const int64_t two31 = (int64_t)1 << 31;
    const int64_t ends[] = {-2 * two31 + 1, -two31 - 1, -two31, -1, 0, two31 - 1, two31, 2 * two31 - 1};
    for (int32_t n = -2 * (PH_GUARD_MAX + 128); n <= 2 * (PH_GUARD_MAX + 128); n++) {
        for (unsigned int i = 0; i < sizeof(ends) / sizeof(*ends); i++) {
            if (times_wide(ends[i], n) != ends[i] * n) {
                fail_msg("%lld times %d", (long long)ends[i], (int)n);
            }
        }
    }
}

static void slopes_of_floats_round_without_overflow(void **state)
{
    (void)state;
    assert_int_equal(ph_depth_float16_slope(INT32_MAX, -1), (uint32_t)1 << 30);
    assert_int_equal(ph_depth_float16_slope(INT32_MAX, -3), (uint32_t)1 << 28);
    for (int down = 1; down <= 28; down++) {
        for (int64_t slope = -40; slope <= 40; slope++) {
            assert_int_equal((int32_t)ph_depth_float16_slope((uint32_t)slope, -down),
                             (slope + ((int64_t)1 << (down - 1))) >> down);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gradients_that_round_up_to_half_the_range_keep_their_sign),
        cmocka_unit_test(wide_products_are_exact_for_every_side),
        cmocka_unit_test(slopes_of_floats_round_without_overflow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
