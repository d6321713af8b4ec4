/* depth_plot_kinds: what stands in the scripts for gnuplot: the data of each curve, which curves there are, their
 * styles and names. The test plays the measurements. */
#define _XOPEN_SOURCE 700
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "depth_budget_terms.h"
#include "depth_plot_kinds.h"
#include "lab_probe.h"
#include "stderr_capture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct depth_lab lab, asked; /* asked: of the command that was played last */
static int refusal;
static struct stderr_capture said;
static char *script;

/* ---- in place of the measurements ------------------------------------------------------------------------- */

/* Writes lines that begin with name and bits, for each format that is asked for. */
static void put_rows(const struct depth_lab *of, const char *const *lines)
{
    for (uint32_t i = 0; i < lab_format_count; i++) {
        for (int k = 0; lines[k] != NULL && (of->formats >> i & 1) != 0; k++) {
            fprintf(of->rows, "%s,%d,1,16,%s\n", lab_formats[i].name, lab_formats[i].bits, lines[k]);
        }
    }
}

int depth_resolve(const struct depth_lab *of)
{
    static const char *const lines[] = {"2,0.5,0.75,1.5", "S_worst,7,8,9", "4,1,3,3", NULL};
    asked = *of;
    fputs("format,bits,near,far,z_m,ideal_m,measured_m,ratio\n# A remark, with a comma.\n", of->rows);
    put_rows(of, lines);
    return refusal;
}

int depth_budget(const struct depth_lab *of)
{
    static const char *const lines[] = {"2,input,3,2.5,", "4,input,6,5,", "2,divide,9,8,dominates", "2,all,12,11,",
                                        NULL};
    asked = *of;
    fputs("format,bits,near,far,z_m,part,predicted_m,measured_m,dominant\n", of->rows);
    put_rows(of, lines);
    return refusal;
}

int lab_probe_open(struct lab_probe *p, const struct lab_format *format, fx_t near_z, fx_t far_z)
{
    *p = (struct lab_probe){.format = format, .near_z = near_z, .far_z = far_z};
    return refusal;
}

/* In whole metres of 1 .. 16: 2 and 3 are equal, and so are 5 and 6, 10 and 11; 4 and 5 are swapped. */
uint32_t lab_code(struct lab_probe *p, fx_t w)
{
    static const uint8_t codes[] = {0, 90, 80, 80, 70, 75, 75, 60, 50, 40, 30, 30, 20, 15, 10, 5, 1};
    assert_true(p->near_z == FX_ONE && p->far_z == FX_INT(16));
    return codes[(w + FX_HALF) / FX_ONE];
}

/* ---- the tests ---------------------------------------------------------------------------------------------- */

static int fresh(void **state)
{
    (void)state;
    lab = (struct depth_lab){.near_z = FX_ONE, .far_z = FX_INT(16), .formats = 1, .count = 15};
    refusal = 0;
    return 0;
}

static int write_kind(const char *name)
{
    uint32_t i = 0;
    size_t length;
    int status;
    free(script);
    script = NULL;
    while (strcmp(depth_plot_kinds[i].name, name) != 0) {
        i++;
        assert_true(i < depth_plot_kind_count);
    }
    FILE *const file = open_memstream(&script, &length);
    assert_non_null(file);
    stderr_capture_begin(&said);
    status = depth_plot_kinds[i].write(&lab, file);
    stderr_capture_end(&said);
    fclose(file);
    return status;
}

static void says(const char *part)
{
    if (strstr(script, part) == NULL) {
        fail_msg("'%s' is not in\n%s", part, script);
    }
}

static uint32_t row_of(const char *name, int bits)
{
    uint32_t i = 0;
    while (strcmp(lab_formats[i].name, name) != 0 || lab_formats[i].bits != bits) {
        i++;
    }
    return i;
}

/* Each of 401 rows against the documents' formulas; a matrix's elements have 16 bits of fraction. */
static void curve_is(const char *tag, double n, double f)
{
    const char *at = strstr(script, tag);
    int rows = 0;
    assert_non_null(at);
    for (at = strchr(at, '\n') + 1; strncmp(at, "EOD\n", 4) != 0; at = strchr(at, '\n') + 1) {
        double z, gl, d3d;
        assert_int_equal(sscanf(at, "%lf %lf %lf", &z, &gl, &d3d), 3);
        assert_true(fabs(z - (-f + (f - n) * rows / 400)) < 1e-6);
        assert_true(fabs(gl - ((f + n) / (f - n) + 2 * f * n / (f - n) / z)) < 1e-4);
        assert_true(fabs(d3d - (f / (f - n) + f * n / (f - n) / z)) < 1e-4);
        rows++;
    }
    assert_int_equal(rows, 401);
}

