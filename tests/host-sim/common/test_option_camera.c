/* option_camera: which keys make which textbook's view, what is left out, and what is refused. The views themselves are
 * those of camera.h, which has tests of its own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "camera.h"
#include "option_camera.h"

#include <string.h>

static struct fx_vec3 at(int x, int y, int z)
{
    return (struct fx_vec3){FX_INT(x), FX_INT(y), FX_INT(z)};
}

static void expect(const char *text, struct ph_xform view, fx_t distance)
{
    struct option_camera camera = {0};
    assert_true(option_camera_read(text, &camera));
    assert_true(camera.set);
    assert_memory_equal(&camera.view, &view, sizeof view);
    assert_int_equal(camera.distance, distance);
}

static void an_eye_looks_at_its_target(void **state)
{
    (void)state;
    expect("eye=3,4,12", ph_view_look_at(at(3, 4, 12), at(0, 0, 0), at(0, 1, 0)), FX_INT(13));
    expect("eye=3,4,12,target=3,1,8", ph_view_look_at(at(3, 4, 12), at(3, 1, 8), at(0, 1, 0)), FX_INT(5));
    expect("up=1,0,0,eye=0,0,-7", ph_view_look_at(at(0, 0, -7), at(0, 0, 0), at(1, 0, 0)), FX_INT(7));
    expect("target=1,2,2,up=0,0,1,eye=2,4,4", ph_view_look_at(at(2, 4, 4), at(1, 2, 2), at(0, 0, 1)), FX_INT(3));
}

static void phigs_has_a_reference_point_and_two_vectors(void **state)
{
    (void)state;
    expect("vrp=3,2,5,vpn=3,2,5", ph_view_phigs(at(3, 2, 5), at(3, 2, 5), at(0, 1, 0)), FX_INT(3));
    expect("vpn=1,0,0,vup=0,0,1,vrp=3,2,5", ph_view_phigs(at(3, 2, 5), at(1, 0, 0), at(0, 0, 1)), FX_INT(3));
}

static void angles_are_degrees(void **state)
{
    (void)state;
    const uint32_t turn = 1u << 31; /* half a turn, 180 degrees */
    expect("ypr=90,45,-90", ph_view_yaw_pitch_roll(at(0, 0, 0), turn / 2, turn / 4, 0u - turn / 2), FX_INT(3));
    expect("eye=1,2,3,ypr=0,90,180", ph_view_yaw_pitch_roll(at(1, 2, 3), 0, turn / 2, turn), FX_INT(3));
}

static void a_quaternion_may_have_any_length(void **state)
{
    (void)state;
    const struct fx_quat y180 = {0, 0, FX_ONE, 0}, none = {FX_ONE, 0, 0, 0};
    expect("quat=0,0,1,0,eye=1,2,3", ph_view_quat(y180, at(1, 2, 3)), FX_INT(3));
    expect("quat=0,0,4,0", ph_view_quat(y180, at(0, 0, 0)), FX_INT(3));
    expect("quat=2,0,0,0", ph_view_quat(none, at(0, 0, 0)), FX_INT(3));
    expect("quat=0,0,0,1", ph_view_quat((struct fx_quat){0, 0, 0, FX_ONE}, at(0, 0, 0)), FX_INT(3));
}

static void what_is_no_view_is_refused_and_nothing_changes(void **state)
{
    (void)state;
    static const char *const wrong[] = {"",
                                        "eye",
                                        "eye=",
                                        "eye=1,2",
                                        "eye=1,2,3,",
                                        "eye=1,2,3,4",
                                        "eye=1,2,3 ",
                                        "eye=1,2,3;up=0,1,0",
                                        "eye=1,2,3,eye=1,2,3",
                                        "target=1,2,3",
                                        "up=0,1,0",
                                        "eye=1,2,3,vup=0,1,0",
                                        "eye=1,2,3,vrp=1,2,3",
                                        "eye=1,2,3,vpn=1,2,3",
                                        "vrp=1,2,3",
                                        "vpn=1,2,3",
                                        "vup=0,1,0",
                                        "vrp=1,2,3,vpn=0,0,1,eye=1,2,3",
                                        "vrp=1,2,3,vpn=0,0,1,up=0,1,0",
                                        "ypr=1,2",
                                        "ypr=1,2,3,target=0,0,0",
                                        "ypr=1,2,3,quat=1,0,0,0",
                                        "quat=1,0,0",
                                        "quat=0,0,0,0",
                                        "quat=1,0,0,0,up=0,1,0",
                                        "roll=1,2,3",
                                        "EYE=1,2,3"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        struct option_camera camera, before;
        memset(&camera, 0x5a, sizeof camera);
        before = camera;
        assert_false(option_camera_read(wrong[i], &camera));
        assert_memory_equal(&camera, &before, sizeof camera);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_eye_looks_at_its_target),
        cmocka_unit_test(phigs_has_a_reference_point_and_two_vectors),
        cmocka_unit_test(angles_are_degrees),
        cmocka_unit_test(a_quaternion_may_have_any_length),
        cmocka_unit_test(what_is_no_view_is_refused_and_nothing_changes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
