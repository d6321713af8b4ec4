/*
 * Dithered light (ph_dither) against ideal light in double precision, as the eye sees it: CIE76 after a blur of 1
 * pixel. And it is the same in any band, on two cores, and in a frame that stands still.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "colour.h"
#include "render.h"

enum { WIDTH = 160, HEIGHT = 120, COLUMNS = 26, ROWS = 20, CELL = 7, CORNERS = COLUMNS * ROWS, EDGE = 6 };
enum { FACES = 2 * (COLUMNS - 1) * (ROWS - 1), GRADIENTS = 6 };

/* Light, 0 .. 1, at a place of the picture. */
static double across(double x, double y)
{
    (void)y;
    return .1 + .85 * x / WIDTH;
}

static double down(double x, double y)
{
    (void)x;
    return .3 + .3 * y / HEIGHT;
}

static double aslant(double x, double y)
{
    return .06 + .5 * (x + y) / (WIDTH + HEIGHT);
}

static double slow(double x, double y)
{
    return .6 + .05 * x / WIDTH + .12 * y / HEIGHT;
}

static double lamp(double x, double y)
{
    const double dx = x - 60, dy = y - 40;
    return .15 + .8 / (1 + (dx * dx + dy * dy) / 4000);
}

static double ball(double x, double y) /* a part of one, lit from the upper right */
{
    const double u = (x - 80) / 130, v = (60 - y) / 130, w = sqrt(1 - u * u - v * v);
    return .2 + .8 * (.5 * u + .6 * v + .7 * w) / sqrt(.25 + .36 + .49);
}

static const struct gradient {
    double (*light)(double x, double y);
    uint8_t colour[3];
    bool is_flat; /* light is linear: two triangles do */
} gradients[GRADIENTS] = {
    {across, {200, 200, 200}, true}, {down, {60, 130, 230}, true},  {aslant, {90, 180, 80}, true},
    {slow, {255, 255, 255}, true},   {lamp, {224, 104, 52}, false}, {ball, {255, 160, 64}, false},
};

static uint64_t vertices[2048], triangles[8192];
static uint32_t bins[HEIGHT], depth[WIDTH * HEIGHT];
static struct fx_vec3 corners[CORNERS];
static int16_t normals[CORNERS][3];
static uint16_t faces[FACES][3], ramp[PH_RAMP_SIZE];
static struct ph_dithered_ramp ramps[2];

/* How a picture is drawn. */
struct way {
    const struct ph_depth_format *format;
    uint16_t lines;   /* of a band */
    bool is_dithered; /* and by what, if not by a new struct ph_dither */
    struct ph_dither *dither;
    bool on_two_cores;
    bool is_coarse; /* two triangles, if light is linear */
    double lean;    /* of the surface: its distance doubles so often from top to bottom */
    const struct ph_blend *blend;
    fx_t specular;
    bool has_line;
};

/* The place of a corner in the picture, and the light there. */
static void set_corner(uint32_t i, double x, double y, const struct gradient *g, double lean)
{
    const double z = 2 * exp2(lean * (HEIGHT - y) / HEIGHT), light = g->light(x, y);
    corners[i] =
        (struct fx_vec3){(fx_t)lround((x - WIDTH / 2) / (HEIGHT / 2) * z * FX_ONE),
                         (fx_t)lround((HEIGHT / 2 - y) / (HEIGHT / 2) * z * FX_ONE), -(fx_t)lround(z * FX_ONE)};
    normals[i][0] = (int16_t)lround(16384 * sqrt(1 - light * light));
    normals[i][2] = (int16_t)lround(16384 * light);
}