static void curves_of_documents_have_their_own_planes_or_those_asked_for(void **state)
{
    (void)state;
    assert_int_equal(write_kind("ndc"), 0);
    curve_is("$c0 << EOD\n", .5, 10);
    curve_is("$c1 << EOD\n", 1, 10);
    says("set arrow from -0.952381,-1.05 to -0.952381,0 nohead dt 3 lw 1.5 lc '#0072b2'\n"); /* 2 * 10 * .5 / 10.5 */
    says(" dt 2 lc '#d55e00' title 'n = 1 m, f = 10 m: half before 1.82 m'");
    assert_int_equal(write_kind("g"), 0);
    curve_is("$c0 << EOD\n", 1, 3);
    says("set xrange [-3:0]");
    assert_null(strstr(script, "$c1"));
    lab.near_set = lab.far_set = true;
    lab.nears[0] = lab.near_z, lab.near_count = 1;
    assert_int_equal(write_kind("ndc"), 0);
    curve_is("$c0 << EOD\n", 1, 16);
    assert_null(strstr(script, "$c1"));
    assert_int_equal(write_kind("g"), 0);
    curve_is("$c0 << EOD\n", 1, 16);
    lab.near_set = false; /* the second near plane lies at 1 m, where this far plane lies, too */
    lab.far_z = FX_ONE;
    assert_int_equal(write_kind("ndc"), 0);
    curve_is("$c0 << EOD\n", .5, 1);
    assert_null(strstr(script, "$c1"));
}

static void a_matrix_that_does_not_fit_is_told(void **state)
{
    (void)state;
    lab.near_set = lab.far_set = true;
    lab.near_z = lab.nears[0] = FX_INT(30000), lab.far_z = FX_INT(30000) + 1;
    lab.near_count = 1;
    assert_int_equal(write_kind("g"), PH_ERR_INVAL);
    assert_non_null(strstr(said.text, "this camera's matrix does not fit Q16.16"));
}

static void resolve_asks_at_distances_spread_over_the_logarithm(void **state)
{
    (void)state;
    assert_int_equal(write_kind("resolve"), 0);
    assert_int_equal(asked.at_count, 400);
    assert_true(asked.at[0] == FX_ONE && asked.at[399] == FX_INT(16));
    for (uint32_t i = 1; i < 400; i++) {
        assert_true(fabs(log2(asked.at[i] / 65536.) - 4 * i / 399.) < 1e-4);
    }
    assert_int_equal(write_kind("others"), 0);
    assert_int_equal(asked.at_count, 240);
    lab.at[0] = FX_INT(3), lab.at_count = 1;
    assert_int_equal(write_kind("resolve"), 0);
    assert_true(asked.at_count == 1 && asked.at[0] == FX_INT(3));
}

/* Of each row z, ideal, measured and ratio; S_worst and remarks are no points. */
static void resolve_has_a_block_a_format_and_curves_over_bands(void **state)
{
    (void)state;
    lab.formats = 3;
    lab.format_set = true;
    assert_int_equal(write_kind("resolve"), 0);
    assert_ptr_equal(strstr(script, "$r0 << EOD\n2 0.5 0.75 1.5\n4 1 3 3\nEOD\n$r1 << EOD\n2 0.5 0.75 1.5\n4 1 3 3\n"
                                    "EOD\nset multiplot\n"),
                     script);
    says("set xrange [1:16]\n");
    says("set yrange [1e-6:48]\n");
    says("(thin dots); near 1 m, far 16 m'\n");
    says("more than 10^{-3} z' at 1.1,graph");
    says("one step of Q16.16' at 1.1,8e-6");
    says("less than 10^{-6} z' at 14.4,graph");
    says(", $r0 using 1:2 with lines lw 1 dt 3 lc '#e69f00' notitle, $r1 using 1:2 with lines lw 1 dt 3 lc '#0072b2' "
         "notitle, $r0 using 1:3 with linespoints pt 5 ps 0.6 pi 24 lw 2.2 lc '#e69f00' notitle");
    says(", $r1 using 1:4 with linespoints pt 7 ps 0.6 pi 24 lw 2.2 lc '#0072b2' notitle, keyentry with linespoints");
}

