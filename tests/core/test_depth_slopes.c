/*
 * Depth of surfaces at every slope. Random triangles, from tiny to larger than the picture, facing the camera to seen
 * nearly edge-on, are drawn in every format and as every kind of surface. The code of each pixel is compared with the
 * exact plane through the projected corners, in integers of 128 bits, and with the code of the other surfaces, which
 * must be the same. So are all triangles of a demo. Then the scenes that once went wrong: floors in front of walls, and
 * a sphere drawn twice.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "clip.h"
#include "demo_stage.h"
#include "edge.h"
#include "list.h"
#include "raster.h"
#include "ref_random.h"
#include "ref_rig.h"
#include "setup.h"
#include "vertex.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define WIDTH  160
#define HEIGHT 120
#ifndef TRIANGLES /* the long test has more: exhaustive_depth_slopes.c */
#define TRIANGLES 2000
#endif
#define ALL_OF 4 /* one triangle in so many is drawn as each surface, the others as the first OFTEN */

__extension__ typedef __int128 int128;

struct lens {
    double near_z, far_z;
};

/* ---- drawing ------------------------------------------------------------------------------------------------------
 */

/* What a triangle can look like. Its depth must not depend on it. */
struct surface {
    const char *name;
    const struct ph_shading *shading;
    const struct ph_filter *filter;
    uint8_t wrap;
    int8_t blend;                  /* enum ph_blend_kind; NONE: opaque */
    bool fog, coloured, is_tinted; /* coloured: the mesh has colours; is_tinted: the light has one */
};

enum { OFTEN = 6, OPAQUE = 17, SURFACES = 20, NONE = -1 };

static const struct surface surfaces[SURFACES] = {
    {"unlit", PH_SHADE_UNLIT, NULL, 0, NONE, false, false, false},
    {"flat", PH_SHADE_FLAT, NULL, 0, NONE, false, false, false},
    {"Gouraud", PH_SHADE_GOURAUD, NULL, 0, NONE, false, false, false},
    {"texture", PH_SHADE_TEXTURE, NULL, 0, NONE, false, false, false},
    {"texture lit", PH_SHADE_TEXTURE_LIT, NULL, 0, NONE, false, false, false},
    {"clamped", PH_SHADE_TEXTURE, NULL, PH_WRAP_CLAMP, NONE, false, false, false},
    {"texture Gouraud", PH_SHADE_TEXTURE_GOURAUD, NULL, 0, NONE, false, false, false},
    {"bilinear", PH_SHADE_TEXTURE, PH_FILTER_BILINEAR, 0, NONE, false, false, false},
    {"mipmap Gouraud", PH_SHADE_TEXTURE_GOURAUD, PH_FILTER_MIPMAP, 0, NONE, false, false, false},
    {"clamped, bilinear Gouraud", PH_SHADE_TEXTURE_GOURAUD, PH_FILTER_BILINEAR, PH_WRAP_CLAMP, NONE, false, false,
     false},
    {"colours", PH_SHADE_UNLIT, NULL, 0, NONE, false, true, false},
    {"colours, Gouraud", PH_SHADE_GOURAUD, NULL, 0, NONE, false, true, false},
    {"coloured light", PH_SHADE_GOURAUD, NULL, 0, NONE, false, false, true},
    {"cut-out, key", PH_SHADE_TEXTURE_GOURAUD, NULL, 0, PH_BLEND_KEY, false, false, false},
    {"cut-out, mask", PH_SHADE_TEXTURE, PH_FILTER_BILINEAR, 0, PH_BLEND_MASK, false, false, false},
    {"cut-out, clamped mask", PH_SHADE_UNLIT, NULL, PH_WRAP_CLAMP, PH_BLEND_MASK, false, false, false},
    {"fog", PH_SHADE_GOURAUD, NULL, 0, NONE, true, false, false},
    {"alpha", PH_SHADE_UNLIT, NULL, 0, PH_BLEND_ALPHA, false, false, false}, /* from here on they write no depth */
    {"alpha, texture", PH_SHADE_TEXTURE_GOURAUD, PH_FILTER_BILINEAR, 0, PH_BLEND_ALPHA, true, false, false},
    {"added", PH_SHADE_GOURAUD, NULL, 0, PH_BLEND_ADD, false, true, false},
};

static void begin_with(struct rig *rig, const struct ph_projection *projection, const struct surface *surface)
{
    const struct ph_scene_light light = {
        FX_HALF,
        1,
        {{.intensity = FX_ONE, .to_light_q30 = {0, 0, FX_Q30_ONE}, .red = surface->is_tinted ? FX_ONE : 0}}};
    const struct ph_fog fog = {0x1234, projection->near_z, projection->far_z};
    assert_int_equal(ph_frame_begin(&rig->r, &ph_xform_identity, projection, &light, 0), PH_OK);
    if (surface->fog) {
        assert_int_equal(ph_frame_fog(&rig->r, &fog), PH_OK);
    }
}

static void begin(struct rig *rig, const struct lens *lens, const struct surface *surface)
{
    struct ph_projection projection;
    assert_int_equal(ph_projection_perspective(&projection, FX_INT(60), ref_q16((double)rig->width / rig->height),
                                               ref_q16(lens->near_z), ref_q16(lens->far_z)),
                     PH_OK);
    begin_with(rig, &projection, surface);
}

/* A material for a surface; nothing of its texture is cut out. */
static struct ph_material material_of(const struct surface *surface, const uint16_t ramp[PH_RAMP_SIZE], uint16_t colour)
{
    static const uint16_t texels[6] = {1, 2, 3, 4, 5}, opaque[1] = {UINT16_MAX};
    static struct ph_texture textures[PH_WRAP_CLAMP + 1][3];
    static const struct ph_texture alphas[] = {
        [PH_WRAP_REPEAT] = {.texels = opaque}, [PH_WRAP_CLAMP] = {.texels = opaque, .wrap = PH_WRAP_CLAMP}};
    static struct ph_blend blends[PH_BLEND_ADD + 1];
    const int filter = surface->filter == PH_FILTER_MIPMAP ? 2 : surface->filter == PH_FILTER_BILINEAR;
    struct ph_texture *const texture = &textures[surface->wrap][filter];
    *texture = (struct ph_texture){.texels = texels,
                                   .log2_width = 1,
                                   .log2_height = 1,
                                   .wrap = surface->wrap,
                                   .filter = surface->filter,
                                   .levels = 1};
    if (surface->blend != NONE) {
        blends[surface->blend] =
            (struct ph_blend){ph_draw_blended_alphas, (uint8_t)surface->blend, 16, 9, &alphas[surface->wrap]};
    }
    return (struct ph_material){.shading = surface->shading,
                                .two_sided = 1,
                                .ambient = FX_ONE,
                                .diffuse = FX_ONE,
                                .colour = colour,
                                .ramp = ramp,
                                .texture = texture,
                                .blend = surface->blend != NONE ? &blends[surface->blend] : NULL};
}

