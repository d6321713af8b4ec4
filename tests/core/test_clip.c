/* Clipping: a triangle has room after it, however its corners are rounded. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "clip.h"

/* A sliver along the line in which two sides of the guard band meet: to rounding it lies in both. */
struct sliver {
    fx_t near_z, far_z;
    uint8_t guard_up;
    int32_t xyz[3][3];
};

static void slivers_in_two_planes_at_once_keep_within_their_room(void **state)
{
    (void)state;
    static const struct sliver slivers[] = {
        {1006, 2277752, 8, {{7437, 7439, -235594}, {-131869, -131958, 4221419}, {-32025, -32025, 1024794}}},
        {9, 6820, 0, {{44650, -44663, -5549}, {-108347, 108377, 13547}, {-50633, 50633, 6329}}},
        {15, 3233633, 7, {{-157803, -157803, -2524805}, {363732, 363738, 5819725}, {129821, 129818, 2077127}}},
    };
    for (size_t k = 0; k < sizeof slivers / sizeof slivers[0]; k++) {
        const struct sliver *s = &slivers[k];
        const struct ph_lens lens = {.near_z = s->near_z, .far_z = s->far_z, .guard_up = s->guard_up};
        struct ph_clip_vertex in[3], out[PH_CLIP_MAX + 1];
        for (int i = 0; i < 3; i++) {
            const int32_t *p = s->xyz[i];
            in[i] = (struct ph_clip_vertex){.x = p[0], .y = p[1], .w = p[2], .z = p[2]};
        }
        out[PH_CLIP_MAX].x = 12345;
        assert_in_range(ph_clip(&lens, in, 3, out), 3, PH_CLIP_MAX);
        assert_int_equal(out[PH_CLIP_MAX].x, 12345);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(slivers_in_two_planes_at_once_keep_within_their_room)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
