/*
 * Light on textures, and filters, are compared with double precision: the benchmark's torus of the scenes S7 and S8, in
 * which each channel of a pixel must be near the product of the exact light and the exact texel. Errors are in 31sts of
 * a channel, the step of red and blue.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_plane.h"
#include "ref_random.h"
#include "ref_rig.h"
#include "surface_row.h"
#include "textured_torus.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define WIDTH  320
#define HEIGHT 240
#define LOG2   6
#define SIZE   (1 << LOG2)
#define MAPS   (LOG2 + 1)
#define TEXELS 5461

struct scene {
    struct ref_scene torus;
    struct rig_mesh mesh;
    struct ph_material material;
    struct ph_texture texture;
    uint16_t texels[TEXELS];
    double exact[TEXELS][3]; /* 0 .. 31 */
};

static void set_texel(struct scene *s, int at, double red, double green, double blue)
{
    s->texels[at] = ph_rgb565((uint8_t)lrint(red), (uint8_t)lrint(green), (uint8_t)lrint(blue));
    const uint8_t *wire = (const uint8_t *)&s->texels[at];
    const unsigned c = (unsigned)wire[0] << 8 | wire[1];
    s->exact[at][0] = c >> 11;
    s->exact[at][1] = (c >> 5 & 63) * 31. / 63;
    s->exact[at][2] = c & 31;
}

/* A smooth texture, so that a texel beside shows little. */
static void base_texels(struct scene *s)
{
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            const double a = 2 * 3.14159265 * x / SIZE, b = 2 * 3.14159265 * y / SIZE;
            set_texel(s, y * SIZE + x, 140 + 90 * sin(a), 150 + 80 * cos(b), 120 + 60 * sin(a + b));
        }
    }
}

static int map_at(int level)
{
    int at = 0;
    for (int k = 0; k < level; k++) {
        at += (SIZE >> k) * (SIZE >> k);
    }
    return at;
}

static void maps(struct scene *s)
{
    for (int level = 1; level < MAPS; level++) {
        const int width = SIZE >> level, from = map_at(level - 1), to = map_at(level);
        for (int i = 0; i < width * width; i++) {
            const int corner = from + i / width * 4 * width + i % width * 2;
            double sum[3];
            for (int c = 0; c < 3; c++) {
                sum[c] = (s->exact[corner][c] + s->exact[corner + 1][c] + s->exact[corner + 2 * width][c] +
                          s->exact[corner + 2 * width + 1][c]) *
                         255 / 31 / 4;
            }
            set_texel(s, to + i, sum[0], sum[1], sum[2]);
        }
    }
}

static const struct ph_filter *const filters[3] = {PH_FILTER_NEAREST, PH_FILTER_BILINEAR, PH_FILTER_MIPMAP};

static void scene_open(struct scene *s, const struct ph_shading *shading, const struct ph_filter *filter)
{
    textured_torus_build(&s->torus);
    rig_mesh_build(&s->mesh, &s->torus);
    base_texels(s);
    maps(s);
    s->texture = (struct ph_texture){.texels = s->texels,
                                     .log2_width = LOG2,
                                     .log2_height = LOG2,
                                     .wrap = PH_WRAP_REPEAT,
                                     .filter = filter,
                                     .levels = LOG2};
    s->material = s->mesh.materials[0];
    s->material.shading = shading;
    s->material.texture = &s->texture;
    s->mesh.mesh.materials = &s->material;
}

static void scene_close(struct scene *s)
{
    rig_mesh_free(&s->mesh);
    ref_scene_free(&s->torus);
}

static void scene_draw(struct rig *rig, const struct scene *s, int frame)
{
    const struct ph_xform pose = rig_pose(&s->torus, frame);
    rig_begin(rig);
    assert_int_equal(ph_draw_mesh(&rig->r, &s->mesh.mesh, &pose), PH_OK);
    assert_true(rig_finish(rig));
}

/* The exact texel of a level, 0 .. 31, nearest or bilinear. */
static double texel(const struct scene *s, int level, bool smooth, const double uv[2], int channel)
{
    const int width = SIZE >> level, at = map_at(level);
    const double u = uv[0] * width - (smooth ? .5 : 0), v = uv[1] * width - (smooth ? .5 : 0);
    const int x = (int)floor(u), y = (int)floor(v), m = width - 1;
    const double fu = u - x, fv = v - y;
    if (!smooth) {
        return s->exact[at + (y & m) * width + (x & m)][channel];
    }
    const double upper = s->exact[at + (y & m) * width + (x & m)][channel] * (1 - fu) +
                         s->exact[at + (y & m) * width + ((x + 1) & m)][channel] * fu;
    const double lower = s->exact[at + ((y + 1) & m) * width + (x & m)][channel] * (1 - fu) +
                         s->exact[at + ((y + 1) & m) * width + ((x + 1) & m)][channel] * fu;
    return upper * (1 - fv) + lower * fv;
}

