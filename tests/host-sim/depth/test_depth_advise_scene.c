/* depth_advise_scene: what is counted of scenes that the test plays, pixel by pixel: surfaces that are just further
 * apart than what a format can tell, or just less. */
#define _XOPEN_SOURCE 700
#include "complain.h"
#include "depth_advise_scene.h"
#include "depth_budget_terms.h"
#include "depth_layers.h"
#include "stderr_capture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 4, HEIGHT = 3, PIXELS = WIDTH * HEIGHT };

static struct depth_lab lab;
static struct scene_pixel played[2][PIXELS]; /* of frames 7 and 8 */
static uint16_t shown[PIXELS];               /* in every format */
static struct scene_surface surfaces[3];
static struct scene_draw draws[1];
static int open_status;
static double file_scale;
static unsigned shows, is_open;

/* In place of depth_layers.c. */
int depth_layers_open(struct depth_layers *s, const struct depth_lab *of)
{
    static struct scene_pixel layers[PIXELS];
    assert_string_equal(of->demo, "played");
    *s = (struct depth_layers){.lab = of,
                               .pixels = shown,
                               .layers = layers,
                               .surfaces = surfaces,
                               .draws = draws,
                               .surface_count = 3,
                               .draw_count = 1,
                               .lens = {.kind = PH_PERSPECTIVE, .near_z = FX_ONE, .far_z = FX_INT(1000)}};
    is_open++;
    return open_status;
}

double depth_layers_file_scale(const struct depth_layers *s)
{
    assert_true(s->pixels == shown);
    return file_scale;
}

void depth_layers_close(struct depth_layers *s)
{
    assert_true(s->pixels == shown);
    is_open--;
}

int depth_layers_find(struct depth_layers *s, uint32_t frame)
{
    assert_in_range(frame, 7, 8);
    memcpy(s->layers, played[frame - 7], sizeof played[0]);
    return 0;
}

int depth_layers_show(struct depth_layers *s, const struct lab_format *format, fx_t near_z)
{
    assert_true(s->pixels == shown && format->kind == LAB_DRAWN && near_z >= FX_ONE);
    shows++;
    return 0;
}

static int fresh(void **state)
{
    (void)state;
    memset(played, 0, sizeof played);
    memset(shown, 0, sizeof shown);
    memset(surfaces, 0, sizeof surfaces);
    draws[0] = (struct scene_draw){.lens = {.kind = PH_PERSPECTIVE}};
    for (int i = 0; i < 3; i++) {
        surfaces[i].look.shading = PH_SHADE_UNLIT;
        snprintf(surfaces[i].colour, sizeof surfaces[i].colour, "#00000%u", (unsigned)i % 10);
    }
    lab = (struct depth_lab){.demo = "played",
                             .near_z = FX_ONE,
                             .far_z = FX_INT(1000),
                             .formats = 1,
                             .width = WIDTH,
                             .height = HEIGHT,
                             .start = 7,
                             .frames = 1,
                             .fov_deg = FX_INT(60)};
    open_status = 0;
    file_scale = 0;
    shows = is_open = 0;
    return 0;
}

/* Two surfaces at a pixel: 0 in front at z, 1 behind it by `gap`. */
static struct scene_pixel *put_two(int pixel, double z, double gap)
{
    played[0][pixel] = (struct scene_pixel){2, {{.z_m = z}, {.z_m = z + gap, .surface = 1}}};
    return &played[0][pixel];
}

static char *csv;

static const char *advise(void)
{
    free(csv);
    assert_int_equal(depth_lab_capture(&lab, depth_advise_scene, &csv), 0);
    assert_int_equal(is_open, 0);
    return csv;
}

static void says(const char *line)
{
    if (strstr(csv, line) == NULL) {
        fail_msg("'%s' is not in\n%s", line, csv);
    }
}

static double step_at(double z)
{
    return z * z / (511 / 512. * 1000 / 999) / 65536; /* of fixed16 with the scene's own near plane */
}

