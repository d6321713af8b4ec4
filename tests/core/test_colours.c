/*
 * Colours over a small triangle (colours_small.h) against planes in double precision through the colours of its
 * corners. Corners, sizes and colours are random.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>

#include "band.h"
#include "colours_small.h"
#include "ref_random.h"
#include "sides.h"

enum { SIZE = 64, TRIANGLES = 20000 };

static uint16_t pixels[SIZE * SIZE], depth[SIZE * SIZE];

/* A channel of a colour as a number, 0 red, 1 green, 2 blue. */
static int channel(unsigned colour, int k)
{
    return k == 0 ? (int)(colour >> 11) : k == 1 ? (int)(colour >> 5 & 63) : (int)(colour & 31);
}

/* How many steps the pixels of a triangle are off, at most. */
static double worst_of(const struct ph_vertex *const v[3], const struct ph_sides *s)
{
    double worst = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        if (depth[i] == 0) {
            continue;
        }
        const double x = i % SIZE * 256 + 128 - v[0]->x, y = i / SIZE * 256 + 128 - v[0]->y;
        const double b = (x * -s->dy2 + y * s->dx2) / s->area, c = (x * s->dy1 - y * s->dx1) / s->area;
        const unsigned shown = (unsigned)(pixels[i] >> 8 | (pixels[i] & 255) << 8);
        for (int k = 0; k < 3; k++) {
            const int first = channel(v[0]->light, k);
            const double value = first + b * (channel(v[1]->light, k) - first) + c * (channel(v[2]->light, k) - first);
            worst = fmax(worst, fabs(channel(shown, k) - value));
        }
    }
    return worst;
}

/* Besides what rounding to a step takes, the planes are off by a quarter of a step at most, and by 1/32 in between and
 * beside the triangle. A triangle whose height is an eighth of its longest side, and three pixels, is always taken. */
static void small_triangles_have_the_planes_of_their_corners(void **state)
{
    (void)state;
    const struct ph_material material = {.shading = PH_SHADE_GOURAUD};
    const struct ph_setting setting = {.fast.material = &material};
    const struct ph_band band = {.pixels = pixels, .depth = depth, .stride = SIZE, .y1 = SIZE, .width = SIZE};
    static const uint32_t codes[3] = {1u << 30, 1u << 30, 1u << 30};
    double worst = 0;
    int taken = 0;
    for (int n = 0; n < TRIANGLES; n++) {
        const double size = exp2(ref_uniform(6, 12.9));
        struct ph_vertex corner[3];
        for (int i = 0; i < 3; i++) {
            corner[i] = (struct ph_vertex){.x = (int32_t)(4096 + ref_uniform(0, size)),
                                           .y = (int32_t)(4096 + ref_uniform(0, size)),
                                           .light = (uint16_t)ref_uniform(0, 65536)};
        }
        const bool turned = ph_sides(&corner[0], &corner[1], &corner[2]).area < 0;
        const struct ph_vertex *const v[3] = {&corner[0], &corner[turned ? 2 : 1], &corner[turned ? 1 : 2]};
        const struct ph_sides sides = ph_sides(v[0], v[1], v[2]);
        struct ph_triangle t = {.block = PH_BLOCK_NONE};
        if (sides.area == 0 || ph_setup_small(&t, v, &sides, codes) != PH_SMALL_SET) {
            continue;
        }
        const double longest = fmax(fmax(hypot(sides.dx1, sides.dy1), hypot(sides.dx2, sides.dy2)),
                                    hypot(sides.dx2 - sides.dx1, sides.dy2 - sides.dy1));
        if (!ph_set_small_colours(&t, &setting, v, NULL)) {
            assert_true(sides.area < longest * longest / 8 || sides.area < 768 * longest);
            continue;
        }
        memset(depth, 0, sizeof depth);
        t.as.small.of.own.draw(&t, &band);
        worst = fmax(worst, worst_of(v, &sides));
        taken++;
    }
    print_message("%d triangles, most %.3f of a step\n", taken, worst);
    assert_true(taken > TRIANGLES / 4);
    assert_true(worst > .5 && worst < .5 + .25 + 1. / 32);
}

/* A corner, from the first one in 1/256 px. */
struct beside {
    int32_t dx, dy;
};

/* Whether a triangle takes a step of green from its first corner to the second or to the third one by a plane of that
 * gradient per pixel; the other corner has the colour of the first one. Slopes are such that the gradient is exact. */
static bool takes_step(int corner, struct beside at, struct beside other, int32_t gx, int32_t gy)
{
    const struct ph_material material = {.shading = PH_SHADE_GOURAUD};
    const struct ph_setting setting = {.fast.material = &material};
    const struct ph_vertex first = {.x = 4096, .y = 4096}, same = {.x = 4096 + other.dx, .y = 4096 + other.dy};
    const struct ph_vertex step = {.x = 4096 + at.dx, .y = 4096 + at.dy, .light = 1 << 5};
    const struct ph_vertex *const v[3] = {&first, corner == 1 ? &step : &same, corner == 1 ? &same : &step};
    struct ph_triangle t = {.block = PH_BLOCK_NONE, .y_top = 16};
    t.as.small.of.slopes = (struct ph_slopes){.a = gx, .b = -gx, .d = gy, .c = -gy, .shift = 18};
    return ph_set_small_colours(&t, &setting, v, NULL);
}

/* A step of green is 1024. A corner may be off by a quarter of it. */
static void a_quarter_of_a_step_is_the_most_at_a_corner(void **state)
{
    (void)state;
    const struct beside right = {256, 0}, below = {0, 256}, above = {0, -256}, none = {0, 0};
    for (int corner = 1; corner <= 2; corner++) {
        assert_true(takes_step(corner, right, none, 1024 + 255, 0));
        assert_false(takes_step(corner, right, none, 1024 + 256, 0));
        assert_true(takes_step(corner, right, none, 1024 - 256, 0));
        assert_false(takes_step(corner, right, none, 1024 - 257, 0));
        assert_true(takes_step(corner, below, none, 0, 1024 + 255));
        assert_false(takes_step(corner, below, none, 0, 1024 + 256));
        assert_true(takes_step(corner, right, above, 1024 + 255, 256));
        assert_false(takes_step(corner, right, above, 1024 + 256, 256));
    }
}

/* A pixel may take half of a channel, which has 16 bits; here a corner lies 1/32 px beside the first one. */
static void half_of_a_channel_is_the_most_at_a_pixel(void **state)
{
    (void)state;
    const struct beside right = {8, 0}, left = {-8, 0}, below = {0, 8}, none = {0, 0};
    for (int corner = 1; corner <= 2; corner++) {
        assert_true(takes_step(corner, right, none, 32767, -32768));
        assert_false(takes_step(corner, right, none, 32768, -32768));
        assert_true(takes_step(corner, left, none, -32768, 0));
        assert_false(takes_step(corner, left, none, -32769, 0));
        assert_true(takes_step(corner, below, none, -32768, 32767));
        assert_false(takes_step(corner, below, none, -32768, 32768));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(small_triangles_have_the_planes_of_their_corners),
                                       cmocka_unit_test(a_quarter_of_a_step_is_the_most_at_a_corner),
                                       cmocka_unit_test(half_of_a_channel_is_the_most_at_a_pixel)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
