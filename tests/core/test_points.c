/*
 * Points against a reference in double precision: where they lie, how large they are, which pixel centres lie inside
 * them, and which of them is in front follow from the definitions in render.h and geom.h alone.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_random.h"
#include "ref_rig.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { W = 96, H = 72, POINTS = 60, FIRST = 1 };

#define PI     3.14159265358979323846
#define NEAR_Z 1.
#define FAR_Z  40.
#define WALL_Z 8. /* a wall that covers the right half of a picture in perspective */

enum lens { PERSPECTIVE, ORTHOGRAPHIC, FISHEYE, LENSES };

/* Points that stand in view space, and how they are drawn. */
struct cloud {
    enum lens lens;
    bool in_world, round, own_sizes, own_colours;
    struct fx_vec3 positions[POINTS];
    fx_t sizes[POINTS], size;
    uint16_t colours[POINTS];
};

static uint16_t colour_of(const struct cloud *c, int i)
{
    return c->own_colours ? c->colours[i] : 0xffff;
}

static double number(fx_t v)
{
    return v / 65536.;
}

static struct ph_projection projection_of(enum lens lens)
{
    struct ph_projection p;
    const int status =
        lens == PERSPECTIVE ? ph_projection_perspective(&p, FX_INT(60), FX_ONE * W / H, ref_q16(NEAR_Z), ref_q16(FAR_Z))
        : lens == ORTHOGRAPHIC
            ? ph_projection_ortho(&p, FX_INT(-8), FX_INT(8), FX_INT(-6), FX_INT(6), ref_q16(NEAR_Z), ref_q16(FAR_Z))
            : ph_projection_fisheye(&p, FX_INT(60), ref_q16(NEAR_Z), ref_q16(FAR_Z));
    assert_int_equal(status, PH_OK);
    return p;
}

static void any_cloud(struct cloud *c, int n)
{
    static const enum lens lenses[4] = {PERSPECTIVE, ORTHOGRAPHIC, FISHEYE, PERSPECTIVE};
    c->lens = lenses[n % 4];
    c->in_world = n / 4 % 2 != 0;
    c->round = n / 8 % 2 != 0;
    c->own_sizes = n / 16 % 2 != 0;
    c->own_colours = true;
    c->size = ref_q16(c->in_world ? ref_uniform(.01, 1.5) : ref_uniform(.2, n % 3 == 0 ? 1 : 12));
    for (int i = 0; i < POINTS; i++) {
        const double z = i % 5 == 0 ? ref_uniform(.5, 1.5) : ref_uniform(NEAR_Z, FAR_Z * 1.05);
        const double far = c->lens == ORTHOGRAPHIC ? 9 : c->lens == FISHEYE ? 1.2 * z : .9 * z;
        c->positions[i] =
            (struct fx_vec3){ref_q16(ref_uniform(-far, far)), ref_q16(ref_uniform(-far, far)), ref_q16(-z)};
        c->sizes[i] = ref_q16(c->in_world ? ref_uniform(-.1, 3) : ref_uniform(-1, 9));
        c->colours[i] = (uint16_t)(FIRST + i * 911);
    }
}

static const struct ph_material white = {.colour = 0xffff};

static void draw_cloud(struct ph_renderer *r, const struct cloud *c, const struct ph_material *material)
{
    const struct ph_points points = {.positions = c->positions,
                                     .colours = c->own_colours ? c->colours : NULL,
                                     .sizes = c->own_sizes ? c->sizes : NULL,
                                     .count = POINTS,
                                     .size = c->size,
                                     .in_world = c->in_world,
                                     .round = c->round};
    assert_int_equal(ph_draw_points(r, &points, &ph_xform_identity, material), PH_OK);
}

/* A wall that faces the viewer, at a distance, from x = 0 to the right. */
static void draw_wall(struct ph_renderer *r, double z, const struct ph_material *material)
{
    static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const struct ph_part part = {.count = 2};
    const fx_t x = FX_INT(20), d = ref_q16(-z);
    const struct fx_vec3 corners[4] = {{0, -x, d}, {x, -x, d}, {x, x, d}, {0, x, d}};
    const struct ph_mesh mesh = {.positions = corners,
                                 .triangles = triangles,
                                 .parts = &part,
                                 .materials = material,
                                 .vertex_count = 4,
                                 .triangle_count = 2,
                                 .part_count = 1};
    assert_int_equal(ph_draw_mesh(r, &mesh, &ph_xform_identity), PH_OK);
}

