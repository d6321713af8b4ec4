/* The number type of fx.hpp: its operators are the functions of fx.h, its literals are right by long division. */
#include "fx/fx.hpp"

#include <cstdio>
#include <initializer_list>

using pinhole::fixed;
using namespace pinhole::literals;

/* Literals: 2^-17 is a tie, and goes up; a little less goes down. */
static_assert((1_fx).raw() == 65536, "");
static_assert((0.1_fx).raw() == 6554, "6553.6");
static_assert((.25_fx).raw() == 16384, "");
static_assert((3.14159265358979_fx).raw() == 205887, "205887.416");
static_assert((2.718281828459045_fx).raw() == 178145, "178145.32");
static_assert((0.00000762939453125_fx).raw() == 1, "a tie");
static_assert((0.00000762939453124999999999_fx).raw() == 0, "less than a tie");
static_assert((1'234.000'015_fx).raw() == 1234 * 65536 + 1, "");
static_assert((32767.99998_fx).raw() == 2147483647, "2147483646.7");
static_assert((-0.5_fx).raw() == -32768, "");

/* Whole numbers of any type. */
static_assert(fixed(-3).raw() == -3 * 65536, "");
static_assert(fixed(32767u).raw() == 32767 * 65536, "");
static_assert(fixed(-32768LL).raw() == FX_MIN, "");
static_assert(fixed(40000u).raw() == FX_MAX && fixed(-40000).raw() == FX_MIN, "");
static_assert(fixed(~0ULL).raw() == FX_MAX, "");
static_assert(sizeof(fixed) == sizeof(fx_t), "");
static_assert(!std::is_convertible<double, fixed>::value && !std::is_constructible<fixed, float>::value, "");

static unsigned wrong;

static void same(const char *what, fx_t a, fx_t b, long got, long expected)
{
    if (got != expected && wrong++ < 5) {
        std::printf("# %ld %s %ld is %ld, not %ld\n", long(a), what, long(b), got, expected);
    }
}

static void operators_agree(fx_t x, fx_t y)
{
    const fixed a = fixed::from_raw(x), b = fixed::from_raw(y);
    same("+", x, y, (a + b).raw(), fx_add_sat(x, y));
    same("-", x, y, (a - b).raw(), fx_sub_sat(x, y));
    same("*", x, y, (a * b).raw(), fx_mul_sat(x, y));
    same("/", x, y, (a / b).raw(), fx_div_sat(x, y));
    same("==", x, y, a == b, x == y);
    same("!=", x, y, a != b, x != y);
    same("<", x, y, a < b, x < y);
    same(">", x, y, a > b, x > y);
    same("<=", x, y, a <= b, x <= y);
    same(">=", x, y, a >= b, x >= y);
    same("minus", x, 0, (-a).raw(), fx_neg_sat(x));
    same("plus", x, 0, (+a).raw(), x);
    same("int", x, 0, int(a), x / 65536);
}

int main()
{
    for (const fx_t x : {FX_MIN, FX_MIN + 1, -98304, -65536, -1, 0, 1, 65535, 65536, 98305, FX_MAX - 1, FX_MAX}) {
        for (const fx_t y : {FX_MIN, FX_MIN + 1, -98304, -65536, -1, 0, 1, 65535, 65536, 98305, FX_MAX - 1, FX_MAX}) {
            operators_agree(x, y);
        }
    }
    fixed sum = 1;
    sum += 2;
    sum *= 2.5_fx;
    sum -= 0.5_fx;
    sum /= 2;
    same("sum", 0, 0, sum.raw(), fx_t(3.5 * 65536));
    same("mixed", 0, 0, (2 * sum + 1).raw(), 8 * 65536);
    return wrong != 0;
}
