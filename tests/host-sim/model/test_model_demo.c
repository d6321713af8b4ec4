/* model_demo: what demo a model becomes: its views, its room, and which camera each view begins with. A demo of the
 * model is compared with those that are made directly. */
#include "animation.h"
#include "made_asset.h"
#include "scene_file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { ARENA_BYTES = 1 << 15 };

static uint8_t memory[2][ARENA_BYTES] __attribute__((aligned(8)));
static struct demo_context ours, theirs;

static struct model *fresh(bool moves, bool has_camera)
{
    struct model *const model = &made_asset(moves)->model;
    model->has_camera = has_camera;
    model->camera = (struct demo_eye){.view = ph_xform_translate(0, 0, FX_INT(-4)),
                                      .lens = {.kind = PH_PERSPECTIVE,
                                               .near_z = FX_ONE,
                                               .far_z = FX_INT(9),
                                               .scale_x_q20 = 1 << 20,
                                               .scale_y_q20 = 1 << 20}};
    model->triangle_count = 7;
    memset(memory, 0, sizeof memory);
    ours = (struct demo_context){
        .arena = {.base = memory[0], .size = ARENA_BYTES}, .state = model, .width = 64, .height = 48};
    theirs = (struct demo_context){.arena = {.base = memory[1], .size = ARENA_BYTES}, .width = 64, .height = 48};
    return model;
}

/* Both arenas hold the same, but for pointers into them and for what a compiler leaves between members: the upper half
 * of a word may be such a gap. */
static void expect_same(void)
{
    assert_int_equal(ours.arena.used, theirs.arena.used);
    assert_int_equal((uint8_t *)ours.state - memory[0], (uint8_t *)theirs.state - memory[1]);
    for (size_t i = 0; i + 8 <= ours.arena.used; i += 8) {
        uintptr_t a, b;
        memcpy(&a, memory[0] + i, sizeof a);
        memcpy(&b, memory[1] + i, sizeof b);
        const bool is_inside = a - (uintptr_t)memory[0] < ARENA_BYTES && b - (uintptr_t)memory[1] < ARENA_BYTES;
        assert_int_equal((uint32_t)(is_inside ? a - (uintptr_t)memory[0] : a),
                         (uint32_t)(is_inside ? b - (uintptr_t)memory[1] : b));
    }
}

static const struct fx_vec3 origin;

static void a_model_turns_unless_it_has_a_camera(void **state)
{
    static const char *const views[] = {NULL, "camera", "turntable"};
    (void)state;
    for (int i = 0; i < 6; i++) {
        const struct model *const model = fresh(false, i % 2 == 1);
        const struct demo demo = model_demo(model);
        ours.view = views[i / 2];
        assert_int_equal(demo.init(&ours), 0);
        if (i == 1 || i == 3) {
            assert_int_equal(demo_still_init(&theirs, model->meshes, MADE_MESHES, &model->camera), 0);
        } else {
            assert_int_equal(demo_turntable_init(&theirs, model->meshes, MADE_MESHES, origin), 0);
        }
        expect_same();
        assert_true(i % 2 == 0 ? demo.frame == demo_turntable_frame
                               : demo.frame != demo_turntable_frame && demo.frame != demo_still_frame);
    }
}

static void what_moves_is_an_animation_before_the_same_cameras(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        const struct model *const model = fresh(true, i > 0);
        const struct demo demo = model_demo(model);
        ours.view = i == 2 ? "turntable" : NULL;
        assert_int_equal(demo.init(&ours), 0);
        assert_int_equal(animation_init(&theirs, &model->motion->animation, model->meshes, MADE_MESHES,
                                        i == 1 ? &model->camera : NULL),
                         0);
        expect_same();
        assert_true(demo.frame == animation_frame && demo.select == animation_select);
        assert_true(ours.arena.used <= demo.arena_bytes);
    }
}

