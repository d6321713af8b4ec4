/*
 * What the depth formats resolve is measured through the real vertices, set-up and spans. Quads that face the camera or
 * lean are drawn into a picture of 33 x 33 pixels, whose middle pixel has its centre on the axis; then the depth buffer
 * is read.
 *
 * S(w) is the longest plateau: the number of steps of the Q16.16 distance that have the code of w. Its expected values
 * follow from the formats' definition in depth.h.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "depth_chain.h"
#include "option_text.h"
#include "ref_random.h"
#include "ref_rig.h"

#include <math.h>
#include <stdio.h>

#define SIZE   33
#define MIDDLE (SIZE / 2 * SIZE + SIZE / 2)
#define LSB    (1. / 65536)

/* The renderer's formats, and the floats with each number of bits of exponent. */
static const struct option_depth formats[] = {
    {PH_DEPTH_FIXED16, 0}, {PH_DEPTH_FLOAT16, 0}, {PH_DEPTH_FIXED24, 0}, {PH_DEPTH_FLOAT24, 0}, {PH_DEPTH_LINEAR_W, 0},
    {PH_DEPTH_FLOAT16, 3}, {PH_DEPTH_FLOAT16, 4}, {PH_DEPTH_FLOAT16, 5}, {PH_DEPTH_FLOAT16, 6}, {PH_DEPTH_FLOAT24, 3},
    {PH_DEPTH_FLOAT24, 4}, {PH_DEPTH_FLOAT24, 5}, {PH_DEPTH_FLOAT24, 6},
};
#define FORMATS ((int)(sizeof formats / sizeof formats[0]))

static const char *name_of(struct option_depth format)
{
    static char text[OPTION_DEPTH_NAME];
    return option_text_depth_name(format, text);
}

/* What the other tests and the oracles take from the table stands here once more. */
static void the_traits_are_those_of_the_formulas(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        const struct ph_depth_format *format;
        uint8_t coding, bits, bytes;
    } known[] = {{"auto", PH_DEPTH_AUTO, PH_DEPTH_IS_FIXED, 16, 2},
                 {"fixed16", PH_DEPTH_FIXED16, PH_DEPTH_IS_FIXED, 16, 2},
                 {"float16", PH_DEPTH_FLOAT16, PH_DEPTH_IS_FLOAT, 16, 2},
                 {"fixed24", PH_DEPTH_FIXED24, PH_DEPTH_IS_FIXED, 24, 4},
                 {"float24", PH_DEPTH_FLOAT24, PH_DEPTH_IS_FLOAT, 24, 4},
                 {"linear-w", PH_DEPTH_LINEAR_W, PH_DEPTH_IS_LINEAR, 16, 2}};
    for (unsigned i = 0; i < sizeof known / sizeof known[0]; i++) {
        const struct ph_depth_format *const format = known[i].format;
        assert_ptr_equal(ph_depth_formats[i], format); /* what stands in files stays what it was */
        assert_string_equal(format->name, known[i].name);
        assert_int_equal(format->coding, known[i].coding);
        assert_int_equal(format->bits, known[i].bits);
        assert_int_equal(ph_depth_bytes(known[i].format), known[i].bytes);
    }
}

/* A camera with one of the formats. */
struct bench {
    struct rig rig;
    const struct ph_depth_format *format;
    struct ph_projection projection;
    double near_z, far_z; /* as Q16.16 has them */
};

static void bench_open(struct bench *b, struct option_depth depth, double near_z, double far_z)
{
    const struct ph_depth_format *const format = depth.format;
    rig_open(&b->rig, SIZE, SIZE, SIZE, format, 4, 2);
    b->rig.r.config.depth_exponent = depth.exponent;
    assert_int_equal(ph_projection_perspective(&b->projection, FX_INT(60), FX_ONE, ref_q16(near_z), ref_q16(far_z)),
                     PH_OK);
    b->format = format;
    b->near_z = b->projection.near_z * LSB;
    b->far_z = b->projection.far_z * LSB;
}

/*
 * Code in the middle of a quad at distance w whose right side is `lean` of w further away than its left one; about
 * `pixels` wide.
 */