/* Three or four corners as one or two triangles. */
static void draw_polygon(struct rig *rig, const struct fx_vec3 *p, int corners, const struct surface *surface,
                         const struct ph_material *material)
{
    static const uint16_t colours[4] = {0x1111, 0x2222, 0x3333, 0x4444};
    static const uint16_t faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const int16_t normals[4][3] = {{0, 0, 16384}, {16384, 0, 0}, {0, 16384, 0}, {0, 0, 16384}};
    static const fx_t uvs[4][2] = {{0, 0}, {FX_ONE, 0}, {0, FX_ONE}, {FX_ONE, FX_ONE}};
    const struct ph_part part = {0, (uint32_t)corners - 2, 0};
    const struct ph_mesh mesh = {.positions = p,
                                 .normals = normals,
                                 .uvs = uvs,
                                 .colours = surface->coloured ? colours : NULL,
                                 .vertex_count = (uint32_t)corners,
                                 .triangles = faces,
                                 .triangle_count = (uint32_t)corners - 2,
                                 .parts = &part,
                                 .part_count = 1,
                                 .materials = material};
    assert_int_equal(ph_draw_mesh(&rig->r, &mesh, &ph_xform_identity), PH_OK);
}

/* ---- the exact plane ----------------------------------------------------------------------------------------------
 */

struct plane {
    struct ph_vertex v[3];
    int128 over_w[3]; /* N/w of the corners, 2^-56 */
    int64_t area;
    double low, high; /* N/w of the corners */
};

static int64_t cross(int64_t ax, int64_t ay, int64_t bx, int64_t by)
{
    return ax * by - ay * bx;
}

/* The head room of d: see depth.h. */
static int head_of(const struct rig *rig)
{
    return rig->r.stats.depth_exponent > 4 ? 13 - rig->r.stats.depth_exponent : 9;
}

/* N of depth.h, times 2^56. */
static int128 near_of(const struct rig *rig)
{
    const struct ph_lens *lens = &rig->r.lens;
    const int128 n = (int128)lens->near_z * (512 - (512 >> head_of(rig))) << 47;
    const bool is_fixed = rig->r.stats.depth_format->coding == PH_DEPTH_IS_FIXED;
    return is_fixed ? n / (lens->far_z - lens->near_z) * lens->far_z : n; /* the planes here are far apart */
}

/* The triangle that was drawn last, at `at`. False if it was clipped or has no area. */
static bool plane_open(struct plane *p, const struct rig *rig, const struct fx_vec3 at[3])
{
    const int128 n = near_of(rig);
    memcpy(p->v, rig->vertices, sizeof p->v);
    p->low = HUGE_VAL;
    p->high = 0;
    for (int i = 0; i < 3; i++) {
        if (p->v[i].code & PH_CLIP) {
            return false;
        }
        p->over_w[i] = n / -at[i].z;
        p->low = fmin(p->low, ldexp((double)p->over_w[i], -56));
        p->high = fmax(p->high, ldexp((double)p->over_w[i], -56));
    }
    p->area = cross(p->v[1].x - p->v[0].x, p->v[1].y - p->v[0].y, p->v[2].x - p->v[0].x, p->v[2].y - p->v[0].y);
    return p->area != 0;
}

/* N/w at the centre of a pixel; *outside: the centre lies outside the triangle. */
static double plane_at(const struct plane *p, int x, int y, bool *outside)
{
    const int64_t px = 256 * x + 128, py = 256 * y + 128;
    int128 sum = 0;
    *outside = false;
    for (int i = 0; i < 3; i++) {
        const struct ph_vertex *a = &p->v[(i + 1) % 3], *b = &p->v[(i + 2) % 3];
        const int64_t share = cross(a->x - px, a->y - py, b->x - px, b->y - py);
        *outside |= share != 0 && (share < 0) != (p->area < 0);
        sum += share * p->over_w[i];
    }
    return ldexp((double)(sum / p->area), -56);
}

/* The steepest of the slopes right and down, of N/w per pixel. */
static double plane_slope(const struct plane *p)
{
    bool outside;
    const double here = plane_at(p, 0, 0, &outside);
    return fmax(fabs(plane_at(p, 1, 0, &outside) - here), fabs(plane_at(p, 0, 1, &outside) - here));
}

/* The value of which the code is the floor: see depth.h. */
static double code_exact(const struct rig *rig, double over_w)
{
    const struct ph_lens *lens = &rig->r.lens;
    const struct ph_depth_format *const format = rig->r.stats.depth_format;
    const double d = fmax(over_w - ldexp((double)near_of(rig), -56) / lens->far_z, 0);
    const double unit = ph_depth_bytes(format) == 4 ? 256 : 1;
    if (format->coding == PH_DEPTH_IS_LINEAR) {
        const double w = lens->near_z * (511. / 512) / over_w;
        return 65408 * (lens->far_z - w) / ((double)lens->far_z - lens->near_z) + 16;
    }
    if (format->coding == PH_DEPTH_IS_FIXED) {
        return unit * (65536 * d + 16.25);
    }
    const int bits = rig->r.stats.depth_exponent, top = 1 << bits;
    const int exponent = d < ldexp(1, 1 - top) ? 1 : ilogb(d) + top;
    return unit * (ldexp(d, 16 - bits + top - exponent) + ldexp(exponent - 1, 16 - bits) + 8);
}

/* ---- random triangles ---------------------------------------------------------------------------------------------
 */

/* The point at a place of the picture, at distance w. */
static struct fx_vec3 point_at(double x, double y, double w)
{
    const double focal = HEIGHT / 2. * sqrt(3);
    return (struct fx_vec3){ref_q16((x - WIDTH / 2.) * w / focal), ref_q16((HEIGHT / 2. - y) * w / focal), -ref_q16(w)};
}

/* Any size, thin or not, anywhere in the picture, its corners at distances that are alike or far apart. */
static void random_triangle(const struct lens *lens, struct fx_vec3 p[3])
{
    const double size = pow(2, ref_uniform(0, 9)), thin = pow(2, ref_uniform(-9, 0)), turn = ref_uniform(0, 6.283);
    const double steep = pow(2, ref_uniform(-12, 0)), middle = ref_uniform(0, 1);
    const double x = ref_uniform(0, WIDTH), y = ref_uniform(0, HEIGHT);
    for (int i = 0; i < 3; i++) {
        const double u = ref_uniform(-.5, .5) * size, v = ref_uniform(-.5, .5) * size * thin;
        const double share = fmin(fmax(middle + ref_uniform(-.5, .5) * steep, 0), 1);
        const double w = lens->near_z * 1.001 * pow(lens->far_z / lens->near_z / 1.002, share);
        p[i] = point_at(x + u * cos(turn) - v * sin(turn), y + u * sin(turn) + v * cos(turn), w);
    }
}

