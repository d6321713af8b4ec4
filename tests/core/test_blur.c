/*
 * Depth of field is compared with a reference in double that has the whole picture. It computes distances from the
 * depth codes, a thin lens' radius from each distance, and then the two passes that blur.h describes.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "blur.h"
#include "ref_random.h"
#include "ref_rig.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define WIDTH    64
#define HEIGHT   48
#define PIXELS   (WIDTH * HEIGHT)
#define NEAR     1.
#define FAR      60.
#define QUAD_MAX 40

/* Upright squares at several distances, each in one colour. */
struct scene {
    struct fx_vec3 positions[4 * QUAD_MAX];
    uint16_t triangles[2 * QUAD_MAX][3];
    struct ph_part parts[QUAD_MAX];
    struct ph_material materials[QUAD_MAX];
    struct ph_mesh mesh;
    int quads;
};

static void add_square(struct scene *s, double x, double y, double z, double half, uint16_t colour)
{
    const int q = s->quads++;
    for (int i = 0; i < 4; i++) {
        s->positions[4 * q + i] =
            (struct fx_vec3){ref_q16(x + (i == 1 || i == 2 ? half : -half)), ref_q16(y + (i >= 2 ? half : -half)),
                             ref_q16(-z - (i >= 2 ? z / 3 : 0))};
    }
    for (int i = 0; i < 6; i++) {
        s->triangles[2 * q + i / 3][i % 3] = (uint16_t)(4 * q + (i % 3 == 0 ? 0 : i % 3 + i / 3));
    }
    s->parts[q] = (struct ph_part){(uint32_t)(2 * q), 2, (uint16_t)q};
    s->materials[q] = (struct ph_material){.shading = PH_SHADE_UNLIT, .colour = colour};
    s->mesh = (struct ph_mesh){.positions = s->positions,
                               .triangles = (const uint16_t(*)[3])s->triangles,
                               .parts = s->parts,
                               .materials = s->materials,
                               .vertex_count = (uint32_t)(4 * s->quads),
                               .triangle_count = (uint32_t)(2 * s->quads),
                               .part_count = (uint32_t)s->quads};
}

static void build_random(struct scene *s)
{
    s->quads = 0;
    for (int i = 0; i < 30; i++) {
        const double z = 1.5 * exp(ref_uniform(0, 3));
        add_square(s, ref_uniform(-.5, .5) * z, ref_uniform(-.4, .4) * z, z, .14 * z,
                   ph_rgb565((uint8_t)ref_uniform(0, 255), (uint8_t)ref_uniform(0, 255), (uint8_t)ref_uniform(0, 255)));
    }
}

/* exponent: see struct ph_config. */
static void draw_with(struct rig *rig, const struct scene *s, int band, const struct ph_depth_format *format,
                      int exponent)
{
    struct ph_projection p;
    rig_open(rig, WIDTH, HEIGHT, band, format, 4 * QUAD_MAX, 4 * QUAD_MAX);
    rig->r.config.depth_exponent = (uint8_t)exponent;
    assert_int_equal(
        ph_projection_perspective(&p, FX_INT(50), ref_q16((double)WIDTH / HEIGHT), ref_q16(NEAR), ref_q16(FAR)), PH_OK);
    assert_int_equal(ph_frame_begin(&rig->r, &ph_xform_identity, &p, NULL, ph_rgb565(90, 120, 200)), PH_OK);
    assert_int_equal(ph_draw_mesh(&rig->r, &s->mesh, &ph_xform_identity), PH_OK);
}

static void draw(struct rig *rig, const struct scene *s, int band, const struct ph_depth_format *format)
{
    draw_with(rig, s, band, format, 0);
}

/* Draws all bands through the blur, with exactly the memory that it asks for. */
static void finish_blurred(struct rig *rig, const struct ph_focus *focus)
{
    const size_t bytes = PH_BLUR_BYTES(WIDTH, rig->r.config.band_height, focus->radius);
    void *scratch = malloc(bytes);
    struct ph_blur blur;
    assert_non_null(scratch);
    const uint32_t bands = ph_frame_bands(&rig->r);
    assert_int_equal(ph_blur_begin(&blur, &rig->r, scratch, bytes, focus), PH_OK);
    uint32_t row = 0;
    for (uint32_t i = 0; i < bands; i++) {
        row += ph_blur_band(&blur, &rig->r, i, rig->pixels + row * WIDTH);
    }
    assert_int_equal(row, HEIGHT);
    free(scratch);
}