static void renderers_formats_are_shown_by_default_with_one_to_compare(void **state)
{
    const uint32_t log16 = row_of("log", 16), recip = row_of("recip-q16", 24), fixed24 = row_of("fixed24", 24);
    (void)state;
    assert_int_equal(write_kind("resolve"), 0);
    assert_int_equal(asked.formats, depth_drawn_formats(&lab) | 1u << log16);
    char curve[120]; /* of another format: dashed, and below those of the renderer */
    snprintf(curve, sizeof curve, "notitle, $r%u using 1:3 with lines lw 1.6 dt 2 lc '#000000' notitle, $r0 using 1:3",
             (unsigned)log16);
    says(curve);
    says("title 'log 16 bits'\n");
    says("title 'fixed16'");
    lab.formats = 1u << recip | 1u << row_of("float16-e4", 16);
    lab.format_set = true;
    assert_int_equal(write_kind("resolve"), 0);
    assert_int_equal(asked.formats, lab.formats);
    says("with lines lw 1.3 dt 4 lc '#b2182b' title 'recip-q16 24 bits'");
    says(" lc '#117733' title 'float16-e4'");
    lab.format_set = false;
    lab.formats = UINT32_MAX;
    assert_int_equal(write_kind("others"), 0);
    assert_true((asked.formats >> fixed24 & asked.formats >> recip & 1) != 0);
    assert_int_equal(__builtin_popcount(asked.formats), 5);
}

static void pairs_are_counted_in_bins_of_the_logarithm(void **state)
{
    (void)state;
    lab.format_set = true;
    assert_int_equal(write_kind("pairs"), 0);
    assert_ptr_equal(strstr(script, "$p0 << EOD\n1 0\n"), script);
    says("\n2 100\n2.24492 100\n2.24492 0\n");                /* 2 m */
    says("\n4 100\n4.48985 100\n4.48985 100\n5.03968 100\n"); /* 4 and 5 m */
    says("\n8.9797 50\n10.0794 50\n");                        /* 9 and 10 m */
    says("set title '15 pairs of neighbours, linear spacing, that the codes do not order; near 1 m, far 16 m'\n");
    says("plot -5 notitle, $p0 with lines lw 2.4 lc '#e69f00' notitle, keyentry with lines lw 2.4 lc '#e69f00' title "
         "'fixed16: 26.7 % of all'\n");
    lab.spacing = LAB_LOG_SPACED; /* 1, 4, 16 m: none is wrong */
    lab.count = 2;
    assert_int_equal(write_kind("pairs"), 0);
    says("set title '2 pairs of neighbours, log spacing");
    says("title 'fixed16: 0 % of all'\n");
}

static void budget_has_a_block_a_part_and_a_panel_a_format(void **state)
{
    (void)state;
    lab.formats = 7;
    assert_int_equal(write_kind("budget"), 0);
    assert_int_equal(asked.at_count, 8);
    for (uint32_t i = 0; i < 8; i++) {
        assert_true(fabs(log2(asked.at[i] / 65536.) - (i + 1) / 2.) < 1e-4);
    }
    assert_int_equal(asked.at[7], FX_INT(16));
    says("set xrange [1.41422:16]\nset yrange [1e-9:1.6]\n");
    says("$b0_0 << EOD\n2 3 2.5\n4 6 5\nEOD\n$b0_1 << EOD\nEOD\n$b0_2 << EOD\n2 9 8\nEOD\n");
    says("$b0_6 << EOD\n2 12 11\nEOD\nset lmargin at screen 0.09\nset rmargin at screen 0.5\nset tmargin at screen "
         "0.93\n"
         "set bmargin at screen 0.565\nset title 'fixed16' offset 0,-0.6\nset ylabel 'separation [m]'\n"
         "set xlabel '' offset 0,0.5\nset key at screen 0.64,0.25 left top vertical\n");
    says("set lmargin at screen 0.57\nset rmargin at screen 0.98\nset tmargin at screen 0.93\n"); /* the second */
    says("set ylabel ''\nset xlabel 'distance z [m]' offset 0,0.5\nset key off\n");
    says("set lmargin at screen 0.09\nset rmargin at screen 0.5\nset tmargin at screen 0.5\nset bmargin at screen "
         "0.135\n");
    says(", $b2_6 using 1:3 with linespoints pt 10 ps 0.6 lw 2.6 lc '#000000' title 'all together', $b2_6 using 1:2 ");
    says(", $b2_0 using 1:3 with linespoints pt 4 ps 0.6 lw 1.6 lc '#999999' title 'input'");
    lab.formats = 5; /* two panels have the key below them */
    assert_int_equal(write_kind("budget"), 0);
    says("set tmargin at screen 0.93\nset bmargin at screen 0.135\nset title 'fixed16' offset 0,-0.6\nset ylabel "
         "'separation [m]'\nset xlabel 'distance z [m]' offset 0,0.5\nset key at screen 0.53,0.002 center bottom");
    lab.formats = 1;
    lab.at[0] = FX_INT(2), lab.at_count = 1;
    assert_int_equal(write_kind("budget"), 0);
    assert_int_equal(asked.at_count, 1);
    says("set lmargin at screen 0.09\nset rmargin at screen 0.97\n");
    says("set xlabel 'distance z [m]' offset 0,0.5\nset key at screen 0.53,0.002 center bottom");
}

