/*
 * Antialiasing: how much of a pixel a white triangle covers is compared with 64 exact samples, a line with its length,
 * and a frame does not depend on its bands. What is not on an edge is as it is without antialiasing.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_random.h"
#include "render.h"
#include "surface_row.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { W = 64, H = 48, TRIANGLES = 200 };

struct stage {
    struct ph_renderer r;
    uint16_t pixels[W * H], samples[4 * W * H];
    uint32_t depth[4 * W * H], bins[H];
    uint64_t vertices[512], triangles[1024];
};

static void open_stage(struct stage *s, int lines, bool antialias)
{
    const struct ph_config config = {.width = W,
                                     .height = H,
                                     .band_height = (uint16_t)lines,
                                     .depth_format = PH_DEPTH_FIXED16,
                                     .colouring = PH_COLOURS,
                                     .vertices = s->vertices,
                                     .vertex_max = 64,
                                     .triangles = s->triangles,
                                     .triangle_max = 64,
                                     .bins = s->bins,
                                     .bin_max = H,
                                     .depth = s->depth,
                                     .samples = antialias ? s->samples : NULL,
                                     .antialiasing = PH_ANTIALIAS_2X2};
    assert_int_equal(ph_renderer_init(&s->r, &config), PH_OK);
}

/* One unit is a pixel; (0, 0) is the top left corner of the picture. */
static void begin(struct stage *s, const struct ph_scene_light *light)
{
    struct ph_projection lens;
    assert_int_equal(ph_projection_ortho(&lens, 0, FX_INT(W), FX_INT(-H), 0, FX_ONE, FX_INT(9)), PH_OK);
    assert_int_equal(ph_frame_begin(&s->r, &ph_xform_identity, &lens, light, 0), PH_OK);
}

static void finish(struct stage *s)
{
    const uint32_t bands = ph_frame_bands(&s->r);
    uint32_t rows = 0;
    for (uint32_t band = 0; band < bands; band++) {
        rows += ph_draw_band(&s->r, band, s->pixels + rows * W);
    }
    assert_int_equal(rows, H);
    assert_int_equal(s->r.stats.triangles_dropped, 0);
}

static const struct ph_material white = {.shading = PH_SHADE_UNLIT, .two_sided = 1, .colour = 0xffff};

static void draw_triangle(struct stage *s, const double p[3][2])
{
    static const uint16_t corners[1][3] = {{0, 1, 2}};
    static const struct ph_part all = {.count = 1};
    struct fx_vec3 at[3];
    for (int i = 0; i < 3; i++) {
        at[i] = (struct fx_vec3){ref_q16(p[i][0]), ref_q16(-p[i][1]), -FX_INT(4)};
    }
    const struct ph_mesh mesh = {.positions = at,
                                 .triangles = corners,
                                 .parts = &all,
                                 .materials = &white,
                                 .vertex_count = 3,
                                 .triangle_count = 1,
                                 .part_count = 1};
    begin(s, NULL);
    assert_int_equal(ph_draw_mesh(&s->r, &mesh, &ph_xform_identity), PH_OK);
    finish(s);
}

static double share(const struct stage *s, int x, int y)
{
    const uint16_t v = s->pixels[y * W + x];
    return ((unsigned)(v >> 8 | v << 8) >> 5 & 63) / 63.; /* green; grey is the same in each channel */
}

static double side(const double a[2], const double b[2], double x, double y)
{
    return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
}

