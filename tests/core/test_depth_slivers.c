/*
 * Depth of thin triangles: planes in 32 bits, against the differences of the corners. A plane that is right at all
 * three corners is so everywhere between them. Slivers down to the least area there is, at every angle, with every
 * difference of depth, of sides up to 32 px (small triangles, in the kernel of this CPU) and to 64 px, or to 64 samples
 * of antialiasing.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "edge.h"
#include "kernels.h"
#include "planes.h"
#include "ref_random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TRIANGLES    2000000
#define CODE         65536.0    /* 16.16 */
#define SMALL_CODES  (9.0 / 16) /* depth_separation.c has the sums */
#define SAMPLE_CODES (9.0 / 8)
#define SHORT_CODES  (5.0 / 16 + 508 / CODE)

struct sliver {
    struct ph_vertex corner[3];
    struct ph_sides sides;
    uint32_t d[3];
};

/* least <= result <= most */
static int32_t between(int32_t least, int32_t most)
{
    return (int32_t)floor(ref_uniform(least, most + 1.0));
}

static int32_t within(int32_t most)
{
    return between(-most, most);
}

/* A triangle, thin in most cases, whose sides are at most `longest` in 1/256 px. False if it has no area. */
static bool make_sliver(int32_t longest, struct sliver *t)
{
    const int32_t size = 1 << between(3, 31 - fx_clz32((uint32_t)longest));
    const int32_t thick = (int32_t)1 << between(0, 8), part = between(0, 256);
    int32_t x1 = within(size), y1 = within(size);
    int32_t x2 = x1 * part / 256 + within(thick), y2 = y1 * part / 256 + within(thick);
    if ((int64_t)x2 * y1 < (int64_t)x1 * y2) {
        const int32_t x = x1, y = y1;
        x1 = x2, y1 = y2, x2 = x, y2 = y;
    }
    const int32_t x = 40 * 256 + within(200), y = 40 * 256 + within(200);
    t->corner[0] = (struct ph_vertex){.x = x, .y = y};
    t->corner[1] = (struct ph_vertex){.x = x + x1, .y = y + y1};
    t->corner[2] = (struct ph_vertex){.x = x + x2, .y = y + y2};
    t->sides = ph_sides(&t->corner[0], &t->corner[1], &t->corner[2]);
    /* The corners of any plane, of one whose corners rise and fall alike, or of one as steep as a surface seen edge-on.
     */
    const int bits = between(1, 30), kind = between(0, 2);
    int64_t d1 = within((int32_t)((1u << bits) - 1)), d2 = kind == 0 ? -d1 : within((int32_t)((1u << bits) - 1));
    if (kind == 1) {
        const int32_t gx = within(1 << (bits / 2)), gy = within(1 << (bits / 2));
        d1 = (int64_t)gx * x1 + (int64_t)gy * y1;
        d2 = (int64_t)gx * x2 + (int64_t)gy * y2;
    }
    t->d[0] = (uint32_t)1 << 31;
    t->d[1] = t->d[0] + (uint32_t)d1;
    t->d[2] = t->d[0] + (uint32_t)d2;
    return llabs(d1) < 1 << 30 && llabs(d2) < 1 << 30 && llabs(d2 - d1) < 1 << 30 && t->sides.area > 0;
}

/* How far a plane, given at the centre of pixel (0, 0), is off at the corners, in codes. */
static double off(const struct sliver *t, const struct ph_plane *plane)
{
    double most = 0;
    for (int i = 0; i < 3; i++) {
        const double x = (t->corner[i].x - 128) / 256.0, y = (t->corner[i].y - 128) / 256.0;
        const double wraps = plane->base + x * (int32_t)plane->gx + y * (int32_t)plane->gy - t->d[i];
        most = fmax(most, fabs(remainder(wraps, 4294967296.0)) / CODE);
    }
    return most;
}

static void expect_right(const struct sliver *s, const struct ph_plane *plane, double most)
{
    const double codes = off(s, plane);
    if (codes > most) {
        fail_msg("%.3f codes: sides %d, %d and %d, %d; depth %d, %d", codes, (int)s->sides.dx1, (int)s->sides.dy1,
                 (int)s->sides.dx2, (int)s->sides.dy2, (int)(s->d[1] - s->d[0]), (int)(s->d[2] - s->d[0]));
    }
}

/* Sets up triangles whose sides are below `side`. */
static void check_small(uint32_t side, double most)
{
    long set = 0, steep = 0;
    for (long i = 0; i < TRIANGLES; i++) {
        struct sliver s;
        const struct ph_vertex *const v[3] = {&s.corner[0], &s.corner[1], &s.corner[2]};
        struct ph_triangle t;
        memset(&t, 0, sizeof(t));
        if (!make_sliver((int32_t)side, &s) || !ph_sides_are_below(&s.sides, side)) {
            continue;
        }
        const enum ph_small_setup done = ph_setup_small(&t, v, &s.sides, s.d);
        steep += done == PH_SMALL_STEEP;
        if (done == PH_SMALL_SET) {
            const struct ph_small_triangle *const small = &t.as.small.rows;
            const struct ph_plane plane = {small->d - (uint32_t)t.y_top * small->d_dy, small->gd, small->d_dy};
            expect_right(&s, &plane, most);
            set++;
        }
    }
    assert_true(set > TRIANGLES / 4 && steep > TRIANGLES / 50);
}

static void small_triangles_are_right(void **state)
{
    (void)state;
    ref_seed(11);
    check_small(PH_SIDE_SMALL, SMALL_CODES);
}

static void samples_are_right(void **state)
{
    (void)state;
    ref_seed(13);
    check_small(PH_SIDE_SHORT, SAMPLE_CODES);
}

static void short_triangles_are_right(void **state)
{
    long set = 0;
    (void)state;
    ref_seed(12);
    for (long i = 0; i < TRIANGLES; i++) {
        struct sliver s;
        struct ph_plane plane;
        if (make_sliver(PH_SIDE_SHORT, &s) && s.sides.is_short && ph_depth_plane(&plane, &s.corner[0], &s.sides, s.d)) {
            expect_right(&s, &plane, SHORT_CODES);
            set++;
        }
    }
    assert_true(set > TRIANGLES / 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_triangles_are_right),
        cmocka_unit_test(samples_are_right),
        cmocka_unit_test(short_triangles_are_right),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
