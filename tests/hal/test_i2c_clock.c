/* The counts of the I2C units: for every clock that can be asked for, the specification's least times. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "chips/i2c_clock.h"

/* UM10204, table 10, in ns: low, high and set-up of data in fast mode, and above 400 kHz in fast-mode plus. */
static void check(uint32_t chip_hz, uint32_t asked)
{
    const struct i2c_clock c = i2c_clock_dw(chip_hz, asked);
    const uint64_t low = c.low + 1, high = c.high + c.spike + 7;
    const uint64_t mhz = chip_hz / 1000000;
    assert_in_range(c.hz, 1, asked);
    assert_int_equal(c.hz, chip_hz / (low + high));
    assert_true(c.low <= UINT16_MAX && c.high <= UINT16_MAX);
    assert_true(low * 1000 >= (asked > 400000 ? 500 : 1300) * mhz);
    assert_true(high * 1000 >= (asked > 400000 ? 260 : 600) * mhz);
    assert_true(c.hold * 1000 >= 300 * mhz && (low - c.hold) * 1000 >= 100 * mhz);
    assert_true(c.spike * 1000 >= 50 * mhz && c.high > c.spike + 5);
}

static void every_clock_keeps_the_times_of_its_mode(void **state)
{
    (void)state;
    for (uint32_t hz = 1600; hz <= 1000000; hz += 100) {
        check(125000000, hz);
        check(150000000, hz);
    }
    assert_int_equal(i2c_clock_dw(125000000, 400000).hz, 399361);
    assert_int_equal(i2c_clock_dw(150000000, 400000).hz, 400000);
}

static void clocks_end_at_fast_mode_plus_and_at_the_counters(void **state)
{
    (void)state;
    assert_int_equal(i2c_clock_dw(125000000, 4000000).hz, 1000000);
    assert_int_equal(i2c_clock_dw(125000000, 1000).hz, 0);
    assert_int_equal(i2c_clock_dw(125000000, 0).hz, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_clock_keeps_the_times_of_its_mode),
        cmocka_unit_test(clocks_end_at_fast_mode_plus_and_at_the_counters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
