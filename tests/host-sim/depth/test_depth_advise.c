/* depth_advise: the near plane that a format's formula gives and that the bound decides, what is searched beside it,
 * what is advised and said. The test plays bound and search, and calculates the formulas of lab.h by itself. */
#define _XOPEN_SOURCE 700
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "depth_advise_scene.h"
#include "depth_planes_count.h"
#include "depth_separation.h"
#include "lab_search.h"
#include "stderr_capture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LSB  (1 / 65536.)
#define HEAD (511 / 512.) /* N of depth.h over the near plane, but for floats of 5 bits of exponent: 255 / 256 */

static struct depth_lab lab;
static fx_t enough[32]; /* by row: from this near plane on `bounded` LSBs are enough, else many */
static double bounded;
static uint32_t needs, needs_at, needs_there; /* found: at the distance needs_at it is needs_there */
static fx_t searched[64];
static unsigned searches, sweeps, scenes;
static double lean_m, lean_at_m, bound_tilt;
static int probe_status, open_status, is_open;
static char *csv;
static struct stderr_capture said;

/* ---- in place of the measurements ------------------------------------------------------------------------- */

int lab_probe_open(struct lab_probe *p, const struct lab_format *format, fx_t near_z, fx_t far_z)
{
    *p = (struct lab_probe){.format = format, .near_z = near_z, .far_z = far_z};
    return probe_status;
}

void lab_search_open(struct lab_search *s, struct lab_probe *p)
{
    assert_true(s != NULL && p->format != NULL);
}

uint32_t lab_search_at(struct lab_search *s, struct lab_probe *p, fx_t z)
{
    assert_true(s != NULL && z >= p->near_z && z <= p->far_z);
    searched[searches++ % 64] = z;
    return z == (fx_t)needs_at ? needs_there : needs;
}

int depth_planes_open(struct planes_canvas *canvas, const struct depth_lab *of, const struct ph_depth_format *format)
{
    *canvas = (struct planes_canvas){.lab = of};
    assert_true(format != NULL && of->near_z > 0);
    is_open++;
    return open_status;
}

void depth_planes_close(struct planes_canvas *canvas)
{
    assert_non_null(canvas->lab);
    is_open--;
}

struct planes_sweep depth_planes_sweep(struct planes_canvas *canvas, const struct ph_depth_format *format,
                                       struct planes_lean lean)
{
    assert_true(canvas->lab->far_z == lab.far_z && format != NULL && isnan(lean.azimuth_deg));
    lean_at_m = sweeps++ == 0 ? lean.at_m : lean_at_m;
    return (struct planes_sweep){.found_m = lean_m};
}

double depth_way_px(const struct depth_lab *of)
{
    return of->width;
}

double depth_separation_m(const struct ph_depth_format *format, const struct depth_lab *of, double z, double tilt_deg,
                          double way_px)
{
    const struct lab_format *row = lab_formats;
    while (row->format != format || row->kind != LAB_DRAWN || row->exponent != of->exponent) {
        row++;
    }
    assert_true(z == lab.at[0] * LSB && way_px == lab.width && of->far_z == lab.far_z);
    bound_tilt = tilt_deg;
    return (of->near_z < enough[row - lab_formats] ? 1 << 24 : bounded) * LSB;
}

uint32_t depth_separation_lsbs(double metres)
{
    return metres < 16384 ? (uint32_t)(metres * 65536) : UINT32_MAX;
}

int depth_advise_scene(const struct depth_lab *of)
{
    assert_true(of->demo == lab.demo && of->model == lab.model);
    scenes++;
    return 7;
}

/* ---- the tests ---------------------------------------------------------------------------------------------- */

static uint32_t row_of(const char *name)
{
    uint32_t i = 0;
    while (strcmp(lab_formats[i].name, name) != 0) {
        i++;
    }
    return i;
}

static void take(const char *a, const char *b)
{
    lab.formats = 1u << row_of(a) | (b != NULL ? 1u << row_of(b) : 0);
}