/* ---- the reference ---------------------------------------------------------------------------------------------- */

/* A point on the screen, in pixels; half: of its size, after the least size. */
struct place {
    double x, y, half, distance;
    bool is_seen, is_unsure; /* between near and far plane; too near to one to tell */
};

static struct place place_of(const struct cloud *c, int i)
{
    const double x = number(c->positions[i].x), y = number(c->positions[i].y), z = -number(c->positions[i].z);
    const double size = number(c->own_sizes ? c->sizes[i] : c->size), focal = H / 2 / tan(PI / 6);
    struct place p = {.distance = z};
    double world = 1; /* pixels of a world unit at the point */
    if (c->lens == PERSPECTIVE) {
        world = focal / z;
        p.x = W / 2. + x * world;
        p.y = H / 2. - y * world;
    } else if (c->lens == ORTHOGRAPHIC) {
        world = W / 16.;
        p.x = W / 2. + x * world;
        p.y = H / 2. - y * world;
    } else {
        const double aside = hypot(x, y), radian = H / (60 * PI / 180), angle = atan2(aside, z);
        p.distance = hypot(aside, z);
        world = radian / p.distance;
        p.x = W / 2. + radian * angle * x / aside;
        p.y = H / 2. - radian * angle * y / aside;
    }
    p.half = fmin(fmax(size * (c->in_world ? world : 1), 1), 255) / 2;
    p.is_seen = size > 0 && p.distance >= NEAR_Z && p.distance <= FAR_Z;
    p.is_unsure = size > 0 && (fabs(p.distance - NEAR_Z) < .001 || fabs(p.distance - FAR_Z) < .01);
    return p;
}

/* Whether a pixel's centre lies in a point: 1, 0, or -1 where rounding may decide. */
static int covers(const struct cloud *c, const struct place *p, int column, int row)
{
    const double dx = column + .5 - p->x, dy = row + .5 - p->y, margin = c->lens == FISHEYE ? .06 : .02;
    const bool disc = c->round && p->half > .75;
    const double inside = p->half - (disc ? hypot(dx, dy) : fmax(fabs(dx), fabs(dy)));
    if (c->round && fabs(p->half - .75) < .01) {
        return inside > .5 ? 1 : -1;
    }
    return fabs(inside) < (disc ? margin + 1 / 32. : margin) ? -1 : inside > 0;
}

struct seen {
    int point; /* -1: none */
    bool is_unsure;
    double distance;
};

static struct seen nearest_at(const struct cloud *c, const struct place *places, int column, int row)
{
    struct seen seen = {-1, false, FAR_Z * 2};
    for (int i = 0; i < POINTS; i++) {
        const int covered = places[i].is_seen || places[i].is_unsure ? covers(c, &places[i], column, row) : 0;
        if (covered > 0 && !places[i].is_unsure && places[i].distance < seen.distance) {
            seen.point = i;
            seen.distance = places[i].distance;
        }
    }
    for (int i = 0; i < POINTS; i++) { /* near enough to the nearest, or in front of it and on a border */
        const int covered = places[i].is_seen || places[i].is_unsure ? covers(c, &places[i], column, row) : 0;
        const bool unsure = covered < 0 || (covered > 0 && places[i].is_unsure);
        seen.is_unsure |= unsure && places[i].distance < seen.distance * 1.01;
        seen.is_unsure |= covered > 0 && i != seen.point && fabs(places[i].distance / seen.distance - 1) < .01;
    }
    return seen;
}

/* ---- pixels ----------------------------------------------------------------------------------------------------- */

