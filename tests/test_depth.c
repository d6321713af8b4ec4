/*
 * What the depth formats resolve, through the real vertices, set-up and spans: quads that face the camera or lean are
 * drawn into a picture of 33 x 33 pixels, whose middle pixel has its centre on the axis, and the depth buffer is read.
 *
 * S(w) is the longest plateau: how many steps of the Q16.16 distance have the code of w. Expected values are those of
 * the project's table of published and computed resolutions, or computed here in double from the formats' definition.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "options.h"
#include "ref_random.h"
#include "ref_rig.h"

#include <math.h>
#include <stdio.h>

#define SIZE   33
#define MIDDLE (SIZE / 2 * SIZE + SIZE / 2)
#define LSB    (1. / 65536)

/* A camera with one of the formats. */
struct bench {
    struct rig rig;
    enum ph_depth_format format;
    struct ph_projection projection;
    double near_z, far_z; /* as Q16.16 has them */
};

static void bench_open(struct bench *b, enum ph_depth_format format, double near_z, double far_z)
{
    rig_open(&b->rig, SIZE, SIZE, SIZE, format, 4, 2);
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

/* The longest plateau of the format on 200 distances, the far end and the near side of every octave of the float. */
static double worst_plateau(struct bench *b)
{
    const double n = b->near_z * (1 - 1. / 512), f = b->far_z;
    double worst = 0;
    for (int i = 0; i < 200; i++) {
        const double w = b->near_z * pow(f / b->near_z, (i + .5) / 200);
        worst = fmax(worst, longest_plateau(b, w, 2));
    }
    for (int octave = 1; octave <= 15; octave++) {
        const double w = n / (ldexp(1, -octave) * 1.002 + n / f);
        worst = w < b->near_z ? worst : fmax(worst, longest_plateau(b, w, 2));
    }
    const double last = rig_format_distance(b->format, code_at(b, b->projection.far_z, 0, 3) + 6, b->near_z, f);
    return fmax(worst, longest_plateau(b, fmin(last, f), 8));
}

/* The project's table: S_worst in metres. */
static const struct {
    enum ph_depth_format format;
    double near_z, far_z, worst;
} table[] = {
    {PH_DEPTH_FIXED16, .1, 1000, 126},   {PH_DEPTH_FLOAT16, .1, 1000, .074},   {PH_DEPTH_FIXED24, .1, 1000, .596},
    {PH_DEPTH_FLOAT24, .1, 1000, 3e-4},  {PH_DEPTH_LINEAR_W, .1, 1000, .0153}, {PH_DEPTH_FIXED16, .5, 100, .303},
    {PH_DEPTH_FLOAT16, .5, 100, .0058},  {PH_DEPTH_LINEAR_W, .5, 100, .0015},  {PH_DEPTH_FIXED24, 1, 1000, .060},
    {PH_DEPTH_FLOAT24, 1, 1000, 2.4e-4},
};

static void formats_resolve_what_the_table_says(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        struct bench b;
        bench_open(&b, table[i].format, table[i].near_z, table[i].far_z);
        const double worst = worst_plateau(&b);
        print_message("    %-8s n %.1f f %4.0f: S_worst %.3g m, table %.3g m, ratio %.3f\n",
                      options_depth_name((uint8_t)table[i].format), table[i].near_z, table[i].far_z, worst,
                      table[i].worst, worst / table[i].worst);
        assert_true(worst <= table[i].worst * 1.05);
        assert_true(worst >= table[i].worst * .8);
        rig_close(&b.rig);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formats_resolve_what_the_table_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