/* A sliver whose long side passes a pixel's centre near its lower end so closely that rounding decides on which side it
 * lies. Depth changes along it, or across it, too. */
static void random_sliver(const struct lens *lens, struct fx_vec3 p[3])
{
    const double x = floor(ref_uniform(40, WIDTH - 40)) + .5, y = floor(ref_uniform(40, HEIGHT - 40)) + .5;
    const double dx = floor(ref_uniform(-512, 512)) / 256, dy = floor(ref_uniform(0, 512)) / 256;
    const double times = floor(ref_uniform(16, 32)), part = ref_uniform(0, 1), length = hypot(dx, dy) + .01;
    const double across = floor(pow(2, ref_uniform(0, 6))) / -256 / length, noise = pow(2, ref_uniform(-12, 0));
    const double ax = x - times * dx + floor(ref_uniform(-1, 2)) / 256;
    const double ay = y - times * dy + floor(ref_uniform(-1, 2)) / 256, bx = x + dx, by = y + dy;
    const double least = lens->near_z / lens->far_z;
    const double a = ref_uniform(least * 1.001, .99), b = ref_uniform(least * 1.001, .99);
    const double c = fmin(fmax(a + (b - a) * part + ref_uniform(-.5, .5) * noise, least * 1.001), .99);
    p[0] = point_at(ax, ay, lens->near_z / a);
    p[1] = point_at(bx, by, lens->near_z / b);
    p[2] = point_at(ax + (bx - ax) * part - dy * across, ay + (by - ay) * part + dx * across, lens->near_z / c);
}

/* A triangle in space: its plane is tilted by up to 89.9 degrees, towards any side. */
static void tilted_triangle(const struct lens *lens, struct fx_vec3 p[3])
{
    const double tilt = ref_uniform(0, 89.9) * acos(-1) / 180, side = ref_uniform(0, 6.283);
    const double w = lens->near_z * pow(lens->far_z / lens->near_z, ref_uniform(.02, .98));
    const double size = w * pow(2, ref_uniform(-6, 1)), focal = HEIGHT / 2. * sqrt(3);
    const double x = ref_uniform(-.5, .5) * WIDTH * w / focal, y = ref_uniform(-.5, .5) * HEIGHT * w / focal;
    for (int i = 0; i < 3; i++) {
        const double u = ref_uniform(-.5, .5) * size, v = ref_uniform(-.5, .5) * size;
        p[i].x = ref_q16(x + u * cos(tilt) * cos(side) - v * sin(side));
        p[i].y = ref_q16(y + u * cos(tilt) * sin(side) + v * cos(side));
        p[i].z = ref_q16(fmax(fmin(-w + u * sin(tilt), -lens->near_z * 1.001), -lens->far_z / 1.001));
    }
}

enum { SLOPES = 5 };
static const double steepest[SLOPES] = {1. / 4096, 1. / 256, 1. / 16, 1, INFINITY}; /* of d, in its range a pixel */

struct result {
    double worst[OPAQUE][SLOPES];    /* codes off the exact plane, at centres within the corners */
    double distance[OPAQUE][SLOPES]; /* codes off the exact plane, as a share of the distance */
    double beyond;                   /* codes outside the range of the corners */
    long pixels, unlike;             /* unlike: code differs from that of the first surface */
};

static void compare(const struct rig *rig, const struct plane *plane, const uint32_t *first, int surface,
                    struct result *result)
{
    const double slope = plane_slope(plane), low = code_exact(rig, plane->low), high = code_exact(rig, plane->high);
    int bin = 0;
    while (slope > steepest[bin]) {
        bin++;
    }
    double *const worst = &result->worst[surface][bin], *const distance = &result->distance[surface][bin];
    for (int at = 0; at < WIDTH * HEIGHT; at++) {
        const uint32_t code = rig->depth[at];
        result->unlike += code != first[at];
        if (code == 0) {
            continue;
        }
        bool outside;
        const double over_w = plane_at(plane, at % WIDTH, at / WIDTH, &outside);
        result->pixels++;
        result->beyond = fmax(result->beyond, fmax(low - (code + 1), code - high));
        if (!outside) {
            const double off = fabs(code + .5 - code_exact(rig, over_w));
            const double step = code_exact(rig, over_w * (1 + 1e-6)) - code_exact(rig, over_w);
            *worst = fmax(*worst, off);
            *distance = fmax(*distance, step > 0 ? (off + .5) * 1e-6 / step : 0);
        }
    }
}

/* Draws a triangle as each of the first surfaces and compares. */
static void compare_surfaces(struct rig *rig, const struct lens *lens, const struct fx_vec3 p[3], int count,
                             struct result *result)
{
    static uint16_t ramp[PH_RAMP_SIZE];
    static uint32_t first[WIDTH * HEIGHT];
    for (int surface = 0; surface < count; surface++) {
        const struct ph_material material = material_of(&surfaces[surface], ramp, 1);
        struct plane plane;
        begin(rig, lens, &surfaces[surface]);
        draw_polygon(rig, p, 3, &surfaces[surface], &material);
        assert_true(rig_finish(rig));
        if (surface == 0) {
            memcpy(first, rig->depth, sizeof first);
        }
        if (plane_open(&plane, rig, p)) {
            compare(rig, &plane, first, surface, result);
        }
    }
}

static void print_table(const struct result *result)
{
    for (int surface = 0; surface < OPAQUE; surface++) {
        printf("#   %-25s", surfaces[surface].name);
        for (int bin = 0; bin < SLOPES; bin++) {
            printf("  %6.2f %8.2g", result->worst[surface][bin], result->distance[surface][bin]);
        }
        printf("\n");
    }
}

