/* sim_cameras: which cameras of a frame are recorded. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "camera.h"
#include "sim_cameras.h"

/* ---- in place of the linker: it calls nothing, and says what it is told to ---------------------------------- */

static int status_of_core;

// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
int __real_ph_frame_begin(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection,
                          const struct ph_scene_light *light, uint16_t background);
int __real_ph_frame_begin(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection,
                          const struct ph_scene_light *light, uint16_t background)
{
    (void)r, (void)view, (void)projection, (void)light, (void)background;
    return status_of_core;
}

int __real_ph_frame_camera(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection);
int __real_ph_frame_camera(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection)
{
    (void)r, (void)view, (void)projection;
    return status_of_core;
}

int __real_ph_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world);
int __real_ph_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world)
{
    (void)r, (void)mesh, (void)to_world;
    return status_of_core;
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

static const struct ph_projection lens = {.scale_x_q20 = 1, .scale_y_q20 = 2, .near_z = 5, .far_z = 6};

static void begin(fx_t x)
{
    const struct ph_xform view = ph_xform_translate(x, 0, 0);
    assert_int_equal(sim_cameras_frame_begin(NULL, &view, &lens, NULL, 0), status_of_core);
}

static void add(fx_t x, const struct ph_projection *p)
{
    const struct ph_xform view = ph_xform_translate(x, 0, 0);
    assert_int_equal(sim_cameras_frame_camera(NULL, &view, p), status_of_core);
}

static void each_camera_of_the_last_frame_is_recorded_once(void **state)
{
    (void)state;
    struct sim_cameras seen = {.count = 0};
    sim_cameras_record(&seen);
    begin(1);
    add(2, &lens);
    begin(3);
    add(4, &lens);
    add(3, &lens); /* again */
    assert_int_equal(seen.count, 2);
    assert_int_equal(seen.cameras[0].view.t.x, 3);
    assert_int_equal(seen.cameras[1].view.t.x, 4);
    assert_int_equal(seen.cameras[1].projection.far_z, 6);
    struct ph_projection others[7] = {lens, lens, lens, lens, lens, lens, lens};
    others[0].kind = PH_ORTHOGRAPHIC;
    others[1].scale_x_q20++;
    others[2].scale_y_q20++;
    others[3].shift_x++;
    others[4].shift_y++;
    others[5].near_z--;
    others[6].far_z++;
    for (int i = 0; i < 7; i++) { /* the eighth and last that there is room for, and one more */
        add(3, &others[i]);
        assert_int_equal(seen.count, i < 6 ? i + 3 : SIM_CAMERAS_MAX);
    }
    sim_cameras_record(NULL);
    begin(5);
    add(6, &lens);
    assert_int_equal(seen.count, SIM_CAMERAS_MAX);
    assert_int_equal(seen.cameras[0].view.t.x, 3);
}

static void what_the_renderer_refuses_is_no_camera(void **state)
{
    (void)state;
    struct sim_cameras seen = {.count = 0};
    sim_cameras_record(&seen);
    begin(1);
    status_of_core = PH_ERR_INVAL;
    begin(2);
    add(3, &lens);
    status_of_core = PH_OK;
    sim_cameras_record(NULL);
    assert_int_equal(seen.count, 1);
    assert_int_equal(seen.cameras[0].view.t.x, 1);
}

static void draw(fx_t x)
{
    const struct ph_xform to_world = ph_xform_translate(x, 0, 0);
    assert_int_equal(sim_cameras_draw_mesh(NULL, NULL, &to_world), status_of_core);
}

static void the_place_of_one_mesh_is_recorded(void **state)
{
    (void)state;
    struct sim_cameras seen = {.parent = 1};
    status_of_core = PH_OK;
    draw(1);
    sim_cameras_record(&seen);
    begin(1);
    draw(2);
    draw(3);
    draw(4);
    begin(1); /* again: meshes count from 0 */
    draw(5);
    assert_int_equal(seen.meshes, 1);
    assert_int_equal(seen.parent_to_world.t.x, 3);
    draw(6);
    draw(7);
    status_of_core = PH_ERR_INVAL;
    draw(8);
    status_of_core = PH_OK;
    sim_cameras_record(NULL);
    draw(9);
    assert_int_equal(seen.meshes, 3);
    assert_int_equal(seen.parent_to_world.t.x, 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_camera_of_the_last_frame_is_recorded_once),
        cmocka_unit_test(what_the_renderer_refuses_is_no_camera),
        cmocka_unit_test(the_place_of_one_mesh_is_recorded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