/* 10 m, with a far plane at 100 m, planes that face the camera. */
static int fresh(void **state)
{
    (void)state;
    lab = (struct depth_lab){.near_z = FX_HALF,
                             .far_z = FX_INT(100),
                             .formats = 1,
                             .width = 320,
                             .height = 240,
                             .fov_deg = FX_INT(60),
                             .tilt_set = true,
                             .azimuth_deg = FX_INT(30),
                             .separate = 655,
                             .at = {FX_INT(10)},
                             .at_count = 1};
    memset(enough, 0, sizeof enough);
    bounded = 300, needs = 100, needs_at = needs_there = 0;
    searches = sweeps = scenes = 0;
    probe_status = open_status = is_open = 0;
    lean_m = .001;
    return 0;
}

static int advise(void)
{
    free(csv);
    csv = NULL;
    searches = sweeps = 0;
    stderr_capture_begin(&said);
    const int status = depth_lab_capture(&lab, depth_advise, &csv);
    stderr_capture_end(&said);
    assert_int_equal(is_open, 0);
    return status;
}

static void says(const char *part)
{
    if (strstr(csv, part) == NULL) {
        fail_msg("'%s' is not in\n%s", part, csv);
    }
}

/* Cell `column` of the row of a format. */
static const char *cell(const char *format, int column)
{
    static char text[64];
    char begin[40];
    snprintf(begin, sizeof begin, "\n%s,", format);
    const char *at = strstr(csv, begin);
    assert_non_null(at);
    for (at++; column > 0; column--) {
        at = strchr(at, ',') + 1;
    }
    snprintf(text, sizeof text, "%.*s", (int)strcspn(at, ",\n"), at);
    return text;
}

enum { LEAST = 5, SAFE, NEAR_Z, ENOUGH, FOUND, TILT };

static void metres_are(const char *format, int column, double m)
{
    const double is = strtod(cell(format, column), NULL);
    if (fabs(is - m) > 1.01 * LSB) {
        fail_msg("%s: %s m, not %.9g", format, cell(format, column), m);
    }
}

/* A step of n f / (f - n) / 2^bits of the square of the distance; one LSB of the separation is left for the rounding.
 */
static double fixed_near(double z, double s, int bits)
{
    const double r = z * z / (HEAD * s * exp2(bits));
    return r * 100 / (100 + r);
}

static void formulas_give_the_near_plane_of_each_coding(void **state)
{
    const double z = 10 + 655 * LSB;
    (void)state;
    take("fixed16", "float16-e3");
    assert_int_equal(advise(), 0);
    metres_are("fixed16", LEAST, fixed_near(z, 654 * LSB, 16));
    metres_are("fixed16", SAFE, fixed_near(10 + 327 * LSB, 326 * LSB, 16));
    metres_are("float16-e3", LEAST, z * z / (HEAD * 654 * LSB * exp2(13 + 7)));
    take("float16", "fixed24");
    assert_int_equal(advise(), 0);
    metres_are("float16", LEAST, 256 * LSB); /* 4 bits of exponent would do with 5 LSBs: the least that is advised */
    metres_are("fixed24", LEAST, 256 * LSB);
    lab.at[0] = FX_INT(50), lab.separate = 65;
    take("linear-w", "float16-e5");
    bounded = 20;
    assert_int_equal(advise(), 0);
    metres_are("linear-w", LEAST, 100 - 64 * HEAD);
    assert_string_equal(cell("linear-w", SAFE), "none");    /* beyond 50 m */
    assert_string_equal(cell("float16-e5", LEAST), "none"); /* its 11 bits of mantissa step in 0.0122 m there */
    lab.separate = 1000;
    assert_int_equal(advise(), 0);
    metres_are("float16-e5", LEAST, 256 * LSB);
    lab.at[0] = FX_INT(90),
    lab.separate = 131; /* 2 mm; the step of 13 bits of mantissa is largest at half of far: 3.05 mm */
    take("float16-e3", NULL);
    assert_int_equal(advise(), 0);
    assert_string_equal(cell("float16-e3", LEAST), "none");
}

