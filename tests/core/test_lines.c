/*
 * Lines: their pixels follow from the rule in render.h in whole numbers of 64 bits, pixel by pixel and without a walk;
 * their depth is that of a strip of two triangles in which they lie.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "camera.h"
#include "ref_random.h"
#include "ref_rig.h"

#include <stdlib.h>
#include <string.h>

#define WIDE  128
#define HIGH  64 /* powers of two: the scales of the parallel camera are exact */
#define LINES 3000

static const struct ph_material white = {.shading = PH_SHADE_WIRE, .colour = 0xffff};

/* A line on the screen, 1/256 px. */
struct line {
    int64_t x0, y0, x1, y1;
};

static int64_t whole(double low, double high)
{
    return (int64_t)ref_uniform(low, high);
}

/* Long and short ones, level, upright and diagonal ones, on borders of pixels and on centres. */
static struct line any_line(int i)
{
    const double far = i % 5 == 0 ? 200000 : i % 5 == 1 ? 600 : 40000, grid = i % 3 == 0 ? 128 : 1;
    struct line l = {whole(-far, far), whole(-far, far), 0, 0};
    l.x0 = (l.x0 / (int64_t)grid) * (int64_t)grid + (i % 5 == 1 ? 128 * WIDE : 0);
    l.y0 = (l.y0 / (int64_t)grid) * (int64_t)grid + (i % 5 == 1 ? 128 * HIGH : 0);
    l.x1 = i % 7 == 0 ? l.x0 : whole(0, 256 * WIDE / grid) * (int64_t)grid;
    l.y1 = i % 7 == 1 ? l.y0 : whole(0, 256 * HIGH / grid) * (int64_t)grid;
    if (i % 7 == 2) {
        l.y1 = l.y0 + (l.x1 - l.x0);
    }
    return l;
}

static void draw_line(struct rig *rig, const struct line *l)
{
    struct ph_projection p;
    const struct fx_vec3 a = {(fx_t)(l->x0 * 256), (fx_t)((HIGH * 256 - l->y0) * 256), FX_INT(-2)};
    const struct fx_vec3 b = {(fx_t)(l->x1 * 256), (fx_t)((HIGH * 256 - l->y1) * 256), FX_INT(-2)};
    assert_int_equal(ph_projection_ortho(&p, 0, FX_INT(WIDE), 0, FX_INT(HIGH), FX_ONE, FX_INT(3)), PH_OK);
    assert_int_equal(ph_frame_begin(&rig->r, &ph_xform_identity, &p, NULL, 0), PH_OK);
    ph_draw_line(&rig->r, a, b, &white);
    assert_true(rig_finish(rig));
}

/* Whether the line takes the pixel: 1, 0, or -1 where it runs so near to a border that rounding may decide. */
static int takes(const struct line *l, int x, int y)
{
    const int64_t dx = l->x1 - l->x0, dy = l->y1 - l->y0;
    const int x_major = llabs(dx) >= llabs(dy);
    const int64_t centre = 256 * (x_major ? x : y) + 128, from = x_major ? l->x0 : l->y0, length = x_major ? dx : dy;
    const int64_t low = length > 0 ? from : from + length, high = length > 0 ? from + length : from;
    if (centre < low || centre >= high) {
        return 0;
    }
    /* the place across times the length, against the borders of the pixel */
    const int64_t sign = length > 0 ? 1 : -1;
    const int64_t at = sign * ((x_major ? l->y0 : l->x0) * length + (centre - from) * (x_major ? dy : dx));
    const int64_t first = 256 * (x_major ? y : x) * sign * length, last = first + 256 * sign * length;
    const int64_t unsure = sign * length / 3; /* 128 steps, each 2^-17 px off, in 1/256 px */
    if ((x_major ? dy : dx) != 0 && (llabs(at - first) < unsure || llabs(at - last) < unsure)) {
        return -1;
    }
    return at > first && at <= last;
}

