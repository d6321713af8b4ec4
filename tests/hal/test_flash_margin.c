/*
 * When the bits of the flash are sampled, against the times at which they change, in a model of its own: it follows the
 * clock's edges one by one, in half cycles of clk_sys and nanoseconds of floating point, and knows nothing of the
 * formulas of flash_margin.h.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "flash_margin.h"

#include <math.h>
#include <stdbool.h>

#define BITS 3 /* nibbles that are put out; the middle one is looked at */

struct way { /* ns, from the data sheets that flash_margin.h names */
    double tclqv, tclqx, pads_least, pads_most;
};

static const struct way w25q = {6, 1.5, 1.11 + 0.47, 2.5 + 1.5}, unknown = {8, 0, 1.11 + 0.47, 2.5 + 1.5};

struct margins {
    double setup, hold;
};

/* The clock starts low and rises after half a period; each of its falling edges puts the next nibble out. */
static struct margins follow(double clk_sys_mhz, int divider, int halves, const struct way *way)
{
    const double half_ns = 500 / clk_sys_mhz;
    double valid[BITS] = {0}, gone[BITS] = {0}, sampled[BITS] = {0};
    int falls = 0, rises = 0;
    bool level = true;
    for (int half = 0; falls <= BITS; half++) {
        if (half % divider != 0) { /* half a period has as many half cycles as a period has cycles */
            continue;
        }
        level = !level;
        const double now = half * half_ns;
        if (!level) {
            if (falls > 0) {
                gone[falls - 1] = now + way->pads_least + way->tclqx;
            }
            if (falls < BITS) {
                valid[falls] = now + way->pads_most + way->tclqv;
            }
            falls++;
        } else if (rises < BITS) {
            sampled[rises++] = now + halves * half_ns;
        }
    }
    return (struct margins){sampled[1] - valid[1], gone[1] - sampled[1]};
}

static bool is_safe(double clk_sys_mhz, int divider, int halves, const struct way *way)
{
    const struct margins m = follow(clk_sys_mhz, divider, halves, way);
    return m.setup >= 3 && m.hold >= 3;
}

static void the_first_fetch_of_a_disregarded_delay_comes_too_early(void **state)
{
    (void)state;
    const struct margins m = follow(125, 2, 0, &w25q);
    assert_true(m.setup < 0); /* 8 ns after the edge, when the flash may take 6 and the pads 4 */
    assert_true(!is_safe(125, 2, 0, &w25q));
    assert_true(!FLASH_IS_SAFE(125000000, 2, 0, 6000, 1500));
}

static void what_the_rp2040_sets_has_3_ns_on_both_sides(void **state)
{
    (void)state;
    assert_true(is_safe(125, RP2040_FLASH_W25Q_DIVIDER, 2 * RP2040_FLASH_DELAY, &w25q));
    assert_true(is_safe(125, RP2040_FLASH_UNKNOWN_DIVIDER, 2 * RP2040_FLASH_DELAY, &unknown));
    assert_int_equal(RP2040_FLASH_CLK_SYS_HZ, 125000000);
    assert_int_equal(RP2040_FLASH_W25Q_DIVIDER % 2 + RP2040_FLASH_UNKNOWN_DIVIDER % 2, 0);
    for (int divider = 2; divider < RP2040_FLASH_UNKNOWN_DIVIDER; divider += 2) { /* and no faster one would do */
        for (int delay = 0; delay < 8; delay++) {
            assert_true(!is_safe(125, divider, 2 * delay, &unknown));
        }
    }
}

/* RXDELAY counts half cycles. No smaller divider would do, whatever the delay. */
static void what_the_rp2350_sets_has_3_ns_on_both_sides(void **state)
{
    (void)state;
    assert_true(is_safe(150, RP2350_FLASH_W25Q_DIVIDER, RP2350_FLASH_DELAY, &w25q));
    assert_true(is_safe(150, RP2350_FLASH_UNKNOWN_DIVIDER, RP2350_FLASH_DELAY, &unknown));
    assert_int_equal(RP2350_FLASH_CLK_SYS_HZ, 150000000);
    for (int delay = 0; delay < 8; delay++) {
        for (int divider = 1; divider < RP2350_FLASH_W25Q_DIVIDER; divider++) {
            assert_true(!is_safe(150, divider, delay, &w25q));
        }
        for (int divider = 1; divider < RP2350_FLASH_UNKNOWN_DIVIDER; divider++) {
            assert_true(!is_safe(150, divider, delay, &unknown));
        }
    }
    for (int mhz = 1; mhz <= 150; mhz++) {
        assert_true(is_safe(mhz, RP2350_FLASH_W25Q_DIVIDER, RP2350_FLASH_DELAY, &w25q));
        assert_true(is_safe(mhz, RP2350_FLASH_UNKNOWN_DIVIDER, RP2350_FLASH_DELAY, &unknown));
    }
}

/* clk_sys is slower until the PLL runs, and then it must not get any worse. */
static void a_slower_clk_sys_does_not_spoil_it(void **state)
{
    (void)state;
    for (int mhz = 1; mhz <= 125; mhz++) {
        assert_true(is_safe(mhz, RP2040_FLASH_W25Q_DIVIDER, 2 * RP2040_FLASH_DELAY, &w25q));
        assert_true(is_safe(mhz, RP2040_FLASH_UNKNOWN_DIVIDER, 2 * RP2040_FLASH_DELAY, &unknown));
    }
}

static void the_formulas_say_what_the_edges_say(void **state)
{
    (void)state;
    static const int64_t clocks[] = {6500000, 48000000, 125000000, 133000000, 150000000, 200000000};
    for (size_t i = 0; i < sizeof clocks / sizeof clocks[0]; i++) {
        for (int divider = 1; divider <= 8; divider++) {
            for (int halves = 0; halves <= 16; halves++) {
                const struct margins m = follow((double)clocks[i] / 1e6, divider, halves, &w25q);
                const int64_t setup = FLASH_SETUP_PS(clocks[i], divider, halves, FLASH_W25Q_TCLQV_PS);
                const int64_t hold = FLASH_HOLD_PS(clocks[i], divider, halves, FLASH_W25Q_TCLQX_PS);
                assert_true(fabs(m.setup * 1000 - (double)setup) <= divider + halves); /* a ps a half cycle */
                assert_true(fabs(m.hold * 1000 - (double)hold) <= divider + halves);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_first_fetch_of_a_disregarded_delay_comes_too_early),
        cmocka_unit_test(what_the_rp2040_sets_has_3_ns_on_both_sides),
        cmocka_unit_test(what_the_rp2350_sets_has_3_ns_on_both_sides),
        cmocka_unit_test(a_slower_clk_sys_does_not_spoil_it),
        cmocka_unit_test(the_formulas_say_what_the_edges_say),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