static void every_slope_is_right_and_the_same_on_all_surfaces(void **state)
{
    static const struct lens lenses[] = {{.5, 100}, {.1, 1000}, {1, 3}};
    static const struct {
        const char *name;
        const struct ph_depth_format *format;
        uint8_t exponent;
        double worst, beyond; /* codes off the plane and beyond the range of the corners: see depth.h */
    } bounds[] = {{"fixed16", PH_DEPTH_FIXED16, 0, 3, 4},        {"float16", PH_DEPTH_FLOAT16, 4, 3, 4},
                  {"fixed24", PH_DEPTH_FIXED24, 0, 2, 1024},     {"float24", PH_DEPTH_FLOAT24, 4, 8, 1024},
                  {"linear-w", PH_DEPTH_LINEAR_W, 0, 1, 4},      {"float16-e3", PH_DEPTH_FLOAT16, 3, 6, 8},
                  {"float16-e5", PH_DEPTH_FLOAT16, 5, 3, 4},     {"float16-e6", PH_DEPTH_FLOAT16, 6, 3, 4},
                  {"float24-e3", PH_DEPTH_FLOAT24, 3, 16, 2048}, {"float24-e5", PH_DEPTH_FLOAT24, 5, 8, 1024},
                  {"float24-e6", PH_DEPTH_FLOAT24, 6, 8, 1024}};
    int wrong = 0;
    (void)state;
    printf(
        "# codes off the exact plane, and that and half a code as a share of the distance, by the slope of d: up to\n"
        "# 1/4096, 1/256, 1/16, 1, and more than 1 of its range a pixel\n");
    ref_seed(13);
    for (size_t i = 0; i < sizeof bounds / sizeof bounds[0]; i++) {
        struct rig rig;
        struct result result = {0};
        rig_open(&rig, WIDTH, HEIGHT, 16, bounds[i].format, 3, 300); /* room for rows of cut-outs */
        rig.r.config.depth_exponent = bounds[i].exponent;
        for (int n = 0; n < TRIANGLES; n++) {
            static void (*const kinds[3])(const struct lens *lens,
                                          struct fx_vec3 p[3]) = {random_triangle, random_sliver, tilted_triangle};
            const struct lens *lens = &lenses[n / 3 % 3];
            struct fx_vec3 p[3];
            kinds[n % 3](lens, p);
            compare_surfaces(&rig, lens, p, n % ALL_OF == 0 ? OPAQUE : OFTEN, &result);
        }
        printf("# %s: %ld pixels, %.2f codes beyond the corners, %ld unlike\n", bounds[i].name, result.pixels,
               result.beyond, result.unlike);
        print_table(&result);
        for (int at = 0; at < OPAQUE * SLOPES; at++) {
            wrong += result.worst[at / SLOPES][at % SLOPES] > bounds[i].worst;
        }
        wrong += result.beyond > bounds[i].beyond || result.unlike > 0;
        rig_close(&rig);
    }
    assert_int_equal(wrong, 0);
}

/* ---- the slope's bias ---------------------------------------------------------------------------------------------
 */

/* Codes that a lifted triangle is off what scene.h says, at centres within its corners. Where it reaches into a nearer
 * octave of a float it may be lifted as in its own octave, by up to twice as many codes. */
static double off_lifted(const struct rig *rig, const struct plane *plane, uint32_t slope)
{
    const bool is_linear = rig->r.stats.depth_format->coding == PH_DEPTH_IS_LINEAR;
    const double by = fmin(plane_slope(plane) * slope / 16, plane->high - plane->low);
    const double room = fmin(255 - 16, 65535 - code_exact(rig, plane->high)); /* linear-w: 16 of the bias are its own */
    const double far = fmin(code_exact(rig, plane->low + by) - code_exact(rig, plane->low), room);
    double worst = 0;
    for (int at = 0; at < WIDTH * HEIGHT; at++) {
        bool outside;
        const double over_w = rig->depth[at] != 0 ? plane_at(plane, at % WIDTH, at / WIDTH, &outside) : 0;
        if (rig->depth[at] == 0 || outside) {
            continue;
        }
        const double before = code_exact(rig, over_w), code = rig->depth[at] + .5;
        const double in_d = code_exact(rig, over_w + by) - before, step = over_w * 1e-6;
        const double in_codes = by / step * (code_exact(rig, over_w + step) - before);
        const double least = is_linear ? floor(far) : fmin(in_d, in_codes);
        const double most = is_linear ? ceil(far) : fmax(in_d, in_codes);
        worst = fmax(worst, fmax(before + least - code, code - before - most));
    }
    return worst;
}

/* Also in every shading alike: what takes the small triangle's way, the general one or 64 bits. */
static void a_slope_lifts_as_it_says_on_all_surfaces(void **state)
{
    static const struct {
        const struct ph_depth_format *format;
        uint8_t exponent;
        double worst;
    } bounds[] = {{PH_DEPTH_FIXED16, 0, 4}, {PH_DEPTH_FLOAT16, 4, 4},  {PH_DEPTH_FLOAT16, 6, 4},
                  {PH_DEPTH_FIXED24, 0, 4}, {PH_DEPTH_FLOAT24, 4, 16}, {PH_DEPTH_LINEAR_W, 0, 3}};
    static uint16_t ramp[PH_RAMP_SIZE];
    static uint32_t first[WIDTH * HEIGHT];
    int wrong = 0;
    (void)state;
    ref_seed(17);
    for (size_t i = 0; i < sizeof bounds / sizeof bounds[0]; i++) {
        struct rig rig;
        double worst = 0;
        long unlike = 0, lifted = 0;
        rig_open(&rig, WIDTH, HEIGHT, 16, bounds[i].format, 3, 300);
        rig.r.config.depth_exponent = bounds[i].exponent;
        for (int n = 0; n < TRIANGLES / 4; n++) {
            static void (*const kinds[3])(const struct lens *lens,
                                          struct fx_vec3 p[3]) = {random_triangle, random_sliver, tilted_triangle};
            const struct lens lens = {.5, 100};
            const uint8_t slope = (const uint8_t[]){2, 16, 255}[n / 3 % 3]; /* 255: beyond an octave */
            struct fx_vec3 p[3];
            kinds[n % 3](&lens, p);
            for (int surface = 0; surface < OPAQUE; surface++) {
                struct ph_material material = material_of(&surfaces[surface], ramp, 1);
                struct plane plane;
                material.depth_bias_slope = slope;
                begin(&rig, &lens, &surfaces[surface]);
                draw_polygon(&rig, p, 3, &surfaces[surface], &material);
                assert_true(rig_finish(&rig));
                unlike += surface > 0 && memcmp(first, rig.depth, sizeof first) != 0;
                memcpy(first, rig.depth, sizeof first);
                /* below the near plane's head room */
                if (surface == 0 && plane_open(&plane, &rig, p) && 2 * plane.high - plane.low < .98) {
                    /* a gradient may be a quarter of a code off, and the lift is so many sixteenths of it */
                    worst = fmax(worst, off_lifted(&rig, &plane, slope) - slope / 64.);
                    lifted++;
                }
            }
        }
        printf("# %s-e%d: %.2f codes off a plane that a slope lifts, %ld triangles; %ld unlike\n",
               bounds[i].format->name, bounds[i].exponent, worst, lifted, unlike);
        wrong += worst > bounds[i].worst || unlike > 0 || lifted < TRIANGLES / 8;
        rig_close(&rig);
    }
    assert_int_equal(wrong, 0);
}

/* About as wide as a small triangle can be, 32 px, with any corner as its first. */
static void triangle_of_32_px(const struct lens *lens, struct fx_vec3 p[3])
{
    const double w = lens->near_z * pow(lens->far_z / lens->near_z, ref_uniform(.02, .98)), lean = ref_uniform(-.1, .1);
    const double left = ref_uniform(0, WIDTH - 36), right = left + ref_uniform(30.5, 32), y = ref_uniform(0, HEIGHT);
    const double xs[3] = {left, right, ref_uniform(left, right)};
    const int first = (int)ref_uniform(0, 3);
    for (int i = 0; i < 3; i++) {
        const double x = xs[(i + first) % 3];
        p[i] = point_at(x, y + ref_uniform(-15, 15), w * (1 + lean * (x - left) / 32));
    }
}

