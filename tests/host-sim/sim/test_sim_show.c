/* sim_show: the depth buffer as greys, of a triangle at a known distance. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "sim_show.h"

#define SIDE 8

/* ---- in place of the linker ----------------------------------------------------------------------------------- */

// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
uint32_t __real_demo_draw_band(const struct demo *demo, struct demo_context *context, struct ph_renderer *r,
                               uint32_t band, uint16_t *pixels);
uint32_t __real_demo_draw_band(const struct demo *demo, struct demo_context *context, struct ph_renderer *r,
                               uint32_t band, uint16_t *pixels)
{
    (void)demo, (void)context;
    return ph_draw_band(r, band, pixels);
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

static uint16_t pixels[SIDE * SIDE];
static uint32_t depth[SIDE * SIDE];

/* Draws a red triangle over the lower left half of the picture, 4 before the eye; near is 1, far 9. */
static void draw(const struct ph_depth_format *format)
{
    static uint64_t room[256];
    static uint32_t bin;
    static struct ph_renderer r;
    static const struct fx_vec3 corners[] = {{FX_INT(-16), FX_INT(-16), FX_INT(-4)},
                                             {FX_INT(16), FX_INT(-16), FX_INT(-4)},
                                             {FX_INT(-16), FX_INT(16), FX_INT(-4)}};
    static const uint16_t faces[][3] = {{0, 1, 2}};
    static const struct ph_part all = {.count = 1};
    const struct ph_material red = {.shading = PH_SHADE_UNLIT, .colour = ph_rgb565(255, 0, 0)};
    const struct ph_mesh mesh = {.positions = corners,
                                 .vertex_count = 3,
                                 .triangles = faces,
                                 .triangle_count = 1,
                                 .parts = &all,
                                 .part_count = 1,
                                 .materials = &red};
    const struct ph_config config = {.width = SIDE,
                                     .height = SIDE,
                                     .band_height = SIDE,
                                     .depth_format = format,
                                     .vertices = room,
                                     .vertex_max = 8,
                                     .triangles = room,
                                     .triangle_max = 16,
                                     .bins = &bin,
                                     .bin_max = 1,
                                     .depth = depth};
    const struct ph_projection lens = {
        .scale_x_q20 = 1 << 20, .scale_y_q20 = 1 << 20, .near_z = FX_ONE, .far_z = FX_INT(9)};
    assert_int_equal(ph_renderer_init(&r, &config), PH_OK);
    assert_int_equal(ph_frame_begin(&r, &ph_xform_identity, &lens, NULL, ph_rgb565(0, 0, 255)), PH_OK);
    assert_int_equal(ph_draw_mesh(&r, &mesh, &ph_xform_identity), PH_OK);
    assert_int_equal(ph_frame_bands(&r), 1);
    assert_int_equal(sim_show_draw_band(NULL, NULL, &r, 0, pixels), SIDE);
}

static uint16_t at(int x, int y)
{
    return pixels[y * SIDE + x];
}

/* fixed16 by depth.h: floor(2^16 d + 16 1/4) with d = N/w - N/f, N = (1 - 2^-9) 9/8, is 10236: 39.8 of 255. */
static void grey_is_the_share_of_the_largest_code(void **state)
{
    (void)state;
    sim_show_depth(true);
    draw(PH_DEPTH_FIXED16);
    assert_int_equal(at(1, 6), ph_rgb565(40, 40, 40));
    assert_int_equal(at(6, 1), ph_rgb565(0, 0, 0)); /* nothing is there */
    draw(PH_DEPTH_FIXED24);
    assert_int_equal(at(1, 6), ph_rgb565(40, 40, 40)); /* the same share of 2^24 - 1 */
    assert_int_equal(at(6, 1), ph_rgb565(0, 0, 0));
}

static void the_picture_is_shown_unless_depth_is_asked_for(void **state)
{
    (void)state;
    sim_show_depth(false);
    draw(PH_DEPTH_FIXED16);
    assert_int_equal(at(1, 6), ph_rgb565(255, 0, 0));
    assert_int_equal(at(6, 1), ph_rgb565(0, 0, 255));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grey_is_the_share_of_the_largest_code),
        cmocka_unit_test(the_picture_is_shown_unless_depth_is_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