static uint32_t set_mesh(const struct gradient *g, const struct way *way)
{
    const bool two = way->is_coarse && g->is_flat;
    const uint32_t columns = two ? 2 : COLUMNS, rows = two ? 2 : ROWS, cell = two ? (COLUMNS - 1) * CELL : CELL;
    for (uint32_t i = 0; i < columns * rows; i++) {
        set_corner(i, (int32_t)(i % columns * cell) - 8, (int32_t)(i / columns * cell) - 8, g, way->lean);
    }
    uint32_t n = 0;
    for (uint32_t i = 0; i < (columns - 1) * (rows - 1); i++) {
        const uint16_t a = (uint16_t)(i / (columns - 1) * columns + i % (columns - 1)), below = (uint16_t)(a + columns);
        const uint16_t two_faces[2][3] = {{a, below, (uint16_t)(below + 1)},
                                          {a, (uint16_t)(below + 1), (uint16_t)(a + 1)}};
        memcpy(faces[n], two_faces, sizeof two_faces);
        n += 2;
    }
    return n;
}

static bool run_at_once(void (*run)(void *argument), void *argument)
{
    run(argument);
    return true;
}

static void join(void)
{
}

static void draw(const struct gradient *g, const struct way *way, uint16_t *pixels)
{
    const struct ph_config config = {.width = WIDTH,
                                     .height = HEIGHT,
                                     .band_height = way->lines,
                                     .depth_format = way->format,
                                     .vertices = vertices,
                                     .vertex_max = (uint32_t)(sizeof vertices / ph_vertex_bytes),
                                     .triangles = triangles,
                                     .triangle_max = (uint32_t)(sizeof triangles / ph_triangle_bytes),
                                     .bins = bins,
                                     .bin_max = HEIGHT,
                                     .depth = depth,
                                     .other_core = way->on_two_cores ? run_at_once : NULL,
                                     .other_core_join = way->on_two_cores ? join : NULL,
                                     .cores = way->on_two_cores ? PH_TWO_CORES : NULL};
    const struct ph_projection projection = {
        .near_z = FX_ONE / 2, .far_z = FX_INT(200), .scale_x_q20 = (1 << 20) / WIDTH * HEIGHT, .scale_y_q20 = 1 << 20};
    const struct ph_scene_light sun = {.count = 1, .lights = {{.intensity = FX_ONE, .to_light_q30 = {0, 0, 1 << 30}}}};
    const struct ph_material material = {.shading = PH_SHADE_GOURAUD,
                                         .two_sided = true,
                                         .diffuse = FX_ONE,
                                         .specular = way->specular,
                                         .ramp = ramp,
                                         .blend = way->blend};
    const struct ph_part part = {.count = set_mesh(g, way)};
    const struct ph_mesh mesh = {.positions = corners,
                                 .normals = (const int16_t(*)[3])normals,
                                 .triangles = (const uint16_t(*)[3])faces,
                                 .parts = &part,
                                 .materials = &material,
                                 .vertex_count = CORNERS,
                                 .triangle_count = part.count,
                                 .part_count = 1};
    struct ph_dither own = {.ramps = ramps, .ramp_max = 1};
    struct ph_renderer r;
    ph_material_ramp(ramp, g->colour[0], g->colour[1], g->colour[2], way->specular);
    assert_int_equal(ph_renderer_init(&r, &config), PH_OK);
    if (way->is_dithered) {
        assert_int_equal(ph_dither(&r, way->dither != NULL ? way->dither : &own), PH_OK);
    }
    assert_int_equal(ph_frame_begin(&r, &ph_xform_identity, &projection, &sun, 0), PH_OK);
    assert_int_equal(ph_draw_mesh(&r, &mesh, &ph_xform_identity), PH_OK);
    if (way->has_line) {
        assert_int_equal(ph_draw_line(&r, corners[0], corners[CORNERS - 1], &material), PH_OK);
    }
    for (uint32_t band = 0, bands = ph_frame_bands(&r); band < bands; band++) {
        ph_draw_band(&r, band, pixels + band * way->lines * WIDTH);
    }
    assert_int_equal(r.stats.triangles_dropped + r.stats.vertices_dropped, 0);
}

/* ---- what the eye sees ------------------------------------------------------------------------------------------ */

typedef double plane[HEIGHT][WIDTH];