static void compare(const struct rig *rig, const struct cloud *c, int n, int *compared)
{
    struct place places[POINTS];
    for (int i = 0; i < POINTS; i++) {
        places[i] = place_of(c, i);
    }
    for (int k = 0; k < W * H; k++) {
        const bool behind_wall = c->lens == PERSPECTIVE && k % W >= W / 2;
        struct seen seen = nearest_at(c, places, k % W, k / W);
        if (seen.is_unsure || (behind_wall && fabs(seen.distance - WALL_Z) < .1)) {
            continue;
        }
        const uint16_t want = behind_wall && seen.distance > WALL_Z ? 0x1234
                              : seen.point >= 0                     ? colour_of(c, seen.point)
                                                                    : 0;
        if (rig->pixels[k] != want) {
            fail_msg("cloud %d: pixel %d %d is %04x, not %04x (point %d)", n, k % W, k / W, rig->pixels[k], want,
                     seen.point);
        }
        if (c->lens == PERSPECTIVE && seen.point >= 0 && want != 0x1234) {
            const uint32_t code = rig->depth[k], unit = ph_depth_bytes(rig->r.config.depth_format) == 4 ? 256 : 1;
            assert_true(rig_distance(rig, code + 2 * unit, NEAR_Z, FAR_Z) < seen.distance * 1.00001);
            assert_true(rig_distance(rig, code - 2 * unit, NEAR_Z, FAR_Z) > seen.distance * .99999);
        }
        *compared += seen.point >= 0;
    }
}

static void pixels_are_those_of_the_rule(void **state)
{
    static const struct ph_material wall = {.shading = PH_SHADE_UNLIT, .colour = 0x1234};
    (void)state;
    for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
        struct rig rig;
        int compared = 0;
        ref_seed((uint32_t)f);
        rig_open(&rig, W, H, 16, ph_depth_formats[f], 100, 100);
        for (int n = 0; n < 64; n++) {
            struct cloud c;
            any_cloud(&c, n);
            const struct ph_projection p = projection_of(c.lens);
            assert_int_equal(ph_frame_begin(&rig.r, &ph_xform_identity, &p, NULL, 0), PH_OK);
            draw_cloud(&rig.r, &c, &white);
            if (c.lens == PERSPECTIVE) {
                draw_wall(&rig.r, WALL_Z, &wall);
            }
            assert_true(rig_finish(&rig));
            assert_int_equal(rig.r.stats.vertices_dropped + rig.r.stats.triangles_dropped, 0);
            compare(&rig, &c, n, &compared);
        }
        assert_in_range(compared, 20000, W * H * 64);
        rig_close(&rig);
    }
}

/* Squares of one size that stand side by side share no pixel and leave none out; sizes end at 1 and 255 pixels. */
static void squares_tile_the_picture(void **state)
{
    static const double sizes[4] = {.25, 1, 4, 300}, steps[4] = {1, 1, 4, 255};
    struct rig rig;
    struct ph_projection p;
    (void)state;
    rig_open(&rig, 256, 256, 16, PH_DEPTH_FIXED16, 70000, 100);
    assert_int_equal(ph_projection_ortho(&p, 0, FX_INT(256), 0, FX_INT(256), FX_ONE, FX_INT(9)), PH_OK);
    for (int i = 0; i < 4; i++) {
        for (int shift = 0; shift < 2; shift++) { /* half a step: centres stand on left and upper sides */
            struct fx_vec3 *const at = calloc(64000, sizeof *at);
            struct ph_points points = {.positions = at, .size = ref_q16(sizes[i])};
            for (double y = 0; y < 240; y += steps[i]) {
                for (double x = 0; x < 240; x += steps[i]) {
                    const double add = shift != 0 ? 0 : steps[i] / 2;
                    at[points.count++] = (struct fx_vec3){ref_q16(x + add), ref_q16(256 - y - add), FX_INT(-2)};
                }
            }
            assert_int_equal(ph_frame_begin(&rig.r, &ph_xform_identity, &p, NULL, 0), PH_OK);
            assert_int_equal(ph_draw_points(&rig.r, &points, &ph_xform_identity, &white), PH_OK);
            assert_true(rig_finish(&rig));
            /* from the upper left corner on; shifted by half a step, less the half squares there */
            const int side = (int)(steps[i] * ceil(240 / steps[i])), cut = shift != 0 ? (int)ceil(steps[i] / 2) : 0;
            int drawn = 0;
            for (int k = 0; k < 256 * 256; k++) {
                const bool inside = k % 256 < side - cut && k / 256 < side - cut;
                assert_int_equal(rig.pixels[k] != 0, inside);
                drawn += inside;
            }
            assert_int_equal(rig.r.stats.fragments, drawn);
            free(at);
        }
    }
    rig_close(&rig);
}