/* log2 of texels per pixel, from the pixels right and below; < 0 where these belong to another triangle. */
static double exact_level(const struct ref_picture *exact, int x, int y)
{
    const struct ref_pixel p = ref_at(exact, x, y), r = ref_at(exact, x + 1, y), d = ref_at(exact, x, y + 1);
    if (r.triangle != p.triangle || d.triangle != p.triangle) {
        return -1;
    }
    const double right = hypot(r.uv[0] - p.uv[0], r.uv[1] - p.uv[1]);
    const double down = hypot(d.uv[0] - p.uv[0], d.uv[1] - p.uv[1]);
    return fmax(0, log2(fmax(right, down) * SIZE));
}

struct errors {
    long pixels, off;         /* off: a channel is more than 2 31sts away */
    double sum, square, most; /* of red and blue; of all */
};

static void count_pixel(struct errors *e, const struct scene *s, const struct rig *rig, const struct ref_picture *exact,
                        int x, int y)
{
    const struct ref_pixel p = ref_at(exact, x, y);
    const double level = exact_level(exact, x, y);
    if (p.triangle < 0 || rig->depth[y * WIDTH + x] == 0 || level < 0) {
        return;
    }
    const bool mip = s->texture.filter == PH_FILTER_MIPMAP, smooth = s->texture.filter != PH_FILTER_NEAREST;
    const int first = mip ? (int)fmax(0, floor(level - .3)) : 0, last = mip ? (int)ceil(level + .3) : 0;
    const double light = s->material.shading == PH_SHADE_TEXTURE_GOURAUD ? p.intensity : 1;
    double rgb[3], best = 1e9, mean = 0;
    rig_rgb(rig, x, y, rgb);
    for (int k = first; k <= last && k < MAPS; k++) {
        double most = 0, sum = 0;
        for (int c = 0; c < 3; c++) {
            const double off = rgb[c] * 31 / 255 - texel(s, k, smooth, p.uv, c) * light;
            most = fmax(most, fabs(off));
            sum += off / 3;
        }
        mean = most < best ? sum : mean;
        best = fmin(best, most);
    }
    e->pixels++;
    e->off += best > 2;
    e->sum += mean;
    e->square += mean * mean;
    e->most = fmax(e->most, best);
}

static struct errors errors_of(const struct ph_shading *shading, const struct ph_filter *filter,
                               const struct ph_depth_format *format)
{
    static struct scene s;
    struct rig rig;
    struct errors e = {0, 0, 0, 0, 0};
    scene_open(&s, shading, filter);
    rig_open(&rig, WIDTH, HEIGHT, 16, format, s.torus.vertex_count, s.torus.triangle_count);
    for (int frame = 0; frame < 64; frame += 16) {
        struct ref_picture exact;
        scene_draw(&rig, &s, frame);
        ref_draw(&exact, &ref_benchmark, &s.torus, frame);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            count_pixel(&e, &s, &rig, &exact, i % WIDTH, i / WIDTH);
        }
        ref_picture_free(&exact);
    }
    rig_close(&rig);
    scene_close(&s);
    return e;
}

static void expect_errors(const char *what, const struct ph_shading *shading, const struct ph_filter *filter,
                          const struct ph_depth_format *format, double mean, double off)
{
    const struct errors e = errors_of(shading, filter, format);
    const double n = (double)e.pixels, sum = e.sum / n;
    print_message("%s: %ld pixels, RMS %.3f, most %.2f 31sts\n", what, e.pixels, sqrt(e.square / n), e.most);
    assert_true(e.pixels > 55000);
    assert_true(surface_row(what, "mean, of 31", fabs(sum), mean));
    assert_true(surface_row(what, "% of pixels over 2 of 31 off", 100. * (double)e.off / n, off));
}

