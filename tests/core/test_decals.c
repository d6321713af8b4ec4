/*
 * Decals that lie in the plane of their surface: with the recipe of scene.h (PH_DECAL_SLOPE) every pixel of a decal
 * shows, and none shows through a card a quarter of the distance before it. Random lenses, tilts up to 89 degrees,
 * turns and sizes; all corners lie exactly in one plane. And depth_bias beyond its range: one surface has one depth.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_random.h"
#include "ref_rig.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef SCENES /* a format; the long test has more: exhaustive_decals.c */
#define SCENES 400
#define SEED   11
#endif

enum { WIDTH = 120, HEIGHT = 90, SURFACE = 1, DECAL = 2, CARD = 3 };

static void draw(struct rig *rig, const struct fx_vec3 p[4], uint8_t slope, uint8_t bias, uint16_t colour)
{
    static const uint16_t faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
    const struct ph_part part = {0, 2, 0};
    const struct ph_material material = {
        .shading = PH_SHADE_UNLIT, .two_sided = 1, .colour = colour, .depth_bias = bias, .depth_bias_slope = slope};
    const struct ph_mesh mesh = {.positions = p,
                                 .vertex_count = 4,
                                 .triangles = faces,
                                 .triangle_count = 2,
                                 .parts = &part,
                                 .part_count = 1,
                                 .materials = &material};
    assert_int_equal(ph_draw_mesh(&rig->r, &mesh, &ph_xform_identity), PH_OK);
}

struct scene {
    struct ph_projection projection;
    struct fx_vec3 surface[4], decal[4], card[4];
};

static struct fx_vec3 at(const int32_t o[3], const int32_t a[3], const int32_t b[3], int u, int v)
{
    return (struct fx_vec3){o[0] + u * a[0] + v * b[0], o[1] + u * a[1] + v * b[1], -(o[2] + u * a[2] + v * b[2])};
}

/* Corners are whole multiples of two vectors in Q16.16, so all lie in one plane. False: they do not fit. */
static bool random_scene(struct scene *s)
{
    const double near_m = .05 * pow(40, ref_uniform(0, 1)), far_m = near_m * pow(1000, ref_uniform(.3, 1));
    const double fov = ref_uniform(30, 90), high = 2 * tan(fov * acos(-1) / 360);
    const double tilt = ref_uniform(0, 89) * acos(-1) / 180, side = ref_uniform(0, 6.283), turn = ref_uniform(0, 6.283);
    const double z = near_m * pow(far_m / near_m, ref_uniform(.1, .9)), size = z * high * pow(2, ref_uniform(-2, 1.5));
    const double along[3] = {cos(tilt) * cos(side), cos(tilt) * sin(side), sin(tilt)},
                 across[3] = {-sin(side), cos(side)};
    const double part = ref_uniform(.1, .5) * 256;
    int32_t a[3], b[3], o[3];
    bool fits = true;
    assert_int_equal(ph_projection_perspective(&s->projection, ref_q16(fov), ref_q16((double)WIDTH / HEIGHT),
                                               ref_q16(near_m), ref_q16(far_m)),
                     PH_OK);
    for (int i = 0; i < 3; i++) {
        a[i] = ref_q16(along[i] * size / 512);
        b[i] = ref_q16(across[i] * size / 512);
        o[i] = ref_q16(i == 2 ? z : ref_uniform(-.3, .3) * z * high);
    }
    for (int i = 0; i < 4; i++) {
        const int u = i == 0 || i == 3 ? -1 : 1, v = i < 2 ? -1 : 1;
        s->surface[i] = at(o, a, b, 256 * u, 256 * v);
        s->decal[i] = at(o, a, b, (int)lrint(part * (u * cos(turn) - v * sin(turn))),
                         (int)lrint(part * (u * sin(turn) + v * cos(turn))));
        s->card[i] = (struct fx_vec3){s->surface[i].x / 4 * 3, s->surface[i].y / 4 * 3, s->surface[i].z / 4 * 3};
        fits &= -s->card[i].z > s->projection.near_z && -s->surface[i].z < s->projection.far_z;
    }
    return fits;
}

struct counts {
    long scenes, pixels, lost, through;
};

