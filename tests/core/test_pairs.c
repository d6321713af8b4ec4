/*
 * The kernels of pairs.h in every channel of both pixels, for all values and shares, against divisions.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "pairs.h"

/* The channels of a pair: where each begins, and its bits. */
static const struct {
    int from, bits;
} channels[6] = {{0, 5}, {5, 6}, {11, 5}, {16, 5}, {21, 6}, {27, 5}};

static uint32_t expected(const char *kind, uint32_t to, uint32_t from, uint32_t share, uint32_t full)
{
    const uint32_t part = (2 * from * share + 32) / 64;
    switch (kind[0]) {
    case 'm':
        return (2 * (to * (32 - share) + from * share) + 32) / 64;
    case 'a':
        return to + part < full ? to + part : full;
    default:
        return (2 * to * from + full) / (2 * full);
    }
}

static void times(ph_pair *to, const ph_pair *from, uint32_t n, uint32_t share)
{
    (void)share;
    ph_pairs_times(to, from, n);
}

/* The other channels hold values of their own, of which none must reach this one. */
static void try_kernel(const char *kind, void (*lay)(ph_pair *, const ph_pair *, uint32_t, uint32_t))
{
    uint32_t random = 1;
    for (int k = 0; k < 6; k++) {
        const uint32_t full = (1u << channels[k].bits) - 1;
        for (uint32_t to = 0; to <= full; to++) {
            for (uint32_t from = 0; from <= full; from++) {
                for (uint32_t share = 0; share <= 32; share++) {
                    random = random * 1664525 + 1013904223;
                    const uint32_t others = ~(full << channels[k].from);
                    ph_pair under = ph_wire_pair((random & others) | to << channels[k].from);
                    const ph_pair over = ph_wire_pair(((random ^ random << 13) & others) | from << channels[k].from);
                    lay(&under, &over, 1, share);
                    assert_int_equal(ph_wire_pair(under) >> channels[k].from & full,
                                     expected(kind, to, from, share, full));
                }
            }
        }
    }
}

static void channels_are_mixed_each_by_itself(void **state)
{
    (void)state;
    try_kernel("mix", ph_pairs_mix);
}

static void channels_are_added_up_to_full(void **state)
{
    (void)state;
    try_kernel("add", ph_pairs_add);
}

static void channels_are_multiplied_each_by_itself(void **state)
{
    (void)state;
    try_kernel("times", times);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(channels_are_mixed_each_by_itself),
        cmocka_unit_test(channels_are_added_up_to_full),
        cmocka_unit_test(channels_are_multiplied_each_by_itself),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
