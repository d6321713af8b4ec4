/* Sums in Q32.32 and calls over arrays, against 128-bit integers and the functions of fx.h one by one. See fx_math.h.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "fx_math.h"
#include "fx_inputs.h"

#include <string.h>

enum { N = 37 };

static fx_t a[N], b[N], to[N + 1];

static int64_t clamp64(__int128 v)
{
    return v > INT64_MAX ? INT64_MAX : v < INT64_MIN ? INT64_MIN : (int64_t)v;
}

static int32_t clamp32(__int128 v)
{
    return v > INT32_MAX ? INT32_MAX : v < INT32_MIN ? INT32_MIN : (int32_t)v;
}

static int make(void **state)
{
    (void)state;
    add_bit_edges();
    for (int i = 0; i < N; i++) {
        a[i] = noise_any();
        b[i] = noise_any();
    }
    a[3] = a[4] = b[3] = b[4] = FX_MIN;
    a[5] = FX_MAX;
    b[5] = FX_MIN;
    return 0;
}

static int64_t any_sum(void)
{
    return (int64_t)((uint64_t)(uint32_t)noise_any() << 32 | (uint32_t)noise_any());
}

static void sums_are_exact_or_the_nearest_that_they_hold(void **state)
{
    static const int64_t far[] = {INT64_MIN, INT64_MIN + 1, -1, 0, 1, INT64_MAX - 1, INT64_MAX};
    (void)state;
    for (int i = 0; i < 7; i++) {
        for (int k = 0; k < 7; k++) {
            assert_true(fx_sum_add_sat(far[i], far[k]) == clamp64((__int128)far[i] + far[k]));
        }
        for (int k = 0; k < 100000; k++) {
            const int64_t one = any_sum(), other = any_sum();
            const int32_t x = noise_any(), y = noise_any();
            assert_true(fx_sum_add_sat(one, other) == clamp64((__int128)one + other));
            assert_true(fx_sum_mul_sat(far[i], x, y) == clamp64((__int128)far[i] + (__int128)x * y));
        }
    }
}

static void a_sum_becomes_the_nearest_number(void **state)
{
    (void)state;
    for (int i = 0; i < 300000; i++) {
        const int64_t sum = any_sum() >> (i % 40);
        assert_int_equal(fx_from_sum_sat(sum), clamp32(((__int128)sum + (1 << 15)) >> 16));
    }
    assert_int_equal(fx_from_sum_sat(1 << 15), 1); /* a tie */
    assert_int_equal(fx_from_sum_sat(-(1 << 15)), 0);
    for (size_t i = 0; i < edge_count; i++) {
        assert_int_equal(fx_from_sum_sat(fx_sum_of(edges[i])), edges[i]);
    }
}

/* Each element is what the function of fx.h gives; the one behind the last stays as it was. */
static void is_each(fx_t (*f)(fx_t, fx_t), const fx_t *second)
{
    for (int i = 0; i < N; i++) {
        assert_int_equal(to[i], f(a[i], second[i]));
    }
    assert_int_equal(to[N], 12345);
}

static void arrays_are_the_functions_of_each_element(void **state)
{
    fx_t three[N];
    (void)state;
    to[N] = 12345;
    fx_add_array_sat(to, a, b, N);
    is_each(fx_add_sat, b);
    fx_sub_array_sat(to, a, b, N);
    is_each(fx_sub_sat, b);
    fx_mul_array_sat(to, a, b, N);
    is_each(fx_mul_sat, b);
    for (int i = 0; i < N; i++) {
        three[i] = FX_INT(3) + 7;
    }
    fx_scale_array_sat(to, a, three[0], N);
    is_each(fx_mul_sat, three);
    fx_map_array(to, a, N, fx_sqrt);
    for (int i = 0; i < N; i++) {
        assert_int_equal(to[i], fx_sqrt(a[i]));
    }
    memcpy(to, a, sizeof a); /* in place */
    fx_mul_array_sat(to, to, b, N);
    is_each(fx_mul_sat, b);
    fx_add_array_sat(to, a, b, 0);
    is_each(fx_mul_sat, b);
}

static void totals_lose_nothing(void **state)
{
    static fx_t many[65537];
    (void)state;
    for (int n = 0; n <= N; n++) {
        __int128 sum = 0, products = 0;
        for (int i = 0; i < n; i++) {
            sum += (__int128)a[i] * FX_ONE;
            products = clamp64(products + (__int128)a[i] * b[i]);
        }
        assert_true(fx_sum_array_sat(a, (size_t)n) == (int64_t)sum);
        assert_true(fx_dot_array_sat(a, b, (size_t)n) == (int64_t)products);
    }
    for (int i = 0; i < 65537; i++) {
        many[i] = FX_MIN;
    }
    assert_true(fx_sum_array_sat(many, 65536) == INT64_MIN);
    assert_true(fx_sum_array_sat(many, 65537) == INT64_MIN);   /* no longer exact */
    assert_true(fx_dot_array_sat(many, many, 2) == INT64_MAX); /* 2^63 */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_are_exact_or_the_nearest_that_they_hold),
        cmocka_unit_test(a_sum_becomes_the_nearest_number),
        cmocka_unit_test(arrays_are_the_functions_of_each_element),
        cmocka_unit_test(totals_lose_nothing),
    };
    return cmocka_run_group_tests(tests, make, NULL);
}
