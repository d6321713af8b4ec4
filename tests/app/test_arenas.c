/* arenas: what a demo's arena takes on a 32-bit target: what the demo says, else what the table of demos says, else
 * what it takes here. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "demo.h"

static const struct {
    const char *demo;
    uint32_t bytes[5];
} known[] = {
#include "arenas.inc"
};

static void what_a_demo_says_counts(void **state)
{
    static const struct demo_level coarser[2] = {{.arena_bytes = 80, .arena_bytes_32 = 40}, {.arena_bytes = 72}};
    const struct demo demo = {
        .name = "turntable", .arena_bytes = 1000, .arena_bytes_32 = 500, .coarser = coarser, .coarser_count = 2};
    (void)state;
    assert_int_equal(demo_arena_bytes_32(&demo, 0), 500);
    assert_int_equal(demo_arena_bytes_32(&demo, 1), 40);
}

/* What is in no table is as long as here. */
static void another_demo_takes_what_it_takes_here(void **state)
{
    static const struct demo_level coarser[6] = {{.arena_bytes = 8},  {.arena_bytes = 16}, {.arena_bytes = 24},
                                                 {.arena_bytes = 32}, {.arena_bytes = 40}, {.arena_bytes = 48}};
    const struct demo other = {.name = "other", .arena_bytes = 1000, .coarser = coarser, .coarser_count = 6};
    struct demo listed = other;
    (void)state;
    assert_int_equal(demo_arena_bytes_32(&other, 0), 1000);
    listed.name = "turntable";
    for (uint32_t level = 1; level <= 6; level++) {
        assert_int_equal(demo_arena_bytes_32(&other, level), 8 * level);
    }
    assert_int_equal(demo_arena_bytes_32(&listed, 6), 48); /* the table has no such level */
}

/* Pointers are shorter on a target: no demo takes more there, and none less than half. */
static void the_table_has_the_demos_and_is_near_what_they_take_here(void **state)
{
    (void)state;
    for (uint32_t d = 0; d < demo_count; d++) {
        const struct demo *const demo = demo_list[d];
        for (uint32_t level = 0; level <= demo->coarser_count; level++) {
            const size_t here = level > 0 ? demo->coarser[level - 1].arena_bytes : demo->arena_bytes;
            const uint32_t there = demo_arena_bytes_32(demo, level);
            assert_true(there <= here && 2 * (size_t)there >= here);
        }
    }
    for (size_t i = 0; sizeof(void *) > 4 && i < sizeof known / sizeof known[0]; i++) {
        const struct demo *const demo = demo_find(known[i].demo);
        assert_non_null(demo);
        for (uint32_t level = 0; level <= demo->coarser_count && level < 5; level++) {
            if (known[i].bytes[level] != 0) {
                assert_int_equal(demo_arena_bytes_32(demo, level), known[i].bytes[level]);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_a_demo_says_counts),
        cmocka_unit_test(another_demo_takes_what_it_takes_here),
        cmocka_unit_test(the_table_has_the_demos_and_is_near_what_they_take_here),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
