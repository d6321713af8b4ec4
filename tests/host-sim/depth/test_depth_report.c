/* depth_report: the sections of the report, their tables, remarks, commands and files; and what is left when a command
 * fails. The test plays the commands, the plots and the searches. */
#define _XOPEN_SOURCE 700
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "depth_gnuplot.h"
#include "depth_plot.h"
#include "files.h"
#include "depth_separation.h"
#include "stderr_capture.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static struct depth_lab lab, advised;
static const char *failing; /* the command that fails */
static char ran[256];       /* the commands and plots that ran, with where `planes` was to draw */
static bool can_plot;
static uint32_t worst[32]; /* LSBs, by row of lab_formats */
static uint32_t probed;

/* ---- in place of the commands ----------------------------------------------------------------------------- */

static int play(const struct depth_lab *of, const char *name)
{
    char *const end = ran + strlen(ran);
    snprintf(end, sizeof ran - (size_t)(end - ran), "%s%s ", name, of->out != NULL ? "!" : "");
    fprintf(of->rows, "a,b\n%s,2\n# A remark.\n3,\n#! The answer, of %s.\n", name, name);
    return failing != NULL && strcmp(failing, name) == 0 ? complain("%s failed", name) : 0;
}

int depth_advise(const struct depth_lab *of)
{
    advised = *of;
    return play(of, "advise");
}

int depth_resolve(const struct depth_lab *of)
{
    return play(of, "resolve");
}

int depth_pairs(const struct depth_lab *of)
{
    return play(of, "pairs");
}

int depth_budget(const struct depth_lab *of)
{
    return play(of, "budget");
}

int depth_planes(const struct depth_lab *of)
{
    assert_non_null(of->out);
    assert_string_equal(strrchr(of->out, '/'), "/planes.png");
    return play(of, "planes");
}

int depth_slopes(const struct depth_lab *of)
{
    return play(of, "slopes");
}

int depth_scenes(const struct depth_lab *of)
{
    return play(of, "scenes");
}

int depth_monotone(const struct depth_lab *of)
{
    return play(of, "monotone");
}

int depth_anchors(const struct depth_lab *of)
{
    return play(of, "anchors");
}

bool depth_gnuplot_is_here(void)
{
    return can_plot;
}

const struct depth_plot_kind *depth_plot_find(const char *name)
{
    static struct depth_plot_kind kind;
    kind = (struct depth_plot_kind){.name = name, .title = "A plot"};
    return &kind;
}

int depth_plot_picture(const struct depth_lab *of, const struct depth_plot_kind *kind, bool png, char **picture,
                       size_t *length)
{
    char *const end = ran + strlen(ran);
    assert_false(png);
    snprintf(end, sizeof ran - (size_t)(end - ran), "(%s%s%s) ", kind->name, of->near_set ? " near" : "",
             of->far_set ? " far" : "");
    *picture = strdup(kind->name);
    *length = strlen(kind->name);
    return 0;
}

double depth_way_px(const struct depth_lab *of)
{
    return of->width;
}

/* The rows of a format differ in their bits of exponent. */
double depth_separation_m(const struct ph_depth_format *format, const struct depth_lab *of, double z, double tilt_deg,
                          double way_px)
{
    const struct lab_format *row = lab_formats;
    while (row->format != format || row->kind != LAB_DRAWN || row->exponent != of->exponent) {
        row++;
    }
    assert_true(z == lab.far_z / 65536. && tilt_deg == 0 && way_px == lab.width);
    probed++;
    return worst[row - lab_formats] / 65536.;
}

/* ---- the tests ---------------------------------------------------------------------------------------------- */

static struct stderr_capture said;
static char *text; /* of the report; NULL: there is none */

static int fresh(void **state)
{
    (void)state;
    lab = (struct depth_lab){.near_z = FX_HALF,
                             .far_z = FX_INT(100) + 1,
                             .near_set = true,
                             .far_set = true,
                             .fov_deg = FX_INT(60),
                             .width = 8,
                             .height = 6};
    for (int i = 0; i < 32; i++) {
        worst[i] = 66000;
    }
    failing = NULL;
    can_plot = true;
    probed = 0;
    return 0;
}