static void light_on_nearest_texels_is_near(void **state)
{
    (void)state;
    expect_errors("texture, nearest, times light: float16", PH_SHADE_TEXTURE_GOURAUD, PH_FILTER_NEAREST,
                  PH_DEPTH_FLOAT16, .3, .1);
    expect_errors("texture, nearest, times light: fixed24", PH_SHADE_TEXTURE_GOURAUD, PH_FILTER_NEAREST,
                  PH_DEPTH_FIXED24, .3, .1);
    expect_errors("texture, nearest, times light: linear-w", PH_SHADE_TEXTURE_GOURAUD, PH_FILTER_NEAREST,
                  PH_DEPTH_LINEAR_W, .3, .1);
}

static void bilinear_texels_are_near(void **state)
{
    (void)state;
    expect_errors("texture, bilinear: float16", PH_SHADE_TEXTURE, PH_FILTER_BILINEAR, PH_DEPTH_FLOAT16, .1, .1);
    expect_errors("texture, bilinear: fixed24", PH_SHADE_TEXTURE, PH_FILTER_BILINEAR, PH_DEPTH_FIXED24, .1, .1);
    expect_errors("texture, maps: float16", PH_SHADE_TEXTURE, PH_FILTER_MIPMAP, PH_DEPTH_FLOAT16, .1, .1);
    expect_errors("texture, maps: fixed24", PH_SHADE_TEXTURE, PH_FILTER_MIPMAP, PH_DEPTH_FIXED24, .1, .1);
}

static void light_on_bilinear_texels_is_near(void **state)
{
    (void)state;
    expect_errors("texture, maps, times light: float16", PH_SHADE_TEXTURE_GOURAUD, PH_FILTER_MIPMAP, PH_DEPTH_FLOAT16,
                  .3, .1);
    expect_errors("texture, maps, times light: fixed24", PH_SHADE_TEXTURE_GOURAUD, PH_FILTER_MIPMAP, PH_DEPTH_FIXED24,
                  .3, .1);
}

/* Draws frame 24 into a picture of its own. */
static void picture_of(const struct scene *s, int band_height, const struct ph_depth_format *format, uint16_t *picture)
{
    struct rig rig;
    rig_open(&rig, WIDTH, HEIGHT, band_height, format, s->torus.vertex_count, s->torus.triangle_count);
    scene_draw(&rig, s, 24);
    memcpy(picture, rig.pixels, sizeof *picture * WIDTH * HEIGHT);
    rig_close(&rig);
}

static void pictures_do_not_depend_on_bands(void **state)
{
    static const struct ph_shading *const shadings[] = {PH_SHADE_TEXTURE, PH_SHADE_TEXTURE_LIT,
                                                        PH_SHADE_TEXTURE_GOURAUD};
    static struct scene s;
    static uint16_t whole[WIDTH * HEIGHT], bands[WIDTH * HEIGHT];
    (void)state;
    for (int i = 0; i < 36; i++) {
        const struct ph_depth_format *const format = i % 2 ? PH_DEPTH_FLOAT16 : PH_DEPTH_FIXED24;
        scene_open(&s, shadings[i / 2 % 3], filters[i / 6 % 3]);
        s.material.specular = FX_ONE / 2;
        s.texture.wrap = (uint8_t)(i < 18 ? PH_WRAP_REPEAT : PH_WRAP_CLAMP_U + i % 3);
        picture_of(&s, HEIGHT, format, whole);
        for (int lines = 1; lines < 8; lines += 6) {
            picture_of(&s, lines, format, bands);
            assert_memory_equal(whole, bands, sizeof whole);
        }
        scene_close(&s);
    }
}

static void full_light_leaves_texels_as_they_are(void **state)
{
    static struct scene s;
    static uint16_t unlit[WIDTH * HEIGHT], lit[WIDTH * HEIGHT];
    (void)state;
    for (int i = 0; i < 3; i++) {
        scene_open(&s, PH_SHADE_TEXTURE, filters[i]);
        picture_of(&s, 16, PH_DEPTH_FLOAT16, unlit);
        s.material.shading = PH_SHADE_TEXTURE_GOURAUD;
        s.mesh.mesh.normals = NULL; /* then it is not lit */
        picture_of(&s, 16, PH_DEPTH_FLOAT16, lit);
        assert_memory_equal(unlit, lit, sizeof unlit);
        scene_close(&s);
    }
}

static double brightness(const uint16_t *picture)
{
    const uint8_t *const wire = (const uint8_t *)picture;
    double sum = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        sum += wire[2 * i] >> 3;
    }
    return sum;
}

