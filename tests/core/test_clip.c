/* Clipping: what it leaves fits the room and the range of set-up, however its corners are rounded. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_rig.h"

#include "clip.h"

/* A sliver along the line in which two sides of the guard band meet: to rounding it lies in both. */
struct sliver {
    fx_t near_z, far_z;
    uint8_t guard_up;
    int32_t xyz[3][3];
};

static void slivers_in_two_planes_at_once_keep_within_their_room(void **state)
{
    (void)state;
    static const struct sliver slivers[] = {
        {1006, 2277752, 8, {{7437, 7439, -235594}, {-131869, -131958, 4221419}, {-32025, -32025, 1024794}}},
        {9, 6820, 0, {{44650, -44663, -5549}, {-108347, 108377, 13547}, {-50633, 50633, 6329}}},
        {15, 3233633, 7, {{-157803, -157803, -2524805}, {363732, 363738, 5819725}, {129821, 129818, 2077127}}},
    };
    for (size_t k = 0; k < sizeof slivers / sizeof slivers[0]; k++) {
        const struct sliver *s = &slivers[k];
        const struct ph_lens lens = {.near_z = s->near_z, .far_z = s->far_z, .guard_up = s->guard_up};
        struct ph_clip_vertex in[3], out[PH_CLIP_MAX + 1];
        for (int i = 0; i < 3; i++) {
            const int32_t *p = s->xyz[i];
            in[i] = (struct ph_clip_vertex){.x = p[0], .y = p[1], .w = p[2], .z = p[2]};
        }
        out[PH_CLIP_MAX].x = 12345;
        assert_in_range(ph_clip(&lens, in, 3, out), 3, PH_CLIP_MAX);
        assert_int_equal(out[PH_CLIP_MAX].x, 12345);
    }
}

/* One corner lies before the near plane, another one left of the guard band; the far plane between them cuts nothing.
 */
static void two_planes_cut_two_corners(void **state)
{
    (void)state;
    const struct ph_lens lens = {.near_z = FX_ONE, .far_z = FX_INT(100)};
    const struct ph_clip_vertex in[3] = {{.w = FX_HALF, .z = FX_HALF},
                                         {.x = FX_INT(16), .w = FX_INT(4), .z = FX_INT(4)},
                                         {.x = FX_INT(-48), .y = FX_INT(8), .w = FX_INT(4), .z = FX_INT(4)}};
    struct ph_clip_vertex out[PH_CLIP_MAX];
    assert_int_equal(ph_clip(&lens, in, 3, out), 5);
    for (int i = 0; i < 5; i++) {
        const struct ph_clip_vertex *const v = &out[i], *const next = &out[(i + 1) % 5];
        assert_true(v->z >= lens.near_z && v->x >= -8 * v->w - 1);
        assert_true(v->x != next->x || v->y != next->y || v->z != next->z);
    }
}

/* Near plane and corners some LSB from the eye: corners are rounded, and set-up must take them (the sanitizer looks for
 * overflow). */
static void a_triangle_some_lsb_from_the_eye_is_set_up(void **state)
{
    (void)state;
    static const uint16_t triangle[1][3] = {{0, 1, 2}};
    static const struct fx_vec3 corners[3] = {{28, 20, -8}, {-21, -31, -12}, {-31, 28, 1}};
    const struct ph_material material = {.shading = PH_SHADE_UNLIT, .colour = 0xffff, .two_sided = 1};
    const struct ph_part part = {0, 1, 0};
    const struct ph_mesh mesh = {.positions = corners,
                                 .triangles = triangle,
                                 .parts = &part,
                                 .materials = &material,
                                 .vertex_count = 3,
                                 .triangle_count = 1,
                                 .part_count = 1};
    struct ph_projection p = {.kind = PH_PERSPECTIVE, .near_z = 6, .far_z = 8388608};
    p.scale_x_q20 = p.scale_y_q20 = 1073741823;
    struct rig rig;
    rig_open(&rig, 64, 64, 64, PH_DEPTH_FLOAT16, 3, 16);
    assert_int_equal(ph_frame_begin(&rig.r, &ph_xform_identity, &p, NULL, 0), PH_OK);
    assert_int_equal(ph_draw_mesh(&rig.r, &mesh, &ph_xform_identity), PH_OK);
    assert_true(rig.r.stats.triangles_drawn > 0);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slivers_in_two_planes_at_once_keep_within_their_room),
        cmocka_unit_test(two_planes_cut_two_corners),
        cmocka_unit_test(a_triangle_some_lsb_from_the_eye_is_set_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