/* Radius in pixels, positive before the focal plane. */
static double radius_of(const struct rig *rig, int i, const struct ph_focus *focus)
{
    const double strength = focus->strength / 65536., focal = focus->distance / 65536.;
    const double over = rig->depth[i] == 0 ? 0 : focal / rig_distance(rig, rig->depth[i], NEAR, FAR);
    const double most = focus->radius + 15 / 16.;
    return fmax(-most, fmin(most, strength * (over - 1)));
}

/* One pass over `in` in steps of `step` pixels; position and size along that direction. */
static void mix_pixel(const double (*in)[3], const double *radius, int i, int at, int size, int step, int most,
                      double out[3])
{
    double rest = 1;
    out[0] = out[1] = out[2] = 0;
    for (int k = 1; k <= most; k++) {
        for (int side = -1; side <= 1; side += 2) {
            if (at + side * k < 0 || at + side * k >= size) {
                continue;
            }
            const int j = i + side * k * step;
            const double c = fabs(fmax(radius[i], radius[j]));
            const double share = c > k ? fmin(rest, fmin(1, c - k) / (2 * c - 1)) : 0;
            for (int x = 0; x < 3; x++) {
                out[x] += share * in[j][x];
            }
            rest -= share;
        }
    }
    for (int x = 0; x < 3; x++) {
        out[x] += rest * in[i][x];
    }
}

static void blur_reference(const struct rig *rig, const struct ph_focus *focus, double (*out)[3])
{
    static double sharp[PIXELS][3], along[PIXELS][3], radius[PIXELS];
    for (int i = 0; i < PIXELS; i++) {
        rig_rgb(rig, i % WIDTH, i / WIDTH, sharp[i]);
        radius[i] = radius_of(rig, i, focus);
    }
    for (int i = 0; i < PIXELS; i++) {
        mix_pixel((const double(*)[3])sharp, radius, i, i % WIDTH, WIDTH, 1, focus->radius, along[i]);
    }
    for (int i = 0; i < PIXELS; i++) {
        mix_pixel((const double(*)[3])along, radius, i, i / WIDTH, HEIGHT, WIDTH, focus->radius, out[i]);
    }
}

static void picture_is_that_of_a_thin_lens(void **state)
{
    static double want[PIXELS][3];
    struct scene *s = malloc(sizeof(*s));
    (void)state;
    assert_non_null(s);
    ref_seed(6);
    for (int i = 0; i < 48; i++) {
        struct rig sharp, blurred;
        const struct ph_focus focus = {ref_q16(ref_uniform(1.2, 20)), ref_q16(ref_uniform(.5, 8)),
                                       (uint8_t)(1 + i % 7)};
        const struct ph_depth_format *const format = ph_depth_formats[i % PH_DEPTH_FORMATS];
        const int exponent = i < 24 ? 0 : 3 + i / PH_DEPTH_FORMATS % 4;
        double sum = 0;
        build_random(s);
        draw_with(&sharp, s, HEIGHT, format, exponent);
        assert_true(rig_finish(&sharp));
        blur_reference(&sharp, &focus, want);
        draw_with(&blurred, s, 9, format, exponent);
        finish_blurred(&blurred, &focus);
        for (int k = 0; k < PIXELS; k++) {
            double got[3];
            rig_rgb(&blurred, k % WIDTH, k / WIDTH, got);
            for (int x = 0; x < 3; x++) { /* steps of 8, rounded twice; radii rounded to 1/16 px */
                assert_true(fabs(got[x] - want[k][x]) < 24);
                sum += fabs(got[x] - want[k][x]);
            }
        }
        assert_true(sum < 3. * PIXELS * 3);
        rig_close(&sharp);
        rig_close(&blurred);
    }
    free(s);
}