/* ---- bands, cores, samples -------------------------------------------------------------------------------------- */

static bool other_core(void (*run)(void *argument), void *argument)
{
    run(argument);
    return true;
}

static void other_core_join(void)
{
}

static const struct ph_blend added = {.draw = ph_draw_blended, .kind = PH_BLEND_ADD, .alpha = 20},
                             mixed = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 12},
                             times = {.draw = ph_draw_blended, .kind = PH_BLEND_TIMES, .alpha = 32};

/* Walls and clouds, opaque and blended, in fog. */
static void draw_scene(struct ph_renderer *r, uint32_t seed)
{
    const struct ph_material materials[6] = {{.colour = 0x1234, .depth_bias = 3},
                                             {.blend = &added},
                                             {.colour = 0x7700, .blend = &mixed},
                                             {.blend = &times},
                                             {.blend = &mixed},
                                             {.colour = 0x4321}};
    const struct ph_fog fog = {0x5555, FX_INT(3), FX_INT(50)};
    const struct ph_projection p = projection_of((enum lens)(seed % LENSES));
    ref_seed(seed);
    assert_int_equal(ph_frame_begin(r, &ph_xform_identity, &p, NULL, 0x1111), PH_OK);
    if (seed % 2 == 0) {
        assert_int_equal(ph_frame_fog(r, &fog), PH_OK);
    }
    for (int n = 0; n < 12; n++) {
        struct cloud c;
        any_cloud(&c, (int)(n * 4 + seed % LENSES + seed * 16));
        draw_cloud(r, &c, &materials[n % 6]);
        if (n % 3 == 0) {
            draw_wall(r, 5 + n, &materials[n / 3 % 3 * 2]);
        }
    }
}

static void bands_and_cores_do_not_change_points(void **state)
{
    static const int bands[] = {1, 7, 16, 33};
    (void)state;
    for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
        for (uint32_t seed = 0; seed < 6; seed++) {
            struct rig whole;
            rig_open(&whole, W, H, H, ph_depth_formats[f], 900, 900);
            draw_scene(&whole.r, seed);
            assert_true(rig_finish(&whole));
            assert_int_equal(whole.r.stats.vertices_dropped + whole.r.stats.triangles_dropped, 0);
            for (int i = 0; i < 8; i++) {
                struct rig rig;
                rig_open(&rig, W, H, bands[i / 2], ph_depth_formats[f], 900, 900);
                struct ph_config config = rig.r.config;
                config.other_core = i % 2 != 0 ? other_core : NULL;
                config.other_core_join = other_core_join;
                config.cores = PH_TWO_CORES;
                assert_int_equal(ph_renderer_init(&rig.r, &config), PH_OK);
                draw_scene(&rig.r, seed);
                assert_true(rig_finish(&rig));
                assert_int_equal(rig.r.stats.points_drawn, whole.r.stats.points_drawn);
                assert_memory_equal(rig.pixels, whole.pixels, W * H * sizeof *rig.pixels);
                assert_memory_equal(rig.depth, whole.depth, W * H * sizeof *rig.depth);
                rig_close(&rig);
            }
            rig_close(&whole);
        }
    }
}

static unsigned channel(uint16_t wire, int k)
{
    const unsigned v = (unsigned)(uint16_t)(wire << 8 | wire >> 8);
    return k == 0 ? v >> 11 : k == 1 ? v >> 5 & 63 : v & 31;
}