static void pixels_are_those_of_the_rule(void **state)
{
    struct rig rig;
    int drawn = 0, unsure = 0;
    (void)state;
    ref_seed(3);
    rig_open(&rig, WIDE, HIGH, 16, PH_DEPTH_FIXED16, 8, 8);
    for (int i = 0; i < LINES; i++) {
        const struct line l = any_line(i);
        draw_line(&rig, &l);
        for (int k = 0; k < WIDE * HIGH; k++) {
            const int right = takes(&l, k % WIDE, k / WIDE), got = rig.pixels[k] != 0;
            if (right >= 0 && right != got) {
                fail_msg("line %d (%d %d) .. (%d %d): pixel %d %d is %d", i, (int)l.x0, (int)l.y0, (int)l.x1, (int)l.y1,
                         k % WIDE, k / WIDE, got);
            }
            drawn += got;
            unsure += right < 0;
        }
    }
    assert_true(drawn > 20 * LINES && unsure < drawn / 25);
    rig_close(&rig);
}

/* No column of an x-major line or row of a high one has two pixels or, inside the picture, none. */
static void a_line_has_one_pixel_a_column(void **state)
{
    struct rig rig;
    (void)state;
    ref_seed(5);
    rig_open(&rig, WIDE, HIGH, HIGH, PH_DEPTH_FIXED16, 8, 8);
    for (int i = 0; i < LINES / 4; i++) {
        const struct line l = {whole(0, 256 * WIDE), whole(0, 256 * HIGH), whole(0, 256 * WIDE), whole(0, 256 * HIGH)};
        const int x_major = llabs(l.x1 - l.x0) >= llabs(l.y1 - l.y0);
        const int64_t a = x_major ? l.x0 : l.y0, b = x_major ? l.x1 : l.y1, low = a < b ? a : b, high = a < b ? b : a;
        draw_line(&rig, &l);
        for (int along = 0; along < (x_major ? WIDE : HIGH); along++) {
            int here = 0;
            for (int across = 0; across < (x_major ? HIGH : WIDE); across++) {
                here += rig.pixels[x_major ? across * WIDE + along : along * WIDE + across] != 0;
            }
            assert_int_equal(here, 256 * along + 128 >= low && 256 * along + 128 < high);
        }
    }
    rig_close(&rig);
}

/* Lines in space, most of them with an end outside the picture or near the eye. */
static void draw_scene(struct rig *rig, const struct ph_material *material)
{
    struct ph_projection p;
    assert_int_equal(ph_projection_perspective(&p, FX_INT(60), WIDE * FX_ONE / HIGH, FX_ONE / 4, FX_INT(200)), PH_OK);
    assert_int_equal(ph_frame_begin(&rig->r, &ph_xform_identity, &p, NULL, 0), PH_OK);
    ref_seed(7);
    for (int i = 0; i < 150; i++) {
        struct fx_vec3 v[2];
        for (int k = 0; k < 2; k++) {
            const double z = i % 3 == 0 ? ref_uniform(-.5, 150) : ref_uniform(.5, 6);
            v[k] = (struct fx_vec3){ref_q16(ref_uniform(-1, 1) * z), ref_q16(ref_uniform(-1, 1) * z), ref_q16(-z)};
        }
        ph_draw_line(&rig->r, v[0], v[1], material);
    }
    assert_true(rig_finish(rig));
}

static void bands_do_not_change_a_line(void **state)
{
    static const int bands[] = {1, 7, 16, 64};
    (void)state;
    for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
        const struct ph_depth_format *const format = ph_depth_formats[f];
        for (int slope = 0; slope < 2; slope++) {
            struct ph_material material = white;
            struct rig whole_picture, rig;
            material.depth_bias_slope = (uint8_t)slope;
            rig_open(&whole_picture, WIDE, HIGH, HIGH, format, 200, 400);
            draw_scene(&whole_picture, &material);
            for (int i = 0; i < 8; i++) {
                rig_open(&rig, WIDE, HIGH, bands[i / 2], format, i % 2 == 0 ? 200 : 8,
                         i % 2 == 0 ? 400 : /* few slots */ (int)(6400 / ph_triangle_bytes));
                draw_scene(&rig, &material);
                assert_int_equal(rig.r.stats.triangles_dropped, 0);
                assert_memory_equal(rig.pixels, whole_picture.pixels, WIDE * HIGH * sizeof *rig.pixels);
                assert_memory_equal(rig.depth, whole_picture.depth, WIDE * HIGH * sizeof *rig.depth);
                rig_close(&rig);
            }
            rig_close(&whole_picture);
        }
    }
}

/* ---- depth -------------------------------------------------------------------------------------------------- */

/* A strip of two triangles, six pixels wide across the longer axis, whose middle is the line from a to b. */
struct strip {
    struct fx_vec3 positions[4], a, b;
    struct ph_part part;
    struct ph_mesh mesh;
};