/* The two are as bright with a highlight, too, which is white on both. */
static void a_white_texture_is_as_bright_as_the_colour(void **state)
{
    static struct scene s;
    static uint16_t colour[WIDTH * HEIGHT], textured[WIDTH * HEIGHT];
    uint16_t ramp[PH_RAMP_SIZE];
    (void)state;
    for (int i = 0; i < 4; i++) {
        const uint8_t grey = i % 2 ? 255 : 132;
        scene_open(&s, PH_SHADE_GOURAUD, PH_FILTER_NEAREST);
        s.material.specular = i / 2 * FX_ONE / 2;
        s.material.shininess_log2 = 4;
        s.material.ramp = ramp;
        ph_material_ramp(ramp, grey, grey, grey, s.material.specular);
        for (int k = 0; k < TEXELS; k++) {
            set_texel(&s, k, grey, grey, grey);
        }
        picture_of(&s, 16, PH_DEPTH_FLOAT16, colour);
        s.material.shading = PH_SHADE_TEXTURE_GOURAUD;
        picture_of(&s, 16, PH_DEPTH_FLOAT16, textured);
        const double share = brightness(textured) / brightness(colour);
        print_message("grey %d, specular %.1f: %.4f of the untextured brightness\n", grey, i / 2 * .5, share);
        assert_true(share > .98 && share < 1.02);
        scene_close(&s);
    }
}

/* ---- a plane that leans away ------------------------------------------------------------------------------- */

static const struct ref_lens lens = {WIDTH, HEIGHT, .5, 100};

/* A checkerboard floor, moved by `shift` of its repeats. */
static void draw_floor(struct rig *rig, const struct scene *s, double shift)
{
    static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const struct ph_part part = {0, 2, 0};
    static const struct fx_vec3 positions[4] = {{-FX_INT(20), -FX_ONE, -FX_INT(1)},
                                                {FX_INT(20), -FX_ONE, -FX_INT(1)},
                                                {FX_INT(20), -FX_ONE, -FX_INT(40)},
                                                {-FX_INT(20), -FX_ONE, -FX_INT(40)}};
    fx_t uvs[4][2] = {{0, FX_INT(13)}, {FX_INT(13), FX_INT(13)}, {FX_INT(13), 0}, {0, 0}};
    struct ph_projection projection;
    for (int i = 0; i < 4; i++) {
        uvs[i][1] += ref_q16(shift);
    }
    const struct ph_mesh mesh = {.positions = positions,
                                 .uvs = (const fx_t(*)[2])uvs,
                                 .triangles = triangles,
                                 .parts = &part,
                                 .materials = &s->material,
                                 .vertex_count = 4,
                                 .triangle_count = 2,
                                 .part_count = 1};
    ref_lens_projection(&lens, &projection);
    assert_int_equal(ph_frame_begin(&rig->r, &ph_xform_identity, &projection, NULL, 0), PH_OK);
    assert_int_equal(ph_draw_mesh(&rig->r, &mesh, &ph_xform_identity), PH_OK);
    assert_true(rig_finish(rig));
}

/* RMS change, in 31sts, of the far part of the floor from frame to frame while it moves by a tenth of a texel. */
static double shimmer(const struct ph_filter *filter)
{
    static struct scene s;
    static double last[WIDTH * HEIGHT];
    struct rig rig;
    double square = 0;
    long n = 0;
    scene_open(&s, PH_SHADE_TEXTURE, filter);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const double white = ((i / SIZE ^ i) & 4) != 0 ? 255 : 0;
        set_texel(&s, i, white, white, white);
    }
    maps(&s);
    rig_open(&rig, WIDTH, HEIGHT, 16, PH_DEPTH_FLOAT16, 4, 64);
    for (int frame = 0; frame < 12; frame++) {
        draw_floor(&rig, &s, frame * .1 / SIZE);
        for (int i = WIDTH * 126; i < WIDTH * 180; i++) {
            double rgb[3];
            rig_rgb(&rig, i % WIDTH, i / WIDTH, rgb);
            if (frame > 0) {
                square += pow((rgb[0] - last[i]) * 31 / 255, 2);
                n++;
            }
            last[i] = rgb[0];
        }
    }
    rig_close(&rig);
    scene_close(&s);
    return sqrt(square / (double)n);
}

static void maps_still_a_receding_checkerboard(void **state)
{
    (void)state;
    const double nearest = shimmer(PH_FILTER_NEAREST), bilinear = shimmer(PH_FILTER_BILINEAR);
    const double mip = shimmer(PH_FILTER_MIPMAP);
    print_message("shimmer: nearest %.2f, bilinear %.2f, mipmap %.2f 31sts RMS\n", nearest, bilinear, mip);
    assert_true(mip < nearest / 4);
    assert_true(mip < bilinear / 2);
}