/* A pixel of an antialiased picture is the mean of four of a picture twice as large. */
static void samples_are_pixels_of_a_larger_picture(void **state)
{
    static uint16_t samples[4 * W * 16], small[W * H];
    static uint32_t depth[4 * W * 16];
    (void)state;
    for (int n = 0; n < 32; n++) {
        struct rig rig, large;
        struct cloud c;
        ref_seed((uint32_t)n);
        any_cloud(&c, n);
        rig_open(&rig, W, H, 16, PH_DEPTH_FLOAT16, 100, 100);
        rig_open(&large, 2 * W, 2 * H, 16, PH_DEPTH_FLOAT16, 100, 100);
        struct ph_config config = rig.r.config;
        config.samples = samples;
        config.antialiasing = PH_ANTIALIAS_2X2;
        config.depth = depth;
        assert_int_equal(ph_renderer_init(&rig.r, &config), PH_OK);
        const struct ph_projection p = projection_of(c.lens);
        assert_int_equal(ph_frame_begin(&rig.r, &ph_xform_identity, &p, NULL, 0x2222), PH_OK);
        assert_int_equal(ph_frame_begin(&large.r, &ph_xform_identity, &p, NULL, 0x2222), PH_OK);
        draw_cloud(&rig.r, &c, &white);
        for (uint32_t band = 0, row = 0, bands = ph_frame_bands(&rig.r); band < bands; band++) {
            row += ph_draw_band(&rig.r, band, small + (size_t)row * W);
        }
        c.size *= c.in_world ? 1 : 2;
        c.size = c.in_world ? c.size : c.size < FX_INT(2) ? FX_INT(2) : c.size;
        for (int i = 0; i < POINTS; i++) {
            c.sizes[i] *= c.in_world ? 1 : 2;
            c.sizes[i] = !c.in_world && c.sizes[i] > 0 && c.sizes[i] < FX_INT(2) ? FX_INT(2) : c.sizes[i];
        }
        if (!c.in_world && !c.round) { /* else the least size is another */
            draw_cloud(&large.r, &c, &white);
            assert_true(rig_finish(&large));
            for (int k = 0; k < W * H; k++) {
                const uint16_t *const at = &large.pixels[k / W * 4 * W + k % W * 2];
                for (int i = 0; i < 3; i++) {
                    const unsigned sum =
                        channel(at[0], i) + channel(at[1], i) + channel(at[2 * W], i) + channel(at[2 * W + 1], i);
                    assert_int_equal(channel(small[k], i), (sum + 2) / 4);
                }
            }
        }
        rig_close(&rig);
        rig_close(&large);
    }
}

/* ---- blends ----------------------------------------------------------------------------------------------------- */

static double blended(const struct ph_blend *blend, double behind, double colour)
{
    const double a = blend->alpha / 32.;
    return blend->kind == PH_BLEND_ADD     ? fmin(behind + a * colour, 1)
           : blend->kind == PH_BLEND_TIMES ? behind * (1 - a + a * colour)
                                           : behind * (1 - a) + a * colour;
}

/* A point and a wall with blends, one after the other, before a wall; all layers are seen through. */
static void blends_are_laid_in_the_order_of_the_calls(void **state)
{
    static const struct ph_blend *const blends[3] = {&added, &mixed, &times};
    const struct ph_projection p = projection_of(PERSPECTIVE);
    struct rig rig;
    (void)state;
    rig_open(&rig, W, H, 16, PH_DEPTH_FIXED16, 100, 400);
    ref_seed(9);
    for (int n = 0; n < 300; n++) {
        const struct ph_blend *const of[2] = {blends[n % 3], blends[n / 3 % 3]};
        const bool points_first = n / 9 % 2 != 0, round = n / 18 % 2 != 0;
        uint16_t colours[3];
        for (int k = 0; k < 3; k++) {
            colours[k] = (uint16_t)ref_uniform(0, 65535);
        }
        const struct ph_material back = {.colour = colours[0]}, wall = {.colour = colours[1], .blend = of[0]},
                                 spark = {.colour = colours[2], .blend = of[1]};
        const struct fx_vec3 at = {FX_ONE, 0, FX_INT(-4)};
        const struct ph_points points = {
            .positions = &at, .count = 1, .size = n % 5 == 0 ? FX_ONE : FX_INT(9), .round = round};
        assert_int_equal(ph_frame_begin(&rig.r, &ph_xform_identity, &p, NULL, 0), PH_OK);
        draw_wall(&rig.r, 20, &back);
        for (int k = 0; k < 2; k++) {
            if ((k == 0) == points_first) {
                assert_int_equal(ph_draw_points(&rig.r, &points, &ph_xform_identity, &spark), PH_OK);
            } else {
                draw_wall(&rig.r, 10, &wall);
            }
        }
        assert_true(rig_finish(&rig));
        const double focal = H / 2 / tan(PI / 6);
        const uint16_t got = rig.pixels[H / 2 * W - W + (int)(W / 2 + focal / 4 - 1e-3)];
        const bool spark_first = (of[0]->kind == PH_BLEND_TIMES) == (of[1]->kind == PH_BLEND_TIMES)
                                     ? points_first
                                     : of[1]->kind == PH_BLEND_TIMES;
        for (int k = 0; k < 3; k++) {
            const double top = k == 1 ? 63 : 31;
            double v = channel(colours[0], k) / top;
            for (int i = 0; i < 2; i++) {
                const bool is_spark = (i == 0) == spark_first;
                v = blended(of[is_spark], v, channel(colours[is_spark ? 2 : 1], k) / top);
            }
            assert_true(fabs(v * 31 - channel(got, k) * 31 / top) < 1.3);
        }
    }
    rig_close(&rig);
}