#define FOCAL 55.4 /* pixels at a distance of 1: 32 / tan 30 degrees */

static void any_strip(struct strip *s, int i)
{
    static const uint16_t triangles[2][3] = {{0, 1, 2}, {2, 1, 3}};
    static const struct ph_material both_sides = {.shading = PH_SHADE_UNLIT, .two_sided = 1, .colour = 0x1234};
    double at[2][3];
    for (int k = 0; k < 2; k++) {
        at[k][2] = i % 2 == 0 ? ref_uniform(.5, 8) : ref_uniform(20, 190);
        at[k][0] = ref_uniform(-58, 58) / FOCAL;
        at[k][1] = ref_uniform(-30, 30) / FOCAL;
    }
    const int x_major = (at[1][0] - at[0][0]) * (at[1][0] - at[0][0]) >= (at[1][1] - at[0][1]) * (at[1][1] - at[0][1]);
    for (int k = 0; k < 6; k++) {
        const double side = k > 3 ? 0 : k % 2 == 0 ? 3 / FOCAL : -3 / FOCAL, *const p = at[k > 3 ? k - 4 : k / 2];
        const struct fx_vec3 v = {ref_q16((p[0] + (x_major ? 0 : side)) * p[2]),
                                  ref_q16((p[1] + (x_major ? side : 0)) * p[2]), ref_q16(-p[2])};
        *(k > 3 ? k == 4 ? &s->a : &s->b : &s->positions[k]) = v;
    }
    s->part = (struct ph_part){0, 2, 0};
    s->mesh = (struct ph_mesh){.positions = s->positions,
                               .triangles = triangles,
                               .parts = &s->part,
                               .materials = &both_sides,
                               .vertex_count = 4,
                               .triangle_count = 2,
                               .part_count = 1};
}

static void draw_one(struct rig *rig, const struct strip *s, int line)
{
    struct ph_projection p;
    assert_int_equal(ph_projection_perspective(&p, FX_INT(60), WIDE * FX_ONE / HIGH, FX_ONE / 4, FX_INT(200)), PH_OK);
    assert_int_equal(ph_frame_begin(&rig->r, &ph_xform_identity, &p, NULL, 0), PH_OK);
    if (line) {
        ph_draw_line(&rig->r, s->a, s->b, &white);
    } else {
        assert_int_equal(ph_draw_mesh(&rig->r, &s->mesh, &ph_xform_identity), PH_OK);
    }
    assert_true(rig_finish(rig));
}

/* Two codes of 16 bits at most, or what the ends' rounding to 1/256 px makes of them. */
static void depth_is_that_of_a_surface_along_the_line(void **state)
{
    (void)state;
    for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
        const struct ph_depth_format *const format = ph_depth_formats[f];
        struct rig line, surface;
        int compared = 0;
        ref_seed(11);
        rig_open(&line, WIDE, HIGH, 16, format, 8, 64);
        rig_open(&surface, WIDE, HIGH, 16, format, 8, 64);
        const int unit = ph_depth_bytes(line.r.config.depth_format) == 4 ? 256 : 1;
        for (int i = 0; i < 400; i++) {
            struct strip s;
            any_strip(&s, i);
            draw_one(&line, &s, 1);
            draw_one(&surface, &s, 0);
            uint32_t least = UINT32_MAX, most = 0;
            int pixels = 1;
            for (int k = 0; k < WIDE * HIGH; k++) {
                const uint32_t d = line.depth[k];
                least = d != 0 && d < least ? d : least;
                most = d > most ? d : most;
                pixels += d != 0;
            }
            for (int k = 0; k < WIDE * HIGH; k++) {
                if (line.depth[k] != 0 && surface.depth[k] != 0) {
                    const int64_t off = llabs((int64_t)line.depth[k] - surface.depth[k]);
                    assert_true(off <= 2 * unit + (int64_t)(most - least) / pixels / 32);
                    compared++;
                }
            }
        }
        assert_true(compared > 10000);
        rig_close(&line);
        rig_close(&surface);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_are_those_of_the_rule),
        cmocka_unit_test(a_line_has_one_pixel_a_column),
        cmocka_unit_test(bands_do_not_change_a_line),
        cmocka_unit_test(depth_is_that_of_a_surface_along_the_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
