/* model_framing: the share of the picture at which a camera is kept, and what is noted; squares of known pixels. The
 * demo that is drawn is the test's own. */
#include "model_framing.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { HALF = 80 /* pixels from the middle to the edge */ };

static struct model_shared shared;
static struct ph_material material;
static struct fx_vec3 corners[4];
static const uint16_t faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
static const struct ph_part part = {0, 2, 0};
static const struct ph_mesh square = {.positions = corners,
                                      .triangles = faces,
                                      .parts = &part,
                                      .materials = &material,
                                      .vertex_count = 4,
                                      .triangle_count = 2,
                                      .part_count = 1};
static uint32_t frames[32], frame_count, on_turntable, special;
static int32_t wide, high, special_wide; /* pixels of the square; its width in the special frame */
static uint16_t size[2];
static int init_status, frame_status;

static int init(struct demo_context *context)
{
    assert_ptr_equal(context->state, &shared.model);
    assert_int_equal(context->arena.size, shared.model.has_camera ? 5000 : 5000 - 4096 + 256);
    memset(context->arena.base, 1, context->arena.size);
    size[0] = context->width;
    size[1] = context->height;
    return init_status;
}

static int frame(struct demo_context *context, struct ph_renderer *r, uint32_t number)
{
    const struct ph_projection flat = {.kind = PH_ORTHOGRAPHIC,
                                       .scale_x_q20 = 1 << 20,
                                       .scale_y_q20 = (1 << 20) * 2 * HALF / context->height,
                                       .near_z = FX_ONE,
                                       .far_z = 3 * FX_ONE};
    const int32_t width = number == special ? special_wide : wide, x0 = -width / 2, y0 = -high / 2;
    const int32_t xs[4] = {x0, x0 + width, x0 + width, x0}, ys[4] = {y0, y0, y0 + high, y0 + high};
    for (int i = 0; i < 4; i++) {
        corners[i] = (struct fx_vec3){xs[i] * FX_ONE / HALF, ys[i] * FX_ONE / HALF, -2 * FX_ONE};
    }
    material = (struct ph_material){.shading = PH_SHADE_UNLIT, .two_sided = true, .colour = 0xFFFF};
    frames[frame_count++] = number;
    on_turntable += !shared.model.has_camera;
    assert_int_equal(ph_frame_begin(r, &ph_xform_identity, &flat, NULL, DEMO_MODEL_BACKGROUND), 0);
    assert_int_equal(ph_draw_mesh(r, &square, &ph_xform_identity), 0);
    return frame_status;
}

struct demo model_demo(const struct model *model)
{
    assert_ptr_equal(model, &shared.model);
    return (struct demo){.name = "model",
                         .loop_frames = 256,
                         .arena_bytes = 5000,
                         .vertex_max = 4,
                         .triangle_max = 4,
                         .init = init,
                         .frame = frame};
}

/* Checks a model that shows so many pixels; scales: of its camera, 0: it has none. */
static void check(int32_t w, int32_t h, int32_t scale_x, int32_t scale_y)
{
    struct model_motion *const motion = shared.model.motion;
    memset(&shared, 0, sizeof shared);
    shared.model.motion = motion;
    shared.model.has_camera = scale_y != 0;
    shared.model.camera.lens.scale_x_q20 = scale_x;
    shared.model.camera.lens.scale_y_q20 = scale_y;
    wide = w;
    high = h;
    frame_count = on_turntable = 0;
    model_framing_check(&shared);
}

static int setup(void **state)
{
    (void)state;
    shared.model.motion = NULL;
    init_status = frame_status = 0;
    special = UINT32_MAX;
    return 0;
}

/* 5 % of 160 x 160 pixels are 1280. */
static void a_camera_that_shows_five_percent_is_kept(void **state)
{
    (void)state;
    check(40, 32, 1 << 20, 1 << 20);
    assert_true(shared.model.has_camera);
    assert_string_equal(shared.note, "");
    assert_int_equal(frame_count, 1);
    check(38, 32, 1 << 20, 1 << 20); /* 1216 of 25600 are 4.75 %, and 6.33 % of the turntable's 160 x 120 */
    assert_false(shared.model.has_camera);
    assert_string_equal(shared.note, "the file's camera shows the model in 4.75 % of its picture, so it is shown on "
                                     "the turntable");
    assert_int_equal(on_turntable, 8);
}

static void the_picture_has_the_shape_that_the_camera_says(void **state)
{
    static const struct {
        int32_t x, y;
        uint16_t height;
    } cases[] = {{3 << 18, 1 << 20, 120}, {1 << 20, 1 << 20, 160}, {1 << 19, 1 << 20, 80}, {1 << 10, 1 << 20, 40},
                 {0, 1 << 20, 120},       {1 << 22, 1 << 20, 320}, {1 << 30, 1 << 20, 320}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        check(100, 30, cases[i].x, cases[i].y);
        assert_true(shared.model.has_camera);
        assert_int_equal(size[0], 160);
        assert_int_equal(size[1], cases[i].height);
    }
}

/* 1 % of 160 x 120 pixels are 192. */
static void a_model_of_which_nearly_nothing_is_seen_is_noted(void **state)
{
    (void)state;
    check(16, 12, 0, 0);
    assert_string_equal(shared.note, "");
    assert_int_equal(frame_count, 8);
    for (uint32_t i = 0; i < 8; i++) {
        assert_int_equal(frames[i], 32 * i);
    }
    check(2, 90, 0, 0); /* 180 of 19200 */
    assert_string_equal(shared.note, "it covers 0.93 % of the picture on the turntable");
    check(0, 0, 1 << 20, 1 << 20);
    assert_false(shared.model.has_camera);
    assert_string_equal(shared.note, "the file's camera shows the model in 0.00 % of its picture, so it is shown on "
                                     "the turntable; it covers 0.00 % of the picture on the turntable");
}

static void of_a_clip_the_best_frame_counts(void **state)
{
    static const struct ph_clip clip = {.duration = FX_ONE * 4};
    static struct model_motion motion = {.animation.clip = &clip};
    (void)state;
    shared.model.motion = &motion;
    special = 75; /* 4 seconds are 120 frames: 0, 15, .. 105 are drawn */
    special_wide = 40;
    check(2, 32, 1 << 20, 1 << 20);
    assert_true(shared.model.has_camera);
    assert_int_equal(frame_count, 8);
    assert_int_equal(frames[7], 105);
    special = 76;
    check(2, 32, 1 << 20, 1 << 20);
    assert_false(shared.model.has_camera);
}

static void what_cannot_be_drawn_stays_as_it_is(void **state)
{
    (void)state;
    init_status = PH_ERR_NOMEM;
    check(2, 2, 1 << 20, 1 << 20);
    assert_true(shared.model.has_camera && frame_count == 0);
    assert_string_equal(shared.note, "");
    init_status = 0;
    frame_status = PH_ERR_INVAL;
    check(2, 2, 0, 0);
    assert_int_equal(frame_count, 1);
    assert_string_equal(shared.note, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_camera_that_shows_five_percent_is_kept, setup),
        cmocka_unit_test_setup(the_picture_has_the_shape_that_the_camera_says, setup),
        cmocka_unit_test_setup(a_model_of_which_nearly_nothing_is_seen_is_noted, setup),
        cmocka_unit_test_setup(of_a_clip_the_best_frame_counts, setup),
        cmocka_unit_test_setup(what_cannot_be_drawn_stays_as_it_is, setup),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