/* 1.25 steps of the one behind; the larger near plane, 9.9 of the nearest at 10 m, tells both apart. */
static void surfaces_fight_within_one_and_a_quarter_steps(void **state)
{
    (void)state;
    put_two(0, 10, 1.24 * step_at(10));
    put_two(1, 11, 1.26 * step_at(11));
    played[0][2] = (struct scene_pixel){1, {{.z_m = 20}}};
    advise();
    says("fixed16,16,0,1,1000,3,2,1,33.33,0,0\n");
    says("fixed16,16,0,9.9,1000,3,2,0,0,0,0\n");
    says("#! Take fixed16 (16 bits) with the near plane at 9.9 m: 0 of 3 pixels (0 %) would fight.\n");
    says("# Surface 1 (#000000) before surface 2 (#000001): 2 pixels, ");
    says("the least at 10 m. With the near plane at 1 m fight: fixed16 50 %.\n");
    assert_int_equal(shows, 2);
}

/* Slopes of 8 m and 4 m a pixel move the two by sqrt(2) / 512 of 12 m, 33 mm, whatever the format. */
static void the_grid_moves_leaning_surfaces_in_every_format(void **state)
{
    (void)state;
    struct scene_pixel *p = put_two(0, 10, 12 * sqrt(2) / 512 * .99);
    p->layers[0].slope_m = 8, p->layers[1].slope_m = 4;
    p = put_two(1, 10, 12 * sqrt(2) / 512 * 1.5);
    p->layers[0].slope_m = 8, p->layers[1].slope_m = 4;
    p = put_two(2, 10, .04);
    p->layers[0].off_m = .03, p->layers[1].off_m = .02;
    advise();
    says("fixed16,16,0,9.9,1000,3,3,2,66.67,0,0\n");
    says("2 of them in every format: the sub-pixel grid moves them more than they are apart.\n");
}

/* A house of 60 m is drawn with a radius of 1 m, and a poster hangs 1 mm from its wall. */
static void a_gap_is_told_in_units_of_the_file_as_well(void **state)
{
    (void)state;
    put_two(0, 10, .001 / 30);
    advise();
    assert_null(strstr(csv, "file"));
    file_scale = 1 / 30.;
    advise();
    says("# The model is drawn with a radius of 1 m: 1 m here is 30 units of its file.\n");
    says("1 pixels, 3.33e-05 m (0.001 units of the file) apart or more, the least at 10 m.");
}

/* Biases of 3 codes set the one in front apart by three more steps. */
static void depth_biases_set_surfaces_apart(void **state)
{
    (void)state;
    put_two(0, 10, .1 * step_at(10))->layers[0].bias = 3;
    put_two(2, 10, .1 * step_at(10))->layers[0].bias = 3;
    put_two(1, 10, .1 * step_at(10))->layers[1].bias = 3;
    advise();
    says("fixed16,16,0,1,1000,3,3,1,33.33,0,0\n");
}

static void one_surface_fights_with_itself_if_it_is_lit(void **state)
{
    (void)state;
    for (int is_lit = 0; is_lit < 2; is_lit++) {
        fresh(NULL);
        put_two(0, 10, 1e-4)->layers[1].surface = 0;
        put_two(1, 10, 0)->layers[1].surface = 1; /* one triangle that is drawn twice */
        surfaces[0].look.shading = is_lit ? PH_SHADE_GOURAUD : PH_SHADE_UNLIT;
        advise();
        says(is_lit ? "fixed16,16,0,1,1000,2,1,1,50,0,0\n" : "fixed16,16,0,1,1000,2,0,0,0,0,0\n");
    }
}

/* What shows is compared with the nearest; it is unforeseen where nothing fights there. */
static void wrong_pixels_are_counted_and_those_that_were_not_foreseen(void **state)
{
    (void)state;
    put_two(0, 10, 1e-4);
    put_two(1, 10, 5);
    put_two(2, 10, 5);
    put_two(4, 10, 1e-4);
    shown[0] = shown[1] = shown[4] = 2; /* surface 1 */
    shown[2] = 1;
    shown[3] = 3; /* where there is nothing */
    advise();
    says("fixed16,16,0,1,1000,4,4,2,50,3,1\n");
    says("fixed16,16,0,9.9,1000,4,4,2,50,3,1\n");
}

