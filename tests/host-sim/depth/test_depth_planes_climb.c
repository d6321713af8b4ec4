/*
 * depth_planes_climb: what the search finds wrong against what depth_separation.h calls enough. It never finds more,
 * for lenses, pictures and planes that nobody has chosen; and where the bound is known to be close it comes close.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "depth_planes_climb.h"
#include "depth_separation.h"
#include "ref_random.h"

#include <math.h>
#include <stdio.h>

#define LENSES 40

static struct depth_lab lab_of(double near_m, double far_m, double fov_deg, int width, int height)
{
    return (struct depth_lab){.near_z = ref_q16(near_m),
                              .far_z = ref_q16(far_m),
                              .fov_deg = ref_q16(fov_deg),
                              .width = (uint16_t)width,
                              .height = (uint16_t)height};
}

static double bound_of(const struct depth_lab *lab, const struct ph_depth_format *format, struct planes_lean lean)
{
    return depth_separation_m(format, lab, lean.at_m, fabs(lean.tilt_deg), depth_way_px(lab));
}

static double found_with(const struct depth_lab *lab, const struct ph_depth_format *format, struct planes_lean lean)
{
    struct planes_canvas canvas;
    assert_int_equal(depth_planes_open(&canvas, lab, format), 0);
    const double found = depth_planes_climb_m(&canvas, lean, bound_of(lab, format, lean));
    depth_planes_close(&canvas);
    return found;
}

static void no_lens_exceeds_its_bound(void **state)
{
    int found_some = 0;
    double closest = 0;
    (void)state;
    ref_seed(2025);
    for (int i = 0; i < LENSES; i++) {
        const double near_m = 0.05 * pow(400, ref_uniform(0, 1));
        const double far_m = fmin(near_m * 1.3 * pow(10000, ref_uniform(0, 1)), 16000);
        const int height = (int)(16 * pow(64, ref_uniform(0, 1))), width = (int)(16 * pow(64, ref_uniform(0, 1)));
        const struct depth_lab lab = lab_of(near_m, far_m, ref_uniform(20, 110), width, height);
        const double tilt = ref_uniform(0, 1) < 0.3 ? 90 - pow(10, ref_uniform(-1, 1)) : ref_uniform(0.1, 89);
        const struct planes_lean lean = {near_m * pow(far_m / near_m, ref_uniform(0.1, 1)), i % 2 == 0 ? tilt : -tilt,
                                         i % 3 == 0 ? NAN : ref_uniform(-360, 360)};
        for (int k = 1; k < PH_DEPTH_FORMATS; k++) {
            const double bound = bound_of(&lab, ph_depth_formats[k], lean);
            const double found = found_with(&lab, ph_depth_formats[k], lean);
            if (found > bound) {
                fail_msg("%s near %g far %g %dx%d at %g tilt %g azimuth %g: bound %g, found %g",
                         ph_depth_formats[k]->name, near_m, far_m, width, height, lean.at_m, lean.tilt_deg,
                         lean.azimuth_deg, bound, found);
            }
            found_some += found > 0;
            closest = fmax(closest, found / bound);
        }
    }
    printf("# found in %d of %d, at most %.3f of the bound\n", found_some, LENSES * (PH_DEPTH_FORMATS - 1), closest);
    assert_true(found_some > LENSES * (PH_DEPTH_FORMATS - 1) * 3 / 4 && closest > 0.9);
}

/* In each format at a tilt of 60 degrees, near .5, 4 and 50 m: how many times what is found the bound is at most. */
static void it_comes_close_to_the_bound(void **state)
{
    static const double near_m[] = {0.5, 4, 50};
    static const struct {
        const struct ph_depth_format *format;
        double times[3];
    } known[] = {{PH_DEPTH_FIXED16, {1.6, 1.3, 1.4}},
                 {PH_DEPTH_FLOAT16, {1.7, 1.7, 1.7}},
                 {PH_DEPTH_FIXED24, {1.8, 1.4, 1.2}},
                 {PH_DEPTH_FLOAT24, {1.9, 1.5, 1.4}},
                 {PH_DEPTH_LINEAR_W, {1.4, 1.4, 1.5}}};
    const struct planes_lean lean = {100, 60, NAN};
    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        for (size_t k = 0; k < sizeof near_m / sizeof near_m[0]; k++) {
            const struct depth_lab lab = lab_of(near_m[k], 100, 60, 240, 240);
            const double bound = bound_of(&lab, known[i].format, lean), found = found_with(&lab, known[i].format, lean);
            printf("# %s, near %g: bound %g m, found %g m, %.2f times\n", known[i].format->name, near_m[k], bound,
                   found, bound / found);
            assert_true(found <= bound && bound <= known[i].times[k] * found);
        }
    }
}

static void two_runs_find_the_same(void **state)
{
    const struct depth_lab lab = lab_of(1, 100, 60, 64, 48);
    const struct planes_lean lean = {50, 40, 30};
    const double found = found_with(&lab, PH_DEPTH_FLOAT16, lean);
    (void)state;
    assert_true(found > 0 && found == found_with(&lab, PH_DEPTH_FLOAT16, lean));
}

/* A camera before which no plane has room. */
static void without_room_nothing_is_found(void **state)
{
    const struct depth_lab lab = lab_of(40, 100, 60, 64, 48);
    (void)state;
    assert_true(found_with(&lab, PH_DEPTH_FIXED16, (struct planes_lean){40.0001, 60, 0}) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_lens_exceeds_its_bound),
        cmocka_unit_test(it_comes_close_to_the_bound),
        cmocka_unit_test(two_runs_find_the_same),
        cmocka_unit_test(without_room_nothing_is_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
