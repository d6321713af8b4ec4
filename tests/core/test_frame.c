/*
 * Light, textures, lines, budgets, statistics and colours of a frame are checked in pictures of 16 x 12 pixels (see
 * ref_drawing.h for coordinates).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Two triangles over the whole picture; "p" and "q" are their letters. */
static const struct shape screen[] = {{'p', {{0, 0}, {0, 12}, {16, 12}}}, {'q', {{0, 0}, {16, 12}, {16, 0}}}};

/* ---- light ------------------------------------------------------------------------------------------------ */

/* A ramp whose colours are their indices. */
static uint16_t index_ramp[PH_RAMP_SIZE];

static int ramp_index_at(const struct drawing *d, int x, int y)
{
    for (int i = 0; i < PH_RAMP_SIZE; i++) {
        if (d->rig.pixels[y * WIDTH + x] == index_ramp[i]) {
            return i;
        }
    }
    return -1;
}

/* A light that shines along -z, without ambient. */
static void begin_lit(struct drawing *d)
{
    struct ph_scene_light light = {.count = 1};
    light.lights[0] =
        (struct ph_light){.kind = PH_LIGHT_DIRECTIONAL, .intensity = FX_ONE, .to_light_q30 = {0, 0, FX_Q30_ONE}};
    for (int i = 0; i < PH_RAMP_SIZE; i++) {
        index_ramp[i] = (uint16_t)(0x1000 + i);
    }
    drawing_begin(d, &light);
}

/* Draws `screen` with the cosines of the normals at x = 0 and x = 16. */
static void draw_lit_screen(struct drawing *d, const struct ph_shading *shading, double left, double right)
{
    for (int i = 0; i < 2; i++) {
        struct rig_one *one = shape_mesh(d, &screen[i]);
        for (int k = 0; k < 3; k++) {
            double cosine = screen[i].corners[k][0] > 0 ? right : left;
            one->normals[k][0] = (int16_t)lrint(sqrt(1 - cosine * cosine) * 16384);
            one->normals[k][2] = (int16_t)lrint(cosine * 16384);
        }
        one->mesh.normals = (const int16_t(*)[3])one->normals;
        one->material.shading = shading;
        one->material.diffuse = FX_ONE;
        one->material.ramp = index_ramp;
        draw_mesh(d, one);
    }
    assert_true(rig_finish(&d->rig));
}

/* Intensity 0 is entry 4 and 1 is entry 123: pixel x has intensity (x + .5) / 16. */
static void gouraud_light_is_linear_across_the_screen(void **state)
{
    struct drawing d;
    (void)state;
    drawing_open(&d);
    for (int reversed = 0; reversed < 2; reversed++) {
        begin_lit(&d);
        draw_lit_screen(&d, PH_SHADE_GOURAUD, reversed ? 1 : 0, reversed ? 0 : 1);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            double share = (i % WIDTH + .5) / WIDTH, exact = 4 + 119 * (reversed ? 1 - share : share);
            assert_true(fabs(ramp_index_at(&d, i % WIDTH, i / WIDTH) - exact) <= .6);
        }
    }
    drawing_close(&d);
}

/* The first vertices lie at x = 0. */
static void flat_light_is_that_of_the_first_vertex(void **state)
{
    static const double cosines[] = {0, .25, .6, 1};
    struct drawing d;
    (void)state;
    drawing_open(&d);
    for (int c = 0; c < COUNT(cosines); c++) {
        begin_lit(&d);
        draw_lit_screen(&d, PH_SHADE_FLAT, cosines[c], .8);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            assert_true(fabs(ramp_index_at(&d, i % WIDTH, i / WIDTH) - (4 + 119 * cosines[c])) <= .6);
        }
    }
    drawing_close(&d);
}

/* ---- textures --------------------------------------------------------------------------------------------- */

/* 8 x 4 texels, one a pixel; texture coordinates -1/2 .. 3/2 across and -1 .. 2 down the picture. */
static void expect_texture(enum ph_wrap wrap, const struct ph_shading *shading, const char *const rows[HEIGHT])
{
    static const char letters[4][9] = {"abcdefgh", "ijklmnop", "qrstuvwx", "01234567"};
    uint16_t texels[32];
    struct ph_texture texture = {.texels = texels, .log2_width = 3, .log2_height = 2, .wrap = (uint8_t)wrap};
    struct drawing d;
    for (int i = 0; i < 32; i++) {
        texels[i] = colour_of(letters[i / 8][i % 8]);
    }
    drawing_open(&d);
    for (int i = 0; i < 2; i++) {
        struct rig_one *one = shape_mesh(&d, &screen[i]);
        for (int k = 0; k < 3; k++) {
            one->uvs[k][0] = (fx_t)(65536 * (screen[i].corners[k][0] / 8 - .5));
            one->uvs[k][1] = (fx_t)(65536 * (screen[i].corners[k][1] / 4 - 1));
        }
        one->mesh.uvs = (const fx_t(*)[2])one->uvs;
        one->material.shading = shading;
        one->material.texture = &texture;
        one->material.ambient = FX_ONE;
        one->mesh.normals = (const int16_t(*)[3])one->normals;
        draw_mesh(&d, one);
    }
    expect(&d, rows);
    drawing_close(&d);
}