/* What the formula gives is tried, and then a hundredth more until it is enough. */
static void near_plane_grows_until_it_is_enough(void **state)
{
    (void)state;
    enough[0] = FX_HALF;
    assert_int_equal(advise(), 0);
    const double least = strtod(cell("fixed16", LEAST), NULL);
    assert_true(least >= .5 && least < .5051);
    enough[0] = FX_INT(10);
    assert_int_equal(advise(), 0);
    assert_string_equal(cell("fixed16", LEAST), "none");
    assert_string_equal(cell("fixed16", SAFE), "none");
    says("# To separate 0.01 m at every distance up to 10 m with fixed16 (16 bits): no near plane does it.\n");
    says("#! No format separates 0.01 m up to 10 m at a tilt of 0 degrees: make the separation larger, or bring far "
         "nearer.\n");
    enough[0] = 0;
    bounded = 655;
    assert_int_equal(advise(), 0);
    metres_are("fixed16", LEAST, fixed_near(10 + 655 * LSB, 654 * LSB, 16));
    assert_string_equal(cell("fixed16", SAFE), "none");
    says(" or more; none leaves a margin: none separates half of that.\n");
    bounded = 656;
    assert_int_equal(advise(), 0);
    assert_string_equal(cell("fixed16", LEAST), "none");
    probe_status = PH_ERR_INVAL;
    assert_int_equal(advise(), 0);
    assert_string_equal(cell("fixed16", LEAST), "none");
}

/* At the distance, and one separation before and behind it. */
static void one_separation_around_the_distance_is_looked_at(void **state)
{
    (void)state;
    lab.separate = 0;
    assert_int_equal(advise(), 0);
    assert_true(searched[0] == FX_INT(10) && searched[1] == FX_INT(10) - 100 && searched[2] == FX_INT(10) + 100);
    assert_string_equal(cell("fixed16", NEAR_Z), "0.5");
    metres_are("fixed16", ENOUGH, 300 * LSB);
    metres_are("fixed16", FOUND, 100 * LSB);
    for (int side = -1; side <= 1; side++) {
        needs_at = (uint32_t)(FX_INT(10) + side * 100);
        needs_there = side == 0 ? 100 : 222;
        assert_int_equal(advise(), 0);
        metres_are("fixed16", ENOUGH, 300 * LSB);
        metres_are("fixed16", FOUND, needs_there * LSB);
    }
    needs = 1 << 22; /* 64 m: neither lies between the planes */
    needs_at = 0;
    lab.far_z = FX_INT(70);
    assert_int_equal(advise(), 0);
    metres_are("fixed16", FOUND, 64);
    needs = 39 << 14; /* 9.75 m: before the near plane, and behind the far one */
    lab.far_z = FX_INT(12);
    assert_int_equal(advise(), 0);
    metres_are("fixed16", FOUND, 9.75);
    lab.far_z = FX_INT(70), needs = 1 << 22;
    assert_int_equal(advise(), 0);
    says("# With the near plane at 0.5 m, fixed16 (16 bits) separates 0.00457764 m at every distance up to 10 m; "
         "what was found to be needed is 64 m.\n");
}

