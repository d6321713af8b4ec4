/* model_camera: the view and the lens of a glTF camera, by hand: axes and eye in the fitted model, 1 / tan(fov / 2). */
#include "model_camera.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define Q30 (1 << 30)
#define Q20 (1 << 20)
#define Q16 65536

static double upright[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
static const struct model_fit as_it_is = {.scale = 1};
static struct model_shared shared;
static struct model_scene scene;

/* Five in front of the unit sphere, half as wide as it is far away: 1 / tan(fov / 2) is 2. */
static int fresh(void **state)
{
    (void)state;
    memset(&shared, 0, sizeof shared);
    scene = (struct model_scene){.camera_count = 1,
                                 .camera = {.name = "eye",
                                            .node = 0,
                                            .position = {0, 0, 5},
                                            .forward = {0, 0, -1},
                                            .up = {0, 1, 0},
                                            .fov_x = (float)(2 * atan(.5)),
                                            .aspect = 1.5f}};
    return 0;
}

static const struct demo_eye *read_at(double place[3][4], const struct model_fit *fit)
{
    const struct model_places places = {.nodes = (double(*)[3][4])place};
    model_camera_read(&shared, &scene, &places, fit);
    return shared.model.has_camera ? &shared.model.camera : NULL;
}

static const struct demo_eye *read_camera(void)
{
    return read_at(upright, &as_it_is);
}

static void assert_view(const struct ph_xform *view, const int r[3][3], double x, double y, double z)
{
    for (int i = 0; i < 9; i++) {
        assert_int_equal(view->r[i / 3][i % 3], r[i / 3][i % 3] * Q30);
    }
    assert_true(view->t.x == x * Q16 && view->t.y == y * Q16 && view->t.z == z * Q16);
}

static void a_camera_before_the_model_has_its_axes_and_planes_at_the_sphere(void **state)
{
    static const int ones[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    (void)state;
    const struct demo_eye *eye = read_camera();
    assert_non_null(eye);
    assert_view(&eye->view, ones, 0, 0, -5);
    assert_int_equal(eye->lens.kind, PH_PERSPECTIVE);
    assert_in_range(eye->lens.scale_x_q20, 2 * Q20 - 1, 2 * Q20 + 1);
    assert_in_range(eye->lens.scale_y_q20, 3 * Q20 - 1, 3 * Q20 + 1);
    assert_int_equal(eye->lens.near_z, 262078); /* 5 - 1.001, rounded */
    assert_int_equal(eye->lens.far_z, 393282);
    assert_int_equal(shared.note[0], 0);
}

/* The node turns a quarter about y, and stands at (7 2 3); the model's centre is (1 2 3), and it is halved. Its up has
 * a part along the view, and no axis has length one. */
static void the_node_turns_the_camera_and_the_fit_moves_it(void **state)
{
    double place[3][4] = {{0, 0, 1, 7}, {0, 1, 0, 2}, {-1, 0, 0, 3}};
    static const int turned[3][3] = {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
    const struct model_fit fit = {.centre = {1, 2, 3}, .scale = .5};
    (void)state;
    memcpy(scene.camera.position, (float[3]){0, 4, 0}, sizeof scene.camera.position);
    memcpy(scene.camera.forward, (float[3]){0, 0, -3}, sizeof scene.camera.forward);
    memcpy(scene.camera.up, (float[3]){0, 7, -5}, sizeof scene.camera.up);
    const struct demo_eye *eye = read_at(place, &fit);
    assert_non_null(eye);
    assert_view(&eye->view, turned, 0, -2, -3);
    memcpy(scene.camera.position, (float[3]){-2, 4, 0}, sizeof scene.camera.position); /* two to its left */
    assert_view(&read_at(place, &fit)->view, turned, 1, -2, -3);
}

static void planes_of_the_file_are_taken_where_they_are_closer(void **state)
{
    (void)state;
    scene.camera.near_z = 4.5f;
    scene.camera.far_z = 5.5f;
    assert_int_equal(read_camera()->lens.near_z, 4.5 * Q16);
    assert_int_equal(read_camera()->lens.far_z, 5.5 * Q16);
    scene.camera.near_z = 1;
    scene.camera.far_z = 100;
    assert_int_equal(read_camera()->lens.near_z, 262078);
    assert_int_equal(read_camera()->lens.far_z, 393282);
    scene.camera.position[2] = .5f; /* in the sphere */
    assert_int_equal(read_camera()->lens.near_z, Q16);
    scene.camera.near_z = 0;
    assert_int_equal(read_camera()->lens.near_z, Q16 / 1024);
    assert_int_equal(read_camera()->lens.far_z, 98370); /* .5 + 1.001 */
    const struct model_fit half = {.scale = .5};
    scene.camera.position[2] = 10;
    scene.camera.near_z = 9;
    scene.camera.far_z = 11;
    assert_int_equal(read_at(upright, &half)->lens.near_z, 4.5 * Q16);
    assert_int_equal(read_at(upright, &half)->lens.far_z, 5.5 * Q16);
}

static void an_orthographic_camera_has_its_width_in_the_fitted_model(void **state)
{
    const struct model_fit half = {.scale = .5};
    (void)state;
    scene.camera.half_width = 4;
    scene.camera.aspect = 2;
    const struct demo_eye *eye = read_at(upright, &half);
    assert_int_equal(eye->lens.kind, PH_ORTHOGRAPHIC);
    assert_int_equal(eye->lens.scale_x_q20, Q20 / 2);
    assert_int_equal(eye->lens.scale_y_q20, Q20);
    scene.camera.half_width = 1 / 1024.f;
    scene.camera.aspect = 1;
    assert_int_equal(read_camera()->lens.scale_x_q20, 1024 * Q20);
    scene.camera.half_width = 1 / 2048.f; /* does not fit into Q12.20 */
    assert_null(read_camera());
    scene.camera.half_width = 1 / 1024.f;
    scene.camera.aspect = 2; /* its height does not */
    assert_null(read_camera());
}

static void without_an_aspect_the_height_is_that_of_the_width(void **state)
{
    (void)state;
    scene.camera.aspect = 0;
    assert_int_equal(read_camera()->lens.scale_x_q20, 0);
    assert_in_range(read_camera()->lens.scale_y_q20, 2 * Q20 - 1, 2 * Q20 + 1);
}

static void a_camera_that_cannot_see_is_noted(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        fresh(NULL);
        if (k == 0) { /* it has no direction */
            memcpy(scene.camera.up, (float[3]){1e-12f, 0, 2}, sizeof scene.camera.up);
        } else if (k == 1) { /* it looks away */
            scene.camera.forward[2] = 1;
        } else if (k == 2) {
            scene.camera.position[0] = 10001;
        } else {
            scene.camera.far_z = 3;
        }
        assert_null(read_camera());
        assert_string_equal(shared.note, "camera eye does not see the model, and is ignored");
    }
    fresh(NULL);
    scene.camera.position[0] = 9990;
    assert_non_null(read_camera());
}

static void the_first_of_several_is_taken_and_one_without_a_node_is_not(void **state)
{
    (void)state;
    scene.camera_count = 0;
    assert_null(read_camera());
    assert_string_equal(shared.note, "");
    scene.camera_count = 3;
    assert_non_null(read_camera());
    assert_string_equal(shared.note, "of 3 cameras the first is used");
    fresh(NULL);
    scene.camera.node = MODEL_NONE;
    assert_null(read_camera());
    assert_string_equal(shared.note, "camera eye stands in no node and is ignored");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_camera_before_the_model_has_its_axes_and_planes_at_the_sphere, fresh),
        cmocka_unit_test_setup(the_node_turns_the_camera_and_the_fit_moves_it, fresh),
        cmocka_unit_test_setup(planes_of_the_file_are_taken_where_they_are_closer, fresh),
        cmocka_unit_test_setup(an_orthographic_camera_has_its_width_in_the_fitted_model, fresh),
        cmocka_unit_test_setup(without_an_aspect_the_height_is_that_of_the_width, fresh),
        cmocka_unit_test_setup(a_camera_that_cannot_see_is_noted, fresh),
        cmocka_unit_test_setup(the_first_of_several_is_taken_and_one_without_a_node_is_not, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
