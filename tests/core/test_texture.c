/*
 * Perspective-correct texturing is compared with exact geometry: random squares that lean away from the camera, also
 * across the borders of the picture and the near plane. Every texel has its own colour. Each pixel inside the square
 * must show the texel that the ray through its centre meets, within 1/32 texel and 1/8 of a pixel's step. The renderer
 * divides exactly at the corners of tiles of up to 64 x 16 pixels, and follows parabolas between them. They are good
 * while the distance changes little over a tile ("gentle": by less than a third from 16 pixels to the left to 16 to the
 * right). Beyond, tiles are smaller, and a stated share of pixels may miss the tolerance.
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

#define WIDTH   128
#define HEIGHT  96
#define LOG2    6
#define TEXELS  (1 << LOG2)
#define SQUARES 60

static const struct ref_lens lens = {WIDTH, HEIGHT, .5, 100};

/* A square of `size` with `tiles` repeats of the texture across; v runs down. */
struct square {
    double size, tiles;
    double across[2]; /* texels in a repeat, along u and v */
    struct fx_vec3 positions[4];
    fx_t uvs[4][2];
    struct ph_material material;
    struct ph_texture texture;
    uint16_t texels[TEXELS * TEXELS];
};

struct totals {
    long pixels, wrong;                        /* wrong: another texel than the exact one */
    long gentle, gentle_bad, steep, steep_bad; /* bad: out of tolerance */
};

static void square_build(struct square *s, double size, double tiles, enum ph_wrap wrap)
{
    static const double corners[4][2] = {{-.5, -.5}, {.5, -.5}, {.5, .5}, {-.5, .5}};
    s->size = size;
    s->tiles = tiles;
    s->across[0] = s->across[1] = TEXELS;
    for (int i = 0; i < 4; i++) {
        s->positions[i] = (struct fx_vec3){ref_q16(corners[i][0] * size), ref_q16(corners[i][1] * size), 0};
        s->uvs[i][0] = ref_q16(corners[i][0] * tiles);
        s->uvs[i][1] = ref_q16(-corners[i][1] * tiles);
    }
    for (int i = 0; i < TEXELS * TEXELS; i++) {
        s->texels[i] = (uint16_t)i;
    }
    s->texture =
        (struct ph_texture){.texels = s->texels, .log2_width = LOG2, .log2_height = LOG2, .wrap = (uint8_t)wrap};
    s->material = (struct ph_material){.shading = PH_SHADE_TEXTURE, .texture = &s->texture};
}

/* Enlarges the texture of square_build, which then stands in it over and over. */
static void enlarge(struct ph_texture *texture, uint8_t log2_width, uint8_t log2_height)
{
    static uint16_t texels[1 << 20];
    const int width = 1 << log2_width, height = 1 << log2_height;
    for (int i = 0; i < width * height; i++) {
        texels[i] = (uint16_t)(i / width % TEXELS * TEXELS + i % width % TEXELS);
    }
    texture->texels = texels;
    texture->log2_width = log2_width;
    texture->log2_height = log2_height;
}

static void square_draw(struct rig *rig, const struct square *s, const struct ref_plane *p)
{
    static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const struct ph_part part = {0, 2, 0};
    struct ph_projection projection;
    const struct ph_mesh mesh = {.positions = s->positions,
                                 .uvs = s->uvs,
                                 .triangles = triangles,
                                 .parts = &part,
                                 .materials = &s->material,
                                 .vertex_count = 4,
                                 .triangle_count = 2,
                                 .part_count = 1};
    ref_lens_projection(&lens, &projection);
    assert_int_equal(ph_frame_begin(&rig->r, &ph_xform_identity, &projection, NULL, 0), PH_OK);
    assert_int_equal(ph_draw_mesh(&rig->r, &mesh, &p->xform), PH_OK);
    assert_true(rig_finish(rig));
}

/* Texture coordinates in texels of a picture point; false unless it lies safely inside the square. */
static bool texel_at(const struct square *s, const struct ref_plane *p, double sx, double sy, double texel[2])
{
    double u, v, z, most = s->size / 2;
    bool in = ref_plane_at(p, &lens, sx, sy, &u, &v, &z);
    texel[0] = u / s->size * s->tiles * s->across[0];
    texel[1] = -v / s->size * s->tiles * s->across[1];
    return in && fabs(u) < most && fabs(v) < most;
}