static void textures_repeat(void **state)
{
    static const char *const rows[HEIGHT] = {
        "efghabcdefghabcd", "mnopijklmnopijkl", "uvwxqrstuvwxqrst", "4567012345670123",
        "efghabcdefghabcd", "mnopijklmnopijkl", "uvwxqrstuvwxqrst", "4567012345670123",
        "efghabcdefghabcd", "mnopijklmnopijkl", "uvwxqrstuvwxqrst", "4567012345670123",
    };
    (void)state;
    expect_texture(PH_WRAP_REPEAT, PH_SHADE_TEXTURE, rows);
}

static void textures_clamp_to_their_border(void **state)
{
    static const char *const rows[HEIGHT] = {
        "aaaaabcdefghhhhh", "aaaaabcdefghhhhh", "aaaaabcdefghhhhh", "aaaaabcdefghhhhh",
        "aaaaabcdefghhhhh", "iiiiijklmnoppppp", "qqqqqrstuvwxxxxx", "0000012345677777",
        "0000012345677777", "0000012345677777", "0000012345677777", "0000012345677777",
    };
    (void)state;
    expect_texture(PH_WRAP_CLAMP, PH_SHADE_TEXTURE, rows);
}

/* Texels take the light of the first vertex: each channel in proportion, within a step of its own. */
static void lit_textures_are_scaled_by_the_light(void **state)
{
    static const double cosines[] = {0, .25, .5, .75, 1};
    uint16_t texel = ph_rgb565(248, 160, 80);
    struct ph_texture texture = {.texels = &texel, .log2_width = 0, .log2_height = 0, .wrap = PH_WRAP_REPEAT};
    struct drawing d;
    (void)state;
    drawing_open(&d);
    for (int c = 0; c < COUNT(cosines); c++) {
        begin_lit(&d);
        struct rig_one *one = shape_mesh(&d, &screen[0]);
        one->normals[0][0] = (int16_t)lrint(sqrt(1 - cosines[c] * cosines[c]) * 16384);
        one->normals[0][2] = (int16_t)lrint(cosines[c] * 16384);
        one->mesh.normals = (const int16_t(*)[3])one->normals;
        one->mesh.uvs = (const fx_t(*)[2])one->uvs;
        one->material.shading = PH_SHADE_TEXTURE_LIT;
        one->material.diffuse = FX_ONE;
        one->material.texture = &texture;
        draw_mesh(&d, one);
        assert_true(rig_finish(&d.rig));
        const double full[3] = {248, 160, 80};
        double rgb[3];
        rig_rgb(&d.rig, 0, HEIGHT - 1, rgb);
        for (int k = 0; k < 3; k++) {
            assert_true(fabs(rgb[k] - full[k] * cosines[c]) <= 9);
        }
    }
    drawing_close(&d);
}

/* Two parts share all vertices; each is lit with its own material. */
static void each_part_is_lit_with_its_own_material(void **state)
{
    static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const struct ph_part parts[2] = {{0, 1, 0}, {1, 1, 1}};
    static const struct fx_vec3 corners[4] = {{0, FX_INT(12), FX_INT(-2)},
                                              {0, 0, FX_INT(-2)},
                                              {FX_INT(16), 0, FX_INT(-2)},
                                              {FX_INT(16), FX_INT(12), FX_INT(-2)}};
    static const int16_t normals[4][3] = {{0, 0, 16384}, {0, 0, 16384}, {0, 0, 16384}, {0, 0, 16384}};
    struct ph_material materials[2] = {
        {.shading = PH_SHADE_GOURAUD, .diffuse = FX_ONE, .ramp = index_ramp},
        {.shading = PH_SHADE_GOURAUD, .diffuse = FX_ONE / 4, .ramp = index_ramp},
    };
    struct ph_mesh mesh = {.positions = corners,
                           .normals = normals,
                           .triangles = triangles,
                           .parts = parts,
                           .materials = materials,
                           .vertex_count = 4,
                           .triangle_count = 2,
                           .part_count = 2};
    struct drawing d;
    (void)state;
    drawing_open(&d);
    begin_lit(&d);
    assert_int_equal(ph_draw_mesh(&d.rig.r, &mesh, &ph_xform_identity), PH_OK);
    assert_true(rig_finish(&d.rig));
    assert_in_range(ramp_index_at(&d, 1, 10), 122, 124);
    assert_in_range(ramp_index_at(&d, 14, 1), 33, 35);
    drawing_close(&d);
}