/* d = N/z - N/f of each octave's end is a power of two; up to 10 m that is 2^-1 .. 2^-4 of 0.5 / z - 0.5 / 100. */
static void float_is_measured_at_the_end_of_each_octave(void **state)
{
    (void)state;
    lab.separate = 0;
    take("float16-e3", NULL);
    assert_int_equal(advise(), 0);
    for (int octave = 1; octave <= 4; octave++) {
        const double head = .5 * HEAD, end = head / (exp2(-octave) + head / 100);
        unsigned i = 0;
        while (i < searches && fabs(searched[i] * LSB - end) > LSB) {
            i++;
        }
        assert_true(i < searches);
    }
    take("float16-e5", NULL); /* whose N is 255 / 256 of the near plane */
    assert_int_equal(advise(), 0);
    unsigned ends = 0;
    for (unsigned i = 0; i < searches && i < 64; i++) {
        ends += searched[i] == (fx_t)floor(.5 * 255 / 256 / (.5 + .5 * 255 / 256 / 100) / LSB);
    }
    assert_int_equal(ends, 1);
    take("float16-e3", NULL);
    needs_at = (uint32_t)floor(.5 * HEAD / (.25 + .5 * HEAD / 100) / LSB);
    needs_there = 200;
    assert_int_equal(advise(), 0);
    metres_are("float16-e3", FOUND, 200 * LSB);
    needs_at = (uint32_t)floor(.5 * HEAD / (1 / 32. + .5 * HEAD / 100) / LSB); /* 13.8 m */
    assert_int_equal(advise(), 0);
    metres_are("float16-e3", FOUND, 100 * LSB);
}

static void planes_that_lean_are_drawn_where_a_tilt_is_asked_for(void **state)
{
    const double moved = sqrt(2) * 2 * tan(acos(-1) / 6) / 240 / 256 * 10 / (2 * sqrt(2)) * sin(acos(-1) / 3);
    (void)state;
    lab.separate = 0;
    assert_int_equal(advise(), 0);
    assert_int_equal(sweeps, 0);
    assert_true(bound_tilt == 0);
    lab.tilt_set = false; /* 60 degrees */
    lean_m = .004;
    assert_int_equal(advise(), 0);
    assert_true(sweeps > 0 && lean_at_m == 10);
    metres_are("fixed16", ENOUGH, 300 * LSB);
    metres_are("fixed16", FOUND, .004);
    assert_true(bound_tilt == 60);
    assert_string_equal(cell("fixed16", TILT), "60");
    lean_m = .0001; /* less than what faces the camera takes */
    assert_int_equal(advise(), 0);
    metres_are("fixed16", FOUND, 100 * LSB);
    lean_m = HUGE_VAL; /* no room */
    assert_int_equal(advise(), 0);
    metres_are("fixed16", FOUND, 100 * LSB);
    lean_m = .004, open_status = COMPLAINED;
    assert_int_equal(advise(), 0);
    metres_are("fixed16", FOUND, 100 * LSB);
    open_status = 0, bounded = 16384 * 65536.;
    assert_int_equal(advise(), 0);
    says("# With the near plane at 0.5 m, fixed16 (16 bits) separates nothing up to there.\n");
    assert_string_equal(cell("fixed16", ENOUGH), "");
    bounded = 300;
    lab.separate = 655;
    assert_int_equal(advise(), 0); /* along the ray the separation is 1 / cos of what the sub-pixel grid leaves */
    metres_are("fixed16", LEAST, fixed_near(10 + 655 * LSB, fmin((655 * LSB - moved) * 2, 655 * LSB) - LSB, 16));
    lab.separate = 10;
    bounded = 1;
    assert_int_equal(advise(), 0);
    assert_string_equal(cell("fixed16", LEAST), "none");
    says("#! No format separates 0.00015 m up to 10 m at a tilt of 60 degrees: the sub-pixel grid of a picture 240 "
         "lines "
         "high alone moves planes there by up to 0.000163 m. More lines or a narrower --fov help.\n");
}