/* How far a coordinate along u (0) or v (1) lies outside texel number `drawn`, in texels, 0 inside. */
static double outside(double exact, int drawn, uint8_t wrap, int along)
{
    double off = exact - (drawn + .5);
    if ((wrap >> along & 1) == 0) {
        off = remainder(off, TEXELS);
    } else if ((drawn == 0 && off < 0) || (drawn == TEXELS - 1 && off > 0)) {
        return 0;
    }
    return fmax(0, fabs(off) - .5);
}

static bool is_gentle(const struct ref_plane *p, int x, int y)
{
    double u, v, left, right;
    return ref_plane_at(p, &lens, x - 15.5, y + .5, &u, &v, &left) &&
           ref_plane_at(p, &lens, x + 16.5, y + .5, &u, &v, &right) && fmax(left, right) < 4. / 3 * fmin(left, right);
}

/* How many tolerances a pixel's texel is off the exact coordinates; `step`: what one pixel changes them by. */
static double tolerances(const struct square *s, int drawn, const double exact[2], const double step[2])
{
    double u = outside(exact[0], drawn % TEXELS, s->texture.wrap, 0),
           v = outside(exact[1], drawn / TEXELS, s->texture.wrap, 1);
    return fmax(u / (1 / 32. + step[0] / 8), v / (1 / 32. + step[1] / 8));
}