/* ---- lines ------------------------------------------------------------------------------------------------ */

static void draw_biased_line(struct drawing *d, char letter, double x0, double y0, double x1, double y1, uint8_t bias)
{
    struct fx_vec3 a = {(fx_t)lrint(x0 * 65536), (fx_t)lrint((HEIGHT - y0) * 65536), FX_INT(-2)};
    struct fx_vec3 b = {(fx_t)lrint(x1 * 65536), (fx_t)lrint((HEIGHT - y1) * 65536), FX_INT(-2)};
    struct ph_material *material = &d->ones[d->count++].material;
    *material = (struct ph_material){.shading = PH_SHADE_WIRE, .colour = colour_of(letter), .depth_bias = bias};
    ph_draw_line(&d->rig.r, a, b, material);
}

static void draw_line(struct drawing *d, char letter, double x0, double y0, double x1, double y1)
{
    draw_biased_line(d, letter, x0, y0, x1, y1, 0);
}

/* One pixel in each column of a flat line and in each row of a steep one, within half a pixel of the exact line. */
static void lines_are_one_pixel_wide_and_connected(void **state)
{
    (void)state;
    for (int i = 0; i < 400; i++) {
        struct drawing d;
        double x0 = 1 + i % 7 * 2.03, y0 = 1 + i % 11 * .91, x1 = 1 + i % 13 * 1.07, y1 = 1 + i % 5 * 2.03;
        bool flat = fabs(x1 - x0) >= fabs(y1 - y0);
        int pixels = 0;
        drawing_open(&d);
        draw_line(&d, 'a', x0, y0, x1, y1);
        assert_true(rig_finish(&d.rig));
        for (int major = 0; major < (flat ? WIDTH : HEIGHT); major++) {
            int here = 0;
            for (int minor = 0; minor < (flat ? HEIGHT : WIDTH); minor++) {
                int x = flat ? major : minor, y = flat ? minor : major;
                if (letter_at(&d, x, y) == '.') {
                    continue;
                }
                double t = flat ? (x + .5 - x0) / (x1 - x0) : (y + .5 - y0) / (y1 - y0);
                double off = flat ? y + .5 - (y0 + t * (y1 - y0)) : x + .5 - (x0 + t * (x1 - x0));
                assert_true(fabs(off) <= .5 + 2 / 256.);
                here++;
            }
            assert_in_range(here, 0, 1);
            pixels += here;
        }
        double length = fmax(fabs(x1 - x0), fabs(y1 - y0));
        assert_true(fabs(pixels - length) <= 1);
        drawing_close(&d);
    }
}

/* The edges of two triangles as lines; the inside stays empty. */
static void wireframe_draws_the_edges(void **state)
{
    static const uint16_t edges[5][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}};
    static const uint16_t triangles[2][3] = {{0, 3, 2}, {0, 2, 1}};
    static const struct ph_material material = {.shading = PH_SHADE_WIRE, .colour = 0x1234};
    static const struct ph_part part = {0, 2, 0};
    const struct fx_vec3 corners[4] = {{FX_INT(2) + FX_HALF, FX_INT(9) + FX_HALF, FX_INT(-2)},
                                       {FX_INT(12) + FX_HALF, FX_INT(9) + FX_HALF, FX_INT(-2)},
                                       {FX_INT(12) + FX_HALF, FX_INT(2) + FX_HALF, FX_INT(-2)},
                                       {FX_INT(2) + FX_HALF, FX_INT(2) + FX_HALF, FX_INT(-2)}};
    struct ph_mesh mesh = {.positions = corners,
                           .triangles = triangles,
                           .edges = edges,
                           .parts = &part,
                           .materials = &material,
                           .vertex_count = 4,
                           .triangle_count = 2,
                           .edge_count = 5,
                           .part_count = 1};
    struct drawing d;
    int drawn = 0;
    (void)state;
    drawing_open(&d);
    assert_int_equal(ph_draw_mesh(&d.rig.r, &mesh, &ph_xform_identity), PH_OK);
    assert_true(rig_finish(&d.rig));
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            bool frame = x >= 2 && x <= 12 && y >= 2 && y <= 9 && (x == 2 || x == 12 || y == 2 || y == 9);
            double diagonal = fabs(y - 2 - (x - 2) * .7);
            bool pixel = d.rig.pixels[y * WIDTH + x] != BLACK;
            assert_true(!pixel || frame || (x > 2 && x < 12 && diagonal <= .51));
            drawn += pixel;
        }
    }
    assert_in_range(drawn, 38, 44); /* the frame has 34 pixels, the diagonal 9 more; ends may be open */
    drawing_close(&d);
}