static uint32_t code_at(struct bench *b, fx_t w, double lean, double pixels)
{
    static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const struct ph_part part = {0, 2, 0};
    static const struct ph_material material = {.shading = PH_SHADE_UNLIT, .colour = 1};
    const double half = pixels / SIZE * sqrt(1. / 3) * w;
    const fx_t size = (fx_t)ceil(half) + 1, back = (fx_t)lrint(half * lean);
    const struct fx_vec3 corners[4] = {
        {-size, -size, back - w}, {size, -size, -back - w}, {size, size, -back - w}, {-size, size, back - w}};
    const struct ph_mesh mesh = {.positions = corners,
                                 .vertex_count = 4,
                                 .triangles = triangles,
                                 .triangle_count = 2,
                                 .parts = &part,
                                 .part_count = 1,
                                 .materials = &material};
    assert_int_equal(ph_frame_begin(&b->rig.r, &ph_xform_identity, &b->projection, NULL, 0), PH_OK);
    assert_int_equal(ph_draw_mesh(&b->rig.r, &mesh, &ph_xform_identity), PH_OK);
    assert_true(rig_finish(&b->rig));
    assert_true(b->rig.depth[MIDDLE] != 0);
    return b->rig.depth[MIDDLE];
}

/* The first w of (from, to] at which a facing quad no longer has the code of `from`, or to + 1; codes are monotone. */
static fx_t plateau_end(struct bench *b, fx_t from, fx_t to)
{
    const uint32_t code = code_at(b, from, 0, 3);
    fx_t same = from, other = to + 1;
    while (other - same > 1) {
        const fx_t w = same + (other - same) / 2;
        if (code_at(b, w, 0, 3) == code) {
            same = w;
        } else {
            other = w;
        }
    }
    return other;
}

/* Longest plateau among `count` that follow each other from about w on. */
static double longest_plateau(struct bench *b, double w, int count)
{
    const fx_t to = b->projection.far_z;
    fx_t from = plateau_end(b, ref_q16(w), to), longest = 0;
    for (int i = 0; i < count && from <= to; i++) {
        const fx_t end = plateau_end(b, from, to);
        longest = end - from > longest ? end - from : longest;
        from = end;
    }
    return longest * LSB;
}

static double distance_of(const struct bench *b, double code)
{
    return rig_format_distance(b->format, b->rig.r.stats.depth_exponent, code, b->near_z, b->far_z);
}

/* The longest plateau of the format on 200 distances, the far end and the near side of every octave of the float. */
static double worst_plateau(struct bench *b)
{
    const double n = b->near_z * (1 - 1. / 512), f = b->far_z;
    double worst = 0;
    for (int i = 0; i < 200; i++) {
        const double w = b->near_z * pow(f / b->near_z, (i + .5) / 200);
        worst = fmax(worst, longest_plateau(b, w, 2));
    }
    for (int octave = 1; octave <= 31; octave++) {
        const double w = n / (ldexp(1, -octave) * 1.002 + n / f);
        worst = w < b->near_z ? worst : fmax(worst, longest_plateau(b, w, 2));
    }
    const double last = distance_of(b, code_at(b, b->projection.far_z, 0, 3) + 6);
    return fmax(worst, longest_plateau(b, fmin(last, f), 8));
}