/* The share of 8 x 8 samples of a pixel that lie inside. */
static double exact(const double p[3][2], int x, int y)
{
    int inside = 0;
    for (int i = 0; i < 64; i++) {
        const double sx = x + (i % 8 + .5) / 8, sy = y + ((double)(i / 8) + .5) / 8;
        const double a = side(p[0], p[1], sx, sy), b = side(p[1], p[2], sx, sy), c = side(p[2], p[0], sx, sy);
        inside += (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
    }
    return inside / 64.;
}

static double rms_of_edges(bool antialias)
{
    static struct stage s;
    double sum = 0;
    int edges = 0;
    ref_seed(5);
    open_stage(&s, H, antialias);
    for (int i = 0; i < TRIANGLES; i++) {
        double p[3][2];
        for (int k = 0; k < 6; k++) {
            p[k / 2][k % 2] = ref_uniform(0, k % 2 ? H : W);
        }
        draw_triangle(&s, (const double(*)[2])p);
        for (int k = 0; k < W * H; k++) {
            const double part = exact((const double(*)[2])p, k % W, k / W), got = share(&s, k % W, k / W);
            const bool edge = part > 0 && part < 1;
            edges += edge;
            sum += edge ? (got - part) * (got - part) : 0;
            if (!edge && antialias) { /* what 64 samples do not see may be seen by one of four */
                assert_true(fabs(got - part) < .51);
            }
        }
    }
    printf("    %s: %.4f RMS over %d pixels on edges\n", antialias ? "antialiased" : "as usual", sqrt(sum / edges),
           edges);
    return sqrt(sum / edges);
}

static void coverage_is_within_an_eighth_of_64_samples(void **state)
{
    (void)state;
    assert_true(
        surface_row("antialiasing: coverage of pixels on edges", "RMS, of a pixel", rms_of_edges(true), 1. / 8));
    assert_true(rms_of_edges(false) > 1. / 4); /* so the test would see it if nothing were done */
}

/* A triangle whose light is share[i] at corner i, drawn with a ramp of numbers. */
static void draw_lit(struct stage *s, const double p[3][2], const double shares[3])
{
    static const uint16_t corners[1][3] = {{0, 1, 2}};
    static const struct ph_part all = {.count = 1};
    static const struct ph_scene_light ahead = {
        .count = 1,
        .lights = {{.kind = PH_LIGHT_DIRECTIONAL, .intensity = FX_ONE, .to_light_q30 = {0, 0, FX_Q30_ONE}}}};
    uint16_t ramp[PH_RAMP_SIZE];
    struct fx_vec3 at[3];
    int16_t normals[3][3];
    for (unsigned i = 0; i < PH_RAMP_SIZE; i++) {
        ramp[i] = (uint16_t)(i + 1);
    }
    for (int i = 0; i < 3; i++) {
        at[i] = (struct fx_vec3){ref_q16(p[i][0]), ref_q16(-p[i][1]), -FX_INT(4)};
        normals[i][0] = (int16_t)lrint(16384 * sqrt(1 - shares[i] * shares[i]));
        normals[i][1] = 0;
        normals[i][2] = (int16_t)lrint(16384 * shares[i]);
    }
    const struct ph_material lit = {.shading = PH_SHADE_GOURAUD, .two_sided = 1, .diffuse = FX_ONE, .ramp = ramp};
    const struct ph_mesh mesh = {.positions = at,
                                 .normals = (const int16_t(*)[3])normals,
                                 .triangles = corners,
                                 .parts = &all,
                                 .materials = &lit,
                                 .vertex_count = 3,
                                 .triangle_count = 1,
                                 .part_count = 1};
    begin(s, &ahead);
    assert_int_equal(ph_draw_mesh(&s->r, &mesh, &ph_xform_identity), PH_OK);
    finish(s);
}

/* The light of a sample between the corners, as an entry of the ramp. */
static double entry_at(const double p[3][2], const double shares[3], double x, double y)
{
    const double whole = side(p[0], p[1], p[2][0], p[2][1]);
    const double light =
        (shares[0] * side(p[1], p[2], x, y) + shares[1] * side(p[2], p[0], x, y) + shares[2] * side(p[0], p[1], x, y)) /
        whole;
    return 4.5 + 119 * light;
}

/* Triangles that are taller than small ones: as narrow, and as wide as they are tall. */
static void short_triangles_have_the_light_between_their_corners(void **state)
{
    (void)state;
    static struct stage s;
    double worst = 0;
    int seen = 0;
    open_stage(&s, H, true);
    for (int i = 0; i < 2000; i++) {
        double p[3][2], shares[3];
        for (int k = 0; k < 3; k++) {
            p[k][0] = ref_uniform(20, i % 2 ? 35.9 : 51.9);
            p[k][1] = ref_uniform(8, 39.9);
            shares[k] = ref_uniform(0, 1);
        }
        memset(s.samples, 0, sizeof s.samples); /* columns without a triangle keep an earlier frame's */
        draw_lit(&s, (const double(*)[2])p, shares);
        for (int k = 0; fabs(side(p[0], p[1], p[2][0], p[2][1])) > 4 && k < 4 * W * H; k++) {
            if (s.samples[k] != 0) {
                const double x = (k % (2 * W) + .5) / 2, y = ((double)(k / (2 * W)) + .5) / 2;
                worst = fmax(worst, fabs(s.samples[k] - .5 - entry_at((const double(*)[2])p, shares, x, y)));
                seen++;
            }
        }
    }
    printf("    %.2f entries of the ramp at most off, in %d samples\n", worst, seen);
    assert_true(seen > 100000);
    assert_true(surface_row("antialiasing: light of samples", "most, of 119 entries", worst, .75));
}

/* Light of a line: its width is one pixel across its longer axis. */
static void lines_keep_their_width(void **state)
{
    (void)state;
    static struct stage s[2];
    double worst = 0;
    for (int i = 0; i < 40; i++) {
        double sums[2] = {0, 0};
        const struct fx_vec3 a = {ref_q16(ref_uniform(2, W - 2)), ref_q16(-ref_uniform(2, H - 2)), -FX_INT(4)};
        const struct fx_vec3 b = {ref_q16(ref_uniform(2, W - 2)), ref_q16(-ref_uniform(2, H - 2)), -FX_INT(4)};
        int partial = 0;
        for (int antialiased = 0; antialiased < 2; antialiased++) {
            open_stage(&s[antialiased], 7, antialiased != 0);
            begin(&s[antialiased], NULL);
            ph_draw_line(&s[antialiased].r, a, b, &white);
            finish(&s[antialiased]);
            for (int k = 0; k < W * H; k++) {
                const double got = share(&s[antialiased], k % W, k / W);
                sums[antialiased] += got;
                partial += got > 0 && got < 1;
            }
        }
        worst = fmax(worst, fabs(sums[0] - sums[1]));
        assert_true(partial > 0);
    }
    printf("    %.2f pixels of light more or less\n", worst);
    assert_true(surface_row("antialiasing: light of a line", "most, of a pixel", worst, 1.6));
}

/* Near the middle of a row a line covers this row whole, and no other. */
static void a_line_lies_where_it_runs(void **state)
{
    (void)state;
    static struct stage s;
    open_stage(&s, H, true);
    begin(&s, NULL);
    ph_draw_line(&s.r, (struct fx_vec3){FX_INT(5), -FX_ONE * 106 / 10, -FX_INT(4)},
                 (struct fx_vec3){FX_INT(50), -FX_ONE * 106 / 10, -FX_INT(4)}, &white);
    finish(&s);
    for (int k = 0; k < W * H; k++) {
        const bool on = k / W == 10 && k % W >= 5 && k % W < 50;
        assert_true(share(&s, k % W, k / W) == (on ? 1 : 0));
    }
}

static void bands_do_not_change_it(void **state)
{
    (void)state;
    static struct stage whole, bands;
    const double p[3][2] = {{3, 2}, {60.3, 17.7}, {21.9, 46.1}};
    open_stage(&whole, H, true);
    draw_triangle(&whole, p);
    for (int lines = 1; lines < H; lines += 5) {
        open_stage(&bands, lines, true);
        draw_triangle(&bands, p);
        assert_memory_equal(bands.pixels, whole.pixels, sizeof whole.pixels);
    }
}

/* A blur reads the depth of all bands. */
static void an_empty_band_has_no_depth(void **state)
{
    (void)state;
    static struct stage s;
    const double p[3][2] = {{3, 2}, {60.3, 17.7}, {21.9, 46.1}};
    uint32_t codes = 0;
    open_stage(&s, 5, true);
    draw_triangle(&s, p);
    memset(s.depth, 0x55, sizeof s.depth);
    begin(&s, NULL);
    finish(&s);
    for (uint32_t i = 0; i < 4 * W * 5 / 2; i++) { /* two codes in a word */
        codes |= s.depth[i];
    }
    assert_int_equal(codes, 0);
}

static void pictures_over_512_pixels_are_refused(void **state)
{
    (void)state;
    static struct stage s;
    struct ph_config config = {.width = 513,
                               .height = 1,
                               .band_height = 1,
                               .depth_format = PH_DEPTH_FIXED16,
                               .vertices = s.vertices,
                               .triangles = s.triangles,
                               .bins = s.bins,
                               .bin_max = 1,
                               .depth = s.depth,
                               .samples = s.samples,
                               .antialiasing = PH_ANTIALIAS_2X2};
    struct ph_renderer r;
    assert_int_equal(ph_renderer_init(&r, &config), PH_ERR_INVAL);
    config.width = 512;
    assert_int_equal(ph_renderer_init(&r, &config), PH_OK);
    config.samples = (uint16_t *)s.samples + 1; /* pairs of samples are read as words */
    assert_int_equal(ph_renderer_init(&r, &config), PH_ERR_INVAL);
    config.samples = s.samples;
    config.antialiasing = NULL;
    assert_int_equal(ph_renderer_init(&r, &config), PH_ERR_INVAL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coverage_is_within_an_eighth_of_64_samples),
        cmocka_unit_test(short_triangles_have_the_light_between_their_corners),
        cmocka_unit_test(lines_keep_their_width),
        cmocka_unit_test(a_line_lies_where_it_runs),
        cmocka_unit_test(bands_do_not_change_it),
        cmocka_unit_test(an_empty_band_has_no_depth),
        cmocka_unit_test(pictures_over_512_pixels_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