/* Clamped textures had lost the last column of such triangles. */
static void triangles_of_32_px_are_whole_on_all_surfaces(void **state)
{
    static const struct lens lens = {.5, 100};
    static const struct ph_depth_format *const formats[] = {PH_DEPTH_FIXED16, PH_DEPTH_FLOAT16};
    struct result result = {0};
    (void)state;
    ref_seed(15);
    for (int i = 0; i < 2; i++) {
        struct rig rig;
        rig_open(&rig, WIDTH, HEIGHT, 16, formats[i], 3, 300);
        for (int n = 0; n < 400; n++) {
            struct fx_vec3 p[3];
            triangle_of_32_px(&lens, p);
            compare_surfaces(&rig, &lens, p, OPAQUE, &result);
        }
        rig_close(&rig);
    }
    assert_true(result.pixels > 1000000);
    assert_int_equal(result.unlike, 0);
}

/* Two small triangles just before the far plane, across two octaves: there a unit of the block's d is many units of a
 * code. And a Gouraud triangle whose first rows are left of the picture, where d of column 0 wraps. */
static void triangles_that_once_were_codes_off_are_right(void **state)
{
    static const struct {
        struct lens lens;
        uint8_t exponent;
        double worst;
        struct fx_vec3 p[3];
    } cases[] = {
        {{1, 3}, 3, 6, {{-46203, 63042, -182508}, {-72460, 55441, -193417}, {-50715, 57374, -182869}}},
        {{1, 3}, 5, 3, {{65976, 44189, -196181}, {57807, 49251, -196207}, {109833, 20406, -196349}}},
        {{.5, 100}, 3, 6, {{-53563, -13512, -60130}, {-22221, -55781, -79804}, {534, -31120, -35147}}},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct rig rig;
        struct result result = {0};
        rig_open(&rig, WIDTH, HEIGHT, 16, PH_DEPTH_FLOAT16, 3, 300);
        rig.r.config.depth_exponent = cases[i].exponent;
        compare_surfaces(&rig, &cases[i].lens, cases[i].p, OPAQUE, &result);
        assert_true(result.pixels > 0);
        assert_int_equal(result.unlike, 0);
        for (int at = 0; at < OPAQUE * SLOPES; at++) {
            assert_true(result.worst[at / SLOPES][at % SLOPES] <= cases[i].worst);
        }
        rig_close(&rig);
    }
}

/* ---- other cameras ------------------------------------------------------------------------------------------------
 */

enum view { FRUSTUM, PARALLEL, FISHEYE, VIEWS };

static void project(struct ph_projection *projection, enum view view, const struct lens *lens)
{
    const fx_t near_z = ref_q16(lens->near_z), far_z = ref_q16(lens->far_z);
    const double high = lens->near_z / sqrt(3), wide = high * WIDTH / HEIGHT;
    const int status = view == FRUSTUM    ? ph_projection_frustum(projection, ref_q16(-.5 * wide), ref_q16(2 * wide),
                                                                  ref_q16(-1.7 * high), ref_q16(.4 * high), near_z, far_z)
                       : view == PARALLEL ? ph_projection_ortho(projection, FX_INT(-4), FX_INT(4), FX_INT(-3),
                                                                FX_INT(3), near_z, far_z)
                                          : ph_projection_fisheye(projection, FX_INT(170), near_z, far_z);
    assert_int_equal(status, PH_OK);
}

/* Any size, and one corner in three may lie behind the eye. */
static void any_triangle(enum view view, const struct lens *lens, struct fx_vec3 p[3])
{
    const double size = pow(2, ref_uniform(-7, 3)), steep = pow(2, ref_uniform(-12, 1)), middle = ref_uniform(0, 1);
    const double x = ref_uniform(-1, 1), y = ref_uniform(-1, 1);
    for (int i = 0; i < 3; i++) {
        const double share = middle + ref_uniform(-.5, .5) * steep, sign = ref_uniform(0, 1) < .3 ? -1 : 1;
        const double range = lens->far_z - lens->near_z;
        const double w = view == PARALLEL ? lens->near_z + range * share
                                          : lens->near_z * pow(lens->far_z / lens->near_z, fmin(share, 1.5)) * sign;
        const double across = view == PARALLEL ? 4 : fabs(w);
        p[i].x = ref_q16((x + ref_uniform(-.5, .5) * size) * across);
        p[i].y = ref_q16((y + ref_uniform(-.5, .5) * size) * across);
        p[i].z = -ref_q16(fmax(fmin(w, 20000), -20000));
    }
}

static bool run_here(void (*run)(void *argument), void *argument)
{
    run(argument);
    return true;
}

static void join_here(void)
{
}

/* Draws a triangle in bands of so many lines, and with two cores or one. Returns in how many pixels some surface has
 * another depth than the first, which is given if it is drawn already. */
static int unlike_pixels(struct rig *rig, const struct ph_projection *projection, const struct fx_vec3 p[3],
                         uint32_t *first, bool is_given)
{
    static uint16_t ramp[PH_RAMP_SIZE];
    int unlike = 0;
    for (int surface = 0; surface < OPAQUE; surface++) {
        const struct ph_material material = material_of(&surfaces[surface], ramp, 1);
        begin_with(rig, projection, &surfaces[surface]);
        draw_polygon(rig, p, 3, &surfaces[surface], &material);
        assert_true(rig_finish(rig));
        assert_int_equal(rig->r.stats.triangles_dropped, 0);
        if (surface == 0 && !is_given) {
            memcpy(first, rig->depth, WIDTH * HEIGHT * sizeof *first);
        }
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            unlike += rig->depth[i] != first[i];
        }
    }
    return unlike;
}

static void open_views(struct rig rigs[2], const struct ph_depth_format *format, int exponent)
{
    for (int i = 0; i < 2; i++) {
        rig_open(&rigs[i], WIDTH, HEIGHT, i == 0 ? 16 : 1, format, 6000, 6000);
        struct ph_config config = rigs[i].r.config;
        config.depth_exponent = (uint8_t)exponent;
        config.cores = PH_TWO_CORES;
        config.other_core = i == 0 ? NULL : run_here;
        config.other_core_join = i == 0 ? NULL : join_here;
        assert_int_equal(ph_renderer_init(&rigs[i].r, &config), PH_OK);
    }
}