static char *read_text(const char *name)
{
    size_t n = 0;
    uint8_t *const bytes = file_read(name, &n);
    char *const copy = malloc(n + 1);
    assert_non_null(copy);
    memcpy(copy, bytes, n);
    copy[n] = '\0';
    free(bytes);
    return copy;
}

static int report(const char *folder)
{
    char name[64];
    ran[0] = '\0';
    free(text);
    text = NULL;
    lab.out = folder != NULL ? file_path(folder) : NULL;
    stderr_capture_begin(&said);
    const int status = depth_report(&lab);
    stderr_capture_end(&said);
    if (status == 0) {
        snprintf(name, sizeof name, "%s/report.md", folder);
        text = read_text(name);
    }
    return status;
}

static void says(const char *part)
{
    if (strstr(text, part) == NULL) {
        fail_msg("'%s' is not in\n%s", part, text);
    }
}

static void every_command_and_plot_runs_once_in_order(void **state)
{
    (void)state;
    assert_int_equal(report("order"), 0);
    assert_string_equal(ran,
                        "advise resolve (resolve near far) (others near far) pairs (pairs near far) budget (budget "
                        "near far) planes! slopes scenes monotone anchors (ndc) (g) ");
    assert_ptr_equal(strstr(text, "# What depth resolves: near 0.5 m, far 100 m, 60 degrees, 8x6\n"), text);
    says("\nMade by `pinhole-depth all --near 0.5 --far 100.00002 --fov 60 --size 8x6 --out DIR`.\n");
    assert_string_equal(said.text, "");
}

static void a_section_has_its_command_table_remarks_and_plot(void **state)
{
    (void)state;
    assert_int_equal(report("section"), 0);
    says("\n## Adjacent pairs\n\nDistances in order from near to far: ");
    says("codes in the wrong order.\n\n`pinhole-depth pairs --near 0.5 --far 100.00002` ([pairs.csv](pairs.csv))\n\n"
         "| format | bits | near [m] | far [m] | spacing | pairs | equal (measured) | swapped (measured) | largest "
         "wrong [m] (measured) |\n|---|---|---|---|---|---|---|---|---|\n| pairs | 2 |\n| 3 |  |\n\n```text\n"
         "A remark.\nThe answer, of pairs.\n```\n\n![A plot](pairs.svg)\n\n"
         "`pinhole-depth plot pairs --near 0.5 --far 100.00002 --out pairs.svg`\n");
    says("`pinhole-depth slopes --near 0.5 --far 100.00002 --fov 60 --size 8x6` ([slopes.csv](slopes.csv))");
    says("`pinhole-depth anchors` ([anchors.csv](anchors.csv))");
    says("`pinhole-depth planes --near 0.5 --far 100.00002 --fov 60 --size 8x6 --out planes.png` ");
    says("\n![Pixels of both planes, right ones blue, wrong ones orange](planes.png)\n");
    says("`pinhole-depth plot g --out g.svg`\n");
}

static void advice_is_asked_for_at_the_far_plane(void **state)
{
    (void)state;
    lab.near_set = false;
    assert_int_equal(report("advice"), 0);
    assert_true(advised.near_set && advised.at_count == 1 && advised.at[0] == lab.far_z);
    assert_int_equal(advised.separate, 6554); /* 6553.601, upwards */
    says(" --size 8x6 --at 100.00002 --separate 0.1` ([advise.csv](advise.csv))");
    says("\n- A remark.\n- The answer, of advise.\n\n## Smallest separation");
}

static void the_files_have_the_rows_and_the_pictures(void **state)
{
    static const char *const files[][2] = {{"files/advise.csv", "a,b\nadvise,2\n3,\n"},
                                           {"files/anchors.csv", "a,b\nanchors,2\n3,\n"},
                                           {"files/others.svg", "others"},
                                           {"files/ndc.svg", "ndc"}};
    (void)state;
    assert_int_equal(report("files"), 0);
    for (int i = 0; i < 4; i++) {
        char *const is = read_text(files[i][0]);
        assert_string_equal(is, files[i][1]);
        free(is);
    }
}

static void without_gnuplot_a_line_stands_for_each_plot(void **state)
{
    (void)state;
    can_plot = false;
    assert_int_equal(report("no_plots"), 0);
    says("\nNo plot `others`: gnuplot is missing (`apt-get install gnuplot-nox`).\n");
    says("\nNo plot `g`: ");
    assert_null(strchr(ran, '('));
    assert_null(strstr(text, ".svg"));
}