static double at_border(int32_t i, int32_t size)
{
    return i < 0 ? 0 : i >= size ? size - 1 : i;
}

/* A Gaussian of 1 pixel. */
static void blur(plane p)
{
    static plane along;
    double weight[9], sum = 0;
    for (int32_t i = -4; i <= 4; i++) {
        sum += weight[i + 4] = exp(-i * i / 2.);
    }
    for (int32_t y = 0; y < HEIGHT; y++) {
        for (int32_t x = 0; x < WIDTH; x++) {
            along[y][x] = 0;
            for (int32_t i = -4; i <= 4; i++) {
                along[y][x] += weight[i + 4] / sum * p[y][(int32_t)at_border(x + i, WIDTH)];
            }
        }
    }
    for (int32_t y = 0; y < HEIGHT; y++) {
        for (int32_t x = 0; x < WIDTH; x++) {
            p[y][x] = 0;
            for (int32_t i = -4; i <= 4; i++) {
                p[y][x] += weight[i + 4] / sum * along[(int32_t)at_border(y + i, HEIGHT)][x];
            }
        }
    }
}

static double lab_part(double t)
{
    return t > 216. / 24389 ? cbrt(t) : (24389. / 27 * t + 16) / 116;
}

static double linear(double c)
{
    return c <= .04045 ? c / 12.92 : pow((c + .055) / 1.055, 2.4);
}

/* sRGB, 0 .. 1 a channel, to CIE L*a*b* under D65. */
static void lab_of(const double rgb[3], double lab[3])
{
    const double r = linear(rgb[0]), g = linear(rgb[1]), b = linear(rgb[2]);
    const double x = lab_part((.4124564 * r + .3575761 * g + .1804375 * b) / .95047);
    const double y = lab_part(.2126729 * r + .7151522 * g + .0721750 * b);
    const double z = lab_part((.0193339 * r + .1191920 * g + .9503041 * b) / 1.08883);
    lab[0] = 116 * y - 16;
    lab[1] = 500 * (x - y);
    lab[2] = 200 * (y - z);
}

struct error {
    double rms, most;
};

/* How far a picture is off ideal light, but for the margin that the blur mixes with what is beyond the picture. */
static struct error error_of(const struct gradient *g, const uint16_t *pixels)
{
    static plane ideal[3], drawn[3];
    static const int from[3] = {11, 5, 0}, top[3] = {31, 63, 31};
    struct error e = {0, 0};
    for (int32_t y = 0; y < HEIGHT; y++) {
        for (int32_t x = 0; x < WIDTH; x++) {
            for (int k = 0; k < 3; k++) {
                ideal[k][y][x] = g->light(x + .5, y + .5) * g->colour[k] / 255;
                drawn[k][y][x] = (double)(ph_wire16(pixels[y * WIDTH + x]) >> from[k] & top[k]) / top[k];
            }
        }
    }
    for (int k = 0; k < 3; k++) {
        blur(ideal[k]);
        blur(drawn[k]);
    }
    for (int32_t y = EDGE; y < HEIGHT - EDGE; y++) {
        for (int32_t x = EDGE; x < WIDTH - EDGE; x++) {
            double a[3], b[3];
            lab_of((double[]){ideal[0][y][x], ideal[1][y][x], ideal[2][y][x]}, a);
            lab_of((double[]){drawn[0][y][x], drawn[1][y][x], drawn[2][y][x]}, b);
            const double off =
                sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
            e.rms += off * off;
            e.most = off > e.most ? off : e.most;
        }
    }
    e.rms = sqrt(e.rms / ((HEIGHT - 2 * EDGE) * (WIDTH - 2 * EDGE)));
    return e;
}

static const struct ph_depth_format *const formats[] = {PH_DEPTH_FIXED16, PH_DEPTH_FLOAT16};