static void frames_are_summed_and_the_nearest_of_all_counts(void **state)
{
    (void)state;
    lab.frames = 2;
    put_two(0, 10, 1e-4);
    played[1][0] = played[1][1] = (struct scene_pixel){1, {{.z_m = 2.345}}};
    advise();
    says("fixed16,16,0,2.3,1000,3,1,1,33.33,0,0\n");
    fresh(NULL);
    played[0][0] = (struct scene_pixel){1, {{.z_m = 1.005}}};
    advise(); /* .99 of it is below the own near plane */
    assert_null(strstr(csv, ",1000,1,0,0,0,0,0\nfixed16"));
}

/* Formats of as few fights: the cheapest one; 0 fixed16, 1 float16, 2 fixed24. */
static void the_cheapest_of_the_best_is_advised(void **state)
{
    (void)state;
    lab.formats = 7;
    put_two(0, 10, 5);
    advise();
    says("#! Take fixed16 (16 bits) with the near plane at 1 m");
    fresh(NULL);
    lab.formats = 6;
    put_two(0, 10, 5);
    advise();
    says("#! Take float16 (16 bits) with the near plane at 1 m");
    fresh(NULL);
    lab.formats = 5;
    played[0][1] = (struct scene_pixel){1, {{.z_m = 1.005}}}; /* no larger near plane */
    put_two(0, 10, 1.24 * step_at(10));
    advise();
    says("#! Take fixed24 (24 bits) with the near plane at 1 m");
    fresh(NULL);
    lab.formats = 7, lab.bits = 24;
    put_two(0, 10, 5);
    advise();
    says("#! Take fixed24");
    assert_null(strstr(csv, "fixed16"));
}

/* A parallel step of fixed16 is 999 m / (511/512) / 65536, 15 mm; its floats have 3 bits of exponent. */
static void parallel_projections_have_their_own_steps(void **state)
{
    (void)state;
    draws[0].lens.kind = PH_ORTHOGRAPHIC;
    lab.formats = 3;
    for (int i = 0; i < 2; i++) {
        struct scene_pixel *const p = put_two(i, 1.005, (i == 0 ? 1.24 : 1.26) * 999 / (511 / 512.) / 65536);
        p->layers[0].parallel = p->layers[1].parallel = true;
    }
    advise();
    says("fixed16,16,0,1,1000,2,2,1,50,0,0\n");
    says("float16,16,3,1,1000,2,2,");
}

static void what_cannot_be_asked_is_told(void **state)
{
    struct stderr_capture said;
    (void)state;
    lab.formats = 0;
    free(csv);
    stderr_capture_begin(&said);
    int status = depth_lab_capture(&lab, depth_advise_scene, &csv);
    stderr_capture_end(&said);
    assert_int_equal(status, PH_ERR_INVAL);
    assert_non_null(strstr(said.text, "none of these formats is drawn"));
    open_status = COMPLAINED;
    free(csv);
    assert_int_equal(depth_lab_capture(&lab, depth_advise_scene, &csv), COMPLAINED);
    assert_int_equal(is_open, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(surfaces_fight_within_one_and_a_quarter_steps, fresh),
        cmocka_unit_test_setup(the_grid_moves_leaning_surfaces_in_every_format, fresh),
        cmocka_unit_test_setup(a_gap_is_told_in_units_of_the_file_as_well, fresh),
        cmocka_unit_test_setup(depth_biases_set_surfaces_apart, fresh),
        cmocka_unit_test_setup(one_surface_fights_with_itself_if_it_is_lit, fresh),
        cmocka_unit_test_setup(wrong_pixels_are_counted_and_those_that_were_not_foreseen, fresh),
        cmocka_unit_test_setup(frames_are_summed_and_the_nearest_of_all_counts, fresh),
        cmocka_unit_test_setup(the_cheapest_of_the_best_is_advised, fresh),
        cmocka_unit_test_setup(parallel_projections_have_their_own_steps, fresh),
        cmocka_unit_test_setup(what_cannot_be_asked_is_told, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