/* S_worst in metres, computed from the formats' definition. */
static const struct {
    struct option_depth format;
    double near_z, far_z, worst;
} table[] = {
    {{PH_DEPTH_FIXED16, 0}, .1, 1000, 126},
    {{PH_DEPTH_FLOAT16, 0}, .1, 1000, .074},
    {{PH_DEPTH_FIXED24, 0}, .1, 1000, .596},
    {{PH_DEPTH_FLOAT24, 0}, .1, 1000, 3e-4},
    {{PH_DEPTH_FIXED16, 0}, 1, 3, 9 / 3. * 2 / 65408},
    {{PH_DEPTH_LINEAR_W, 0}, .1, 1000, .0153},
    {{PH_DEPTH_FIXED16, 0}, .5, 100, .303},
    {{PH_DEPTH_FLOAT16, 0}, .5, 100, .0058},
    {{PH_DEPTH_LINEAR_W, 0}, .5, 100, .0015},
    {{PH_DEPTH_FIXED24, 0}, 1, 1000, .060},
    {{PH_DEPTH_FLOAT24, 0}, 1, 1000, 2.4e-4},
    /* N / f just below a power of two; the step is (f - n) / 65408, its plateau one code */
    {{PH_DEPTH_LINEAR_W, 0}, 1, 1023, 1022. / 65408},
    /* With bits of exponent: far 2^-(18 - e) at a quarter, and where d ends, far^2 / near 2^-(2^e + 15 - e). */
    {{PH_DEPTH_FLOAT16, 3}, 1, 32, 32 / 32768.},
    {{PH_DEPTH_FLOAT16, 3}, 1, 1000, 1e6 / 1048576},
    {{PH_DEPTH_FLOAT16, 4}, 1, 32, 32 / 16384.},
    {{PH_DEPTH_FLOAT16, 4}, .1, 10000, 1e9 / 134217728},
    {{PH_DEPTH_FLOAT16, 5}, .1, 10000, 10000 / 8192.},
    {{PH_DEPTH_FLOAT16, 6}, .1, 10000, 10000 / 4096.},
    {{PH_DEPTH_FLOAT16, 5}, 1. / 65536, 32767, 32767 / 2048.},
    {{PH_DEPTH_FLOAT16, 6}, 1. / 65536, 32767, 32767 / 4096.},
    {{PH_DEPTH_FLOAT24, 5}, .1, 10000, 10000 / 2097152.},
};

static void formats_resolve_what_the_table_says(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        struct bench b;
        bench_open(&b, table[i].format, table[i].near_z, table[i].far_z);
        const double worst = worst_plateau(&b);
        print_message("    %-8s n %.1f f %4.0f: S_worst %.3g m, table %.3g m, ratio %.3f\n", name_of(table[i].format),
                      table[i].near_z, table[i].far_z, worst, table[i].worst, worst / table[i].worst);
        assert_true(worst <= table[i].worst * 1.05);
        assert_true(worst >= table[i].worst * .8);
        rig_close(&b.rig);
    }
}

/* ---- each vertex ---------------------------------------------------------------------------------------------- */

/* A camera with near and far plane anywhere, most ratios alike. */
static void random_camera(struct bench *b, struct option_depth format)
{
    const double near_z = exp(ref_uniform(log(.001), log(50)));
    bench_open(b, format, near_z, fmin(near_z * exp(ref_uniform(log(1.5), log(30000))), 32000));
}

static fx_t random_distance(const struct bench *b)
{
    const double w = b->near_z * pow(b->far_z / b->near_z, ref_uniform(0, 1));
    return (fx_t)fmin(fmax(ref_q16(w), b->projection.near_z), b->projection.far_z);
}

static void vertices_get_the_codes_of_the_definition(void **state)
{
    (void)state;
    ref_seed(4);
    for (int i = 0; i < 4000; i++) {
        const struct option_depth format = formats[i % FORMATS];
        struct bench b;
        random_camera(&b, format);
        const fx_t w = random_distance(&b);
        const uint32_t code = code_at(&b, w, 0, 4);
        assert_int_equal(code, depth_chain(&b.rig.r.lens, b.format, w));
        assert_true(depth_is_right(&b.rig.r.lens, b.format, w, code));
        rig_close(&b.rig);
    }
}

static void codes_never_rise_with_distance(void **state)
{
    (void)state;
    ref_seed(14);
    for (int i = 0; i < 1000; i++) {
        const struct option_depth format = formats[i % FORMATS];
        struct bench b;
        random_camera(&b, format);
        code_at(&b, b.projection.far_z, 0, 3); /* sets the lens up */
        const struct ph_lens *lens = &b.rig.r.lens;
        fx_t w = random_distance(&b);
        uint32_t before = depth_chain(lens, b.format, w);
        for (int k = 0; k < 500 && w < b.projection.far_z; k++) {
            const uint32_t code = depth_chain(lens, b.format, ++w);
            assert_true(code <= before);
            before = code;
        }
        rig_close(&b.rig);
    }
}

