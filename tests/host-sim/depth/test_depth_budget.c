/* depth_budget: which distances and formats are looked at, and the rows that are put; what is predicted and measured is
 * played by the test. */
#define _XOPEN_SOURCE 700
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "depth_budget_measure.h"
#include "depth_planes_count.h"
#include "depth_separation.h"
#include "lab_search.h"
#include "stderr_capture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double measured[DEPTH_SHARES]; /* at 1 m; they grow with the distance */
static double tilts[16];
static unsigned sweeps;
static int open_status, probe_status, is_open;
static const struct ph_depth_format *opened;

/* In place of what depth_budget.c calls. */
const char *const depth_share_names[DEPTH_SHARES] = {"input", "matrix",        "divide",
                                                     "store", "interpolation", "sub-pixel"};

uint32_t depth_drawn_formats(const struct depth_lab *lab)
{
    return lab->formats & 7;
}

double depth_share_m(enum depth_share share, const struct ph_depth_format *format, const struct depth_lab *lab,
                     double z)
{
    assert_true(format != NULL && lab->near_z > 0);
    return z * (1 + (int)share);
}

int depth_planes_open(struct planes_canvas *canvas, const struct depth_lab *lab, const struct ph_depth_format *format)
{
    *canvas = (struct planes_canvas){.lab = lab};
    opened = format;
    is_open++;
    return open_status;
}

void depth_planes_close(struct planes_canvas *canvas)
{
    assert_non_null(canvas->lab);
    is_open--;
}

struct planes_sweep depth_planes_sweep(struct planes_canvas *canvas, const struct ph_depth_format *format,
                                       struct planes_lean lean)
{
    assert_true(canvas->lab != NULL && format == opened && isnan(lean.azimuth_deg));
    tilts[sweeps++ % 16] = lean.tilt_deg;
    return (struct planes_sweep){.found_m = lean.at_m * (10 + lean.tilt_deg / 85)};
}

double depth_way_px(const struct depth_lab *lab)
{
    return lab->width;
}

double depth_separation_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z, double tilt_deg,
                          double way_px)
{
    assert_true(format == opened && lab->near_z > 0 && tilt_deg == 90 && way_px == lab->width);
    return z * 100;
}

void depth_separation_text(double metres, char text[LAB_TEXT_SIZE])
{
    snprintf(text, LAB_TEXT_SIZE, "%g m", metres);
}

double depth_budget_input_m(struct planes_canvas *canvas, double z)
{
    (void)canvas;
    return z * measured[0];
}

double depth_budget_matrix_m(struct planes_canvas *canvas, double z)
{
    (void)canvas;
    return z * measured[1];
}

double depth_budget_divide_m(struct planes_canvas *canvas, double z)
{
    (void)canvas;
    return z * measured[2];
}

double depth_budget_interpolation_m(struct planes_canvas *canvas, double z)
{
    (void)canvas;
    return z * measured[4];
}

double depth_budget_subpixel_m(struct planes_canvas *canvas, double z)
{
    (void)canvas;
    return z * measured[5];
}

int lab_probe_open(struct lab_probe *p, const struct lab_format *format, fx_t near_z, fx_t far_z)
{
    *p = (struct lab_probe){.format = format, .near_z = near_z, .far_z = far_z};
    return probe_status;
}

void lab_search_open(struct lab_search *s, struct lab_probe *p)
{
    assert_true(s != NULL && p->far_z > p->near_z);
}

uint32_t lab_search_at(struct lab_search *s, struct lab_probe *p, fx_t z)
{
    assert_true(s != NULL && p->format != NULL);
    return (uint32_t)(z * measured[3]); /* in LSBs */
}

static struct depth_lab lab;
static char *csv;

static int fresh(void **state)
{
    (void)state;
    lab = (struct depth_lab){
        .near_z = FX_HALF, .far_z = FX_INT(100), .formats = 1, .width = 8, .height = 8, .fov_deg = FX_INT(60)};
    for (int i = 0; i < DEPTH_SHARES; i++) {
        measured[i] = 1 << i;
    }
    sweeps = 0;
    open_status = probe_status = is_open = 0;
    return 0;
}

