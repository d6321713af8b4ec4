/* studio: the lamp and the background that a model is shown with, on the turntable and before an eye of its own. */
#include "demo_scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const struct demo_studio studio = {.background = 0x1234, .has_lamp = 1, .to_lamp_q30 = {0, 1 << 30, 0}};
static const struct demo_studio dark = {.background = 0x4321};

static void without_one_two_lamps_shine(void **state)
{
    (void)state;
    const struct demo_context context = {.studio = NULL};
    const struct ph_scene_light light = demo_studio_light(&context);
    assert_memory_equal(&light, &demo_two_lamps, sizeof light);
    assert_int_equal(demo_studio_background(&context), DEMO_MODEL_BACKGROUND);
}

static void a_background_alone_leaves_the_lamps(void **state)
{
    (void)state;
    const struct demo_context context = {.studio = &dark};
    const struct ph_scene_light light = demo_studio_light(&context);
    assert_memory_equal(&light, &demo_two_lamps, sizeof light);
    assert_int_equal(demo_studio_background(&context), 0x4321);
}

static void its_lamp_shines_alone(void **state)
{
    (void)state;
    const struct demo_context context = {.studio = &studio};
    const struct ph_scene_light light = demo_studio_light(&context);
    assert_int_equal(light.count, 1);
    assert_int_equal(light.ambient, FX_ONE);
    assert_int_equal(light.lights[0].intensity, FX_ONE);
    assert_int_equal(light.lights[0].to_light_q30.x, 0);
    assert_int_equal(light.lights[0].to_light_q30.y, 1 << 30);
    assert_int_equal(light.lights[0].to_light_q30.z, 0);
}

/* A renderer of 8x8 pixels, in which a demo begins a frame. */
static struct ph_renderer renderer;
static uint64_t memory[2][512], depth[32];
static uint32_t bins[1];

static void prepare(struct demo_context *context)
{
    static uint64_t arena[1024];
    const struct ph_config config = {.width = 8,
                                     .height = 8,
                                     .band_height = 8,
                                     .depth_format = PH_DEPTH_AUTO,
                                     .vertices = memory[0],
                                     .vertex_max = sizeof memory[0] / ph_vertex_bytes,
                                     .triangles = memory[1],
                                     .triangle_max = sizeof memory[1] / ph_triangle_bytes,
                                     .depth = depth,
                                     .bins = bins,
                                     .bin_max = 1};
    assert_int_equal(ph_renderer_init(&renderer, &config), 0);
    *context = (struct demo_context){
        .arena = {.base = (uint8_t *)arena, .size = sizeof arena}, .width = 8, .height = 8, .studio = &studio};
}

static const struct fx_vec3 corners[3] = {{FX_ONE, 0, 0}, {0, FX_ONE, 0}, {0, 0, FX_ONE}};

static void expect_lamp(int32_t x, int32_t y, int32_t z)
{
    const struct fx_vec3 way = renderer.light.lights[0].to_light_q30;
    assert_int_equal(renderer.light.count, 1);
    assert_int_equal(renderer.background, 0x1234);
    assert_in_range(way.x - x + 4, 0, 8);
    assert_in_range(way.y - y + 4, 0, 8);
    assert_in_range(way.z - z + 4, 0, 8);
}

static void the_turntable_stands_in_it(void **state)
{
    (void)state;
    struct demo_context context;
    prepare(&context);
    assert_int_equal(demo_turntable_around(&context, NULL, 0, corners, 3), 0);
    (void)demo_turntable_frame(&context, &renderer, 3);
    expect_lamp(0, 1 << 30, 0);
}

/* The eye looks down along -y, and its upper edge is -z: what is above the viewer lies at -z of the world. */
static void before_an_eye_the_lamp_is_where_the_viewer_sees_it(void **state)
{
    (void)state;
    struct demo_context context;
    const struct demo_eye eye = {
        .view = {.r = {{1 << 30, 0, 0}, {0, 0, -(1 << 30)}, {0, 1 << 30, 0}}, .t = {0, 0, FX_INT(-4)}},
        .lens = {.kind = PH_PERSPECTIVE,
                 .near_z = FX_ONE,
                 .far_z = FX_INT(9),
                 .scale_x_q20 = 1 << 20,
                 .scale_y_q20 = 1 << 20}};
    prepare(&context);
    assert_int_equal(demo_still_init(&context, NULL, 0, &eye), 0);
    assert_int_equal(demo_still_frame(&context, &renderer, 0), 0);
    expect_lamp(0, 0, -(1 << 30));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_one_two_lamps_shine),
        cmocka_unit_test(a_background_alone_leaves_the_lamps),
        cmocka_unit_test(its_lamp_shines_alone),
        cmocka_unit_test(the_turntable_stands_in_it),
        cmocka_unit_test(before_an_eye_the_lamp_is_where_the_viewer_sees_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