static void views_are_those_that_there_are(void **state)
{
    (void)state;
    struct demo demo = model_demo(fresh(false, true));
    assert_true(strcmp(demo.views[0], "camera") == 0 && strcmp(demo.views[1], "turntable") == 0 &&
                demo.views[2] == NULL);
    demo = model_demo(fresh(false, false));
    assert_true(strcmp(demo.views[0], "turntable") == 0 && demo.views[1] == NULL);
    assert_int_equal(demo.loop_frames, 256);
    assert_string_equal(demo.name, "model");
}

/* Meshes of 3, 4, 5 and 3 vertices and 7 triangles, a quarter of them clipped; two are blended. */
static void budgets_have_room_for_all_and_the_platter(void **state)
{
    (void)state;
    struct model *const model = fresh(false, false);
    const uint32_t row = model_blend_triangles(model, 1024);
    struct demo demo = model_demo(model);
    assert_int_equal(demo.vertex_max, 15 + DEMO_TURNTABLE_VERTICES);
    assert_int_equal(demo.triangle_max, 7 + 1 + DEMO_TURNTABLE_TRIANGLES + row);
    assert_int_equal(demo.arena_bytes, DEMO_TURNTABLE_BYTES);
    assert_int_equal(demo.arena_bytes_32, DEMO_TURNTABLE_BYTES);
    demo = model_demo(fresh(true, false));
    const struct animation *const a = &made_asset(true)->model.motion->animation;
    const struct animation_need need = animation_need(a);
    assert_int_equal(demo.arena_bytes, DEMO_TURNTABLE_BYTES + animation_bytes(&need, a, MADE_MESHES, false));
    assert_int_equal(demo.arena_bytes_32, DEMO_TURNTABLE_BYTES + animation_bytes(&need, a, MADE_MESHES, true));
}

/* A row that blends take has up to 8 bytes a pixel, in whole triangles. */
static void a_blend_takes_a_row_of_the_triangles(void **state)
{
    (void)state;
    struct model *const model = fresh(false, false);
    for (uint32_t width = 1; width <= 1024; width *= 2) {
        const uint32_t n = model_blend_triangles(model, width);
        assert_in_range(n * PH_TRIANGLE_BYTES_32, width * 8 + 1, width * 8 + PH_TRIANGLE_BYTES_32);
    }
    model->mesh_count = 1; /* the first has no blend */
    assert_int_equal(model_blend_triangles(model, 1024), 0);
    model->mesh_count = 2;
    assert_true(model_blend_triangles(model, 1024) > 0);
}

static void a_binary_scene_keeps_its_demo(void **state)
{
    static uint8_t bytes[1 << 16] __attribute__((aligned(16)));
    (void)state;
    for (int has_camera = 0; has_camera < 2; has_camera++) {
        struct model *const model = fresh(false, has_camera == 1);
        assert_in_range(asset_scene(made_asset(false), NULL), 1, sizeof bytes);
        asset_scene(made_asset(false), bytes);
        fresh(false, has_camera == 1);
        model->scene = bytes;
        const struct demo demo = model_demo(model), own = scene_file_demo(bytes);
        assert_true(demo.frame == own.frame && demo.triangle_max == own.triangle_max &&
                    demo.arena_bytes == own.arena_bytes);
        if (has_camera) {
            assert_null(demo.views);
        } else {
            assert_string_equal(demo.views[0], "turntable");
            assert_null(demo.views[1]);
        }
        theirs.state = bytes;
        assert_int_equal(demo.init(&ours), 0);
        assert_int_equal(own.init(&theirs), 0);
        expect_same();
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_model_turns_unless_it_has_a_camera),
        cmocka_unit_test(what_moves_is_an_animation_before_the_same_cameras),
        cmocka_unit_test(views_are_those_that_there_are),
        cmocka_unit_test(budgets_have_room_for_all_and_the_platter),
        cmocka_unit_test(a_blend_takes_a_row_of_the_triangles),
        cmocka_unit_test(a_binary_scene_keeps_its_demo),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