/* The lens' law at a distance, in every projection: strength (focal / z - 1), in parallel strength (focal - z) / (far -
 * near). d has 2^-20 and `per_d` 1/256 px, so that it is less than 1/32 px off before it is rounded down. */
static void blur_at_a_distance_is_the_lens_law(void **state)
{
    static uint16_t scratch[PH_BLUR_BYTES(WIDTH, 9, PH_BLUR_RADIUS_MAX) / 2];
    (void)state;
    ref_seed(46);
    for (int i = 0; i < 3000; i++) {
        struct rig rig;
        struct ph_blur blur;
        struct ph_projection p;
        const double focal = ref_uniform(1.2, 50), strength = ref_uniform(.5, 9), z = ref_uniform(1, 60);
        const struct ph_focus focus = {ref_q16(focal), ref_q16(strength), (uint8_t)(1 + i % 7)};
        rig_open(&rig, WIDTH, HEIGHT, 9, ph_depth_formats[i % PH_DEPTH_FORMATS], 4, 4);
        const int status = i % 3 == 0   ? ph_projection_perspective(&p, FX_INT(50), FX_ONE, FX_ONE, FX_INT(60))
                           : i % 3 == 1 ? ph_projection_fisheye(&p, FX_INT(180), FX_ONE, FX_INT(60))
                                        : ph_projection_ortho(&p, -FX_ONE, FX_ONE, -FX_ONE, FX_ONE, FX_ONE, FX_INT(60));
        assert_int_equal(status, PH_OK);
        assert_int_equal(ph_frame_begin(&rig.r, &ph_xform_identity, &p, NULL, 0), PH_OK);
        assert_int_equal(ph_blur_begin(&blur, &rig.r, scratch, sizeof scratch, &focus), PH_OK);
        const double most = focus.radius + 15 / 16.;
        const double law = i % 3 == 2 ? strength * (focal - z) / 59 : strength * (focal / z - 1);
        const double want = fmax(-most, fmin(most, law)), got = ph_blur_at(&blur, ref_q16(z)) / 16.;
        assert_true(fabs(got) <= fabs(want) + 1 / 32. && fabs(got) > fabs(want) - 1 / 16. - 1 / 32.);
        rig_close(&rig);
    }
}

static void picture_does_not_depend_on_the_band_height(void **state)
{
    static const int bands[] = {1, 2, 5, 16, 31, 47};
    struct scene *s = malloc(sizeof(*s));
    (void)state;
    assert_non_null(s);
    ref_seed(16);
    build_random(s);
    for (int radius = 1; radius <= PH_BLUR_RADIUS_MAX; radius++) {
        const struct ph_focus focus = {FX_INT(4), FX_INT(6), (uint8_t)radius};
        struct rig whole;
        draw(&whole, s, HEIGHT, PH_DEPTH_FIXED16);
        finish_blurred(&whole, &focus);
        for (int i = 0; i < 6; i++) {
            struct rig rig;
            draw(&rig, s, bands[i], PH_DEPTH_FIXED16);
            finish_blurred(&rig, &focus);
            assert_memory_equal(rig.pixels, whole.pixels, PIXELS * 2);
            rig_close(&rig);
        }
        rig_close(&whole);
    }
    free(s);
}

static void without_strength_nothing_changes(void **state)
{
    struct scene *s = malloc(sizeof(*s));
    const struct ph_focus focus = {FX_INT(4), 0, 5};
    struct rig sharp, blurred;
    (void)state;
    assert_non_null(s);
    ref_seed(26);
    build_random(s);
    draw(&sharp, s, HEIGHT, PH_DEPTH_FLOAT16);
    assert_true(rig_finish(&sharp));
    draw(&blurred, s, 16, PH_DEPTH_FLOAT16);
    finish_blurred(&blurred, &focus);
    assert_memory_equal(sharp.pixels, blurred.pixels, PIXELS * 2);
    rig_close(&sharp);
    rig_close(&blurred);
    free(s);
}