static void lines_hide_behind_surfaces(void **state)
{
    static const struct shape near = {'a', {{0, 0, -.5}, {0, 24, -.5}, {8, 0, -.5}}};
    struct drawing d;
    (void)state;
    drawing_open(&d);
    draw_shapes(&d, &near, 1);
    draw_line(&d, 'b', .5, .5, 15.5, .5);
    assert_true(rig_finish(&d.rig));
    assert_int_equal(letter_at(&d, 2, 0), 'a');
    assert_int_equal(letter_at(&d, 12, 0), 'b');
    drawing_close(&d);
}

/* A line in the very plane of a surface drawn first shows only with a bias, and hides behind what is nearer. */
static void depth_bias_lifts_lines_off_their_surface(void **state)
{
    (void)state;
    for (int f = 0; f < PH_DEPTH_FORMATS; f++) {
        const struct ph_depth_format *const format = ph_depth_formats[f];
        for (int bias = 0; bias <= 16; bias += 16) {
            static const struct shape near = {'n', {{8, 0, -.1}, {8, 24, -.1}, {24, 0, -.1}}};
            struct drawing d;
            drawing_open_formats(&d, HEIGHT, 64, format);
            drawing_begin(&d, NULL);
            draw_shapes(&d, screen, 2);
            draw_shapes(&d, &near, 1);
            draw_biased_line(&d, 'z', 1.5, 3.5, 15.5, 3.5, (uint8_t)bias);
            assert_true(rig_finish(&d.rig));
            assert_int_equal(letter_at(&d, 6, 3), bias ? 'z' : 'q');
            assert_int_equal(letter_at(&d, 12, 3), 'n');
            drawing_close(&d);
        }
    }
}

/* ---- budgets and arguments -------------------------------------------------------------------------------- */

static const struct shape row_of_five[] = {{'a', {{0, 0}, {0, 2}, {2, 2}}},
                                           {'b', {{3, 0}, {3, 2}, {5, 2}}},
                                           {'c', {{6, 0}, {6, 2}, {8, 2}}},
                                           {'d', {{9, 0}, {9, 2}, {11, 2}}},
                                           {'e', {{12, 0}, {12, 2}, {14, 2}}}};

static void triangles_over_the_budget_are_left_out_and_counted(void **state)
{
    static const char letters[] = "abcde";
    (void)state;
    for (int budget = 1; budget <= 5; budget++) {
        struct drawing d;
        drawing_open_formats(&d, HEIGHT, budget, PH_DEPTH_FIXED16);
        drawing_begin(&d, NULL);
        for (int i = 0; i < 5; i++) {
            struct rig_one *one = shape_mesh(&d, &row_of_five[i]);
            int result = ph_draw_mesh(&d.rig.r, &one->mesh, &ph_xform_identity);
            assert_true(result == PH_OK || (i >= budget && result == PH_ERR_NOMEM));
        }
        assert_int_equal(d.rig.r.stats.triangles_in, 5);
        assert_int_equal(d.rig.r.stats.triangles_drawn, budget);
        assert_int_equal(d.rig.r.stats.triangles_dropped, 5 - budget);
        assert_true(rig_finish(&d.rig));
        for (int i = 0; i < 5; i++) {
            assert_int_equal(letter_at(&d, 3 * i, 1), i < budget ? letters[i] : '.');
        }
        drawing_close(&d);
    }
}

static void mesh_over_the_vertex_budget_is_left_out_and_counted(void **state)
{
    struct drawing d;
    (void)state;
    memset(&d, 0, sizeof(d));
    rig_open(&d.rig, WIDTH, HEIGHT, HEIGHT, PH_DEPTH_FIXED16, 2, 8);
    drawing_begin(&d, NULL);
    struct rig_one *one = shape_mesh(&d, &row_of_five[0]);
    assert_int_equal(ph_draw_mesh(&d.rig.r, &one->mesh, &ph_xform_identity), PH_ERR_NOMEM);
    assert_int_equal(d.rig.r.stats.vertices_dropped, 3);
    expect(&d, nothing);
    drawing_close(&d);
}

#define VIEWS 24 /* each shows a triangle of its own in its own cell of 6 x 4 */