/* The floor has tiles of many sizes and two triangles. Along its rows a smooth texture changes little by little. */
static void there_are_no_seams(void **state)
{
    static struct scene s;
    struct rig rig;
    (void)state;
    scene_open(&s, PH_SHADE_TEXTURE, PH_FILTER_BILINEAR);
    rig_open(&rig, WIDTH, HEIGHT, 16, PH_DEPTH_FLOAT16, 4, 64);
    draw_floor(&rig, &s, 0);
    double most = 0;
    for (int y = 180; y < HEIGHT; y++) {
        for (int x = 1; x < WIDTH; x++) {
            double left[3], here[3];
            rig_rgb(&rig, x - 1, y, left);
            rig_rgb(&rig, x, y, here);
            for (int c = 0; c < 3; c++) {
                most = fmax(most, fabs(here[c] - left[c]) * 31 / 255);
            }
        }
    }
    print_message("the largest step from pixel to pixel is %.2f 31sts\n", most);
    assert_true(most < 2.2);
    rig_close(&rig);
    scene_close(&s);
}

/* ---- a wall that the picture's guard cuts ------------------------------------------------------------------ */

/* A white wall before the eye, 40 wide, full in the light at its left end and dark at its right one. */
static void a_cut_triangle_keeps_the_light_of_its_corners(void **state)
{
    static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const struct ph_part part = {0, 2, 0};
    static const struct fx_vec3 positions[4] = {{-FX_INT(20), -FX_INT(20), -FX_ONE},
                                                {FX_INT(20), -FX_INT(20), -FX_ONE},
                                                {FX_INT(20), FX_INT(20), -FX_ONE},
                                                {-FX_INT(20), FX_INT(20), -FX_ONE}};
    static const int16_t normals[4][3] = {{0, 0, 16384}, {16384, 0, 0}, {16384, 0, 0}, {0, 0, 16384}};
    static const fx_t uvs[4][2];
    static const struct ph_scene_light ahead = {.count = 1,
                                                .lights = {{.intensity = FX_ONE, .to_light_q30 = {0, 0, 1 << 30}}}};
    static struct scene s;
    struct ph_projection projection;
    struct rig rig;
    (void)state;
    ref_lens_projection(&lens, &projection);
    for (int k = 0; k < 3; k++) {
        scene_open(&s, PH_SHADE_TEXTURE_GOURAUD, filters[k]);
        for (int i = 0; i < TEXELS; i++) {
            set_texel(&s, i, 255, 255, 255);
        }
        const struct ph_mesh wall = {.positions = positions,
                                     .normals = normals,
                                     .uvs = uvs,
                                     .triangles = triangles,
                                     .parts = &part,
                                     .materials = &s.material,
                                     .vertex_count = 4,
                                     .triangle_count = 2,
                                     .part_count = 1};
        rig_open(&rig, WIDTH, HEIGHT, 16, PH_DEPTH_FLOAT16, 4, 64);
        assert_int_equal(ph_frame_begin(&rig.r, &ph_xform_identity, &projection, &ahead, 0), PH_OK);
        assert_int_equal(ph_draw_mesh(&rig.r, &wall, &ph_xform_identity), PH_OK);
        assert_true(rig_finish(&rig));
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            double rgb[3];
            rig_rgb(&rig, i % WIDTH, i / WIDTH, rgb);
            const double x = (i % WIDTH + .5 - WIDTH / 2.) / (HEIGHT / 2.) * tan(3.14159265 / 6);
            assert_true(fabs(rgb[0] * 31 / 255 - 31 * (20 - x) / 40) < 1);
        }
        rig_close(&rig);
        scene_close(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_on_nearest_texels_is_near),
        cmocka_unit_test(bilinear_texels_are_near),
        cmocka_unit_test(light_on_bilinear_texels_is_near),
        cmocka_unit_test(pictures_do_not_depend_on_bands),
        cmocka_unit_test(full_light_leaves_texels_as_they_are),
        cmocka_unit_test(a_white_texture_is_as_bright_as_the_colour),
        cmocka_unit_test(maps_still_a_receding_checkerboard),
        cmocka_unit_test(there_are_no_seams),
        cmocka_unit_test(a_cut_triangle_keeps_the_light_of_its_corners),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
