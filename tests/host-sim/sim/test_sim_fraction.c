/* Fractions of 128 bits against the compiler's own 128 bits, which not every target has. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_random.h"
#include "sim_fraction.h"

__extension__ typedef __int128 int128;

static int128 whole(struct sim_wide a)
{
    return (int128)a.high << 64 | a.low;
}

static int128 signed_over(struct sim_fraction a)
{
    return a.is_negative ? -whole(a.over) : whole(a.over);
}

static int128 divisor(int128 a, int128 b)
{
    return b == 0 ? (a < 0 ? -a : a) : divisor(b, a % b);
}

static void expect(struct sim_fraction is, int128 over, int128 under)
{
    const int128 by = divisor(over, under) * (under < 0 ? -1 : 1);
    assert_true(signed_over(is) == over / by && whole(is.under) == under / by);
    assert_true(!is.is_negative || over != 0);
}

static struct sim_fraction any(void)
{
    const int32_t least = ref_uniform(0, 1) < .1 ? 0 : ref_uniform(0, 1) < .2 ? INT32_MIN : 0;
    const double size = ref_uniform(0, 1) < .5 ? 4 : 2147483647.0;
    return sim_fraction_of(least != 0 ? least : (int32_t)ref_uniform(-size, size), (int)ref_uniform(0, 31));
}

static void sums_products_and_quotients_are_exact(void **state)
{
    (void)state;
    ref_seed(36);
    for (int i = 0; i < 20000; i++) {
        const struct sim_fraction a = sim_fraction_times(any(), any()), b = sim_fraction_times(any(), any());
        const int128 ao = signed_over(a), au = whole(a.under), bo = signed_over(b), bu = whole(b.under);
        expect(sim_fraction_add(a, b), ao * bu + bo * au, au * bu);
        const struct sim_fraction product = sim_fraction_times(a, b), three = sim_fraction_of(3, 0);
        expect(product, ao * bo, au * bu);
        expect(sim_fraction_times(product, three), 3 * signed_over(product), whole(product.under));
        expect(sim_fraction_times(three, product), 3 * signed_over(product), whole(product.under));
        expect(sim_fraction_minus(a), -ao, au);
        assert_int_equal(sim_fraction_is_0(a), ao == 0);
        if (bo != 0) {
            expect(sim_fraction_divide(a, b), ao * bu, au * bo);
        }
    }
}

static void codes_are_the_nearest_and_saturate(void **state)
{
    (void)state;
    ref_seed(16);
    for (int i = 0; i < 20000; i++) {
        const struct sim_fraction a = sim_fraction_times(any(), any());
        const int128 over = whole(a.over), under = whole(a.under), most = (int128)INT32_MAX + a.is_negative;
        const int128 code = (over / under) >> 20 != 0 ? most : (over * 131072 + under) / (2 * under);
        assert_true(sim_fraction_code(a) == (a.is_negative ? -1 : 1) * (code < most ? code : most));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_products_and_quotients_are_exact),
        cmocka_unit_test(codes_are_the_nearest_and_saturate),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