/* The near plane cuts each, which leaves a draw without triangles behind. */
static void draw_views(struct rig *rig, const struct ph_projection *lens)
{
    static const struct fx_vec3 points[3] = {
        {-FX_ONE / 4, -FX_ONE / 4, 0}, {FX_ONE / 4, -FX_ONE / 4, 0}, {0, FX_ONE / 4, FX_ONE * 5 / 4}};
    static const uint16_t faces[1][3] = {{0, 1, 2}};
    static const struct ph_part part = {.count = 1};
    static const fx_t uvs[3][2];
    static uint16_t texels[VIEWS];
    static struct ph_texture textures[VIEWS];
    static struct ph_material materials[VIEWS];
    assert_int_equal(ph_frame_begin(&rig->r, &ph_xform_identity, lens, NULL, 0), PH_OK);
    for (int i = 0; i < VIEWS; i++) {
        const struct ph_xform view =
            ph_xform_translate((2 * (i % 6) - 5) * FX_HALF, (2 * (i / 6) - 3) * FX_HALF, -FX_INT(2));
        texels[i] = (uint16_t)(i + 1);
        textures[i] = (struct ph_texture){.texels = &texels[i]};
        materials[i] = (struct ph_material){.shading = PH_SHADE_TEXTURE, .texture = &textures[i]};
        const struct ph_mesh mesh = {.positions = points,
                                     .uvs = uvs,
                                     .triangles = faces,
                                     .parts = &part,
                                     .materials = &materials[i],
                                     .vertex_count = 3,
                                     .triangle_count = 1,
                                     .part_count = 1};
        assert_int_equal(ph_frame_camera(&rig->r, &view, lens), PH_OK);
        assert_int_equal(ph_draw_mesh(&rig->r, &mesh, &ph_xform_identity), PH_OK);
    }
    assert_true(rig_finish(rig));
}

static void with_little_room_each_view_shows_its_own_triangle_or_none(void **state)
{
    enum { W = 96, H = 64, MOST = 300 };
    static uint16_t whole[W * H];
    struct ph_projection lens;
    int parts = 0;
    (void)state;
    assert_int_equal(ph_projection_ortho(&lens, FX_INT(-3), FX_INT(3), FX_INT(-2), FX_INT(2), FX_ONE, FX_INT(9)),
                     PH_OK);
    for (int budget = MOST; budget > 0; budget--) {
        struct rig rig;
        rig_open(&rig, W, H, 16, PH_DEPTH_FIXED16, 400, budget);
        draw_views(&rig, &lens);
        parts += rig.r.stats.triangles_drawn > 0 && rig.r.stats.triangles_dropped > 0;
        assert_true(budget < MOST || rig.r.stats.triangles_drawn == 2 * VIEWS);
        for (int i = 0; i < W * H; i++) {
            whole[i] = budget == MOST ? rig.pixels[i] : whole[i];
            assert_true(rig.pixels[i] == 0 || rig.pixels[i] == whole[i]);
        }
        rig_close(&rig);
    }
    assert_true(parts > 20);
}

static void statistics_add_up(void **state)
{
    static const struct shape shapes[] = {{'a', {{1, 1}, {1, 5}, {5, 5}}},
                                          {'b', {{1, 1}, {5, 5}, {1, 5}}},
                                          {'c', {{10, 1}, {10, 5}, {20, 5}}},
                                          {'d', {{-9, 1}, {-9, 5}, {-2, 5}}}};
    struct drawing d;
    (void)state;
    drawing_open(&d);
    draw_shapes(&d, shapes, COUNT(shapes));
    assert_true(rig_finish(&d.rig));
    const struct ph_stats *stats = &d.rig.r.stats;
    assert_int_equal(stats->vertices, 12);
    assert_int_equal(stats->triangles_in, 4);
    assert_int_equal(stats->triangles_culled, 2);
    assert_int_equal(stats->triangles_drawn, 2);
    assert_int_equal(stats->triangles_dropped, 0);
    drawing_begin(&d, NULL);
    assert_int_equal(stats->vertices + stats->triangles_in + stats->fragments, 0);
    expect(&d, nothing);
    drawing_close(&d);
}

static void background_fills_what_is_not_drawn(void **state)
{
    struct ph_projection projection;
    struct drawing d;
    (void)state;
    drawing_open(&d);
    assert_int_equal(ph_projection_perspective(&projection, FX_INT(60), FX_ONE, FX_ONE, FX_INT(9)), PH_OK);
    assert_int_equal(ph_frame_begin(&d.rig.r, &ph_xform_identity, &projection, NULL, 0xabcd), PH_OK);
    assert_true(rig_finish(&d.rig));
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_int_equal(d.rig.pixels[i], 0xabcd);
        assert_int_equal(d.rig.depth[i], 0);
    }
    drawing_close(&d);
}

