/* depth_layers: what is recorded of a frame that the test draws, which surfaces lie at a pixel and how far away,
 * against the planes of their triangles; and what shows there in a format. */
#define _XOPEN_SOURCE 700
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "assert_near.h"
#include "complain.h"
#include "depth_layers.h"
#include "model.h"
#include "stderr_capture.h"

#include <math.h>
#include <string.h>

enum { SIDE = 16, FAR = 100 };

/* Two triangles with the lower left corner and sides of a card: a at the left, b at the right. */
struct card {
    double left, bottom, right, top, left_z, right_z; /* z: distances */
    int material;
};

static struct card cards[10];
static int card_count, begins, init_status, frame_status, open_status;
static struct ph_material materials[10];
static struct ph_projection lens;
static struct ph_xform moved, view;
static struct depth_lab lab;
static struct depth_layers s;
static struct stderr_capture said;
static struct demo_camera camera;

/* ---- in place of the linker and of a model ------------------------------------------------------------------ */

// NOLINTNEXTLINE(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
int __real_ph_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world);
int __real_ph_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world)
{
    return ph_draw_mesh(r, mesh, to_world);
}

static int init(struct demo_context *context)
{
    assert_true(context->arena.size >= 1000 && context->width == SIDE && context->height == SIDE);
    camera = context->camera;
    return init_status;
}

static int draw_card(struct ph_renderer *r, const struct card *c)
{
    static const uint16_t faces[][3] = {{0, 1, 2}, {0, 2, 3}};
    const struct fx_vec3 corners[] = {vec(c->left, c->bottom, -c->left_z), vec(c->right, c->bottom, -c->right_z),
                                      vec(c->right, c->top, -c->right_z), vec(c->left, c->top, -c->left_z)};
    const struct ph_part part = {.count = 2, .material = (uint16_t)c->material};
    const struct ph_mesh mesh = {.positions = corners,
                                 .vertex_count = 4,
                                 .triangles = faces,
                                 .triangle_count = 2,
                                 .parts = &part,
                                 .part_count = 1,
                                 .materials = materials};
    assert_ptr_equal(r->config.colouring, PH_COLOURS); /* for meshes that have vertex colours */
    return depth_layers_draw_mesh(r, &mesh, &moved);
}

static int frame(struct demo_context *context, struct ph_renderer *r, uint32_t number)
{
    int status = ph_frame_begin(r, &view, &lens, NULL, 0);
    assert_true(context->width == SIDE && number >= 5);
    begins++;
    for (int i = 0; i < card_count && status == 0; i++) {
        status = draw_card(r, &cards[i]);
    }
    return frame_status != 0 ? frame_status : status;
}

int model_open(struct model **model, const char *path, const struct model_options *options)
{
    static struct model any = {.scale = .25};
    assert_true(strcmp(path, "a model") == 0 && options->allow_outside);
    *model = &any;
    return open_status;
}

struct demo model_demo(const struct model *model)
{
    static const char *const views[] = {"front", "back", NULL};
    assert_non_null(model);
    return (struct demo){.name = "played",
                         .views = views,
                         .loop_frames = 1,
                         .arena_bytes = 1000,
                         .vertex_max = 40,
                         .triangle_max = 40,
                         .init = init,
                         .frame = frame};
}

void model_close(struct model *model)
{
    (void)model;
}

/* ---- the tests ---------------------------------------------------------------------------------------------- */

/* The ray of a pixel goes through slopes of -1 .. 1 across the picture. */
static double slope_of(int column)
{
    return (2 * column + 1) / (double)SIDE - 1;
}

static int fresh(void **state)
{
    (void)state;
    lab = (struct depth_lab){.near_z = FX_ONE,
                             .far_z = FX_INT(FAR),
                             .fov_deg = FX_INT(90),
                             .width = SIDE,
                             .height = SIDE,
                             .model = "a model",
                             .allow_outside = true,
                             .start = 5};
    card_count = begins = 0;
    init_status = frame_status = open_status = 0;
    moved = view = ph_xform_identity;
    for (int i = 0; i < 10; i++) {
        materials[i] = (struct ph_material){.shading = PH_SHADE_UNLIT, .two_sided = true};
    }
    memset(&lens, 0, sizeof lens);
    return ph_projection_perspective(&lens, FX_INT(90), FX_ONE, FX_ONE, FX_INT(FAR));
}

static void add(int material, double z, double right_z)
{
    cards[card_count++] = (struct card){-2 * z, -2 * z, 2 * z, 2 * z, z, right_z, material};
}

static int open_layers(void)
{
    stderr_capture_begin(&said);
    const int status = depth_layers_open(&s, &lab);
    stderr_capture_end(&said);
    return status;
}

static const struct scene_pixel *find(int column, int row)
{
    assert_int_equal(open_layers(), 0);
    assert_int_equal(depth_layers_find(&s, 6), 0);
    return &s.layers[row * SIDE + column];
}