static int run(void)
{
    struct stderr_capture said;
    free(csv);
    stderr_capture_begin(&said);
    const int status = depth_lab_capture(&lab, depth_budget, &csv);
    stderr_capture_end(&said);
    assert_int_equal(is_open, 0);
    return status;
}

#define HEAD "format,bits,near,far,z_m,part,predicted_m,measured_m,dominant\n"

static void each_part_has_a_row_and_all_have_one(void **state)
{
    (void)state;
    lab.at[0] = FX_INT(4), lab.at_count = 1;
    assert_int_equal(run(), 0);
    assert_string_equal(csv, HEAD "fixed16,16,0.5,100,4,input,4,4,\n"
                                  "fixed16,16,0.5,100,4,matrix,8,8,\n"
                                  "fixed16,16,0.5,100,4,divide,12,16,\n"
                                  "fixed16,16,0.5,100,4,store,16,32,\n"
                                  "fixed16,16,0.5,100,4,interpolation,20,64,\n"
                                  "fixed16,16,0.5,100,4,sub-pixel,24,128,dominates\n"
                                  "fixed16,16,0.5,100,4,all,400 m,44,\n");
    assert_true(sweeps == 4 && tilts[0] == 0 && tilts[1] == 40 && tilts[2] == 75 && tilts[3] == 85);
}

static void the_largest_part_dominates_and_what_is_none_is_told(void **state)
{
    (void)state;
    lab.at[0] = FX_ONE, lab.at_count = 1;
    measured[3] = 50;
    measured[5] = 49;
    assert_int_equal(run(), 0);
    assert_non_null(strstr(csv, ",store,4,50,dominates\n"));
    assert_non_null(strstr(csv, ",sub-pixel,6,49,\n"));
    measured[1] = HUGE_VAL;
    assert_int_equal(run(), 0);
    assert_non_null(strstr(csv, ",matrix,2,none,\n"));
}

/* Twice the near plane, its decades, and the far plane. */
static void without_distances_each_decade_is_looked_at(void **state)
{
    static const char *const distances[] = {",1,input", ",10,input", ",100,input"};
    const char *at;
    (void)state;
    assert_int_equal(run(), 0);
    at = csv;
    for (int i = 0; i < 3; i++) {
        at = strstr(at, distances[i]);
        assert_non_null(at);
    }
    assert_int_equal(sweeps, 12);
    lab.near_z = 1, lab.far_z = FX_MAX; /* 2, 20 .. 2 000 000 000 LSBs */
    sweeps = 0;
    assert_int_equal(run(), 0);
    assert_int_equal(sweeps, 4 * 11);
}

static void each_format_that_was_asked_for_is_looked_at(void **state)
{
    (void)state;
    lab.formats = 5 | 1 << 5; /* the last one is not drawn */
    lab.at[0] = FX_ONE, lab.at[1] = FX_INT(2), lab.at_count = 2;
    assert_int_equal(run(), 0);
    assert_int_equal(sweeps, 2 * 2 * 4);
    assert_non_null(strstr(csv, "\nfixed16,16,0.5,100,2,all,"));
    assert_non_null(strstr(csv, "\nfixed24,24,0.5,100,2,all,"));
    lab.formats = 1 << 5;
    assert_int_equal(run(), PH_ERR_INVAL);
}

static void what_cannot_be_measured_is_told(void **state)
{
    (void)state;
    probe_status = PH_ERR_INVAL;
    assert_int_equal(run(), COMPLAINED);
    assert_string_equal(csv, HEAD);
    probe_status = 0;
    open_status = COMPLAINED;
    assert_int_equal(run(), COMPLAINED);
    assert_int_equal(sweeps, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(each_part_has_a_row_and_all_have_one, fresh),
        cmocka_unit_test_setup(the_largest_part_dominates_and_what_is_none_is_told, fresh),
        cmocka_unit_test_setup(without_distances_each_decade_is_looked_at, fresh),
        cmocka_unit_test_setup(each_format_that_was_asked_for_is_looked_at, fresh),
        cmocka_unit_test_setup(what_cannot_be_measured_is_told, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
