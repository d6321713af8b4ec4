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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(small_triangles_have_the_planes_of_their_corners)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