static void surfaces_are_what_has_one_material(void **state)
{
    uint16_t ramp[PH_RAMP_SIZE] = {0};
    (void)state;
    materials[3].colour = ph_rgb565(255, 0, 0);
    materials[7].shading = PH_SHADE_GOURAUD;
    materials[7].ramp = ramp;
    ramp[PH_RAMP_SIZE * 3 / 4] = ph_rgb565(0, 255, 255);
    materials[9].shading = PH_SHADE_WIRE;
    add(3, 5, 5), add(7, 6, 6), add(3, 7, 7), add(9, 8, 8);
    const struct scene_pixel *const p = find(8, 8);
    assert_true(s.surface_count == 3 && s.draw_count == 4 && s.triangle_count == 6);
    assert_string_equal(s.surfaces[0].colour, "#ff0000");
    assert_string_equal(s.surfaces[1].colour, "#00ffff");
    assert_true(s.surfaces[1].look.shading == PH_SHADE_GOURAUD && s.surfaces[0].material == &materials[3]);
    assert_true(s.draws[2].first == 4 && s.draws[2].count == 2 && s.draws[3].count == 0);
    assert_int_equal(p->count, 3); /* lines are left out */
    assert_true(p->layers[0].surface == 0 && p->layers[1].surface == 1 && p->layers[2].surface == 0);
    assert_memory_equal(&s.lens, &lens, sizeof lens);
    assert_int_equal(begins, 2);
    depth_layers_close(&s);
}

/* z = a + b x: on the ray x = slope z it is a / (1 - b slope). */
static void distances_are_those_of_the_planes(void **state)
{
    (void)state;
    cards[card_count++] = (struct card){-20, -20, 20, 20, 6, 14, 0}; /* a 10, b 0.2 */
    find(0, 0);
    for (int row = 0; row < SIDE; row += 5) {
        for (int column = 0; column < SIDE; column++) {
            const struct scene_pixel *const p = &s.layers[row * SIDE + column];
            assert_int_equal(p->count, 1);
            const double slope = slope_of(column), z = 10 / (1 - .2 * slope);
            assert_near(p->layers[0].z_m, z, 1e-3);
            assert_near(p->layers[0].slope_m, z * z / 10 * .2 * 2 / SIDE, .002);
            assert_true(!p->layers[0].parallel && p->layers[0].off_m == 0);
        }
    }
    depth_layers_close(&s);
    cards[0].left_z = cards[0].right_z = 3;
    moved.t = vec(0, 0, -4); /* the transform of the draw */
    assert_near(find(3, 4)->layers[0].z_m, 7, 1e-4);
    assert_near(s.layers[0].layers[0].slope_m, 0, 1e-9);
    depth_layers_close(&s);
    moved = ph_xform_rotate_y(0x80000000); /* half a turn, and then the camera steps back */
    cards[0].left_z = cards[0].right_z = -3;
    view.t = vec(0, 0, -2);
    assert_near(find(3, 4)->layers[0].z_m, 5, 1e-4);
    depth_layers_close(&s);
}

static void nearest_layers_are_kept_the_first_drawn_before_others(void **state)
{
    static const double z[] = {9, 4, 8, 3, 7, 5, 6, 4, 7};
    static const uint16_t want[] = {3, 1, 7, 5, 6, 4};
    (void)state;
    for (int i = 0; i < 9; i++) {
        add(i, z[i], z[i]);
    }
    const struct scene_pixel *const p = find(2, 9);
    assert_int_equal(depth_layers_find(&s, 7), 0); /* another frame begins anew */
    assert_int_equal(p->count, SCENE_LAYERS);
    for (int i = 0; i < SCENE_LAYERS; i++) {
        assert_int_equal(p->layers[i].surface, want[i]);
    }
    depth_layers_close(&s);
    card_count = 0; /* a bias of 8 is 2^-12 of the distance */
    materials[1].depth_bias = 8;
    add(0, 10, 10), add(1, 10.002, 10.002);
    assert_int_equal(find(2, 9)->layers[0].surface, 1);
    assert_int_equal(s.layers[0].layers[0].bias, 8);
    assert_near(s.layers[0].layers[0].z_m, 10.002, 1e-4);
    depth_layers_close(&s);
    cards[1].left_z = cards[1].right_z = 10.003;
    assert_int_equal(find(2, 9)->layers[0].surface, 0);
    depth_layers_close(&s);
}

static void other_lenses_have_other_rays(void **state)
{
    (void)state;
    assert_int_equal(ph_projection_ortho(&lens, FX_INT(-4), FX_INT(4), FX_INT(-4), FX_INT(4), FX_ONE, FX_INT(FAR)), 0);
    cards[card_count++] = (struct card){-20, -20, 20, 20, 6, 14, 0};
    find(0, 0);
    const double half = 1 / ldexp(lens.scale_x_q20, -20);
    for (int column = 0; column < SIDE; column++) {
        const struct scene_layer *const layer = &s.layers[column].layers[0];
        assert_near(layer->z_m, 10 + .2 * half * slope_of(column), 1e-3);
        assert_near(layer->slope_m, .2 * half * 2 / SIDE, 1e-3);
        assert_true(layer->parallel);
    }
    assert_false(s.fisheye);
    depth_layers_close(&s);
    assert_int_equal(ph_projection_fisheye(&lens, FX_INT(90), FX_ONE, FX_INT(FAR)), 0);
    cards[0] = (struct card){-20, -20, 20, 20, 10, 10, 0}; /* by its distance from the eye */
    find(0, 0);
    assert_true(s.fisheye);
    for (int column = 0; column < SIDE; column++) {
        const struct scene_layer *const layer = &s.layers[8 * SIDE + column].layers[0];
        const double angle = hypot(slope_of(column), slope_of(8)) / ldexp(lens.scale_y_q20, -20);
        assert_near(layer->z_m, 10 / cos(angle), 1e-3);
        assert_true(!layer->parallel && layer->off_m < layer->z_m / 80);
    }
    depth_layers_close(&s);
}