static void the_fixed_formats_use_all_codes_of_near_ranges(void **state)
{
    static const struct {
        double near_z, far_z, share; /* of the codes */
    } lenses[] = {{1, 3, 1}, {.5, .6, 1}, {2, 100, 1}, {.1, 1000, 1}, {8, 9, 8 / 9.}, {100, 104, 8 / 26.}};
    (void)state;
    for (size_t i = 0; i < sizeof lenses / sizeof lenses[0]; i++) {
        for (int k = 0; k < 4; k += 2) { /* fixed16, fixed24 */
            struct bench b;
            bench_open(&b, formats[k], lenses[i].near_z, lenses[i].far_z);
            const double first = code_at(&b, b.projection.far_z, 0, 3), last = code_at(&b, b.projection.near_z, 0, 3);
            const double top = ph_depth_bytes(b.format) == 4 ? 16777216 : 65536;
            assert_true(first >= top * 16 / 65536 && first <= top * 17 / 65536);
            assert_true(last - first >= top * (511. / 512) * lenses[i].share * .9999 - 1);
            assert_true(last - first <= top * (511. / 512) * lenses[i].share * 1.0001 + 1);
            rig_close(&b.rig);
        }
    }
}

/* ---- leaning quads ---------------------------------------------------------------------------------------------- */

/*
 * How far the distance read in the middle of a leaning quad leaves the interval of its code. The 1/256 px of the
 * corners allow for s_xy tan(lean) of the minimum triangle separation (Akeley and Su, 2006): sqrt(2) 2^-8 px. (Beyond
 * some 1/16 of the distance per pixel set-up flattens a surface: see depth.h.)
 */
static double miss_of(struct bench *b, fx_t w, double lean, double pixels, double *allowed)
{
    const uint32_t code = code_at(b, w, lean, pixels);
    const double pixel = 2 * sqrt(1. / 3) / SIZE * w * LSB; /* size of a pixel at w */
    const double farthest = distance_of(b, code - depth_tolerance(b->format));
    const double nearest = distance_of(b, code + 1 + depth_tolerance(b->format));
    *allowed = sqrt(2) / 256 * pixel * fabs(lean) + LSB;
    return fmax(fmax(nearest - w * LSB, w * LSB - farthest), 0);
}

static void leaning_quads_are_off_by_no_more_than_their_corners(void **state)
{
    (void)state;
    ref_seed(24);
    for (int i = 0; i < 10000; i++) {
        const struct option_depth format = formats[i % FORMATS];
        struct bench b;
        double allowed;
        bench_open(&b, format, i & 1 ? .1 : .5, i & 1 ? 1000 : 100);
        const fx_t w = ref_q16(exp(ref_uniform(log(1), log(80))));
        const double lean = (i & 2 ? 1 : -1) * exp(ref_uniform(log(1e-4), log(.8))),
                     miss = miss_of(&b, w, lean, ref_uniform(3, 12), &allowed);
        if (miss > allowed) {
            fail_msg("%s at %g leaning %g: off by %g, allowed %g", name_of(format), w * LSB, lean, miss, allowed);
        }
        rig_close(&b.rig);
    }
}

/* ---- the choice -------------------------------------------------------------------------------------------------- */

static const struct ph_depth_format *chosen(uint8_t kind, fx_t near_z, fx_t far_z)
{
    const struct ph_projection p = {.kind = kind, .near_z = near_z, .far_z = far_z};
    return ph_depth_choose(&p);
}