static void impossible_configurations_are_refused(void **state)
{
    struct drawing d;
    struct ph_renderer r;
    (void)state;
    drawing_open(&d);
    const struct ph_config good = d.rig.r.config;
    struct ph_config bad[16];
    for (int i = 0; i < COUNT(bad); i++) {
        bad[i] = good;
    }
    bad[0].width = 0;
    bad[1].height = 0;
    bad[2].width = 1025;
    bad[3].height = 1025;
    bad[4].band_height = 0;
    bad[5].band_height = HEIGHT + 1;
    bad[6].depth_format = NULL;
    bad[7].vertices = NULL;
    bad[8].triangles = NULL;
    bad[9].bins = NULL;
    bad[10].depth = NULL;
    bad[11].depth = (uint8_t *)good.depth + 1;
    bad[12].depth = (uint8_t *)good.depth + 2;
    bad[12].depth_format = PH_DEPTH_FLOAT24;
    bad[13].depth = (uint8_t *)good.depth + 2;
    bad[13].antialiasing = PH_ANTIALIAS_2X2;
    bad[13].samples = (uint16_t *)good.depth; /* its depth is drawn by words */
    bad[14].shown = (uint16_t *)(void *)((uint8_t *)good.bins + 1);
    bad[15].bin_max = 0;
    assert_int_equal(ph_renderer_init(&r, &good), PH_OK);
    for (int i = 0; i < COUNT(bad); i++) {
        assert_int_equal(ph_renderer_init(&r, &bad[i]), i == 6               ? PH_ERR_FORMAT
                                                        : i < COUNT(bad) - 1 ? PH_ERR_INVAL
                                                                             : PH_ERR_NOMEM);
    }
    assert_int_equal(ph_renderer_init(&r, NULL), PH_ERR_INVAL);
    assert_int_equal(ph_renderer_init(NULL, &good), PH_ERR_INVAL);
    drawing_close(&d);
}

/* A triangle cut into a polygon of several is one that was clipped, not several that were culled. */
static void a_clipped_triangle_counts_once(void **state)
{
    static const struct shape shapes[] = {{'a', {{0, 1, -2}, {0, 4, -2}, {16, 4, 2}}},
                                          {'b', {{5, 4, -2}, {9, 4, 2}, {9, 4.25, 2}}}};
    struct drawing d;
    (void)state;
    drawing_open(&d);
    draw_shapes(&d, shapes, COUNT(shapes));
    draw_line(&d, 'l', -9, 100, -5, 105);
    assert_int_equal(d.rig.r.stats.triangles_in, 2);
    assert_int_equal(d.rig.r.stats.triangles_clipped, 2);
    assert_int_equal(d.rig.r.stats.triangles_culled, 1);
    drawing_close(&d);
}

/* ---- colours ---------------------------------------------------------------------------------------------- */

/* Red 5 bits, green 6, blue 5, the byte with red first. */
/* ---- mistakes ---------------------------------------------------------------------------------------------- */

/* Draws the two halves of the screen and a line with a material, of which nothing is left after each draw if it
 * `changes`. */
static void draw_with(struct drawing *d, const struct ph_material *material, bool changes)
{
    drawing_begin(d, NULL);
    for (int i = 0; i < 3; i++) {
        struct rig_one *const one = shape_mesh(d, &screen[i % 2]);
        one->material = *material;
        if (i < 2) {
            draw_mesh(d, one);
        } else {
            ph_draw_line(&d->rig.r, (struct fx_vec3){0, 0, FX_INT(-2)},
                         (struct fx_vec3){FX_INT(9), FX_INT(9), FX_INT(-2)}, &one->material);
        }
        if (changes) {
            memset(&one->material, 0xA5, sizeof one->material); /* its pointers lead nowhere */
        }
    }
    assert_true(rig_finish(&d->rig));
}

