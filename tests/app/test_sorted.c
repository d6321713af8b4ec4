/* demo_draw_meshes: the pixel in the middle, against the sum that panes of glass give from the farthest to the nearest.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "demo_scene.h"
#include "ref_rig.h"

#include <math.h>
#include <string.h>

enum { SIDE = 32, PANES = 70, BACKGROUND = 8 };

static struct fx_vec3 corners[PANES][4];
static struct ph_material materials[PANES];
static struct ph_mesh meshes[PANES];
static uint16_t ramp[PH_RAMP_SIZE];

/* A pane at z, from 0 to the camera's 1; its green, 0 .. 63. The wall is opaque. */
static void make_pane(int i, double z, int green, const struct ph_blend *blend)
{
    static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const struct ph_part part = {0, 2, 0};
    const fx_t at = (fx_t)lround(z * FX_ONE), one = FX_INT(1);
    corners[i][0] = (struct fx_vec3){-one, -one, at};
    corners[i][1] = (struct fx_vec3){one, -one, at};
    corners[i][2] = (struct fx_vec3){one, one, at};
    corners[i][3] = (struct fx_vec3){-one, one, at};
    materials[i] = (struct ph_material){.shading = PH_SHADE_UNLIT,
                                        .two_sided = 1,
                                        .colour = ph_rgb565(0, (uint8_t)(green * 255 / 63), 0),
                                        .ramp = ramp,
                                        .blend = blend};
    meshes[i] = (struct ph_mesh){.positions = corners[i],
                                 .triangles = triangles,
                                 .parts = &part,
                                 .materials = &materials[i],
                                 .vertex_count = 4,
                                 .triangle_count = 2,
                                 .part_count = 1};
}

/* The green in the middle of the picture, as seen from z = 4 or, turned, from z = -4. */
static int green_of(int count, bool turned)
{
    struct rig rig;
    struct ph_xform view = ph_xform_translate(0, 0, FX_INT(-4));
    const struct ph_xform turn = ph_xform_rotate_y(turned ? 1u << 31 : 0);
    const struct ph_projection lens = {
        .scale_x_q20 = 1 << 20, .scale_y_q20 = 1 << 20, .near_z = FX_INT(1), .far_z = FX_INT(16)};
    rig_open(&rig, SIDE, SIDE, SIDE, PH_DEPTH_FIXED16, 4, 16 * PANES);
    assert_int_equal(ph_frame_begin(&rig.r, &view, &lens, NULL, ph_rgb565(0, BACKGROUND * 255 / 63, 0)), PH_OK);
    assert_int_equal(demo_draw_meshes(&rig.r, meshes, (uint32_t)count, &turn), PH_OK);
    assert_true(rig_finish(&rig));
    const uint16_t wire = rig.pixels[SIDE / 2 * SIDE + SIDE / 2];
    rig_close(&rig);
    uint8_t bytes[2];
    memcpy(bytes, &wire, sizeof bytes);
    return ((bytes[0] & 7) << 3) | bytes[1] >> 5;
}

static const struct ph_blend half = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 16},
                             added = {.draw = ph_draw_blended, .kind = PH_BLEND_ADD, .alpha = 32};

/* A wall behind two panes, in any order in the list: each pane takes half of what is behind it. */
static void the_farthest_pane_comes_first(void **state)
{
    static const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    static const double z[3] = {-1, 0, 1};
    static const int green[3] = {0, 62, 20};
    (void)state;
    for (int k = 0; k < 6; k++) {
        for (int i = 0; i < 3; i++) {
            make_pane(orders[k][i], z[i], green[i], i == 0 ? NULL : &half);
        }
        assert_in_range(green_of(3, false), (0 + 62) / 4. + 20 / 2. - 1.5, (0 + 62) / 4. + 20 / 2. + 1.5);
        materials[orders[k][0]].blend = &half; /* the wall is a pane, too: seen from behind, the order turns */
        assert_in_range(green_of(3, true), BACKGROUND / 8. + 20 / 8. + 62 / 4. - 1.5,
                        BACKGROUND / 8. + 20 / 8. + 62 / 4. + 1.5);
    }
}

/* What is added is sorted among the panes; of those equally far, the first in the list comes first. */
static void light_is_sorted_among_panes(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        make_pane(k, .5, 60, &half);
        make_pane(1 - k, -.5, 20, &added);
        assert_in_range(green_of(2, false), (BACKGROUND + 20) / 2 + 29, (BACKGROUND + 20) / 2 + 31);
        assert_in_range(green_of(2, true), (BACKGROUND + 60) / 2 + 19, (BACKGROUND + 60) / 2 + 21);
    }
    make_pane(0, 0, 60, &half);
    make_pane(1, 0, 20, &half);
    assert_in_range(green_of(2, false), BACKGROUND / 4 + 60 / 4 + 20 / 2 - 1, BACKGROUND / 4 + 60 / 4 + 20 / 2 + 1);
}

/* Up to 64 panes are sorted; more come in the list's order. The nearest, of which half is seen, is the first in the
 * list. */
static void many_panes_come_as_they_are(void **state)
{
    (void)state;
    for (int count = 64; count <= 65; count++) {
        for (int i = 0; i < count; i++) {
            make_pane(i, .9 - i * .02, i == 0 ? 62 : 0, &half);
        }
        assert_in_range(green_of(count, false), count == 64 ? 30 : 0, count == 64 ? 32 : 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_farthest_pane_comes_first),
        cmocka_unit_test(light_is_sorted_among_panes),
        cmocka_unit_test(many_panes_come_as_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