/* Draws one point in fog. Returns a pixel of it. */
static uint16_t pixel_of(struct rig *rig, double z, double size, const struct ph_material *material)
{
    const struct ph_projection p = projection_of(PERSPECTIVE);
    const struct fx_vec3 at = {ref_q16(z / 8), ref_q16(z / 8), ref_q16(-z)};
    const struct ph_points points = {.positions = &at, .count = 1, .size = ref_q16(size)};
    const struct ph_fog fog = {0x8410, FX_INT(3), FX_INT(6)};
    assert_int_equal(ph_frame_begin(&rig->r, &ph_xform_identity, &p, NULL, 0x1863), PH_OK);
    assert_int_equal(ph_frame_fog(&rig->r, &fog), PH_OK);
    assert_int_equal(ph_draw_points(&rig->r, &points, &ph_xform_identity, material), PH_OK);
    assert_true(rig_finish(rig));
    const double focal = H / 2 / tan(PI / 6);
    return rig->pixels[(int)(H / 2 - focal / 8) * W + (int)(W / 2 + focal / 8)];
}

static void fog_hides_what_is_far(void **state)
{
    static const struct ph_blend all_added = {.draw = ph_draw_blended, .kind = PH_BLEND_ADD, .alpha = 32},
                                 all_mixed = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 32};
    static const struct ph_material opaque = {.colour = 0x5555}, glow = {.colour = 0x0400, .blend = &all_added},
                                    pane = {.colour = 0x5555, .blend = &all_mixed};
    (void)state;
    for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
        struct rig rig;
        rig_open(&rig, W, H, 16, ph_depth_formats[f], 100, 100);
        for (double size = 1; size < 9; size += 6) {
            assert_int_equal(pixel_of(&rig, 2, size, &opaque), 0x5555);
            assert_int_equal(pixel_of(&rig, 9, size, &opaque), 0x8410);
            assert_int_equal(pixel_of(&rig, 2, size, &pane), 0x5555);
            assert_int_equal(rig.r.stats.fragments, (int)(size * size));
            assert_int_equal(pixel_of(&rig, 9, size, &pane), 0x8410);
            assert_int_equal(pixel_of(&rig, 2, size, &glow), 0x1863 + 0x0400);
            assert_int_equal(pixel_of(&rig, 9, size, &glow), 0x1863);
        }
        rig_close(&rig);
    }
}

/* Of points at one depth the first stays, but for one with a bias; what is multiplied is seen over the same depth. */
static void of_equal_depths_the_first_stays(void **state)
{
    static const struct ph_material first = {.colour = 0x5555}, second = {.colour = 0x7777},
                                    biased = {.colour = 0x6666, .depth_bias = 8}, dark = {.colour = 0, .blend = &times};
    const struct ph_projection p = projection_of(PERSPECTIVE);
    const struct fx_vec3 at = {0, 0, FX_INT(-3)};
    struct ph_points points = {.positions = &at, .count = 1};
    (void)state;
    for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
        struct rig rig;
        rig_open(&rig, W, H, 16, ph_depth_formats[f], 100, 100);
        for (int n = 0; n < 6; n++) {
            const struct ph_material *const last = n % 3 == 0 ? &second : n % 3 == 1 ? &biased : &dark;
            points.size = n < 3 ? FX_ONE : FX_INT(6);
            assert_int_equal(ph_frame_begin(&rig.r, &ph_xform_identity, &p, NULL, 0), PH_OK);
            assert_int_equal(ph_draw_points(&rig.r, &points, &ph_xform_identity, &first), PH_OK);
            assert_int_equal(ph_draw_points(&rig.r, &points, &ph_xform_identity, last), PH_OK);
            assert_true(rig_finish(&rig));
            assert_int_equal(rig.pixels[(H / 2 - 1) * W + W / 2 - 1], n % 3 == 0 ? 0x5555 : n % 3 == 1 ? 0x6666 : 0);
        }
        rig_close(&rig);
    }
}