static void a_material_may_change_after_its_draw(void **state)
{
    (void)state;
    static const uint16_t texels[4] = {0x1111, 0x2222, 0x3333, 0x4444};
    static const struct ph_texture texture = {.texels = texels, .log2_width = 1, .log2_height = 1};
    static const struct ph_blend half = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 16};
    static const struct ph_shading *const shadings[] = {PH_SHADE_UNLIT,       PH_SHADE_FLAT,
                                                        PH_SHADE_GOURAUD,     PH_SHADE_TEXTURE,
                                                        PH_SHADE_TEXTURE_LIT, PH_SHADE_TEXTURE_GOURAUD};
    uint16_t ramp[PH_RAMP_SIZE], picture[WIDTH * HEIGHT];
    ph_material_ramp(ramp, 255, 160, 64, 0);
    for (int i = 0; i < 4 * COUNT(shadings); i++) {
        const struct ph_material material = {.shading = shadings[i / 4],
                                             .two_sided = 1,
                                             .depth_bias = (uint8_t)(i / 2 % 2),
                                             .depth_bias_slope = (uint8_t)(i / 2 % 2 * 2),
                                             .ambient = FX_ONE,
                                             .colour = 0x5678,
                                             .ramp = ramp,
                                             .texture = &texture,
                                             .blend = i % 2 != 0 ? &half : NULL};
        struct drawing d;
        drawing_open_formats(&d, 5, 100, PH_DEPTH_FLOAT16);
        draw_with(&d, &material, false);
        memcpy(picture, d.rig.pixels, sizeof picture);
        assert_int_not_equal(picture[WIDTH * 5 + 5], 0);
        draw_with(&d, &material, true);
        assert_memory_equal(picture, d.rig.pixels, sizeof picture);
        drawing_close(&d);
    }
}

/* A variable holds one material after the other: each line has the colour of its own draw. */
static void one_variable_may_hold_the_materials_of_many_draws(void **state)
{
    (void)state;
    struct ph_material material = {.shading = PH_SHADE_UNLIT};
    struct drawing d;
    drawing_open(&d);
    for (int y = 0; y < HEIGHT; y++) {
        const fx_t at = FX_INT(HEIGHT - 1 - y) + FX_HALF;
        material.colour = colour_of((char)('a' + y / 2));
        ph_draw_line(&d.rig.r, (struct fx_vec3){0, at, FX_INT(-2)}, (struct fx_vec3){FX_INT(WIDTH), at, FX_INT(-2)},
                     &material);
    }
    assert_true(rig_finish(&d.rig));
    for (int y = 0; y < HEIGHT; y++) {
        assert_int_equal(letter_at(&d, WIDTH / 2, y), 'a' + y / 2);
    }
    drawing_close(&d);
}

/* Bytes of a list of lines that take so many colours by turns, each of which is drawn as it should. */
static size_t bytes_by_turns(int colours)
{
    struct ph_material material = {.shading = PH_SHADE_UNLIT};
    struct drawing d;
    size_t bytes = 0;
    drawing_open(&d);
    for (int y = 0; y < HEIGHT; y++) {
        const fx_t at = FX_INT(HEIGHT - 1 - y) + FX_HALF;
        material.colour = colour_of((char)('a' + y % colours));
        ph_draw_line(&d.rig.r, (struct fx_vec3){0, at, FX_INT(-2)}, (struct fx_vec3){FX_INT(WIDTH), at, FX_INT(-2)},
                     &material);
    }
    for (int piece = 0; piece < 3; piece++) {
        bytes += d.rig.r.list.used[piece];
    }
    assert_true(rig_finish(&d.rig));
    for (int y = 0; y < HEIGHT; y++) {
        assert_int_equal(letter_at(&d, WIDTH / 2, y), 'a' + y % colours);
    }
    drawing_close(&d);
    return bytes;
}

/* With two colours or more each line is a draw of its own. */
static void draws_share_materials_by_turns(void **state)
{
    (void)state;
    const size_t two = bytes_by_turns(2), copy = bytes_by_turns(3) - two;
    assert_true(copy >= sizeof(struct ph_material) && copy < 2 * sizeof(struct ph_material));
    assert_int_equal(bytes_by_turns(PH_LIST_COPIES) - two, (PH_LIST_COPIES - 2) * copy);
    assert_int_equal(bytes_by_turns(PH_LIST_COPIES + 1) - two, (HEIGHT - 2) * copy); /* none is found again */
}

static void what_is_null_is_refused(void **state)
{
    (void)state;
    static struct ph_renderer zeros;
    const struct ph_xform view = {0};
    assert_int_equal(ph_frame_bands(&zeros), 0);
    struct drawing d;
    drawing_open(&d);
    struct ph_renderer *const r = &d.rig.r;
    assert_int_equal(ph_frame_fog(r, NULL), PH_ERR_INVAL);
    assert_int_equal(ph_frame_camera(r, NULL, NULL), PH_ERR_INVAL);
    assert_int_equal(ph_frame_camera(r, &view, NULL), PH_ERR_INVAL);
    assert_int_equal(ph_draw_mesh(r, NULL, &view), PH_ERR_INVAL);
    assert_int_equal(ph_show(r, NULL, NULL), PH_ERR_INVAL);
    assert_true(ph_frame_bands(r) > 0);
    assert_int_equal(ph_draw_band(r, 0, NULL), 0);
    assert_int_equal(ph_draw_band(r, 0, (uint16_t *)((uintptr_t)d.rig.pixels + 1)), 0);
    assert_int_equal(ph_frame_begin(r, NULL, NULL, NULL, 0), PH_ERR_INVAL);
    drawing_close(&d);
}