static void check_pixel(const struct rig *rig, const struct square *s, const struct ref_plane *p, int x, int y,
                        struct totals *t)
{
    static const int around[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    double exact[2], near[2], step[2] = {0, 0};
    bool inside = texel_at(s, p, x + .5, y + .5, exact);
    for (int i = 0; i < 4; i++) {
        inside = texel_at(s, p, x + .5 + around[i][0], y + .5 + around[i][1], near) && inside;
        step[0] = fmax(step[0], fabs(near[0] - exact[0]));
        step[1] = fmax(step[1], fabs(near[1] - exact[1]));
    }
    if (!inside) {
        return;
    }
    double off = tolerances(s, rig->pixels[y * WIDTH + x], exact, step);
    bool gentle = is_gentle(p, x, y);
    t->pixels++;
    t->wrong += off > 0;
    t->gentle += gentle;
    t->gentle_bad += gentle && off > 1;
    t->steep += !gentle;
    t->steep_bad += !gentle && off > 1;
}

/* Random squares; at most `steep` percent of the pixels that are not gentle may be off. */
static void check_squares_of(uint8_t log2_width, uint8_t log2_height, double size, double tiles, enum ph_wrap wrap,
                             double distance, double side, double turn, double steep)
{
    struct rig rig;
    struct square s;
    struct totals t = {0, 0, 0, 0, 0, 0};
    square_build(&s, size, tiles, wrap);
    if (log2_width > LOG2) {
        enlarge(&s.texture, log2_width, log2_height);
        s.across[0] = 1 << log2_width;
        s.across[1] = 1 << log2_height;
    }
    rig_open(&rig, WIDTH, HEIGHT, HEIGHT, PH_DEPTH_FIXED16, 4, 16);
    ref_seed(11);
    for (int i = 0; i < SQUARES; i++) {
        struct ref_plane p;
        ref_plane_place(&p, distance, side, turn);
        square_draw(&rig, &s, &p);
        for (int k = 0; k < WIDTH * HEIGHT; k++) {
            check_pixel(&rig, &s, &p, k % WIDTH, k / WIDTH, &t);
        }
    }
    rig_close(&rig);
    const char *const missed = "% of pixels over 1/32 texel and 1/8 pixel off";
    const double steep_percent = 100. * (double)t.steep_bad / (double)t.steep;
    print_message("%ld pixels, %.2f %% another texel; off: %ld of %ld gentle, %.2f %% of %ld steep\n", t.pixels,
                  100. * (double)t.wrong / (double)t.pixels, t.gentle_bad, t.gentle, steep_percent, t.steep);
    assert_true(t.gentle > 100000);
    assert_true(surface_row("texture, nearest: gentle", missed, 100. * (double)t.gentle_bad / (double)t.gentle, 0));
    assert_true(surface_row("texture, nearest: steep", missed, steep_percent, steep));
}

static void check_squares(double size, double tiles, enum ph_wrap wrap, double distance, double side, double turn,
                          double steep)
{
    check_squares_of(LOG2, LOG2, size, tiles, wrap, distance, side, turn, steep);
}

static void magnified_textures_are_exact(void **state)
{
    (void)state;
    check_squares(2, 1, PH_WRAP_REPEAT, 2.5, .3, 1, .1);
}

static void textures_over_the_borders_are_exact(void **state)
{
    (void)state;
    check_squares(8, 2, PH_WRAP_REPEAT, 3, 3, 1.2, .1);
}

static void textures_through_the_near_plane_are_exact(void **state)
{
    (void)state;
    check_squares(8, 2, PH_WRAP_REPEAT, .7, 1, 1.5, .1);
}

static void clamped_textures_are_exact(void **state)
{
    (void)state;
    for (enum ph_wrap wrap = PH_WRAP_CLAMP_U; wrap <= PH_WRAP_CLAMP; wrap++) {
        check_squares(4, 2, wrap, 3, 1, 1.2, .1);
    }
}

static void many_repeats_are_exact(void **state)
{
    (void)state;
    check_squares(8, 16, PH_WRAP_REPEAT, 3, 3, 1.2, .3);
}

/* v has other units beyond 65,536 texels. */
static void textures_of_every_size_are_exact(void **state)
{
    static const uint8_t log2[][2] = {{7, 10}, {9, 7}, {9, 8}, {9, 9}, {10, 6}, {10, 7}, {10, 10}};
    (void)state;
    for (size_t i = 0; i < sizeof log2 / sizeof log2[0]; i++) {
        check_squares_of(log2[i][0], log2[i][1], 8, .5, PH_WRAP_REPEAT, 3, 3, 1.2, .3);
    }
}

/* ---- a mesh of small triangles ---------------------------------------------------------------------------- */

/* The texel at u or v, along which there are that many. */
static int texel_of(double uv, int across, bool clamps)
{
    const int texel = (int)floor(uv * across);
    return (!clamps ? texel : texel < 0 ? 0 : texel < across ? texel : across - 1) & (TEXELS - 1);
}

static long wrong_texels(const struct rig *rig, const struct ref_picture *exact, int across, enum ph_wrap wrap,
                         long *pixels)
{
    long wrong = 0;
    for (int i = 0; i < rig->width * rig->height; i++) {
        const struct ref_pixel pixel = ref_at(exact, i % rig->width, i / rig->width);
        if (pixel.triangle >= 0 && rig->depth[i] != 0) {
            const int x = texel_of(pixel.uv[0], across, (wrap & PH_WRAP_CLAMP_U) != 0);
            const int y = texel_of(pixel.uv[1], across, (wrap & PH_WRAP_CLAMP_V) != 0);
            (*pixels)++;
            wrong += rig->pixels[i] != y * TEXELS + x;
        }
    }
    return wrong;
}

/* A torus with a texture of 2^log2 texels each way. All of its pixels count, those at the edges of triangles, too; at
 * most `most` percent may have another texel. */
static void check_torus(uint8_t log2, enum ph_wrap wrap, const char *surface, double most)
{
    static struct rig_mesh mesh;
    struct ref_scene scene;
    struct ref_picture exact;
    textured_torus_build(&scene);
    rig_mesh_build(&mesh, &scene);
    enlarge(&mesh.texture, log2, log2);
    mesh.texture.wrap = (uint8_t)wrap;
    static const struct ph_depth_format *const formats[] = {PH_DEPTH_FIXED16, PH_DEPTH_FLOAT16, PH_DEPTH_FIXED24};
    for (int f = 0; f < 3; f++) { /* FIXED24 has no small triangles */
        const struct ph_depth_format *const format = formats[f];
        struct rig rig;
        long wrong = 0, pixels = 0;
        rig_open(&rig, 320, 240, 16, format, scene.vertex_count, scene.triangle_count);
        for (int frame = 0; frame < 64; frame += 8) {
            const struct ph_xform pose = rig_pose(&scene, frame);
            rig_begin(&rig);
            assert_int_equal(ph_draw_mesh(&rig.r, &mesh.mesh, &pose), PH_OK);
            assert_true(rig_finish(&rig));
            ref_draw(&exact, &ref_benchmark, &scene, frame);
            wrong += wrong_texels(&rig, &exact, 1 << log2, wrap, &pixels);
            ref_picture_free(&exact);
        }
        print_message("%ld pixels, %.3f %% another texel\n", pixels, 100. * (double)wrong / (double)pixels);
        assert_true(pixels > 175000);
        assert_true(
            surface_row(surface, "% of pixels with another texel", 100. * (double)wrong / (double)pixels, most));
        rig_close(&rig);
    }
    rig_mesh_free(&mesh);
    ref_scene_free(&scene);
}

static void a_mesh_of_small_triangles_is_exact(void **state)
{
    (void)state;
    for (enum ph_wrap wrap = PH_WRAP_REPEAT; wrap <= PH_WRAP_CLAMP; wrap++) {
        check_torus(LOG2, wrap, "texture, nearest: small triangles", .6);
    }
}

static void a_mesh_of_small_triangles_with_a_large_texture_is_exact(void **state)
{
    (void)state;
    check_torus(9, PH_WRAP_REPEAT, "texture of 512 texels, nearest: small triangles", 4);
}

/* The square in one of two materials, or (2) in both, material 0 first. */
static void draw_two(struct rig *rig, const struct square *s, const struct ref_plane *p,
                     const struct ph_material materials[2], uint32_t which)
{
    static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const struct ph_part parts[2] = {{0, 2, 0}, {0, 2, 1}};
    static const int16_t normals[4][3] = {{0, 0, 1 << 14}, {0, 0, 1 << 14}, {0, 0, 1 << 14}, {0, 0, 1 << 14}};
    const struct ph_scene_light half = {.ambient = FX_ONE / 2};
    struct ph_projection projection;
    const struct ph_mesh mesh = {.positions = s->positions,
                                 .normals = normals,
                                 .uvs = s->uvs,
                                 .triangles = triangles,
                                 .parts = &parts[which % 2],
                                 .materials = materials,
                                 .vertex_count = 4,
                                 .triangle_count = 2,
                                 .part_count = which < 2 ? 1 : 2};
    ref_lens_projection(&lens, &projection);
    assert_int_equal(ph_frame_begin(&rig->r, &ph_xform_identity, &projection, &half, 0), PH_OK);
    assert_int_equal(ph_draw_mesh(&rig->r, &mesh, &p->xform), PH_OK);
    assert_true(rig_finish(rig));
}

static int pixels_that_differ(const uint16_t *a, const uint16_t *b)
{
    int n = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        n += a[i] != b[i];
    }
    return n;
}