/* ---- what is left out ------------------------------------------------------------------------------------------- */

static void what_does_not_fit_is_left_out_and_counted(void **state)
{
    const struct ph_projection p = projection_of(PERSPECTIVE);
    static const struct ph_blend nothing = {.kind = PH_BLEND_ADD};
    static const struct ph_material spark = {.blend = &added}, no_draw = {.blend = &nothing};
    static struct fx_vec3 at[400];
    struct ph_points points = {.positions = at, .count = 400, .size = FX_ONE};
    struct rig rig;
    (void)state;
    for (int i = 0; i < 400; i++) {
        at[i] = (struct fx_vec3){0, 0, FX_INT(-2)};
    }
    rig_open(&rig, W, H, 16, PH_DEPTH_FIXED16, 110, 100);
    assert_int_equal(ph_draw_points(&rig.r, &points, &ph_xform_identity, &white), PH_ERR_STATE);
    assert_int_equal(ph_frame_begin(&rig.r, &ph_xform_identity, &p, NULL, 0), PH_OK);
    assert_int_equal(ph_draw_points(&rig.r, &points, &ph_xform_identity, &white), PH_ERR_NOMEM);
    assert_int_equal(rig.r.stats.vertices_dropped, 400);
    assert_int_equal(ph_draw_points(&rig.r, NULL, &ph_xform_identity, &white), PH_ERR_INVAL);
    assert_int_equal(ph_draw_points(&rig.r, &points, NULL, &white), PH_ERR_INVAL);
    assert_int_equal(ph_draw_points(&rig.r, &points, &ph_xform_identity, NULL), PH_ERR_INVAL);
    points.count = PH_POINTS_MAX + 1;
    assert_int_equal(ph_draw_points(&rig.r, &points, &ph_xform_identity, &white), PH_ERR_INVAL);
    points.count = 90;
    assert_int_equal(ph_draw_points(&rig.r, &points, &ph_xform_identity, &no_draw), PH_OK);
    assert_int_equal(rig.r.stats.vertices_dropped, 490);
    for (int i = 0; i < 90; i++) {
        at[i].z = FX_INT(2);
    }
    for (int i = 0; i < 20; i++) { /* behind the viewer they take no room */
        assert_int_equal(ph_draw_points(&rig.r, &points, &ph_xform_identity, &spark), PH_OK);
    }
    assert_int_equal(rig.r.stats.vertices_dropped, 490);
    assert_int_equal(rig.r.stats.points_drawn, 0);
    const struct ph_xform turned = ph_xform_rotate_y(1u << 31);
    for (int i = 0; i < 20; i++) {
        assert_int_equal(ph_draw_points(&rig.r, &points, &turned, i % 2 != 0 ? &spark : &white), PH_OK);
    }
    assert_in_range(rig.r.stats.points_drawn, 90, 360);
    assert_int_equal(rig.r.stats.points_drawn + rig.r.stats.vertices_dropped, 490 + 20 * 90);
    assert_true(rig_finish(&rig));
    points = (struct ph_points){.positions = NULL, .count = 0};
    assert_int_equal(ph_draw_points(&rig.r, &points, &turned, &white), PH_ERR_STATE);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_are_those_of_the_rule),
        cmocka_unit_test(squares_tile_the_picture),
        cmocka_unit_test(bands_and_cores_do_not_change_points),
        cmocka_unit_test(samples_are_pixels_of_a_larger_picture),
        cmocka_unit_test(blends_are_laid_in_the_order_of_the_calls),
        cmocka_unit_test(fog_hides_what_is_far),
        cmocka_unit_test(of_equal_depths_the_first_stays),
        cmocka_unit_test(what_does_not_fit_is_left_out_and_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