/* Parallel, off the axis, through a fisheye; clipped at the near and the far plane. */
static void other_cameras_have_one_depth_on_all_surfaces_too(void **state)
{
    static const struct lens lenses[] = {{.5, 100}, {1, 3}, {.1, 1000}, {20, 21}};
    static const int exponents[PH_DEPTH_FORMATS][3] = {[2] = {3, 5, 6}, [4] = {3, 4, 6}}; /* of float16 and float24 */
    static uint32_t first[WIDTH * HEIGHT];
    int unlike = 0;
    (void)state;
    ref_seed(14);
    for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
        const struct ph_depth_format *const format = ph_depth_formats[f];
        for (int n = 0; n < 24; n++) {
            const enum view view = (enum view)(n % VIEWS);
            struct ph_projection projection;
            struct fx_vec3 p[3];
            struct rig rigs[2];
            open_views(rigs, format, exponents[f][n % 8 % 3]);
            project(&projection, view, &lenses[n % 4]);
            any_triangle(view, &lenses[n % 4], p);
            unlike += unlike_pixels(&rigs[0], &projection, p, first, false);
            unlike += unlike_pixels(&rigs[1], &projection, p, first, true);
            rig_close(&rigs[0]);
            rig_close(&rigs[1]);
        }
    }
    assert_int_equal(unlike, 0);
}

/* Tiles of texture in which d changes by 2^31 and more, or crosses from 3/4 into another octave: these had codes some
 * octaves off. */
static void steep_textures_have_the_depth_of_other_surfaces(void **state)
{
    static const struct {
        struct lens lens;
        int exponent;
        struct fx_vec3 p[3];
    } cases[] = {
        {{1, 3}, 6, {{-694526, 336900, 41374}, {-508140, 242768, -160482}, {417223, -170679, -160466}}},
        {{1, 3}, 5, {{226970, -110739, -173304}, {31185, 128425, 20040}, {-596469, -72590, -168521}}},
        {{.5, 100}, 4, {{93169, -53232, -4194513}, {16943, 9730, 1440660}, {-183544, -115765, 897688}}},
    };
    static uint32_t first[WIDTH * HEIGHT];
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct ph_projection projection;
        struct rig rigs[2];
        int drawn = 0;
        open_views(rigs, PH_DEPTH_FLOAT16, cases[i].exponent);
        project(&projection, PARALLEL, &cases[i].lens);
        assert_int_equal(unlike_pixels(&rigs[0], &projection, cases[i].p, first, false), 0);
        for (int at = 0; at < WIDTH * HEIGHT; at++) {
            drawn += first[at] != 0;
        }
        assert_true(drawn > 100);
        rig_close(&rigs[0]);
        rig_close(&rigs[1]);
    }
}

/* ---- a demo -------------------------------------------------------------------------------------------------------
 */

/* What was found in all triangles of some frames. */
struct found {
    long triangles, across, pixels; /* across: their depth crosses octaves of a float */
    double worst;                   /* codes off the exact plane */
};

/* Draws a triangle that is set up alone, and compares. */
static void compare_alone(const struct rig *rig, const struct ph_triangle *t, const struct plane *plane,
                          struct found *found)
{
    static uint16_t pixels[WIDTH * HEIGHT], depth16[WIDTH * HEIGHT];
    static uint32_t depth24[WIDTH * HEIGHT];
    const bool is_24 = ph_depth_bytes(rig->r.stats.depth_format) == 4;
    const struct ph_band band = {
        pixels, is_24 ? (void *)depth24 : depth16, is_24, WIDTH, 0, HEIGHT, WIDTH, NULL, ph_depth_ways(&rig->r), NULL};
    memset(depth16, 0, sizeof depth16);
    memset(depth24, 0, sizeof depth24);
    found->pixels += ph_draw_triangle(t, &band);
    found->triangles++;
    found->across += t->block != PH_BLOCK_NONE || t->kind == PH_KIND_SMALL_KNEE;
    for (int at = ph_max(t->y_top, 0) * WIDTH; at < ph_min(t->y_bottom, HEIGHT) * WIDTH; at++) {
        const uint32_t code = is_24 ? depth24[at] : depth16[at];
        bool outside;
        const double over_w = code != 0 ? plane_at(plane, at % WIDTH, at / WIDTH, &outside) : 0;
        if (code != 0 && !outside) {
            found->worst = fmax(found->worst, fabs(code + .5 - code_exact(rig, over_w)));
        }
    }
}

/* Compares the triangle of a reference. The N/w of its corners are those of the vertices: make proof bounds what these
 * are off. */
static void compare_reference(const struct rig *rig, const struct ph_draw *draw, uint32_t number, struct found *found)
{
    const struct ph_ref *const ref = ph_ref_at(&rig->r, number);
    const uint8_t *const base = ph_at(&rig->r, draw->base);
    const size_t size = (draw->kind & PH_DRAW_UVS) != 0 ? sizeof(struct ph_corner) : sizeof(struct ph_vertex);
    struct plane plane;
    struct ph_triangle t;
    for (int i = 0; i < 3; i++) {
        memcpy(&plane.v[i], base + ref->corner[i] * size, sizeof plane.v[i]);
        plane.over_w[i] = (int128)plane.v[i].q << 32 >> plane.v[i].s >> 6;
    }
    plane.area = cross(plane.v[1].x - plane.v[0].x, plane.v[1].y - plane.v[0].y, plane.v[2].x - plane.v[0].x,
                       plane.v[2].y - plane.v[0].y);
    ph_setup_number(&rig->r, number, &t);
    compare_alone(rig, &t, &plane, found);
}

static void every_triangle_of_turntable_is_right(void **state)
{
    static const struct {
        const struct ph_depth_format *format;
        uint8_t exponent;
        double worst; /* of depth.h */
    } bounds[] = {{PH_DEPTH_FIXED16, 0, 3}, {PH_DEPTH_FLOAT16, 3, 6}, {PH_DEPTH_FLOAT16, 4, 3},
                  {PH_DEPTH_FLOAT16, 5, 3}, {PH_DEPTH_FIXED24, 0, 2}, {PH_DEPTH_FLOAT24, 3, 16},
                  {PH_DEPTH_FLOAT24, 4, 8}};
    const struct demo *const demo = demo_find("turntable");
    (void)state;
    for (size_t i = 0; i < sizeof bounds / sizeof bounds[0]; i++) {
        struct demo_stage s = demo_stage_open(demo, WIDTH, HEIGHT);
        struct found found = {0, 0, 0, 0};
        s.rig.r.config.depth_format = bounds[i].format;
        s.rig.r.config.depth_exponent = bounds[i].exponent;
        for (uint32_t frame = 0; frame < 256; frame += 16) {
            assert_int_equal(demo->frame(&s.context, &s.rig.r, frame), PH_OK);
            const struct ph_renderer *const r = &s.rig.r;
            const struct ph_draw *draw = ph_at(r, r->list.first);
            for (uint32_t number = 0; number < ph_ref_count(r); number++) {
                while (draw->next != PH_NONE && ((const struct ph_draw *)ph_at(r, draw->next))->first <= number) {
                    draw = ph_at(r, draw->next);
                }
                compare_reference(&s.rig, draw, number, &found);
            }
        }
        printf("# turntable, %s-e%d: %.2f codes off in %ld pixels of %ld triangles, of which %ld cross octaves\n",
               bounds[i].format->name, bounds[i].exponent, found.worst, found.pixels, found.triangles, found.across);
        assert_true(found.triangles > 10000);
        assert_true(found.pixels > 100000);
        assert_true(bounds[i].exponent == 0 || found.across > 100);
        assert_true(found.worst <= bounds[i].worst);
        demo_stage_close(&s);
    }
}