/* A red square in focus before a green one far behind: no pixel of either gets anything of the other. */
static void sharp_object_does_not_bleed_into_the_background(void **state)
{
    struct scene *s = malloc(sizeof(*s));
    const struct ph_focus focus = {ref_q16(2.3), FX_INT(6), 6};
    const uint16_t red = ph_rgb565(255, 0, 0), green = ph_rgb565(0, 255, 0);
    struct rig rig;
    int reds = 0;
    (void)state;
    assert_non_null(s);
    s->quads = 0;
    add_square(s, 0, 0, 30, 60, green);
    add_square(s, 0, 0, 2, .4, red);
    draw(&rig, s, 8, PH_DEPTH_FIXED16);
    finish_blurred(&rig, &focus);
    for (int i = 0; i < PIXELS; i++) {
        assert_true(rig.pixels[i] == red || rig.pixels[i] == green);
        reds += rig.pixels[i] == red;
    }
    assert_in_range(reds, 100, PIXELS / 2);
    rig_close(&rig);
    free(s);
}

/* A red square before the focal plane: it spreads over the sharp green behind it, which shines through at its rim. */
static void blurred_foreground_spreads_over_what_is_sharp(void **state)
{
    struct scene *s = malloc(sizeof(*s));
    const struct ph_focus focus = {FX_INT(30), FX_ONE / 4, 5};
    struct rig rig;
    double last = 255;
    int mixed = 0;
    (void)state;
    assert_non_null(s);
    s->quads = 0;
    add_square(s, 0, 0, 26, 60, ph_rgb565(0, 255, 0));
    add_square(s, -3, 0, 2, 3, ph_rgb565(255, 0, 0)); /* its right edge in the middle */
    draw(&rig, s, 8, PH_DEPTH_FIXED16);
    finish_blurred(&rig, &focus);
    for (int x = WIDTH / 2 - 10; x < WIDTH / 2 + 10; x++) {
        double rgb[3];
        rig_rgb(&rig, x, HEIGHT / 2, rgb);
        assert_true(rgb[0] <= last);
        mixed += rgb[0] > 20 && rgb[0] < 235;
        last = rgb[0];
    }
    assert_true(last == 0);
    assert_in_range(mixed, 4, 9);
    rig_close(&rig);
    free(s);
}

static void impossible_values_are_refused(void **state)
{
    struct scene *s = malloc(sizeof(*s));
    struct ph_blur blur;
    struct rig rig;
    static uint16_t scratch[PH_BLUR_BYTES(WIDTH, 8, 4) / 2];
    const struct ph_focus good = {FX_ONE, FX_ONE, 4};
    struct ph_focus bad[5];
    (void)state;
    assert_non_null(s);
    build_random(s);
    draw(&rig, s, 8, PH_DEPTH_FIXED16);
    assert_int_equal(ph_blur_begin(&blur, &rig.r, scratch, sizeof(scratch), &good), PH_OK);
    assert_int_equal(ph_blur_begin(&blur, &rig.r, scratch, sizeof(scratch) - 1, &good), PH_ERR_NOMEM);
    assert_int_equal(ph_blur_begin(&blur, &rig.r, NULL, sizeof(scratch), &good), PH_ERR_INVAL);
    for (int i = 0; i < 5; i++) {
        bad[i] = good;
    }
    bad[0].distance = 0;
    bad[1].strength = -1;
    bad[2].strength = FX_INT(64) + 1;
    bad[3].radius = 0;
    bad[4].radius = PH_BLUR_RADIUS_MAX + 1;
    for (int i = 0; i < 5; i++) {
        assert_int_equal(ph_blur_begin(&blur, &rig.r, scratch, sizeof(scratch), &bad[i]), PH_ERR_INVAL);
    }
    rig_close(&rig);
    free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(picture_is_that_of_a_thin_lens),
        cmocka_unit_test(blur_at_a_distance_is_the_lens_law),
        cmocka_unit_test(picture_does_not_depend_on_the_band_height),
        cmocka_unit_test(without_strength_nothing_changes),
        cmocka_unit_test(sharp_object_does_not_bleed_into_the_background),
        cmocka_unit_test(blurred_foreground_spreads_over_what_is_sharp),
        cmocka_unit_test(impossible_values_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
