/*
 * solar: where every camera is and what it looks at, from the orbits in double precision. A year is 1024 frames, 8
 * months and 32 days; the earth's axis leans by 23.4 degrees. (K. Juenemann, HAW Hamburg, chapter 9: the camera is an
 * object of the scene; the view is the inverse of its world matrix.)
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "demo_stage.h"

#include <math.h>

struct place {
    double v[3];
};

/* v turned by `years` about the y axis, counter-clockwise from above. */
static struct place turned(struct place p, double years)
{
    const double a = 2 * acos(-1) * years, *const v = p.v;
    return (struct place){{v[0] * cos(a) + v[2] * sin(a), v[1], v[2] * cos(a) - v[0] * sin(a)}};
}

static struct place leant(struct place p)
{
    const double a = 23.4 / 180 * acos(-1), *const v = p.v;
    return (struct place){{v[0] * cos(a) - v[1] * sin(a), v[0] * sin(a) + v[1] * cos(a), v[2]}};
}

/* Row `row` of the camera's frame in the world (0 right, 1 up, 2 backwards) is +-want, and is a unit vector. */
static void assert_axis(const struct demo_stage *s, int row, double sign, struct place want)
{
    for (int k = 0; k < 3; k++) {
        const double is = ldexp(s->rig.r.view.r[row][k], -30);
        if (fabs(is - sign * want.v[k]) > 1e-6) {
            fail_msg("%s: axis %d is %f, not %f", s->context.view, row, is, sign * want.v[k]);
        }
    }
}

static void every_view_looks_at_what_its_name_says(void **state)
{
    (void)state;
    const struct place x = {{1, 0, 0}}, y = {{0, 1, 0}};
    struct demo_stage s = demo_stage_open(demo_find("solar"), 64, 64);
    for (uint32_t frame = 0; frame < 1024; frame += 7) {
        const double years = frame / 1024.0;
        const struct place out = turned(x, years); /* from the sun to the earth */
        const struct {
            const char *name;
            double sign;
            struct place at, up;
        } views[] = {
            {"sun", -1, out, y},
            {"moon", 1, turned(x, 8 * years), y},
            {"fixed", 1, turned(leant(turned(x, 31 * years)), years), turned(leant(y), years)},
        };
        for (int i = 0; i < 3; i++) {
            s.context.view = views[i].name;
            demo_stage_frame(&s, frame);
            const struct ph_xform eye = ph_xform_inverse_rigid(&s.rig.r.view);
            assert_true(fabs(eye.t.x / 65536.0 - 4 * out.v[0]) < 6e-5 && eye.t.y == 0 &&
                        fabs(eye.t.z / 65536.0 - 4 * out.v[2]) < 6e-5);
            assert_axis(&s, 2, -views[i].sign, views[i].at);
            assert_axis(&s, 1, 1, views[i].up);
        }
    }
    demo_stage_close(&s);
}

/* In the sun's and in the moon's view it is in the middle of the picture in every frame. */
static void sun_and_moon_stand_still_in_their_views(void **state)
{
    (void)state;
    static const char *const names[2] = {"sun", "moon"};
    struct demo_stage s = demo_stage_open(demo_find("solar"), 101, 101);
    for (uint32_t i = 0; i < 128; i++) {
        s.context.view = names[i % 2];
        demo_stage_frame(&s, i * 8);
        assert_int_not_equal(pixel(&s, 50, 50), s.rig.r.background);
    }
    demo_stage_close(&s);
}

/* 87 px is the focal length, and the sun's outline at asin(1/4): 22 px from the middle. */
static void the_sun_s_glow_fades_into_the_sky(void **state)
{
    (void)state;
    struct demo_stage s = demo_stage_open(demo_find("solar"), 101, 101);
    s.context.view = "sun";
    demo_stage_frame(&s, 3);
    int before = 255;
    for (int x = 74; x < 92; x++) {
        const int red = (uint8_t)pixel(&s, x, 50) & 0xF8; /* wire order: red comes first in memory */
        assert_true(red <= before);
        before = red;
    }
    assert_true(((uint8_t)pixel(&s, 74, 50) & 0xF8) > 150 && before < 16);
    demo_stage_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_view_looks_at_what_its_name_says),
        cmocka_unit_test(sun_and_moon_stand_still_in_their_views),
        cmocka_unit_test(the_sun_s_glow_fades_into_the_sky),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