static void fixed16_is_chosen_up_to_64_times_near(void **state)
{
    (void)state;
    assert_ptr_equal(chosen(PH_PERSPECTIVE, FX_ONE, FX_INT(64)), PH_DEPTH_FIXED16);
    assert_ptr_equal(chosen(PH_PERSPECTIVE, FX_ONE, FX_INT(64) + 1), PH_DEPTH_FLOAT16);
    assert_ptr_equal(chosen(PH_FISHEYE, FX_HALF, FX_INT(32)), PH_DEPTH_FIXED16);
    assert_ptr_equal(chosen(PH_FISHEYE, FX_HALF, FX_INT(33)), PH_DEPTH_FLOAT16);
    assert_ptr_equal(chosen(PH_PERSPECTIVE, FX_INT(30000), FX_MAX), PH_DEPTH_FIXED16);
    assert_ptr_equal(chosen(PH_PERSPECTIVE, 1, FX_MAX), PH_DEPTH_FLOAT16);
    assert_ptr_equal(chosen(PH_ORTHOGRAPHIC, FX_MIN, FX_MAX), PH_DEPTH_FIXED16);
}

/* Ulrich's band: a step of more than 1/1000 of the distance invites fighting. */
static void fixed16_resolves_a_thousandth_up_to_there_and_no_further(void **state)
{
    static const double ratios[2] = {PH_DEPTH_FIXED16_RATIO, 68};
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct bench b;
        bench_open(&b, formats[0], 1, ratios[i]);
        double worst = 0;
        for (int k = 0; k < 100; k++) {
            const double z = 1.01 * pow(ratios[i] * .98, k / 100.);
            worst = fmax(worst, longest_plateau(&b, z, 1) / z);
        }
        worst = fmax(worst, longest_plateau(&b, ratios[i] * .996, 3) / ratios[i]);
        print_message("    far = %.0f near: worst step %.3g of the distance\n", ratios[i], worst);
        assert_true(i == 0 ? worst <= 1e-3 : worst > 1e-3);
        rig_close(&b.rig);
    }
}

/* The longest plateau with a number of bits of exponent; far is 1000 m. */
static double worst_with(uint8_t exponent, double ratio)
{
    struct bench b;
    bench_open(&b, (struct option_depth){PH_DEPTH_FLOAT16, exponent}, 1000 / ratio, 1000);
    const double worst = worst_plateau(&b);
    rig_close(&b.rig);
    return worst;
}

/* Where two counts of bits are equally good (the saw-tooth of a float makes 1/4 of difference), either is chosen. */
static void a_float_has_the_bits_of_exponent_that_resolve_most(void **state)
{
    static const double ratios[] = {2, 10, 40, 64, 100, 1000, 10000, 16384, 40000, 1e6, 6e7};
    (void)state;
    for (size_t i = 0; i < sizeof ratios / sizeof ratios[0]; i++) {
        double least = HUGE_VAL;
        for (uint8_t exponent = 3; exponent <= 6; exponent++) {
            least = fmin(least, worst_with(exponent, ratios[i]));
        }
        const double chosen_worst = worst_with(0, ratios[i]);
        print_message("    far = %.0f near: S_worst %.3g m, the best %.3g m\n", ratios[i], chosen_worst, least);
        assert_true(chosen_worst <= 1.25 * least);
    }
}

/* Format and bits of exponent that a frame says it has. */
static void frame_has(struct ph_renderer *r, const struct ph_projection *p, unsigned asked,
                      const struct ph_depth_format *format, int exponent)
{
    r->config.depth_exponent = (uint8_t)asked;
    assert_int_equal(ph_frame_begin(r, &ph_xform_identity, p, NULL, 0), PH_OK);
    assert_ptr_equal(r->stats.depth_format, format);
    assert_int_equal(r->stats.depth_exponent, exponent);
}