static void what_shows_is_the_number_of_its_surface(void **state)
{
    const struct lab_format fixed16 = {.name = "fixed16", .format = PH_DEPTH_FIXED16, .bits = 16};
    (void)state;
    materials[4].depth_bias = 3;
    add(4, 30, 30);
    cards[card_count++] = (struct card){0, -20, 20, 20, 3, 3, 5}; /* over the right half */
    find(0, 0);
    assert_int_equal(s.numbers[0].depth_bias, 3);
    for (int near_z = 0; near_z <= 4; near_z += 2) { /* 0: the demo's own */
        assert_int_equal(depth_layers_show(&s, &fixed16, FX_INT(near_z)), 0);
        for (int i = 0; i < SIDE * SIDE; i++) {
            assert_int_equal(s.pixels[i], i % SIDE >= SIDE / 2 && near_z < 4 ? 2 : 1);
        }
    }
    assert_int_equal(depth_layers_show(&s, &fixed16, FX_INT(31)), 0);
    assert_int_equal(s.pixels[7], 0);
    depth_layers_close(&s);
}

static void camera_of_the_lab_replaces_the_demos_where_it_is_given(void **state)
{
    (void)state;
    assert_int_equal(open_layers(), 0);
    assert_true(!camera.view_set && !camera.projection_set);
    depth_layers_close(&s);
    for (int i = 0; i < 4; i++) {
        lab.fov_set = i == 0, lab.near_set = i == 1, lab.far_set = i == 2, lab.camera.set = i == 3;
        lab.camera.view = ph_xform_rotate_z(77);
        assert_int_equal(open_layers(), 0);
        assert_true(camera.projection_set && camera.projection.near_z == FX_ONE);
        assert_int_equal(camera.view_set, i == 3);
        assert_memory_equal(&camera.view, &lab.camera.view, sizeof camera.view);
        depth_layers_close(&s);
    }
}

static void what_cannot_be_opened_or_drawn_is_told(void **state)
{
    static const struct {
        int *status;
        const char *line;
    } cases[] = {{&init_status, "played: its arena is too small for this picture"},
                 {&frame_status, "frame 5 cannot be drawn with this camera (-22)"},
                 {&open_status, ""}};
    (void)state;
    for (int i = 0; i < 3; i++) {
        fresh(NULL);
        *cases[i].status = i == 2 ? COMPLAINED : -22;
        assert_int_equal(open_layers(), COMPLAINED);
        assert_non_null(strstr(said.text, cases[i].line));
        depth_layers_close(&s);
    }
    fresh(NULL);
    lab.view = "side";
    assert_int_equal(open_layers(), PH_ERR_INVAL);
    assert_non_null(strstr(said.text, "--view 'side': played has no such view"));
    depth_layers_close(&s);
    lab.view = "back";
    assert_int_equal(open_layers(), 0);
    assert_string_equal(s.context.view, "back");
    assert_true(depth_layers_file_scale(&s) == .25);
    frame_status = -22;
    stderr_capture_begin(&said);
    const int status = depth_layers_find(&s, 8);
    stderr_capture_end(&said);
    assert_int_equal(status, COMPLAINED);
    assert_non_null(strstr(said.text, "frame 8 cannot be drawn with this camera (-22)"));
    depth_layers_close(&s);
    lab.model = NULL;
    lab.demo = "icosphare";
    assert_int_equal(open_layers(), PH_ERR_INVAL);
    assert_non_null(strstr(said.text, "--demo 'icosphare': no such demo; "));
    assert_non_null(strstr(said.text, "icosphere"));
    assert_true(depth_layers_file_scale(&s) == 0);
    depth_layers_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(surfaces_are_what_has_one_material, fresh),
        cmocka_unit_test_setup(distances_are_those_of_the_planes, fresh),
        cmocka_unit_test_setup(nearest_layers_are_kept_the_first_drawn_before_others, fresh),
        cmocka_unit_test_setup(other_lenses_have_other_rays, fresh),
        cmocka_unit_test_setup(what_shows_is_the_number_of_its_surface, fresh),
        cmocka_unit_test_setup(camera_of_the_lab_replaces_the_demos_where_it_is_given, fresh),
        cmocka_unit_test_setup(what_cannot_be_opened_or_drawn_is_told, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