/* ---- floors and walls ---------------------------------------------------------------------------------------------
 */

/* Pixels in which a floor more than `margin` metres behind a wall covers it. The eye is 1.6 m above the floor. */
static int floor_before_wall(const struct ph_depth_format *format, const struct lens *lens, double from, double to,
                             double wall, double margin)
{
    enum { SIDE = 240, FLOOR = 1, WALL = 2 };
    const double wide = 2 * wall;
    const struct fx_vec3 floor[4] = {{ref_q16(-wide), ref_q16(-1.6), ref_q16(-from)},
                                     {ref_q16(wide), ref_q16(-1.6), ref_q16(-from)},
                                     {ref_q16(wide), ref_q16(-1.6), ref_q16(-to)},
                                     {ref_q16(-wide), ref_q16(-1.6), ref_q16(-to)}};
    const struct fx_vec3 face[4] = {{ref_q16(-wide), ref_q16(-3), ref_q16(-wall)},
                                    {ref_q16(wide), ref_q16(-3), ref_q16(-wall)},
                                    {ref_q16(wide), ref_q16(3), ref_q16(-wall)},
                                    {ref_q16(-wide), ref_q16(3), ref_q16(-wall)}};
    const struct ph_material materials[2] = {material_of(&surfaces[0], NULL, FLOOR),
                                             material_of(&surfaces[0], NULL, WALL)};
    struct rig rig;
    int wrong = 0;
    rig_open(&rig, SIDE, SIDE, 16, format, 4, 16);
    begin(&rig, lens, &surfaces[0]);
    draw_polygon(&rig, floor, 4, &surfaces[0], &materials[0]);
    draw_polygon(&rig, face, 4, &surfaces[0], &materials[1]);
    assert_true(rig_finish(&rig));
    for (int y = SIDE / 2; y < SIDE; y++) {
        const double distance = 1.6 * (SIDE / 2. * sqrt(3)) / (y + .5 - SIDE / 2.);
        for (int x = 0; x < SIDE && distance > wall + margin && distance < to; x++) {
            wrong += rig.pixels[y * SIDE + x] == FLOOR;
        }
    }
    rig_close(&rig);
    return wrong;
}

static void no_floor_covers_a_wall_in_front_of_it(void **state)
{
    (void)state;
    for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
        const struct ph_depth_format *const format = ph_depth_formats[f];
        assert_int_equal(floor_before_wall(format, &(struct lens){.5, 100}, 60, 80, 66.67, 1), 0);
        if (format != PH_DEPTH_FIXED16) { /* which cannot tell these distances apart: see depth.h */
            assert_int_equal(floor_before_wall(format, &(struct lens){.1, 1000}, 30, 1000, 60, 2), 0);
        }
        for (int tile = 0; tile < 15; tile++) {
            const double from = 5 + 5. * tile;
            assert_int_equal(floor_before_wall(format, &(struct lens){.5, 100}, from, from + 20, from + 8, .5), 0);
        }
    }
}

/* ---- decals -------------------------------------------------------------------------------------------------------
 */

enum { GROUND = 1, DECAL = 2, BOX = 3 };

/* A floor seen at a grazing angle, a decal in its plane whose corners are none of the floor's, and a box that hides a
 * part of both. Counts the pixels of the decal that do not show, and those of the box that the decal covers. */
static void decal_on_floor(const struct ph_depth_format *format, uint8_t slope, const struct ph_shading *shading,
                           int *hidden, int *shown, int *through)
{
    enum { SIDE = 240 };
    const struct lens lens = {.5, 100};
    static const double floor[4][3] = {{-40, -1.6, -2}, {40, -1.6, -2}, {60, -1.6, -90}, {-60, -1.6, -90}};
    static const double decal[4][3] = {{-3.1, -1.6, -7.3}, {2.7, -1.6, -6.9}, {9.3, -1.6, -61}, {-8.7, -1.6, -57}};
    static const double box[4][3] = {{-.5, -1, -6}, {.5, -1, -6}, {.5, 1, -6}, {-.5, 1, -6}};
    static const uint16_t decal_texel[1] = {DECAL};
    static const struct ph_texture texture = {.texels = decal_texel};
    struct fx_vec3 p[3][4];
    struct ph_material materials[3];
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) {
            const double *const from = k == 0 ? floor[i] : k == 1 ? decal[i] : box[i];
            p[k][i] = (struct fx_vec3){ref_q16(from[0]), ref_q16(from[1]), ref_q16(from[2])};
        }
    }
    for (int k = 0; k < 3; k++) {
        materials[k] = material_of(&surfaces[0], NULL, (uint16_t)(GROUND + k));
    }
    materials[1].shading = shading;
    materials[1].texture = &texture;
    materials[1].depth_bias_slope = slope;
    static uint16_t alone[SIDE * SIDE];
    for (int pass = 0; pass < 2; pass++) {
        struct rig rig;
        rig_open(&rig, SIDE, SIDE, 16, format, 4, 16);
        begin(&rig, &lens, &surfaces[0]);
        for (int k = pass == 0 ? 1 : 0; k < (pass == 0 ? 2 : 3); k++) {
            draw_polygon(&rig, p[k == 1 ? 1 : k], 4, &surfaces[0], &materials[k]);
        }
        assert_true(rig_finish(&rig));
        for (int i = 0; i < SIDE * SIDE && pass == 1; i++) {
            *shown += alone[i] == DECAL && rig.pixels[i] == DECAL;
            *hidden += alone[i] == DECAL && rig.pixels[i] == GROUND;
        }
        memcpy(alone, rig.pixels, sizeof alone);
        rig_close(&rig);
    }
    struct rig rig; /* the box alone: all of its pixels are before the decal */
    rig_open(&rig, SIDE, SIDE, 16, format, 4, 16);
    begin(&rig, &lens, &surfaces[0]);
    draw_polygon(&rig, p[2], 4, &surfaces[0], &materials[2]);
    assert_true(rig_finish(&rig));
    for (int i = 0; i < SIDE * SIDE; i++) {
        *through += rig.pixels[i] == BOX && alone[i] != BOX;
    }
    rig_close(&rig);
}