static void bits_of_exponent_are_the_lens_s_or_as_asked(void **state)
{
    struct bench b;
    struct ph_projection p = {.kind = PH_ORTHOGRAPHIC};
    (void)state;
    bench_open(&b, formats[1], 1, 64);
    struct ph_renderer *r = &b.rig.r;
    frame_has(r, &b.projection, 0, PH_DEPTH_FLOAT16, 3);
    frame_has(r, &b.projection, 6, PH_DEPTH_FLOAT16, 6);
    assert_int_equal(ph_projection_perspective(&p, FX_INT(60), FX_ONE, FX_ONE, FX_INT(64) + 1), PH_OK);
    frame_has(r, &p, 0, PH_DEPTH_FLOAT16, 4);
    p.far_z = FX_INT(16384);
    frame_has(r, &p, 0, PH_DEPTH_FLOAT16, 4);
    p.far_z++;
    frame_has(r, &p, 0, PH_DEPTH_FLOAT16, 5);
    assert_int_equal(ph_frame_camera(r, &ph_xform_identity, &b.projection), PH_OK);
    assert_int_equal(r->stats.depth_exponent, 5); /* a second camera keeps them */
    frame_has(r, &p, 3, PH_DEPTH_FLOAT16, 3);
    r->config.depth_format = PH_DEPTH_AUTO;
    frame_has(r, &p, 6, PH_DEPTH_FLOAT16, 6);
    frame_has(r, &b.projection, 6, PH_DEPTH_FIXED16, 0); /* no float */
    p = b.projection;
    p.kind = PH_ORTHOGRAPHIC;
    r->config.depth_format = PH_DEPTH_FLOAT16;
    frame_has(r, &p, 0, PH_DEPTH_FLOAT16, 3);
    for (unsigned bits = 0; bits <= 8; bits++) {
        struct ph_renderer other;
        struct ph_config config = b.rig.r.config;
        config.depth_exponent = (uint8_t)bits;
        assert_int_equal(ph_renderer_init(&other, &config), bits == 0 || (bits >= 3 && bits <= 6) ? 0 : PH_ERR_INVAL);
    }
    rig_close(&b.rig);
}

static void auto_chooses_in_each_frame_and_a_second_camera_keeps_it(void **state)
{
    struct bench b;
    struct ph_projection deep;
    (void)state;
    bench_open(&b, (struct option_depth){PH_DEPTH_AUTO, 0}, 1, 10);
    struct ph_renderer *r = &b.rig.r;
    assert_int_equal(ph_projection_perspective(&deep, FX_INT(60), FX_ONE, FX_ONE, FX_INT(1000)), PH_OK);
    assert_int_equal(ph_frame_begin(r, &ph_xform_identity, &b.projection, NULL, 0), PH_OK);
    assert_ptr_equal(r->stats.depth_format, PH_DEPTH_FIXED16);
    assert_int_equal(ph_frame_camera(r, &ph_xform_identity, &deep), PH_OK);
    assert_ptr_equal(r->stats.depth_format, PH_DEPTH_FIXED16);
    assert_int_equal(ph_frame_begin(r, &ph_xform_identity, &deep, NULL, 0), PH_OK);
    assert_ptr_equal(r->stats.depth_format, PH_DEPTH_FLOAT16);
    assert_int_equal(ph_frame_camera(r, &ph_xform_identity, &b.projection), PH_OK);
    assert_ptr_equal(r->stats.depth_format, PH_DEPTH_FLOAT16);
    rig_close(&b.rig);
}

static void formats_take_two_or_four_bytes(void **state)
{
    static const size_t bytes[PH_DEPTH_FORMATS] = {2, 2, 2, 4, 4, 2};
    (void)state;
    for (int f = 0; f < PH_DEPTH_FORMATS; f++) {
        const struct ph_depth_format *const format = ph_depth_formats[f];
        assert_int_equal(ph_depth_bytes(format), bytes[f]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_traits_are_those_of_the_formulas),
        cmocka_unit_test(formats_resolve_what_the_table_says),
        cmocka_unit_test(vertices_get_the_codes_of_the_definition),
        cmocka_unit_test(codes_never_rise_with_distance),
        cmocka_unit_test(the_fixed_formats_use_all_codes_of_near_ranges),
        cmocka_unit_test(leaning_quads_are_off_by_no_more_than_their_corners),
        cmocka_unit_test(fixed16_is_chosen_up_to_64_times_near),
        cmocka_unit_test(fixed16_resolves_a_thousandth_up_to_there_and_no_further),
        cmocka_unit_test(a_float_has_the_bits_of_exponent_that_resolve_most),
        cmocka_unit_test(bits_of_exponent_are_the_lens_s_or_as_asked),
        cmocka_unit_test(auto_chooses_in_each_frame_and_a_second_camera_keeps_it),
        cmocka_unit_test(formats_take_two_or_four_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