static uint32_t row_of(const char *name)
{
    uint32_t i = 0;
    while (strcmp(lab_formats[i].name, name) != 0) {
        i++;
    }
    return i;
}

/* 100 m want 0.1 m, which are 6553.6 LSBs. */
static void the_cheapest_format_that_is_enough_is_the_answer(void **state)
{
    (void)state;
    worst[row_of("fixed24")] = 10;
    worst[row_of("float16")] = 6553;
    worst[row_of("linear-w")] = worst[row_of("float16-e3")] = 1; /* takes a division; is not what the renderer takes */
    assert_int_equal(report("answer"), 0);
    says("\n**Take `float16` (16 bits): with the near plane at 0.5 m it keeps surfaces that face the camera apart from "
         "0.1 m on, at every distance up to 100 m.**\n");
    worst[row_of("float16")] = 6554;
    assert_int_equal(report("answer"), 0);
    says("\n**Take `fixed24` (24 bits): ");
    says("apart from 0.000153 m on");
    worst[row_of("fixed24")] = 65000; /* of those that are not enough the finest */
    assert_int_equal(report("answer"), 0);
    says("\n**Take `float16` (16 bits): ");
    lab.far_z = FX_INT(1000); /* a metre is just enough */
    worst[row_of("fixed16")] = 65536;
    worst[row_of("float16")] = 65535;
    assert_int_equal(report("answer"), 0);
    says("\n**Take `fixed16` (16 bits): ");
}

static bool is_there(const char *name)
{
    struct stat status;
    return stat(file_path(name), &status) == 0;
}

static void a_failure_leaves_no_report_and_no_empty_folder(void **state)
{
    (void)state;
    failing = "advise";
    assert_int_equal(report("fails"), COMPLAINED);
    assert_string_equal(ran, "advise ");
    assert_false(is_there("fails"));
    assert_int_equal(mkdir(file_path("stays"), 0777), 0);
    assert_int_equal(report("stays"), COMPLAINED);
    assert_true(is_there("stays"));
    failing = "anchors";
    assert_int_equal(report("fails"), COMPLAINED);
    assert_true(is_there("fails/monotone.csv"));
    assert_false(is_there("fails/anchors.csv") || is_there("fails/report.md"));
}

static void a_folder_that_cannot_be_is_refused(void **state)
{
    char name[PATH_MAX];
    (void)state;
    assert_int_equal(report(NULL), PH_ERR_INVAL);
    assert_non_null(strstr(said.text, "all needs --out DIR"));
    file_text("file", "");
    assert_int_equal(report("file"), COMPLAINED);
    assert_non_null(strstr(said.text, "file: cannot be used as a directory: Not a directory"));
    assert_int_equal(report("no/folder"), COMPLAINED);
    assert_non_null(strstr(said.text, "No such file"));
    assert_string_equal(ran, "");
    snprintf(name, sizeof name, "%s", file_path(""));
    const size_t n = strlen(name); /* the folder's own name, made longer than a path may be with what is in it */
    for (size_t i = n; i < PATH_MAX - 8; i += 2) {
        memcpy(name + i, "./", 3);
    }
    lab.out = name;
    stderr_capture_begin(&said);
    assert_int_equal(depth_report(&lab), COMPLAINED);
    stderr_capture_end(&said);
    assert_non_null(strstr(said.text, "--out: this name is too long"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(every_command_and_plot_runs_once_in_order, fresh),
        cmocka_unit_test_setup(a_section_has_its_command_table_remarks_and_plot, fresh),
        cmocka_unit_test_setup(advice_is_asked_for_at_the_far_plane, fresh),
        cmocka_unit_test_setup(the_files_have_the_rows_and_the_pictures, fresh),
        cmocka_unit_test_setup(without_gnuplot_a_line_stands_for_each_plot, fresh),
        cmocka_unit_test_setup(the_cheapest_format_that_is_enough_is_the_answer, fresh),
        cmocka_unit_test_setup(a_failure_leaves_no_report_and_no_empty_folder, fresh),
        cmocka_unit_test_setup(a_folder_that_cannot_be_is_refused, fresh),
    };
    const int failed = cmocka_run_group_tests(tests, files_begin, files_end);
    free(text);
    return failed;
}