static void colours_are_in_wire_order(void **state)
{
    static const struct {
        uint8_t rgb[3], wire[2];
    } cases[] = {{{255, 0, 0}, {0xf8, 0x00}},
                 {{0, 255, 0}, {0x07, 0xe0}},
                 {{0, 0, 255}, {0x00, 0x1f}},
                 {{255, 255, 255}, {0xff, 0xff}},
                 {{0, 0, 0}, {0, 0}}};
    (void)state;
    for (int i = 0; i < COUNT(cases); i++) {
        uint16_t colour = ph_rgb565(cases[i].rgb[0], cases[i].rgb[1], cases[i].rgb[2]);
        assert_memory_equal(&colour, cases[i].wire, 2);
    }
}

static void ramp_goes_from_black_over_the_colour_to_white(void **state)
{
    uint16_t ramp[PH_RAMP_SIZE];
    (void)state;
    ph_material_ramp(ramp, 255, 160, 64, 0);
    for (int i = 0; i < PH_RAMP_SIZE; i++) {
        double intensity = fmin(1, fmax(0, (i - 4) / 119.));
        uint8_t wire[2];
        memcpy(wire, &ramp[i], 2);
        unsigned code = (unsigned)wire[0] << 8 | wire[1];
        assert_true(fabs((code >> 11) - 31 * intensity) <= .51);
        assert_true(fabs((code >> 5 & 63) - 63 * intensity * 160 / 255) <= .51);
        assert_true(fabs((code & 31) - 31 * intensity * 64 / 255) <= .51);
    }
    ph_material_ramp(ramp, 255, 160, 64, FX_ONE);
    assert_int_equal(ramp[4], 0);
    assert_int_equal(ramp[123], 0xffff);
}

/* A line has no back: sixteen directions round the middle, a one-sided material. */
static void a_line_shows_in_every_direction(void **state)
{
    (void)state;
    static const struct ph_material material = {.shading = PH_SHADE_UNLIT, .colour = 0xffff};
    const struct fx_vec3 middle = {FX_INT(8), FX_INT(6), FX_INT(-2)};
    for (uint32_t i = 0; i < 16; i++) {
        int32_t sine, cosine;
        fx_sincos_q30(i << 28, &sine, &cosine);
        const struct fx_vec3 tip = {middle.x + cosine / 4096, middle.y + sine / 4096, FX_INT(-2)}; /* 4 pixels away */
        struct drawing d;
        drawing_open(&d);
        ph_draw_line(&d.rig.r, middle, tip, &material);
        assert_int_equal(d.rig.r.stats.triangles_drawn, 1);
        drawing_close(&d);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_line_shows_in_every_direction),
        cmocka_unit_test(gouraud_light_is_linear_across_the_screen),
        cmocka_unit_test(flat_light_is_that_of_the_first_vertex),
        cmocka_unit_test(textures_repeat),
        cmocka_unit_test(textures_clamp_to_their_border),
        cmocka_unit_test(lit_textures_are_scaled_by_the_light),
        cmocka_unit_test(each_part_is_lit_with_its_own_material),
        cmocka_unit_test(lines_are_one_pixel_wide_and_connected),
        cmocka_unit_test(wireframe_draws_the_edges),
        cmocka_unit_test(lines_hide_behind_surfaces),
        cmocka_unit_test(depth_bias_lifts_lines_off_their_surface),
        cmocka_unit_test(triangles_over_the_budget_are_left_out_and_counted),
        cmocka_unit_test(mesh_over_the_vertex_budget_is_left_out_and_counted),
        cmocka_unit_test(with_little_room_each_view_shows_its_own_triangle_or_none),
        cmocka_unit_test(statistics_add_up),
        cmocka_unit_test(a_clipped_triangle_counts_once),
        cmocka_unit_test(background_fills_what_is_not_drawn),
        cmocka_unit_test(impossible_configurations_are_refused),
        cmocka_unit_test(a_material_may_change_after_its_draw),
        cmocka_unit_test(one_variable_may_hold_the_materials_of_many_draws),
        cmocka_unit_test(draws_share_materials_by_turns),
        cmocka_unit_test(what_is_null_is_refused),
        cmocka_unit_test(colours_are_in_wire_order),
        cmocka_unit_test(ramp_goes_from_black_over_the_colour_to_white),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