static void what_cannot_be_measured_is_passed_on(void **state)
{
    static const char *const kinds[] = {"resolve", "others", "budget"};
    (void)state;
    refusal = COMPLAINED;
    for (int i = 0; i < 3; i++) {
        assert_int_equal(write_kind(kinds[i]), COMPLAINED);
        assert_string_equal(script, "");
    }
    assert_int_equal(write_kind("pairs"), COMPLAINED);
    assert_non_null(strstr(said.text, "plot: fixed16 cannot be measured here"));
}

static char *rows_of(const char *name)
{
    static char text[4096];
    uint32_t i = 0;
    while (strcmp(depth_plot_kinds[i].name, name) != 0) {
        i++;
    }
    memset(text, 0, sizeof text);
    lab.rows = fmemopen(text, sizeof text, "w");
    assert_non_null(lab.rows);
    assert_int_equal(depth_plot_kinds[i].rows(&lab), 0);
    fclose(lab.rows);
    return text;
}

/* HAW's two curves: z_ndc = (f + n) / (f - n) + 2 n f / (f - n) / z in fractions. With f = 9, n = 1, 3 all elements fit
 * Q16.16. At z = -3 the first is 5/4 - 9/12 = 1/2, at -6 it is 5/4 - 9/24 = 7/8. From 0 to 1 a value is half of it
 * and 1/2. */
static void rows_are_the_curves_of_all_near_planes(void **state)
{
    (void)state;
    lab.near_set = lab.far_set = true;
    lab.near_count = 2;
    lab.nears[0] = FX_ONE, lab.nears[1] = FX_INT(3), lab.far_z = FX_INT(9);
    lab.at_count = 3;
    lab.at[0] = FX_INT(3), lab.at[1] = FX_INT(6), lab.at[2] = FX_INT(9);
    assert_string_equal(rows_of("ndc"), "near_m,far_m,z_m,z_ndc,z_0_to_1\n"
                                        "1,9,-3,0.5,0.75\n1,9,-6,0.875,0.9375\n1,9,-9,1,1\n"
                                        "3,9,-3,-1,0\n3,9,-6,0.5,0.75\n3,9,-9,1,1\n");
    lab.near_set = lab.far_set = false; /* exercise 5: f = 3, n = 1 */
    lab.at_count = 2;
    lab.at[0] = FX_ONE, lab.at[1] = FX_ONE * 3 / 2;
    assert_string_equal(rows_of("g"), "near_m,far_m,z_m,z_ndc,z_0_to_1\n1,3,-1,-1,0\n1,3,-1.5,0,0.5\n");
}

static void a_curve_is_drawn_for_each_near_plane(void **state)
{
    (void)state;
    lab.near_set = lab.far_set = true;
    lab.near_count = 3;
    lab.nears[0] = FX_HALF, lab.nears[1] = FX_ONE, lab.nears[2] = FX_INT(2), lab.far_z = FX_INT(10);
    assert_int_equal(write_kind("ndc"), 0);
    says("title 'n = 0.5 m, f = 10 m: half before 0.95 m'");
    says("title 'n = 1 m, f = 10 m: half before 1.82 m'");
    says("title 'n = 2 m, f = 10 m: half before 3.33 m'");
    assert_null(strstr(script, "$c3"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(rows_are_the_curves_of_all_near_planes, fresh),
        cmocka_unit_test_setup(a_curve_is_drawn_for_each_near_plane, fresh),
        cmocka_unit_test_setup(curves_of_documents_have_their_own_planes_or_those_asked_for, fresh),
        cmocka_unit_test_setup(a_matrix_that_does_not_fit_is_told, fresh),
        cmocka_unit_test_setup(resolve_asks_at_distances_spread_over_the_logarithm, fresh),
        cmocka_unit_test_setup(resolve_has_a_block_a_format_and_curves_over_bands, fresh),
        cmocka_unit_test_setup(renderers_formats_are_shown_by_default_with_one_to_compare, fresh),
        cmocka_unit_test_setup(pairs_are_counted_in_bins_of_the_logarithm, fresh),
        cmocka_unit_test_setup(budget_has_a_block_a_part_and_a_panel_a_format, fresh),
        cmocka_unit_test_setup(what_cannot_be_measured_is_passed_on, fresh),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    free(script);
    return failed;
}