static void check_equal_depths(struct square *s, const struct ph_depth_format *format, enum ph_wrap wrap,
                               const struct ph_shading *shading)
{
    static uint16_t other[TEXELS * TEXELS], first[WIDTH * HEIGHT];
    const struct ph_texture texture = {.texels = other, .log2_width = LOG2, .log2_height = LOG2, .wrap = (uint8_t)wrap};
    struct rig rig;
    struct ref_plane p;
    square_build(s, 4, 2, wrap);
    for (int i = 0; i < TEXELS * TEXELS; i++) {
        other[i] = (uint16_t)~s->texels[i];
    }
    const struct ph_material materials[2] = {{.shading = shading, .ambient = FX_ONE, .texture = &s->texture},
                                             {.shading = shading, .ambient = FX_ONE, .texture = &texture}};
    rig_open(&rig, WIDTH, HEIGHT, HEIGHT, format, 4, 16);
    ref_seed(5);
    ref_plane_place(&p, 3, .3, 1);
    draw_two(&rig, s, &p, materials, 0);
    memcpy(first, rig.pixels, sizeof first);
    draw_two(&rig, s, &p, materials, 1);
    assert_true(pixels_that_differ(first, rig.pixels) > WIDTH * HEIGHT / 4);
    draw_two(&rig, s, &p, materials, 2);
    assert_int_equal(pixels_that_differ(first, rig.pixels), 0);
    rig_close(&rig);
}

static void of_two_equal_depths_the_first_texel_stays(void **state)
{
    struct square s;
    (void)state;
    for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
        const struct ph_depth_format *const format = ph_depth_formats[f];
        for (int i = 0; i < 4; i++) {
            check_equal_depths(&s, format, i & 1 ? PH_WRAP_CLAMP_U : PH_WRAP_REPEAT,
                               i & 2 ? PH_SHADE_TEXTURE_LIT : PH_SHADE_TEXTURE);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(magnified_textures_are_exact),
        cmocka_unit_test(textures_over_the_borders_are_exact),
        cmocka_unit_test(textures_through_the_near_plane_are_exact),
        cmocka_unit_test(clamped_textures_are_exact),
        cmocka_unit_test(many_repeats_are_exact),
        cmocka_unit_test(textures_of_every_size_are_exact),
        cmocka_unit_test(a_mesh_of_small_triangles_is_exact),
        cmocka_unit_test(a_mesh_of_small_triangles_with_a_large_texture_is_exact),
        cmocka_unit_test(of_two_equal_depths_the_first_texel_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
