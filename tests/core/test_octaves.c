/* Runs of pixels in one octave of a float's depth (ph_depth_piece of span.h) against their pixels one by one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_random.h"
#include "span.h"

enum { RUNS = 200000, NONE = -1 };

/* The octave of a depth; NONE if it has wrapped below 0. */
static int octave_of(uint32_t d, int lowest)
{
    int octave = 0;
    if (d >= PH_DEPTH_WRAPPED) {
        return NONE;
    }
    for (uint32_t v = d; octave < lowest && v >> 31 == 0; v <<= 1) {
        octave++;
    }
    return octave;
}

/* Depths and their steps lose no bit when they are shifted to codes, as in ph_set_float. A run ends where the octave
 * does, or with the row; a depth that has wrapped and falls stays there. No depth rises beyond the top, or falls below
 * PH_DEPTH_WRAPPED. */
static void a_run_is_what_its_pixels_are_one_by_one(void **state)
{
    (void)state;
    static const struct ph_material material = {.depth_bias = 3};
    int cut = 0, wrapped = 0;
    for (int k = 0; k < RUNS; k++) {
        const int down = 2 + (int)ref_uniform(0, 3), exponents = (2 << down) - 2,
                  block = (int)ref_uniform(0, exponents);
        const int lowest = exponents - block < 31 ? exponents - block : 31;
        const uint32_t exact = UINT32_MAX << down, row = 1 + (uint32_t)ref_uniform(0, 300);
        const int32_t gd = (int32_t)((uint32_t)ref_q16(ref_uniform(-.2, k % 2 ? .2 : 32)) & exact);
        const uint32_t d =
            ((k % 3 ? (uint32_t)ref_uniform(0, 0x80000000) >> k % 23 : 0u - (uint32_t)ref_uniform(0, 400000))) & exact;
        struct ph_triangle t = {.material = &material, .block = ph_block_of(block, down)};
        t.as.large.depth.as.plane.gx = (uint32_t)gd;
        uint32_t n = row;
        const struct ph_piece run = ph_depth_piece(&t, d, &n);
        const int octave = octave_of(d, lowest);
        const bool stays = octave == NONE && gd <= 0;
        assert_in_range(n, 1, row);
        for (uint32_t i = 0; i < n && !stays; i++) {
            uint32_t one = 1;
            assert_int_equal(octave_of(d + i * (uint32_t)gd, lowest), octave);
            assert_int_equal(ph_depth_piece(&t, d + i * (uint32_t)gd, &one).d, run.d + i * run.gd);
        }
        assert_true(n == row || (!stays && octave_of(d + n * (uint32_t)gd, lowest) != octave));
        assert_true(octave != NONE || run.gd == 0);
        cut += n < row;
        wrapped += octave == NONE;
    }
    assert_true(cut > RUNS / 20 && wrapped > RUNS / 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_run_is_what_its_pixels_are_one_by_one)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