static void a_decal_lies_on_a_surface_that_leans_away(void **state)
{
    static const struct ph_shading *const shadings[] = {PH_SHADE_UNLIT, PH_SHADE_TEXTURE};
    (void)state;
    for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
        const struct ph_depth_format *const format = ph_depth_formats[f];
        for (int i = 0; i < 2; i++) {
            int hidden = 0, shown = 0, through = 0, fought = 0;
            decal_on_floor(format, 0, shadings[i], &fought, &shown, &through);
            assert_true(fought > 100);
            shown = through = 0;
            decal_on_floor(format, 2, shadings[i], &hidden, &shown, &through);
            printf("# %s, shading %s: %d pixels of a decal lie below the floor, with the slope's bias %d, of %d; "
                   "%d before a box\n",
                   format->name, i == 0 ? "unlit" : "texture", fought, hidden, shown, through);
            assert_int_equal(hidden, 0);
            assert_int_equal(through, 0);
            assert_true(shown > 1000);
        }
    }
}

/* ---- a sphere drawn twice -----------------------------------------------------------------------------------------
 */

enum { SEGMENTS = 24, RINGS = 12, CORNERS = (RINGS + 1) * (SEGMENTS + 1), FACES = 2 * RINGS * SEGMENTS };

struct sphere {
    struct fx_vec3 positions[CORNERS];
    int16_t normals[CORNERS][3];
    fx_t uvs[CORNERS][2];
    uint16_t faces[FACES][3];
};

static void sphere_build(struct sphere *s)
{
    for (int j = 0; j <= RINGS; j++) {
        for (int i = 0; i <= SEGMENTS; i++) {
            const double u = 2 * acos(-1) * i / SEGMENTS, v = acos(-1) * j / RINGS;
            const double n[3] = {sin(v) * sin(u), cos(v), sin(v) * cos(u)};
            const int at = j * (SEGMENTS + 1) + i;
            s->positions[at] = (struct fx_vec3){ref_q16(n[0]), ref_q16(n[1]), ref_q16(n[2] - 3)};
            for (int k = 0; k < 3; k++) {
                s->normals[at][k] = (int16_t)lrint(16384 * n[k]);
            }
            s->uvs[at][0] = ref_q16((double)i / SEGMENTS);
            s->uvs[at][1] = ref_q16((double)j / RINGS);
        }
    }
    for (int f = 0; f < FACES / 2; f++) {
        const int a = f / SEGMENTS * (SEGMENTS + 1) + f % SEGMENTS, b = a + SEGMENTS + 1;
        const uint16_t quad[2][3] = {{(uint16_t)a, (uint16_t)b, (uint16_t)(b + 1)},
                                     {(uint16_t)a, (uint16_t)(b + 1), (uint16_t)(a + 1)}};
        memcpy(s->faces[2 * f], quad, sizeof quad);
    }
}

/* Draws the sphere with the first surface, dark, and over it with the second one, bright, if there is one. */
static void draw_spheres(struct rig *rig, const struct sphere *s, const struct surface *second)
{
    static uint16_t dark[PH_RAMP_SIZE], bright[PH_RAMP_SIZE], colours[CORNERS];
    const struct ph_part part = {0, FACES, 0};
    struct ph_mesh mesh = {.positions = s->positions,
                           .normals = s->normals,
                           .uvs = s->uvs,
                           .vertex_count = CORNERS,
                           .triangles = s->faces,
                           .triangle_count = FACES,
                           .parts = &part,
                           .part_count = 1};
    for (int i = 0; i < PH_RAMP_SIZE; i++) {
        dark[i] = 0x1000;
        bright[i] = 0x2000;
    }
    const struct ph_material materials[2] = {material_of(&surfaces[2], dark, 0x1000),
                                             material_of(second != NULL ? second : &surfaces[0], bright, 0x2000)};
    begin(rig, &(struct lens){.5, 100}, &surfaces[0]);
    mesh.materials = &materials[0];
    assert_int_equal(ph_draw_mesh(&rig->r, &mesh, &ph_xform_identity), PH_OK);
    mesh.materials = &materials[1];
    mesh.colours = second != NULL && second->coloured ? colours : NULL;
    if (second != NULL) {
        assert_int_equal(ph_draw_mesh(&rig->r, &mesh, &ph_xform_identity), PH_OK);
    }
    assert_true(rig_finish(rig));
    assert_int_equal(rig->r.stats.triangles_dropped, 0);
}

static void draw_twice(const struct sphere *s, const struct ph_depth_format *format, bool antialiased)
{
    static uint16_t alone[WIDTH * HEIGHT], samples[4 * WIDTH * 16];
    static uint32_t samples_depth[4 * WIDTH * 16];
    struct rig rig;
    rig_open(&rig, WIDTH, HEIGHT, 16, format, CORNERS, 4 * FACES);
    struct ph_config config = rig.r.config;
    config.samples = antialiased ? samples : NULL;
    config.antialiasing = PH_ANTIALIAS_2X2;
    config.depth = antialiased ? samples_depth : config.depth;
    assert_int_equal(ph_renderer_init(&rig.r, &config), PH_OK);
    draw_spheres(&rig, s, NULL);
    memcpy(alone, rig.pixels, sizeof alone);
    for (int second = 0; second < SURFACES; second++) {
        int shown = 0, drawn = 0;
        draw_spheres(&rig, s, &surfaces[second]);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            drawn += alone[i] != 0;
            shown += rig.pixels[i] != alone[i];
        }
        assert_true(drawn > 2000);
        if (shown != 0) {
            printf("# %s, %s: %d of %d\n", format->name, surfaces[second].name, shown, drawn);
        }
        assert_int_equal(shown, 0);
    }
    rig_close(&rig);
}

static void of_a_sphere_drawn_twice_only_the_first_shows(void **state)
{
    static struct sphere s;
    (void)state;
    sphere_build(&s);
    for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
        const struct ph_depth_format *const format = ph_depth_formats[f];
        draw_twice(&s, format, false);
        draw_twice(&s, format, true);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_slope_is_right_and_the_same_on_all_surfaces),
        cmocka_unit_test(a_slope_lifts_as_it_says_on_all_surfaces),
        cmocka_unit_test(triangles_of_32_px_are_whole_on_all_surfaces),
        cmocka_unit_test(triangles_that_once_were_codes_off_are_right),
        cmocka_unit_test(other_cameras_have_one_depth_on_all_surfaces_too),
        cmocka_unit_test(steep_textures_have_the_depth_of_other_surfaces),
        cmocka_unit_test(every_triangle_of_turntable_is_right),
        cmocka_unit_test(no_floor_covers_a_wall_in_front_of_it),
        cmocka_unit_test(a_decal_lies_on_a_surface_that_leans_away),
        cmocka_unit_test(of_a_sphere_drawn_twice_only_the_first_shows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
