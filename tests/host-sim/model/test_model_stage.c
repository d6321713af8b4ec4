/* model_stage: memory for all that a demo asks for; and by what it draws, that the lamps show models as bright as
 * viewers do: the median of the lit pixels is that of the unlit ones, to 15 %. */
#include "model_files.h"
#include "model_stage.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static int the_status;

static int init(struct demo_context *context)
{
    assert_int_equal((uintptr_t)context->arena.base % 16, 0);
    assert_true(context->arena.size == 999 && context->arena.used == 0);
    assert_true(context->width == 70 && context->height == 50);
    memset(context->arena.base, 0xFF, context->arena.size);
    return the_status;
}

static void everything_has_room_of_its_own(void **state)
{
    const struct demo demo = {.arena_bytes = 999, .vertex_max = 13, .init = init};
    const struct model_stage_size size = {.width = 70, .height = 50, .band_height = 20, .triangle_max = 7};
    struct model_stage s;
    (void)state;
    assert_int_equal(model_stage_open(&s, &demo, &the_status, &size), 0);
    const struct ph_config *c = &s.r.config;
    assert_true(c->vertex_max == 13 && c->triangle_max == 7 && c->bin_max == 3 && c->band_height == 20);
    memset(c->vertices, 1, 13 * ph_vertex_bytes); /* under AddressSanitizer what has no room is told */
    memset(c->triangles, 2, 7 * ph_triangle_bytes);
    memset(c->depth, 3, 70 * 20 * 4);
    memset(c->bins, 4, 3 * sizeof *c->bins);
    memset(s.context.arena.base, 5, 999);
    memset(s.pixels, 6, 70 * 20 * 2);
    const uint8_t *const starts[] = {
        c->vertices, c->triangles, c->depth, (const uint8_t *)c->bins, s.context.arena.base, (const uint8_t *)s.pixels};
    const size_t bytes[] = {13 * ph_vertex_bytes, 7 * ph_triangle_bytes, 5600, 12, 999, 2800};
    for (uint8_t i = 0; i < 6; i++) {
        assert_true(starts[i][0] == i + 1 && starts[i][bytes[i] - 1] == i + 1);
    }
    assert_ptr_equal(s.context.state, &the_status);
    free(s.memory);
}

static void errors_are_passed_on(void **state)
{
    const struct demo demo = {.arena_bytes = 999, .vertex_max = 13, .init = init};
    struct model_stage_size size = {.width = 70, .height = 50, .band_height = 20, .triangle_max = 7};
    struct model_stage s;
    (void)state;
    the_status = PH_ERR_NOMEM;
    assert_int_equal(model_stage_open(&s, &demo, &the_status, &size), PH_ERR_NOMEM);
    free(s.memory);
    size.width = 0;
    assert_int_equal(model_stage_open(&s, &demo, &the_status, &size), PH_ERR_INVAL);
    free(s.memory);
}

/* A sphere of 16 x 32 quads; the reader makes its normals smooth. */
static struct model *sphere(void)
{
    enum { RINGS = 16, SIDES = 32 };
    static char text[64000];
    size_t used = 0;
    for (int ring = 0; ring <= RINGS; ring++) {
        for (int side = 0; side < SIDES; side++) {
            const double a = acos(-1) * ring / RINGS, b = 2 * acos(-1) * side / SIDES;
            used += (size_t)snprintf(text + used, sizeof text - used, "v %.6f %.6f %.6f\n", sin(a) * sin(b), cos(a),
                                     sin(a) * cos(b));
        }
    }
    for (int ring = 0; ring < RINGS; ring++) {
        for (int side = 0; side < SIDES; side++) {
            const int a = ring * SIDES + side + 1, b = ring * SIDES + (side + 1) % SIDES + 1;
            used += (size_t)snprintf(text + used, sizeof text - used, "f %d %d %d %d\n", a, a + SIDES, b + SIDES, b);
        }
    }
    return open_good(file_text("sphere.obj", text));
}

/* The median of green, 0 .. 63, of all pixels that are not background. */
static int median_green(struct model *model)
{
    const struct model_stage_size size = {.width = 160, .height = 120, .band_height = 120, .triangle_max = 2000};
    struct demo demo = model_demo(model);
    struct model_stage s;
    int counts[64] = {0}, all = 0, green = 0;
    demo.arena_bytes -= DEMO_TURNTABLE_BYTES - DEMO_TURNTABLE_BARE_BYTES; /* no platter */
    assert_int_equal(model_stage_open(&s, &demo, model, &size), 0);
    assert_int_equal(demo.frame(&s.context, &s.r, 0), 0);
    assert_int_equal(ph_frame_bands(&s.r), 1);
    demo_draw_band(&demo, &s.context, &s.r, 0, s.pixels);
    for (int i = 0; i < 160 * 120; i++) {
        const uint8_t *const wire = (const uint8_t *)&s.pixels[i];
        if (s.pixels[i] != DEMO_MODEL_BACKGROUND) {
            counts[(wire[0] & 7) << 3 | wire[1] >> 5]++;
            all++;
        }
    }
    assert_true(all > 2000);
    for (int below = counts[0]; below * 2 < all; below += counts[green]) {
        green++;
    }
    free(s.memory);
    return green;
}

static void lit_models_are_as_bright_as_unlit_ones(void **state)
{
    (void)state;
    struct model *model = sphere();
    const int lit = median_green(model);
    ((struct ph_material *)(uintptr_t)model->meshes->materials)->shading = PH_SHADE_UNLIT;
    const int unlit = median_green(model);
    assert_true(unlit > 40);
    assert_in_range(lit * 100, unlit * 85, unlit * 115);
    model_close(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everything_has_room_of_its_own),
        cmocka_unit_test(errors_are_passed_on),
        cmocka_unit_test(lit_models_are_as_bright_as_unlit_ones),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