static void slow_gradients_have_no_bands(void **state)
{
    (void)state;
    static uint16_t pixels[WIDTH * HEIGHT];
    for (uint32_t i = 0; i < GRADIENTS; i++) {
        for (int coarse = 0; coarse < 2; coarse++) {
            struct way way = {.format = formats[coarse], .lines = 16, .is_coarse = coarse};
            draw(&gradients[i], &way, pixels);
            const struct error without = error_of(&gradients[i], pixels);
            way.is_dithered = true;
            draw(&gradients[i], &way, pixels);
            const struct error with = error_of(&gradients[i], pixels);
            print_message("gradient %u, %s: RMS %.3f (without %.3f), most %.2f (%.2f)\n", i, coarse ? "coarse" : "fine",
                          with.rms, without.rms, with.most, without.most);
            assert_true(without.rms > 1);
            assert_true(with.rms <= .5 && with.most < 2.3);
        }
    }
}

/* What a pixel may be: the entry that it has without dither, or one beside it, at the threshold of its step. */
static bool is_step_of(const struct gradient *g, uint32_t x, uint32_t y, uint16_t plain, uint16_t dithered)
{
    static const int from[3] = {11, 5, 0}, top[3] = {31, 63, 31};
    const uint32_t step = (3 * x + 7 * y) % 8;
    const double up = step == 0 ? .5 : fmod(.5 + (2 * step + 1) / 16., 1);
    for (int entry = 4; entry <= 123; entry++) {
        bool is_plain = true, is_dithered = true;
        for (int k = 0; k < 3; k++) {
            const double next = g->colour[k] / 255. * top[k] / 119, value = (entry - 4) * next;
            const int one = ph_wire16(plain) >> from[k] & top[k], other = ph_wire16(dithered) >> from[k] & top[k];
            is_plain = is_plain && fabs(value - one) <= .5 + next + 1e-3;
            is_dithered = is_dithered && value + up - other > -1e-3 && value + up - other < 1 + 1e-3;
        }
        if (is_plain && is_dithered) {
            return true;
        }
    }
    return false;
}

static uint16_t pictures[3][WIDTH * HEIGHT];
static uint32_t plain_depth[WIDTH * HEIGHT];

static const double leans[] = {0, 1.5, 5};

/* Every triangle is dithered: small, tall and large, in one octave of depth, with a knee, across octaves, and where 64
 * bits are needed; opaque or blended. Light that lies between two entries may be rounded to another one than without.
 */
static void each_pixel_has_the_step_of_its_place(void **state)
{
    (void)state;
    static const struct ph_blend opaque = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 32};
    for (uint32_t i = 0; i < GRADIENTS * 3 * 2 * 2 * 2; i++) {
        const struct gradient *const g = &gradients[i % GRADIENTS];
        struct way way = {.format = formats[i / GRADIENTS & 1], .lines = HEIGHT, .lean = leans[i / GRADIENTS / 2 % 3]};
        way.is_coarse = (i / GRADIENTS / 6 & 1) != 0;
        way.blend = i / GRADIENTS / 12 != 0 ? &opaque : NULL;
        draw(g, &way, pictures[0]);
        memcpy(plain_depth, depth, sizeof depth);
        way.is_dithered = true;
        draw(g, &way, pictures[1]);
        assert_memory_equal(plain_depth, depth, sizeof depth);
        uint32_t off = 0, same = 0;
        for (uint32_t at = 0; at < WIDTH * HEIGHT; at++) {
            off += !is_step_of(g, at % WIDTH, at / WIDTH, pictures[0][at], pictures[1][at]);
            same += pictures[0][at] == pictures[1][at];
        }
        assert_int_equal(off, 0);
        assert_in_range(same, 0, WIDTH * HEIGHT * 9 / 10);
    }
}