static void count(struct rig *rig, const struct scene *s, uint8_t slope, uint8_t bias, struct counts *n)
{
    static uint16_t alone[WIDTH * HEIGHT], card[WIDTH * HEIGHT];
    assert_int_equal(ph_frame_begin(&rig->r, &ph_xform_identity, &s->projection, NULL, 0), PH_OK);
    draw(rig, s->decal, slope, bias, DECAL);
    assert_true(rig_finish(rig));
    memcpy(alone, rig->pixels, sizeof alone);
    assert_int_equal(ph_frame_begin(&rig->r, &ph_xform_identity, &s->projection, NULL, 0), PH_OK);
    draw(rig, s->card, 0, 0, CARD);
    assert_true(rig_finish(rig));
    memcpy(card, rig->pixels, sizeof card);
    for (int with_card = 0; with_card < 2; with_card++) {
        assert_int_equal(ph_frame_begin(&rig->r, &ph_xform_identity, &s->projection, NULL, 0), PH_OK);
        draw(rig, s->surface, 0, 0, SURFACE);
        draw(rig, s->decal, slope, bias, DECAL);
        if (with_card) {
            draw(rig, s->card, 0, 0, CARD);
        }
        assert_true(rig_finish(rig));
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            n->pixels += !with_card && alone[i] == DECAL;
            n->lost += !with_card && alone[i] == DECAL && rig->pixels[i] != DECAL;
            n->through += with_card && card[i] == CARD && rig->pixels[i] == DECAL;
        }
    }
    n->scenes++;
}

static struct counts count_scenes(const struct ph_depth_format *format, uint8_t slope, uint8_t bias)
{
    struct counts n = {0, 0, 0, 0};
    struct rig rig;
    struct scene s;
    rig_open(&rig, WIDTH, HEIGHT, HEIGHT, format, 64, 64);
    ref_seed(SEED);
    while (n.scenes < SCENES) {
        if (random_scene(&s)) {
            count(&rig, &s, slope, bias, &n);
        }
    }
    rig_close(&rig);
    printf("# %s, slope %d, bias %d: of %ld pixels of decals in %ld scenes %ld are lost, %ld show through\n",
           format->name, slope, bias, n.pixels, n.scenes, n.lost, n.through);
    return n;
}

static void decals_show_and_nothing_shows_through(void **state)
{
    (void)state;
    for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
        const struct ph_depth_format *const format = ph_depth_formats[f];
        const struct counts n =
            count_scenes(format, PH_DECAL_SLOPE, format->coding == PH_DEPTH_IS_FLOAT ? PH_DECAL_BIAS : 2);
        assert_true(n.pixels > 500 * n.scenes);
        assert_int_equal(n.lost, 0);
        assert_int_equal(n.through, 0);
    }
}

/* What the header once said: the slope alone. */
static void the_slope_alone_is_not_enough(void **state)
{
    (void)state;
    assert_true(count_scenes(PH_DEPTH_FIXED16, PH_DECAL_SLOPE, 0).lost > 1000);
    assert_true(count_scenes(PH_DEPTH_FLOAT16, PH_DECAL_SLOPE, 0).lost > 1000);
}

/* Triangles across octaves of a float, and ones inside: more than 56 counts as 56 in all of them. */
static void a_bias_beyond_its_range_is_the_largest(void **state)
{
    static uint32_t depth[WIDTH * HEIGHT];
    long drawn = 0;
    (void)state;
    for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
        struct rig rig;
        struct scene s;
        rig_open(&rig, WIDTH, HEIGHT, HEIGHT, ph_depth_formats[f], 64, 64);
        ref_seed(SEED + 1);
        for (int n = 0; n < 100;) {
            if (!random_scene(&s)) {
                continue;
            }
            n++;
            for (int beyond = 0; beyond < 2; beyond++) {
                assert_int_equal(ph_frame_begin(&rig.r, &ph_xform_identity, &s.projection, NULL, 0), PH_OK);
                draw(&rig, s.surface, 0, beyond ? 255 : 56, SURFACE);
                assert_true(rig_finish(&rig));
                assert_true(!beyond || memcmp(depth, rig.depth, sizeof depth) == 0);
                memcpy(depth, rig.depth, sizeof depth);
                drawn += (long)rig.r.stats.fragments;
            }
        }
        rig_close(&rig);
    }
    assert_true(drawn > 100000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decals_show_and_nothing_shows_through),
        cmocka_unit_test(the_slope_alone_is_not_enough),
        cmocka_unit_test(a_bias_beyond_its_range_is_the_largest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