static void cheap_format_is_advised_where_its_near_plane_shows_something(void **state)
{
    (void)state;
    take("fixed16", "fixed24");
    assert_int_equal(advise(), 0);
    says("#! Take fixed16 (16 bits), and the largest near plane that the scene allows: from 0.15");
    says(" m on it is enough, from 0.30");
    says(" m on it leaves a margin, beyond 9.99 m it cuts the nearer of the two planes off.\n");
    enough[row_of("fixed16")] = FX_INT(10) / 16 + 1;
    assert_int_equal(advise(), 0);
    says("#! Take fixed24 (24 bits), and the largest near plane that the scene allows: from 0.0039 m on it is enough, "
         "with a margin, beyond ");
    enough[row_of("fixed24")] = FX_INT(1);
    assert_int_equal(advise(), 0);
    says("#! Take fixed16 ");
    take("fixed16", "float16"); /* as cheap: the smaller near plane */
    enough[row_of("fixed16")] = 0;
    assert_int_equal(advise(), 0);
    says("#! Take float16 ");
    enough[row_of("float16")] = FX_HALF;
    assert_int_equal(advise(), 0);
    says("#! Take fixed16 ");
    take("float24", "linear-w");
    lab.at[0] = FX_INT(90), lab.separate = 650;
    assert_int_equal(advise(), 0);
    says("#! Take float24 ");
    enough[row_of("float24")] = FX_INT(8);
    assert_int_equal(advise(), 0);
    says("#! Take linear-w ");
}

static void without_a_separation_the_renderers_own_choice_is_told(void **state)
{
    (void)state;
    lab.separate = 0;
    take("fixed16", "fixed24");
    assert_int_equal(advise(), 0);
    says("#! With the near plane at 0.5 m auto takes float16, which separates 0.00457764 m up to 10 m at any tilt up "
         "to 0 "
         "degrees.\n");
    assert_null(strstr(csv, "# To separate"));
    says("# A decal in the plane of its surface shows with depth_bias_slope 2 and depth_bias 2, in the float formats "
         "16.\n");
    assert_string_equal(cell("fixed16", LEAST), "");
    assert_string_equal(cell("fixed24", 1), "24");
    probe_status = PH_ERR_INVAL;
    assert_int_equal(advise(), 0);
    says("# With the near plane at 0.5 m, fixed16 (16 bits) cannot be drawn.\n");
    assert_null(strstr(csv, "#!"));
    probe_status = 0;
    lab.near_set = true;
    lab.separate = 655; /* both are answered */
    assert_int_equal(advise(), 0);
    says("# To separate");
    says("# With the near plane");
    lab.near_set = false;
    assert_int_equal(advise(), 0);
    assert_null(strstr(csv, "# With the near plane"));
}

static void what_cannot_be_answered_is_refused(void **state)
{
    (void)state;
    take("fixed16", "fixed24");
    lab.bits = 24;
    assert_int_equal(advise(), 0);
    assert_null(strstr(csv, "\nfixed16,"));
    take("fixed16", "ndc-q16");
    assert_int_equal(advise(), PH_ERR_INVAL);
    assert_non_null(strstr(said.text, "advise: none of these formats is drawn by the renderer"));
    lab.bits = 0;
    lab.separate = FX_INT(10);
    assert_int_equal(advise(), PH_ERR_INVAL);
    assert_non_null(strstr(said.text, "--separate must be less than --at"));
    lab.at_count = 2;
    assert_int_equal(advise(), PH_ERR_INVAL);
    assert_non_null(strstr(said.text, "advise needs --at Z, one distance"));
    lab.demo = "demo";
    assert_int_equal(advise(), 7);
    lab.demo = NULL;
    lab.model = "model";
    assert_int_equal(advise(), 7);
    assert_int_equal(scenes, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(formulas_give_the_near_plane_of_each_coding, fresh),
        cmocka_unit_test_setup(near_plane_grows_until_it_is_enough, fresh),
        cmocka_unit_test_setup(one_separation_around_the_distance_is_looked_at, fresh),
        cmocka_unit_test_setup(float_is_measured_at_the_end_of_each_octave, fresh),
        cmocka_unit_test_setup(planes_that_lean_are_drawn_where_a_tilt_is_asked_for, fresh),
        cmocka_unit_test_setup(cheap_format_is_advised_where_its_near_plane_shows_something, fresh),
        cmocka_unit_test_setup(without_a_separation_the_renderers_own_choice_is_told, fresh),
        cmocka_unit_test_setup(what_cannot_be_answered_is_refused, fresh),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    free(csv);
    return failed;
}