static void bands_and_cores_change_no_byte(void **state)
{
    (void)state;
    static const uint16_t heights[] = {1, 7, 16, HEIGHT};
    for (uint32_t i = 0; i < GRADIENTS * 3 * 2; i++) {
        const struct gradient *const g = &gradients[i % GRADIENTS];
        struct way way = {.format = formats[i / GRADIENTS % 2], .lines = 16, .lean = leans[i / GRADIENTS / 2]};
        way.is_dithered = true;
        for (int coarse = 0; coarse < 2; coarse++) {
            way.is_coarse = coarse != 0;
            way.lines = HEIGHT;
            way.on_two_cores = false;
            draw(g, &way, pictures[0]);
            for (uint32_t k = 0; k < 8; k++) {
                way.lines = heights[k / 2];
                way.on_two_cores = k % 2 != 0;
                draw(g, &way, pictures[2]);
                assert_memory_equal(pictures[0], pictures[2], sizeof pictures[0]);
            }
        }
    }
}

static void a_frame_that_stands_still_has_pixels_that_stand_still(void **state)
{
    (void)state;
    struct ph_dither dither = {.ramps = ramps, .ramp_max = 1};
    struct way way = {.format = PH_DEPTH_FLOAT16, .lines = 16, .is_dithered = true, .dither = &dither};
    draw(&gradients[4], &way, pictures[0]);
    draw(&gradients[4], &way, pictures[1]);
    assert_memory_equal(pictures[0], pictures[1], sizeof pictures[0]);
    draw(&gradients[5], &way, pictures[1]); /* the same ramp in other colours */
    assert_true(error_of(&gradients[5], pictures[1]).rms < .5);
    way.specular = FX_ONE / 2; /* another ramp, and a line with the same material */
    way.has_line = true;
    draw(&gradients[5], &way, pictures[0]);
    way.is_dithered = false;
    draw(&gradients[5], &way, pictures[1]);
    uint32_t same = 0;
    for (uint32_t at = 0; at < WIDTH * HEIGHT; at++) {
        same += pictures[0][at] == pictures[1][at];
    }
    assert_in_range(same, 1, WIDTH * HEIGHT * 9 / 10);
}

static void what_is_not_dithered_is_as_without(void **state)
{
    (void)state;
    static const struct ph_depth_format *const others[] = {PH_DEPTH_FIXED24, PH_DEPTH_FLOAT24, PH_DEPTH_LINEAR_W};
    for (uint32_t i = 0; i < 3; i++) {
        struct way way = {.format = others[i], .lines = 16};
        draw(&gradients[5], &way, pictures[0]);
        way.is_dithered = true;
        draw(&gradients[5], &way, pictures[1]);
        assert_memory_equal(pictures[0], pictures[1], sizeof pictures[0]);
    }
    struct ph_dither none = {.ramps = ramps, .ramp_max = 0}; /* no room */
    struct way way = {.format = PH_DEPTH_FIXED16, .lines = 16};
    draw(&gradients[5], &way, pictures[0]);
    way.is_dithered = true;
    way.dither = &none;
    draw(&gradients[5], &way, pictures[1]);
    assert_memory_equal(pictures[0], pictures[1], sizeof pictures[0]);
    assert_int_equal(none.left_out, 1);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    struct ph_renderer r = {.samples_log2 = 1};
    struct ph_dither dither = {.ramps = ramps, .ramp_max = 1}, empty = {.ramp_max = 1};
    assert_int_equal(ph_dither(&r, &dither), PH_ERR_INVAL);
    r.samples_log2 = 0;
    assert_int_equal(ph_dither(NULL, &dither), PH_ERR_INVAL);
    assert_int_equal(ph_dither(&r, &empty), PH_ERR_INVAL);
    assert_null(r.config.antialiasing);
    assert_int_equal(ph_dither(&r, &dither), PH_OK);
    assert_non_null(r.config.antialiasing);
    assert_int_equal(ph_dither(&r, NULL), PH_OK);
    assert_null(r.config.antialiasing);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slow_gradients_have_no_bands),
        cmocka_unit_test(each_pixel_has_the_step_of_its_place),
        cmocka_unit_test(bands_and_cores_change_no_byte),
        cmocka_unit_test(a_frame_that_stands_still_has_pixels_that_stand_still),
        cmocka_unit_test(what_is_not_dithered_is_as_without),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
